#include "render/painter.h"

#include "base/parallel.h"
#include "render/gl.h"
#include "render/osmesa_context.h"
#include "render/shaders.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>

namespace weft {

namespace {

constexpr double k_penumbra = 0.0100; // radius of the soft edge, in half diagonals of the subject:
                                      // larger is softer, and needs more taps than 16
constexpr double k_light_margin = 1.05;
constexpr int k_lookup_size = 1024;  // colours of the map; fewer: steps show
constexpr int k_shadow_size = 1024;  // pixels a side; penumbra / texel of 4 to 5 suits 16 taps
constexpr double k_line_width = 0.9; // width of mesh lines, pixels at 720 lines
constexpr int k_most_taps = 18;
const Colour k_clay{0.37F, 0.315F, 0.275F};
const Colour k_backdrop_near{0.325F, 0.335F, 0.345F};
const Colour k_backdrop_far{0.030F, 0.040F, 0.055F};

/// The sun-like key light of the studio and the box that its shadow map covers.
struct KeyLight {
    Vec3 direction;       ///< towards the light, unit
    Vec3 counter;         ///< towards a weak light from the other side, unit
    Vec3 right, up;       ///< axes of the shadow map, unit
    double extent = 1.0;  ///< m, a side of the map
    double depth = 1.0;   ///< m, what light depth 0..1 spans
    double kernel = 0.01; ///< radius of the penumbra in units of the map
    Mat4f to_clip;        ///< world to the clip space of the shadow map
    Mat4f to_map;         ///< world to [0, 1]^3: texture place and depth
};

/// A key light from above the camera's left shoulder, fitted to the box.
KeyLight place_key_light(const Camera& camera, const Box3& subject) {
    const Vec3 centre = subject.isEmpty() ? Vec3::Zero().eval() : subject.center();
    const double radius = std::max(subject.isEmpty() ? 0.0 : 0.5 * subject.diagonal().norm(), 1e-4);
    const Vec3 side = camera.right;
    Vec3 front = side.cross(Vec3::UnitY()); // level, towards the camera
    front.normalize();

    KeyLight light;
    light.direction = (-0.60 * side + 0.88 * Vec3::UnitY() + 0.72 * front).normalized();
    light.counter = (0.85 * side + 0.25 * Vec3::UnitY() + 0.30 * front).normalized();
    light.right = Vec3::UnitY().cross(light.direction).normalized();
    light.up = light.direction.cross(light.right);
    light.extent = 2.0 * k_light_margin * radius;
    light.depth = 2.0 * light.extent;
    light.kernel = k_penumbra * radius / light.extent * 2.0;

    Eigen::Matrix4d world = Eigen::Matrix4d::Identity();
    world.block<1, 3>(0, 0) = light.right.transpose() * (2.0 / light.extent);
    world.block<1, 3>(1, 0) = light.up.transpose() * (2.0 / light.extent);
    world.block<1, 3>(2, 0) = -light.direction.transpose() * (2.0 / light.depth);
    world.block<3, 1>(0, 3) = -world.block<3, 3>(0, 0) * centre;
    Eigen::Matrix4d half = Eigen::Matrix4d::Identity() * 0.5;
    half(3, 3) = 1.0;
    half.block<3, 1>(0, 3) = Vec3::Constant(0.5);
    light.to_clip = world.cast<float>();
    light.to_map = (half * world).cast<float>();
    return light;
}

/// Points spread evenly over the unit disc (Vogel's spiral), x and y in turn. A multiple of
/// supersample^2, so that each pixel of a final pixel takes as many.
std::vector<float> shadow_taps(int supersample) {
    const int count = supersample == 3 ? 18 : 16;
    std::vector<float> taps;
    for (int i = 0; i < count; ++i) {
        const double r = std::sqrt((i + 0.5) / count);
        const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        taps.push_back(static_cast<float>(r * std::cos(angle)));
        taps.push_back(static_cast<float>(r * std::sin(angle)));
    }
    assert(taps.size() <= 2 * k_most_taps);
    return taps;
}

GLuint upload_lookup(const Gl& gl, const ColourScale& scale) {
    const std::vector<Colour> table = lookup_table(scale, k_lookup_size);
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, k_lookup_size, 1, 0, GL_RGB, GL_FLOAT, table.data());
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

void clear(const Gl& gl, bool colour) {
    const std::array<float, 4> nothing{0.0F, 0.0F, 0.0F, 0.0F};
    const float farthest = 1.0F;
    if (colour) {
        gl.ClearBufferfv(GL_COLOR, 0, nothing.data());
    }
    gl.ClearBufferfv(GL_DEPTH, 0, &farthest);
}

} // namespace

struct Painter::Buffers {
    OsMesaContext context;
    std::optional<CurrentContext> current; ///< while the members below are made
    Gl gl;
    Targets targets;
    MeshBuffer cloth, clay, floor;
    Program depth, cloth_light, clay_light, floor_light, value, resolve;
    GLuint lookup = 0, screen = 0;

    explicit Buffers(const PainterParams& p)
        : current(context), gl(load_gl()),
          targets(gl, p.size[0], p.size[1], p.supersample, k_shadow_size), cloth(gl), clay(gl),
          floor(gl), depth(gl, "depth", shaders::depth_vertex(), shaders::depth_fragment()),
          cloth_light(gl, "cloth", shaders::surface_vertex(), shaders::cloth_fragment()),
          clay_light(gl, "clay", shaders::surface_vertex(), shaders::clay_fragment()),
          floor_light(gl, "floor", shaders::surface_vertex(), shaders::floor_fragment()),
          value(gl, "value", shaders::surface_vertex(), shaders::value_fragment()),
          resolve(gl, "resolve", shaders::screen_vertex(), shaders::resolve_fragment()),
          lookup(upload_lookup(gl, p.scale)) {
        gl.GenVertexArrays(1, &screen);
        gl.Enable(GL_DEPTH_CLAMP);
        gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
        check_gl(gl, "setting up");
        current.reset();
    }

    void draw_shadow_map(const KeyLight& light) const;
    void light_up(const PainterParams& p, const DrawnScene& scene, const KeyLight& light) const;
    void set_light(const Program& program, const PainterParams& p, const KeyLight& light) const;
    Image resolve_picture(const PainterParams& p) const;
    void read_values(const PainterParams& p, ValuePicture& picture) const;
};

void Painter::Buffers::draw_shadow_map(const KeyLight& light) const {
    gl.BindFramebuffer(GL_FRAMEBUFFER, targets.shadow);
    gl.Viewport(0, 0, k_shadow_size, k_shadow_size);
    gl.Enable(GL_DEPTH_TEST);
    clear(gl, false);
    depth.use();
    depth.set("to_clip", light.to_clip);
    cloth.draw(gl);
    clay.draw(gl);
}

void Painter::Buffers::set_light(const Program& program,
                                 const PainterParams& p,
                                 const KeyLight& light) const {
    const std::vector<float> taps = shadow_taps(p.supersample);
    program.use();
    program.set("to_clip", p.camera.view_projection);
    program.set("eye", p.camera.eye);
    program.set("key_direction", light.direction);
    program.set("counter_direction", light.counter);
    program.set("light_right", light.right);
    program.set("light_up", light.up);
    program.set("to_light", light.to_map);
    program.set("texel", light.extent / k_shadow_size);
    program.set("light_depth", light.depth);
    program.set("kernel", light.kernel);
    program.set("all_taps", static_cast<int>(taps.size() / 2));
    program.set_points("taps", static_cast<int>(taps.size() / 2), taps.data());
    program.set("supersample", p.supersample);
    program.set("shadow_map", 0);
}

void Painter::Buffers::light_up(const PainterParams& p,
                                const DrawnScene& scene,
                                const KeyLight& light) const {
    gl.BindFramebuffer(GL_FRAMEBUFFER, targets.samples);
    gl.Viewport(0, 0, p.size[0] * p.supersample, p.size[1] * p.supersample);
    gl.Enable(GL_MULTISAMPLE);
    clear(gl, true);
    gl.ActiveTexture(GL_TEXTURE1);
    gl.BindTexture(GL_TEXTURE_2D, lookup);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, targets.shadow_texture);

    set_light(cloth_light, p, light);
    cloth_light.set("lookup", 1);
    cloth_light.set("range", p.scale.low, p.scale.high);
    cloth_light.set("below", linear_from_srgb(p.scale.map->below));
    cloth_light.set("above", linear_from_srgb(p.scale.map->above));
    const double scale = std::max(0.75, p.size[1] / 720.0);
    cloth_light.set("line_width", p.edges ? k_line_width * scale * p.supersample : 0.0);
    cloth.draw(gl);

    set_light(clay_light, p, light);
    clay_light.set("clay", k_clay);
    clay.draw(gl);

    set_light(floor_light, p, light);
    floor_light.set("centre", scene.floor_centre.cast<double>().eval());
    floor_light.set("radius", static_cast<double>(scene.floor_radius));
    floor.draw(gl);
}

Image Painter::Buffers::resolve_picture(const PainterParams& p) const {
    gl.BindFramebuffer(GL_FRAMEBUFFER, targets.picture);
    gl.Viewport(0, 0, p.size[0], p.size[1]);
    gl.Disable(GL_DEPTH_TEST);
    gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, targets.samples_texture);
    resolve.use();
    resolve.set("samples", 0);
    resolve.set("supersample", p.supersample);
    resolve.set("size", p.size[0], p.size[1]);
    resolve.set("backdrop_near", k_backdrop_near);
    resolve.set("backdrop_far", k_backdrop_far);
    gl.BindVertexArray(screen);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);

    Image image(p.size[0], p.size[1]);
    std::vector<std::uint8_t> rgba(image.rgb.size() / 3 * 4);
    gl.ReadPixels(0, 0, p.size[0], p.size[1], GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    for (int y = 0; y < image.height; ++y) { // OpenGL's rows go up
        const std::uint8_t* from = rgba.data() + static_cast<std::size_t>(image.height - 1 - y) *
                                                     static_cast<std::size_t>(image.width) * 4;
        std::uint8_t* to = image.pixel(0, y);
        for (int x = 0; x < image.width; ++x, from += 4, to += 3) {
            std::copy(from, from + 3, to);
        }
    }
    return image;
}

void Painter::Buffers::read_values(const PainterParams& p, ValuePicture& picture) const {
    gl.BindFramebuffer(GL_FRAMEBUFFER, targets.values);
    gl.Viewport(0, 0, p.size[0], p.size[1]);
    gl.Enable(GL_DEPTH_TEST);
    clear(gl, true);
    value.use();
    value.set("to_clip", p.camera.view_projection);
    value.set("is_cloth", 0);
    clay.draw(gl);
    floor.draw(gl);
    value.set("is_cloth", 1);
    cloth.draw(gl);

    picture.width = p.size[0];
    picture.height = p.size[1];
    const std::size_t count =
        static_cast<std::size_t>(p.size[0]) * static_cast<std::size_t>(p.size[1]);
    std::vector<float> pairs(2 * count);
    gl.ReadPixels(0, 0, p.size[0], p.size[1], GL_RG, GL_FLOAT, pairs.data());
    picture.values.resize(count);
    picture.cloth.resize(count);
    const auto width = static_cast<std::size_t>(p.size[0]);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t from = count - width - i / width * width + i % width;
        picture.values[i] = pairs[2 * from];
        picture.cloth[i] = pairs[2 * from + 1] > 0.5F ? 1 : 0;
    }
}

Painter::Painter(const PainterParams& params)
    : params_(params), buffers_(std::make_unique<Buffers>(params)) {
    assert(params.supersample >= 1 && params.supersample <= 4);
}

Painter::~Painter() {
    const CurrentContext current(buffers_->context);
    Buffers& b = *buffers_;
    b.targets.release(b.gl);
    for (MeshBuffer* buffer : {&b.cloth, &b.clay, &b.floor}) {
        buffer->release(b.gl);
    }
    for (Program* program :
         {&b.depth, &b.cloth_light, &b.clay_light, &b.floor_light, &b.value, &b.resolve}) {
        program->release();
    }
    b.gl.DeleteTextures(1, &b.lookup);
    b.gl.DeleteVertexArrays(1, &b.screen);
}

Image Painter::paint(const DrawnScene& scene, ValuePicture* values) {
    const CurrentContext current(buffers_->context);
    const Buffers& b = *buffers_;
    const KeyLight light = place_key_light(params_.camera, scene.subject);
    buffers_->cloth.upload(b.gl, scene.cloth, true);
    buffers_->clay.upload(b.gl, scene.clay, false);
    buffers_->floor.upload(b.gl, scene.floor, false);

    b.draw_shadow_map(light);
    b.light_up(params_, scene, light);
    Image image = b.resolve_picture(params_);
    if (values != nullptr) {
        b.read_values(params_, *values);
    }
    check_gl(b.gl, "drawing");
    return image;
}

} // namespace weft

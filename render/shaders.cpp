#include "render/shaders.h"

namespace weft::shaders {

std::string depth_vertex() {
    return R"(
layout(location = 0) in vec3 position;
uniform mat4 to_clip;
void main() { gl_Position = to_clip * vec4(position, 1.0); }
)";
}

std::string depth_fragment() {
    return "void main() {}\n";
}

std::string surface_vertex() {
    return R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 ambient;   // front sky, front floor, back sky, back floor
layout(location = 3) in float value;
uniform mat4 to_clip;
out vec3 world_position;
out vec3 world_normal;
out vec4 ambient_light;
out vec3 corner;                        // barycentric; drawn without indices
centroid out float shown_value;
void main() {
    gl_Position = to_clip * vec4(position, 1.0);
    world_position = position;
    world_normal = normal;
    ambient_light = ambient;
    int k = gl_VertexID % 3;
    corner = vec3(k == 0, k == 1, k == 2);
    shown_value = value;
}
)";
}

namespace {

/// What the lit materials share: key light with a soft shadow, ambient light, a weak counter light.
///
/// The shadow kernel is a disc of `all_taps` points; each of the supersample^2 pixels that make
/// one final pixel takes its own part of them, so that the final pixel sees the whole disc.
/// Each tap compares against the receiver's own plane, which keeps wide kernels free of acne.
const char* const k_lighting = R"(
in vec3 world_position;
in vec3 world_normal;
in vec4 ambient_light;
uniform vec3 eye;
uniform vec3 key_direction;             // towards the light
uniform vec3 light_right;
uniform vec3 light_up;
uniform mat4 to_light;                  // world to [0, 1]^3
uniform float texel;                    // side of a texel of the shadow map, m
uniform float light_depth;              // m that one unit of light depth spans
uniform float kernel;                   // radius of the penumbra, in units of the map
uniform vec2 taps[18];
uniform int all_taps;
uniform int supersample;
uniform vec3 counter_direction;
uniform sampler2DShadow shadow_map;

const float k_key = 0.84;
const float k_sky = 0.27;
const float k_floor = 0.13;
const float k_counter = 0.11;

float key_visibility(vec3 n) {
    float facing = max(dot(n, key_direction), 0.1);
    vec2 slope = clamp(-vec2(dot(n, light_right), dot(n, light_up)) / facing, -2.5, 2.5);
    vec3 place = (to_light * vec4(world_position + n * texel * 1.5, 1.0)).xyz;
    place.z -= (0.5 + abs(slope.x) + abs(slope.y)) * texel / light_depth; // over one texel's reach
    float per_map_unit = kernel * (texel * float(textureSize(shadow_map, 0).x)) / light_depth;
    vec2 plane = -slope * per_map_unit;
    bool outside = any(lessThan(place.xy, vec2(0.0))) || any(greaterThan(place.xy, vec2(1.0)));
    ivec2 pixel = ivec2(gl_FragCoord.xy) % supersample;
    int stride = supersample * supersample;
    float open = 0.0;
    float count = 0.0;
    int last = (outside || dot(n, key_direction) <= 0.0) ? 0 : all_taps;
    for (int i = pixel.y * supersample + pixel.x; i < last; i += stride) {
        vec2 tap = taps[i];
        open += texture(shadow_map,
            vec3(place.xy + tap * kernel, min(place.z + dot(plane, tap), 0.9999)));
        count += 1.0;
    }
    return count > 0.0 ? open / count : 1.0;
}
)";

} // namespace

std::string cloth_fragment() {
    return std::string(k_lighting) + R"(
in vec3 corner;
centroid in float shown_value;
uniform sampler2D lookup;               // colours over [low, high], linear light
uniform vec2 range;
uniform vec3 below;
uniform vec3 above;
uniform float line_width;               // in pixels of this buffer; 0: none
out vec4 colour;

vec3 shown_colour() {
    if (shown_value < range.x) { return below; }
    if (shown_value > range.y) { return above; }
    float size = float(textureSize(lookup, 0).x);
    float t = (shown_value - range.x) / (range.y - range.x);
    return texture(lookup, vec2((t * (size - 1.0) + 0.5) / size, 0.5)).rgb;
}

/// Share of a mesh line here; lines fade where triangles are only a few pixels high.
float mesh_line() {
    vec3 change = fwidth(corner);
    vec3 away = corner / max(change, vec3(1e-8));
    float nearest = min(away.x, min(away.y, away.z));
    float height = 1.0 / max(change.x, max(change.y, change.z));
    float line = 1.0 - smoothstep(0.5 * line_width - 0.6, 0.5 * line_width + 0.6, nearest);
    return line * smoothstep(2.5 * line_width, 7.0 * line_width, height);
}

void main() {
    float side = gl_FrontFacing ? 1.0 : -1.0;
    vec3 n = normalize(world_normal) * side;
    vec2 open = side > 0.0 ? ambient_light.xy : ambient_light.zw;
    vec3 to_eye = normalize(eye - world_position);

    float key = max(dot(n, key_direction), 0.0);
    float through = max(-dot(n, key_direction), 0.0);     // cloth is a little translucent
    float light = k_key * key * key_visibility(n);
    light += k_sky * open.x + k_floor * open.y;
    light += k_counter * max(dot(n, counter_direction), 0.0) * (open.x + open.y) + 0.04 * through;
    float rim = pow(1.0 - max(dot(n, to_eye), 0.0), 4.0); // fibres that stand off the surface
    vec3 base = shown_colour();
    vec3 lit = base * light + vec3(0.05) * rim * (open.x + open.y);
    if (line_width > 0.0) {
        lit *= 1.0 - 0.36 * mesh_line();
    }
    colour = vec4(lit, 1.0);
}
)";
}

std::string clay_fragment() {
    return std::string(k_lighting) + R"(
uniform vec3 clay;
out vec4 colour;
void main() {
    float side = gl_FrontFacing ? 1.0 : -1.0;
    vec3 n = normalize(world_normal) * side;
    vec2 open = side > 0.0 ? ambient_light.xy : ambient_light.zw;
    vec3 to_eye = normalize(eye - world_position);
    float key = max(dot(n, key_direction), 0.0);
    float seen = key_visibility(n);
    vec3 light = k_key * key * seen * vec3(1.03, 1.0, 0.96);
    light += k_sky * open.x * vec3(0.94, 1.0, 1.08) + k_floor * open.y * vec3(1.06, 1.0, 0.92);
    light += vec3(k_counter * max(dot(n, counter_direction), 0.0) * (open.x + open.y));
    float gloss = pow(max(dot(n, normalize(key_direction + to_eye)), 0.0), 24.0);
    colour = vec4(clay * light + vec3(0.05) * gloss * seen * key, 1.0);
}
)";
}

std::string floor_fragment() {
    return std::string(k_lighting) + R"(
uniform vec3 centre;
uniform float radius;
out vec4 colour;
void main() {
    vec3 n = vec3(0.0, 1.0, 0.0);
    float key = k_key * key_direction.y;
    float full = key + k_sky;
    float light = key * key_visibility(n) + k_sky * ambient_light.x;
    float fade = 1.0 - smoothstep(0.55, 1.0, length(world_position.xz - centre.xz) / radius);
    colour = vec4(0.0, 0.0, 0.0, clamp(1.0 - light / full, 0.0, 1.0) * fade);
}
)";
}

std::string value_fragment() {
    return R"(
centroid in float shown_value;
uniform int is_cloth;
out vec4 value;
void main() { value = vec4(shown_value, float(is_cloth), 0.0, 1.0); }
)";
}

std::string screen_vertex() {
    return R"(
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
)";
}

std::string resolve_fragment() {
    return R"(
uniform sampler2DMS samples;
uniform int supersample;
uniform vec2 size;                      // size of the picture, pixels
uniform vec3 backdrop_near;             // linear light: round the middle of the picture
uniform vec3 backdrop_far;              // towards its corners
out vec4 colour;

vec3 backdrop() {
    vec2 p = (gl_FragCoord.xy / size - vec2(0.5, 0.42)) * vec2(size.x / size.y, 1.0);
    float away = length(p * vec2(0.72, 1.0));
    return mix(backdrop_near, backdrop_far, smoothstep(0.0, 1.0, away));
}

float threshold() {                     // interleaved gradient noise, Jimenez 2014
    return fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
}

void main() {
    vec4 sum = vec4(0.0);
    ivec2 corner = ivec2(gl_FragCoord.xy) * supersample;
    for (int y = 0; y < supersample; ++y) {
        for (int x = 0; x < supersample; ++x) {
            ivec2 at = corner + ivec2(x, y);
            sum += min(texelFetch(samples, at, 0), vec4(1.0))
                + min(texelFetch(samples, at, 1), vec4(1.0))
                + min(texelFetch(samples, at, 2), vec4(1.0))
                + min(texelFetch(samples, at, 3), vec4(1.0));
        }
    }
    sum /= float(4 * supersample * supersample);
    vec3 linear = sum.rgb + (1.0 - sum.a) * backdrop();
    vec3 srgb = mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055,
        step(vec3(0.0031308), linear));
    colour = vec4(srgb + (threshold() - 0.5) / 255.0, 1.0);
}
)";
}

} // namespace weft::shaders

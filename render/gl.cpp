#include "render/gl.h"

#include "base/error.h"
#include "render/osmesa_context.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace weft {

namespace {

template <typename F> void load(F& function, const char* name) {
    function = reinterpret_cast<F>(OsMesaContext::function(name));
    if (function == nullptr) {
        fail_disk("OSMesa: {}: the library does not have this OpenGL function", name);
    }
}

std::string first_line(const char* text) {
    const std::string whole(text);
    return whole.substr(0, whole.find('\n'));
}

GLuint compile(const Gl& gl, const char* name, GLenum kind, const std::string& source) {
    const std::string whole = "#version 330 core\n" + source;
    const char* text = whole.c_str();
    const GLuint shader = gl.CreateShader(kind);
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    GLint compiled = GL_FALSE;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_FALSE) {
        std::array<char, 1024> log{};
        gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
        fail_disk("OpenGL: {} {} shader: {}", name,
                  kind == GL_VERTEX_SHADER ? "vertex" : "fragment", first_line(log.data()));
    }
    return shader;
}

} // namespace

Gl load_gl() {
    Gl gl;
#define WEFT_GL_LOAD(type, name) load(gl.name, "gl" #name);
    WEFT_GL_FUNCTIONS(WEFT_GL_LOAD)
#undef WEFT_GL_LOAD
    return gl;
}

GLuint link_program(const Gl& gl,
                    const char* name,
                    const std::string& vertex,
                    const std::string& fragment) {
    const GLuint program = gl.CreateProgram();
    const std::array<GLuint, 2> shaders{compile(gl, name, GL_VERTEX_SHADER, vertex),
                                        compile(gl, name, GL_FRAGMENT_SHADER, fragment)};
    for (const GLuint shader : shaders) {
        gl.AttachShader(program, shader);
        gl.DeleteShader(shader); // lives on with the program
    }
    gl.LinkProgram(program);
    GLint linked = GL_FALSE;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) {
        std::array<char, 1024> log{};
        gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
        fail_disk("OpenGL: {} program: {}", name, first_line(log.data()));
    }
    return program;
}

void check_gl(const Gl& gl, const char* stage) {
    const GLenum error = gl.GetError();
    if (error == GL_OUT_OF_MEMORY) {
        fail_disk("OpenGL: {}: out of memory", stage);
    }
    if (error != GL_NO_ERROR) {
        fail_disk("OpenGL: {}: error {:#x}", stage, error);
    }
}

namespace {

GLuint new_renderbuffer(const Gl& gl, GLenum format, int width, int height, int samples) {
    GLuint buffer = 0;
    gl.GenRenderbuffers(1, &buffer);
    gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
    return buffer;
}

GLuint new_framebuffer(const Gl& gl) {
    GLuint framebuffer = 0;
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    return framebuffer;
}

void attach(const Gl& gl, GLenum place, GLuint renderbuffer) {
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, renderbuffer);
}

void check_complete(const Gl& gl, const char* name, int width, int height) {
    check_gl(gl, name);
    const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        fail_disk("OpenGL: {} of {} x {} pixels: not possible here ({:#x})", name, width, height,
                  status);
    }
}

constexpr int k_samples = 4;

struct Vertex {
    std::array<float, 3> position;
    std::array<float, 3> normal;
    Ambient ambient;
    float value;
};

Vertex vertex_at(const Surface& s, std::size_t v) {
    const Vec3f& x = s.positions[v];
    const Vec3f& n = s.normals[v];
    return {{x.x(), x.y(), x.z()}, {n.x(), n.y(), n.z()}, s.ambient[v], s.values[v]};
}

void describe(const Gl& gl, GLuint location, GLint components, std::size_t offset) {
    gl.EnableVertexAttribArray(location);
    gl.VertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                           reinterpret_cast<const void*>(offset)); // OpenGL's way to pass an offset
}

} // namespace

Targets::Targets(const Gl& gl, int width, int height, int supersample, int shadow_size) {
    const int wide = width * supersample;
    const int high = height * supersample;

    samples = new_framebuffer(gl);
    gl.GenTextures(1, &samples_texture);
    gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, samples_texture);
    gl.TexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, k_samples, GL_RGBA16F, wide, high, GL_TRUE);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE,
                            samples_texture, 0);
    samples_depth = new_renderbuffer(gl, GL_DEPTH_COMPONENT32F, wide, high, k_samples);
    attach(gl, GL_DEPTH_ATTACHMENT, samples_depth);
    check_complete(gl, "multisampled picture", wide, high);

    shadow = new_framebuffer(gl);
    gl.GenTextures(1, &shadow_texture);
    gl.BindTexture(GL_TEXTURE_2D, shadow_texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, shadow_size, shadow_size, 0,
                  GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadow_texture, 0);
    gl.DrawBuffer(GL_NONE);
    gl.ReadBuffer(GL_NONE);
    check_complete(gl, "shadow map", shadow_size, shadow_size);

    picture = new_framebuffer(gl);
    picture_colour = new_renderbuffer(gl, GL_RGBA8, width, height, 0);
    attach(gl, GL_COLOR_ATTACHMENT0, picture_colour);
    check_complete(gl, "picture", width, height);

    values = new_framebuffer(gl);
    values_colour = new_renderbuffer(gl, GL_RG32F, width, height, 0);
    values_depth = new_renderbuffer(gl, GL_DEPTH_COMPONENT32F, width, height, 0);
    attach(gl, GL_COLOR_ATTACHMENT0, values_colour);
    attach(gl, GL_DEPTH_ATTACHMENT, values_depth);
    check_complete(gl, "value picture", width, height);
}

void Targets::release(const Gl& gl) {
    for (const GLuint framebuffer : {samples, shadow, picture, values}) {
        gl.DeleteFramebuffers(1, &framebuffer);
    }
    for (const GLuint buffer : {samples_depth, picture_colour, values_colour, values_depth}) {
        gl.DeleteRenderbuffers(1, &buffer);
    }
    for (const GLuint texture : {samples_texture, shadow_texture}) {
        gl.DeleteTextures(1, &texture);
    }
}

MeshBuffer::MeshBuffer(const Gl& gl) {
    gl.GenVertexArrays(1, &array_);
    gl.GenBuffers(1, &vertices_);
    gl.GenBuffers(1, &indices_);
    gl.BindVertexArray(array_);
    gl.BindBuffer(GL_ARRAY_BUFFER, vertices_);
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
    describe(gl, 0, 3, offsetof(Vertex, position));
    describe(gl, 1, 3, offsetof(Vertex, normal));
    describe(gl, 2, 4, offsetof(Vertex, ambient));
    describe(gl, 3, 1, offsetof(Vertex, value));
}

void MeshBuffer::release(const Gl& gl) {
    gl.DeleteVertexArrays(1, &array_);
    gl.DeleteBuffers(1, &vertices_);
    gl.DeleteBuffers(1, &indices_);
}

void MeshBuffer::upload(const Gl& gl, const Surface& surface, bool expanded) {
    expanded_ = expanded;
    count_ = static_cast<GLsizei>(3 * surface.triangles.size());
    std::vector<Vertex> vertices;
    if (expanded) {
        vertices.reserve(3 * surface.triangles.size());
        for (const Triangle& t : surface.triangles) {
            for (const Index v : t) {
                vertices.push_back(vertex_at(surface, static_cast<std::size_t>(v)));
            }
        }
    } else {
        vertices.reserve(surface.positions.size());
        for (std::size_t v = 0; v < surface.positions.size(); ++v) {
            vertices.push_back(vertex_at(surface, v));
        }
    }
    gl.BindVertexArray(array_);
    gl.BindBuffer(GL_ARRAY_BUFFER, vertices_);
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)),
                  vertices.data(), GL_STREAM_DRAW);
    if (!expanded) {
        gl.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                      static_cast<GLsizeiptr>(surface.triangles.size() * sizeof(Triangle)),
                      surface.triangles.data(), GL_STREAM_DRAW);
    }
}

void MeshBuffer::draw(const Gl& gl) const {
    if (count_ == 0) {
        return;
    }
    gl.BindVertexArray(array_);
    if (expanded_) {
        gl.DrawArrays(GL_TRIANGLES, 0, count_);
    } else {
        gl.DrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
    }
}

} // namespace weft

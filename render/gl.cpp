#include "render/gl.h"

#include "base/error.h"
#include "render/osmesa_context.h"

#include <array>

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

} // namespace weft

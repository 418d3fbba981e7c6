#pragma once

#include "render/camera.h"
#include "render/colour_map.h"
#include "render/gl.h"

namespace weft {

/// A linked program and the setting of its uniforms by name (a name that the compiler dropped is
/// ignored by OpenGL). `use` first.
class Program {
public:
    Program(const Gl& gl, const char* name, const std::string& vertex, const std::string& fragment)
        : gl_(&gl), id_(link_program(gl, name, vertex, fragment)) {}
    void release() { gl_->DeleteProgram(id_); }

    void use() const { gl_->UseProgram(id_); }
    void set(const char* name, int value) const { gl_->Uniform1i(at(name), value); }
    void set(const char* name, double value) const {
        gl_->Uniform1f(at(name), static_cast<float>(value));
    }
    void set(const char* name, double x, double y) const {
        gl_->Uniform2f(at(name), static_cast<float>(x), static_cast<float>(y));
    }
    void set(const char* name, const Vec3& v) const {
        const Vec3f f = v.cast<float>();
        gl_->Uniform3f(at(name), f.x(), f.y(), f.z());
    }
    void set(const char* name, const Colour& c) const {
        gl_->Uniform3f(at(name), c[0], c[1], c[2]);
    }
    void set(const char* name, const Mat4f& m) const {
        gl_->UniformMatrix4fv(at(name), 1, GL_FALSE, m.data());
    }
    /// `points` is count pairs.
    void set_points(const char* name, int count, const float* points) const {
        gl_->Uniform2fv(at(name), count, points);
    }

private:
    GLint at(const char* name) const { return gl_->GetUniformLocation(id_, name); }

    const Gl* gl_;
    GLuint id_;
};

} // namespace weft

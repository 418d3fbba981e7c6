#pragma once

#include "render/camera.h"
#include "render/colour_map.h"
#include "render/surface.h"

#include <GL/glcorearb.h>

#include <span>
#include <string>
#include <vector>

namespace weft {

/// Every OpenGL function that the renderer calls.
#define WEFT_GL_FUNCTIONS(F)                                                                       \
    F(PFNGLACTIVETEXTUREPROC, ActiveTexture)                                                       \
    F(PFNGLATTACHSHADERPROC, AttachShader)                                                         \
    F(PFNGLBINDBUFFERPROC, BindBuffer)                                                             \
    F(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                                                   \
    F(PFNGLBINDRENDERBUFFERPROC, BindRenderbuffer)                                                 \
    F(PFNGLBINDTEXTUREPROC, BindTexture)                                                           \
    F(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                                                   \
    F(PFNGLBLITFRAMEBUFFERPROC, BlitFramebuffer)                                                   \
    F(PFNGLBUFFERDATAPROC, BufferData)                                                             \
    F(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)                                     \
    F(PFNGLCLEARPROC, Clear)                                                                       \
    F(PFNGLCLEARBUFFERFVPROC, ClearBufferfv)                                                       \
    F(PFNGLCLEARBUFFERUIVPROC, ClearBufferuiv)                                                     \
    F(PFNGLCOMPILESHADERPROC, CompileShader)                                                       \
    F(PFNGLCREATEPROGRAMPROC, CreateProgram)                                                       \
    F(PFNGLCREATESHADERPROC, CreateShader)                                                         \
    F(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                                       \
    F(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                                             \
    F(PFNGLDELETEPROGRAMPROC, DeleteProgram)                                                       \
    F(PFNGLDELETERENDERBUFFERSPROC, DeleteRenderbuffers)                                           \
    F(PFNGLDELETESHADERPROC, DeleteShader)                                                         \
    F(PFNGLDELETETEXTURESPROC, DeleteTextures)                                                     \
    F(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                                             \
    F(PFNGLDISABLEPROC, Disable)                                                                   \
    F(PFNGLDRAWARRAYSPROC, DrawArrays)                                                             \
    F(PFNGLDRAWBUFFERPROC, DrawBuffer)                                                             \
    F(PFNGLDRAWELEMENTSPROC, DrawElements)                                                         \
    F(PFNGLENABLEPROC, Enable)                                                                     \
    F(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray)                                   \
    F(PFNGLFINISHPROC, Finish)                                                                     \
    F(PFNGLFRAMEBUFFERRENDERBUFFERPROC, FramebufferRenderbuffer)                                   \
    F(PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D)                                         \
    F(PFNGLGENBUFFERSPROC, GenBuffers)                                                             \
    F(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                                                   \
    F(PFNGLGENRENDERBUFFERSPROC, GenRenderbuffers)                                                 \
    F(PFNGLGENTEXTURESPROC, GenTextures)                                                           \
    F(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                                                   \
    F(PFNGLGETERRORPROC, GetError)                                                                 \
    F(PFNGLGETINTEGERVPROC, GetIntegerv)                                                           \
    F(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                                               \
    F(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                                         \
    F(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                                                 \
    F(PFNGLGETSHADERIVPROC, GetShaderiv)                                                           \
    F(PFNGLGETSTRINGPROC, GetString)                                                               \
    F(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                                             \
    F(PFNGLLINKPROGRAMPROC, LinkProgram)                                                           \
    F(PFNGLPIXELSTOREIPROC, PixelStorei)                                                           \
    F(PFNGLPOLYGONOFFSETPROC, PolygonOffset)                                                       \
    F(PFNGLREADBUFFERPROC, ReadBuffer)                                                             \
    F(PFNGLREADPIXELSPROC, ReadPixels)                                                             \
    F(PFNGLRENDERBUFFERSTORAGEPROC, RenderbufferStorage)                                           \
    F(PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC, RenderbufferStorageMultisample)                     \
    F(PFNGLSHADERSOURCEPROC, ShaderSource)                                                         \
    F(PFNGLTEXIMAGE2DPROC, TexImage2D)                                                             \
    F(PFNGLTEXIMAGE2DMULTISAMPLEPROC, TexImage2DMultisample)                                       \
    F(PFNGLTEXPARAMETERIPROC, TexParameteri)                                                       \
    F(PFNGLUNIFORM1FPROC, Uniform1f)                                                               \
    F(PFNGLUNIFORM1IPROC, Uniform1i)                                                               \
    F(PFNGLUNIFORM2FPROC, Uniform2f)                                                               \
    F(PFNGLUNIFORM2FVPROC, Uniform2fv)                                                             \
    F(PFNGLUNIFORM3FPROC, Uniform3f)                                                               \
    F(PFNGLUNIFORMMATRIX4FVPROC, UniformMatrix4fv)                                                 \
    F(PFNGLUSEPROGRAMPROC, UseProgram)                                                             \
    F(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)                                           \
    F(PFNGLVIEWPORTPROC, Viewport)

/// The functions, loaded by name: `gl.Clear(...)`.
struct Gl {
#define WEFT_GL_MEMBER(type, name) type name = nullptr;
    WEFT_GL_FUNCTIONS(WEFT_GL_MEMBER)
#undef WEFT_GL_MEMBER
};

/// Loads all of them; the context must be current. Throws Error (Disk) naming the missing one.
Gl load_gl();

/// Compiles and links a program from vertex and fragment sources (GLSL 330, without the #version
/// line). Throws Error (Disk) with `name` and the compiler's words.
GLuint link_program(const Gl& gl,
                    const char* name,
                    const std::string& vertex,
                    const std::string& fragment);

/// Throws Error (Disk) with `stage` when OpenGL has reported an error since the last call.
void check_gl(const Gl& gl, const char* stage);

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

/// Framebuffers of one picture size. Made once, drawn into for each frame; the context must be
/// current for every call.
class Targets {
public:
    Targets(const Gl& gl, int width, int height, int supersample, int shadow_size);
    void release(const Gl& gl);

    /// Samples of light: 4 a pixel, supersample^2 pixels a final pixel; RGB premultiplied, and how
    /// much of the backdrop is hidden as alpha.
    GLuint samples = 0, samples_texture = 0, samples_depth = 0;
    /// Depth seen from the light.
    GLuint shadow = 0, shadow_texture = 0;
    /// The picture, 8 bits a channel.
    GLuint picture = 0, picture_colour = 0;
    /// Value and cloth flag of each final pixel.
    GLuint values = 0, values_colour = 0, values_depth = 0;
};

/// A surface on the OpenGL side. Attributes: 0 position, 1 normal, 2 ambient, 3 value.
class MeshBuffer {
public:
    explicit MeshBuffer(const Gl& gl);
    void release(const Gl& gl);

    /// Replaces the contents. `expanded`: each triangle gets its own three vertices in order, so
    /// that a shader can tell corners apart.
    void upload(const Gl& gl, const Surface& surface, bool expanded);
    void draw(const Gl& gl) const;

private:
    GLuint array_ = 0, vertices_ = 0, indices_ = 0;
    GLsizei count_ = 0;
    bool expanded_ = false;
};

} // namespace weft

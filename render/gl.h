#pragma once

#include <GL/glcorearb.h>

#include <span>
#include <string>

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

} // namespace weft

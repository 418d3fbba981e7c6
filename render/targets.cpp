#include "render/targets.h"

#include "base/error.h"

namespace weft {

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

} // namespace weft

#include "render/osmesa_context.h"

#include "base/error.h"

#include <GL/osmesa.h>

#include <array>

namespace weft {

namespace {

constexpr int k_token_size = 16; // pixels a side of the context's own, unused buffer

OSMesaContext create(int major, int minor) {
    const std::array<int, 13> attributes{OSMESA_FORMAT,
                                         OSMESA_RGBA,
                                         OSMESA_DEPTH_BITS,
                                         0,
                                         OSMESA_STENCIL_BITS,
                                         0,
                                         OSMESA_PROFILE,
                                         OSMESA_CORE_PROFILE,
                                         OSMESA_CONTEXT_MAJOR_VERSION,
                                         major,
                                         OSMESA_CONTEXT_MINOR_VERSION,
                                         minor,
                                         0};
    return OSMesaCreateContextAttribs(attributes.data(), nullptr);
}

} // namespace

OsMesaContext::OsMesaContext() : token_buffer_(4 * k_token_size * k_token_size) {
    handle_ = create(4, 5);
    if (handle_ == nullptr) {
        handle_ = create(3, 3);
    }
    if (handle_ == nullptr) {
        fail_disk("OSMesa: no OpenGL 4.5 or 3.3 core context: install libosmesa6, or write no "
                  "pictures");
    }
}

OsMesaContext::~OsMesaContext() {
    OSMesaDestroyContext(static_cast<OSMesaContext>(handle_));
}

OsMesaContext::Function OsMesaContext::function(const char* name) {
    return OSMesaGetProcAddress(name);
}

CurrentContext::CurrentContext(OsMesaContext& context) {
    if (OSMesaMakeCurrent(static_cast<OSMesaContext>(context.handle_), context.token_buffer_.data(),
                          GL_UNSIGNED_BYTE, k_token_size, k_token_size) == GL_FALSE) {
        fail_disk("OSMesa: OSMesaMakeCurrent: refused on this thread");
    }
}

CurrentContext::~CurrentContext() {
    OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
}

} // namespace weft

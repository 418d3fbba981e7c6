#pragma once

#include <vector>

namespace weft {

/// An OpenGL context in main memory, without display or GPU: 4.5 core, or 3.3 core where the
/// library has no more. Everything is drawn into framebuffer objects; the context's own buffer is a
/// token.
class OsMesaContext {
public:
    /// Throws Error (Disk) with the versions tried.
    OsMesaContext();
    ~OsMesaContext();
    OsMesaContext(const OsMesaContext&) = delete;
    OsMesaContext& operator=(const OsMesaContext&) = delete;

    using Function = void (*)();
    /// Address of an OpenGL function by name; null when the library has none.
    static Function function(const char* name);

private:
    friend class CurrentContext;
    void* handle_ = nullptr;
    std::vector<unsigned char> token_buffer_;
};

/// Makes the context current on the calling thread while it lives. A context is current on one
/// thread at a time; which one may change between frames.
class CurrentContext {
public:
    explicit CurrentContext(OsMesaContext& context);
    ~CurrentContext();
    CurrentContext(const CurrentContext&) = delete;
    CurrentContext& operator=(const CurrentContext&) = delete;
};

} // namespace weft

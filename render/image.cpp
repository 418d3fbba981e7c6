#include "render/image.h"

#include "base/error.h"

#include <libdeflate.h>

#include <cassert>
#include <cstdlib>

namespace {

constexpr int k_compression = 6; // libdeflate's own default; 9 costs twice the time for 1 %

/// stb_image_write's hook: a zlib stream in memory of malloc, or null.
unsigned char* compress(unsigned char* data, int size, int* compressed_size, int /*quality*/) {
    libdeflate_compressor* compressor = libdeflate_alloc_compressor(k_compression);
    if (compressor == nullptr) {
        return nullptr;
    }
    const auto count = static_cast<std::size_t>(size);
    const std::size_t bound = libdeflate_zlib_compress_bound(compressor, count);
    auto* result = static_cast<unsigned char*>(std::malloc(bound));
    if (result != nullptr) {
        *compressed_size =
            static_cast<int>(libdeflate_zlib_compress(compressor, data, count, result, bound));
    }
    libdeflate_free_compressor(compressor);
    return result;
}

} // namespace

#define STBIW_ZLIB_COMPRESS compress
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace weft {

std::string encode_png(const Image& image) {
    assert(image.width > 0 && image.height > 0);
    std::string bytes;
    const auto append = [](void* context, void* data, int size) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                                   static_cast<std::size_t>(size));
    };
    if (stbi_write_png_to_func(append, &bytes, image.width, image.height, 3, image.rgb.data(),
                               3 * image.width) == 0) {
        fail_disk("png: {} x {} pixels: out of memory", image.width, image.height);
    }
    return bytes;
}

} // namespace weft

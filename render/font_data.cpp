#include "render/font_data.h"

// WEFT_FONT_FILE is the path that CMake found; the assembler copies the file in as it stands.
asm(".section .rodata\n"
    ".balign 16\n"
    "weft_font_begin:\n"
    ".incbin \"" WEFT_FONT_FILE "\"\n"
    "weft_font_end:\n"
    ".byte 0\n"
    ".text\n");

extern "C" {
extern const unsigned char weft_font_begin[]; // NOLINT: named by the assembler
extern const unsigned char weft_font_end[];   // NOLINT
}

namespace weft {

std::span<const unsigned char> font_data() {
    return {weft_font_begin, weft_font_end};
}

} // namespace weft

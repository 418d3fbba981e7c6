#include "support/paths.h"

namespace weft::test {

std::filesystem::path source_path(const std::string& relative) {
    return std::filesystem::path(WEFT_SOURCE_DIR) / relative;
}

std::filesystem::path weft_binary() {
    return WEFT_BINARY;
}

} // namespace weft::test

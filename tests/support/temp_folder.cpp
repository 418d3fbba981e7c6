#include "support/temp_folder.h"

#include <stdlib.h>

#include <stdexcept>
#include <string>

namespace weft::test {

TempFolder::TempFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "weft-test-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
        throw std::runtime_error("cannot make a temporary folder");
    }
    path_ = name;
}

TempFolder::~TempFolder() {
    std::error_code ignored; // a test that failed may have taken the rights away
    std::filesystem::remove_all(path_, ignored);
}

} // namespace weft::test

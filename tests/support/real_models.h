#pragma once

#include <gtest/gtest.h>

#include <filesystem>

namespace weft::test {

/// Folder of the real meshes of Debian's package assimp-testmodels.
inline const std::filesystem::path k_real_models = "/usr/share/assimp/models";

} // namespace weft::test

/// Skips the test, saying why, when the real meshes are not installed.
#define WEFT_NEEDS_REAL_MODELS()                                                                   \
    if (!std::filesystem::exists(weft::test::k_real_models)) {                                     \
        GTEST_SKIP() << "needs the package assimp-testmodels";                                     \
    }                                                                                              \
    static_assert(true, "")

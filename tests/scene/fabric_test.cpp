#include "base/atomic_file.h"
#include "base/error.h"
#include "scene/fabric.h"
#include "scene/names.h"
#include "scene/scene_keys.h"
#include "support/paths.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace weft {
namespace {

TEST(Fabric, LibraryHoldsEachFileOfTheFolderAsItStands) {
    std::size_t files = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(test::source_path("assets/fabrics"))) {
        const Fabric* fabric = find_fabric(entry.path().stem().string());
        ASSERT_NE(fabric, nullptr) << entry.path();
        EXPECT_EQ(fabric->toml, read_file(entry.path()));
        ++files;
    }
    EXPECT_EQ(files, fabric_library().size());
    EXPECT_GE(files, 12u);
}

TEST(Fabric, EachPresetIsSoundAndSaysWhereItComesFrom) {
    for (const Fabric& fabric : fabric_library()) {
        EXPECT_EQ(problem(fabric.params), "") << fabric.name;
        EXPECT_EQ(fabric.params.name, fabric.name);
        EXPECT_FALSE(fabric.description.empty()) << fabric.name;
        EXPECT_NE(fabric.toml.find("# Source: "), std::string_view::npos) << fabric.name;
    }
}

/// Clothing lies between 2e-6 and 1e-4 N m, 0.05 and 0.4 kg/m^2 (Kawabata's ranges, converted);
/// felt and leather above, by no more than a factor of two.
TEST(Fabric, PresetsLieInTheRangesOfClothing) {
    for (const Fabric& fabric : fabric_library()) {
        const FabricParams& f = fabric.params;
        EXPECT_GE(f.bend_stiffness, 1.9e-6) << fabric.name;
        EXPECT_LE(f.bend_stiffness, 2e-4) << fabric.name;
        EXPECT_GE(f.area_density, 0.05) << fabric.name;
        EXPECT_LE(f.area_density, 0.8) << fabric.name;
        EXPECT_GE(f.stretch_stiffness.minCoeff(), 50.0) << fabric.name;
        EXPECT_LE(f.stretch_stiffness.maxCoeff(), 3e4) << fabric.name;
        EXPECT_LT(f.working_range[0], 1.0) << fabric.name;
        EXPECT_GT(f.working_range[1], 1.0) << fabric.name;
    }
}

/// The plane-stress law C11 = E1 / (1 - nu^2) and so on must give back the table that denim was
/// converted from (Wang et al. 2011: 205.352005 + 232.027634 N/m and so on, rounded to 3 digits).
TEST(Fabric, DenimGivesBackTheTableItCameFrom) {
    const FabricParams denim = find_fabric("denim")->params;
    const double factor = 1.0 - denim.poisson * denim.poisson;

    EXPECT_NEAR(denim.stretch_stiffness[0] / factor, 205.352005 + 232.027634, 2.0);
    EXPECT_NEAR(denim.stretch_stiffness[1] / factor, 1013.88629 + 1051.55712, 2.0);
    EXPECT_NEAR(denim.shear_stiffness, (53.387184 + 83.99202) / 4.0, 0.1);
    EXPECT_NEAR(denim.bend_stiffness, (64.196457e-6 + 96.951576e-6) / 8.0, 1e-7);
}

TEST(Fabric, ReadsAUsersOwnFile) {
    const auto file = std::filesystem::temp_directory_path() / "weft_fabric_test_mine.toml";
    std::ofstream(file) << "density = 0.3\nbend = 2e-5\n";

    const FabricParams fabric = read_fabric_file(file);
    std::filesystem::remove(file);

    FabricParams expected;
    expected.name = "weft_fabric_test_mine";
    expected.area_density = 0.3;
    expected.bend_stiffness = 2e-5;
    EXPECT_EQ(fabric, expected);
}

} // namespace
} // namespace weft

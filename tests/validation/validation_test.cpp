#include "frames/csv.h"
#include "validation/experiment_world.h"
#include "validation/statics.h"
#include "validation/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace weft {

namespace {

const ValidationRow k_good{.what = "tip, of a strip",
                           .unit = "m",
                           .theory = 2.0,
                           .measured = 2.02,
                           .tolerance = 0.02,
                           .note = "a|b",
                           .experiment = "strip"};
const ValidationRow k_bad{.what = "drift",
                          .unit = "m",
                          .theory = 0.0,
                          .measured = 0.5,
                          .tolerance = 0.125,
                          .relative = false,
                          .experiment = "fall"};

} // namespace

TEST(ValidationRow, ErrorIsRelativeOrInItsUnit) {
    EXPECT_NEAR(error_of(k_good), 0.01, 1e-15);
    EXPECT_TRUE(is_within(k_good));
    EXPECT_EQ(error_of(k_bad), 0.5);
    EXPECT_FALSE(is_within(k_bad));
}

TEST(ValidationRow, WithoutAResultMisses) {
    ValidationRow row = k_good;
    row.measured = std::numeric_limits<double>::quiet_NaN();

    EXPECT_FALSE(is_within(row));
    EXPECT_EQ(verdict(row), "missed: no result");
}

TEST(ValidationTable, SaysByHowMuchARowMisses) {
    EXPECT_EQ(verdict(k_good), "ok");
    EXPECT_EQ(verdict(k_bad), "missed by 0.38 m"); // 0.5 - 0.125 to two digits
}

TEST(ValidationTable, CsvReadsBack) {
    const CsvTable table = parse_csv(csv_text(std::array{k_good, k_bad}), "table");

    ASSERT_EQ(table.rows.size(), 2U);
    const auto cell = [&](std::size_t row, const char* name) {
        return table.rows[row][static_cast<std::size_t>(table.find_column(name))];
    };
    EXPECT_EQ(cell(0, "what"), "tip; of a strip");
    EXPECT_EQ(table.number(0, table.find_column("measured")), 2.02);
    EXPECT_EQ(cell(0, "verdict"), "ok");
    EXPECT_EQ(cell(0, "missed_by"), "0");
    EXPECT_EQ(cell(1, "verdict"), "missed");
    EXPECT_EQ(cell(1, "error_kind"), "absolute");
    EXPECT_EQ(table.number(1, table.find_column("missed_by")), 0.375);
}

TEST(ValidationTable, MarkdownHasASectionAnExperimentAndNamesWhatMisses) {
    const std::string text = markdown_text(std::array{k_good, k_bad});

    EXPECT_NE(text.find("1 of 2 rows are within their tolerance"), std::string::npos);
    EXPECT_NE(text.find("\n\n- fall: drift: missed by 0.38 m\n\n##"), std::string::npos);
    EXPECT_NE(text.find("## strip\n"), std::string::npos);
    EXPECT_NE(text.find("## fall\n"), std::string::npos);
    EXPECT_NE(text.find("a\\|b"), std::string::npos);
}

TEST(Statics, TransverseStiffnessOfAStretchedSheetIsItsTension) {
    constexpr double modulus = 100.0;
    constexpr double strain = 0.01;
    const Sheet sheet = one_diagonal_sheet(2, 2, 2.0, 2.0);
    ClothParams cloth;
    cloth.fabric = isotropic_membrane(modulus, 0.0);
    const World world = sheet_world(
        sheet, cloth, [](const Vec2& p) { return Vec3((1.0 + strain) * p.x(), p.y(), 0.0); });

    const Eigen::MatrixXd stiffness = transverse_stiffness(world, empty_space(), 1e-4);

    // W = A/2 E (stretch - 1)^2, stretch^2 = (1 + e)^2 + z_x^2: d2W/dz_x^2 = A E e / (1 + e); the
    // shape function of the middle has z_x = +-1 on four of its six half-unit triangles.
    EXPECT_NEAR(stiffness(4, 4), 4.0 * 0.5 * modulus * strain / (1.0 + strain), 1e-4);
}

TEST(MeanPeriod, OfASampledSineIsItsOwn) {
    std::vector<double> sine;
    for (int n = 1; n <= 500; ++n) {
        sine.push_back(std::sin(2.0 * std::numbers::pi * (0.01 * n / 0.73 - 0.3)));
    }

    EXPECT_NEAR(mean_period(sine, 0.01), 0.73, 1e-5);
}

TEST(MeanPeriod, NeedsTwoRises) {
    const std::vector<double> one_rise{-1.0, 1.0, 2.0, -1.0};

    EXPECT_TRUE(std::isnan(mean_period(one_rise, 0.1)));
}

} // namespace weft

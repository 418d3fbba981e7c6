#include "base/atomic_file.h"
#include "frames/statistics.h"
#include "frames/statistics_columns.h"
#include "support/paths.h"

#include <gtest/gtest.h>

#include <set>

namespace weft {
namespace {

CsvTable table_of(const FrameStatistics& statistics) {
    return parse_csv(statistics_header() + "\n" + statistics_row(statistics) + "\n", "stats.csv");
}

TEST(StatisticsColumns, BeginWithTheColumnsThatScriptsRelyOn) {
    constexpr std::string_view k_first =
        "frame,time_s,substeps,retries,cg_iterations,residual,vertices,triangles,refined,"
        "coarsened,contacts_obstacle,contacts_self,unresolved,min_gap_m,stretch_min,stretch_mean,"
        "stretch_p95,stretch_max,shear_max_deg,kinetic_J,membrane_J,bending_J,gravity_J,com_x_m,"
        "com_y_m,com_z_m,max_speed_m_s,state_hash";

    EXPECT_TRUE(statistics_header().starts_with(k_first));
}

TEST(StatisticsColumns, PutEachNumberUnderItsName) {
    FrameStatistics statistics{.frame = 11, .time = 0.4, .vertices = 9, .triangles = 8};
    statistics.report = {.substeps = 5, .retries = 1, .cg_iterations = 70, .residual = 1e-5};
    statistics.report.contact = {.contacts_obstacle = 3, .contacts_self = 4, .min_gap = 5e-4};
    statistics.strain = {0.9, 1.0, 1.1, 1.2, 7.5};
    statistics.motion = {1.0, 2.0, 3.0, 4.0, Vec3(5.0, 6.0, 7.0), 8.0};
    statistics.least_angle_deg = 18.4;
    statistics.report.adaptation_energy = -0.25;
    statistics.state_hash = 0xab;

    const CsvTable table = table_of(statistics);

    const auto value = [&](const char* name) { return table.number(0, table.find_column(name)); };
    EXPECT_EQ(value("frame"), 11);
    EXPECT_EQ(value("substeps"), 5);
    EXPECT_EQ(value("retries"), 1);
    EXPECT_EQ(value("cg_iterations"), 70);
    EXPECT_EQ(value("residual"), 1e-5);
    EXPECT_EQ(value("triangles"), 8);
    EXPECT_EQ(value("contacts_obstacle"), 3);
    EXPECT_EQ(value("contacts_self"), 4);
    EXPECT_EQ(value("min_gap_m"), 5e-4);
    EXPECT_EQ(value("stretch_p95"), 1.1);
    EXPECT_EQ(value("shear_max_deg"), 7.5);
    EXPECT_EQ(value("bending_J"), 3.0);
    EXPECT_EQ(value("gravity_J"), 4.0);
    EXPECT_EQ(value("com_z_m"), 7.0);
    EXPECT_EQ(value("least_angle_deg"), 18.4);
    EXPECT_EQ(value("adaptation_J"), -0.25);
    EXPECT_EQ(value("max_speed_m_s"), 8.0);
    EXPECT_EQ(table.rows[0][static_cast<std::size_t>(table.find_column("state_hash"))],
              "00000000000000ab");
}

TEST(StatisticsColumns, CountACrossingThatTheSolverDidNotSee) {
    FrameStatistics statistics{.crossings = 2};

    const CsvTable table = table_of(statistics);

    EXPECT_EQ(table.number(0, table.find_column("unresolved")), 2);
}

TEST(StatisticsColumns, EachHaveTheirOwnNameAndAMeaning) {
    std::set<std::string_view> names;
    for (const StatisticsColumn& column : statistics_columns()) {
        EXPECT_TRUE(names.insert(column.name).second) << column.name;
        EXPECT_FALSE(column.meaning.empty()) << column.name;
        EXPECT_FALSE(column.meaning.ends_with('.')) << column.name;
    }
}

TEST(StatisticsColumns, AreTheOnesOfTheDocumentation) {
    EXPECT_EQ(read_file(test::source_path("docs/statistics.md")), statistics_page())
        << "weft check --columns > docs/statistics.md writes it anew";
}

TEST(StatisticsColumns, OfTheVersionBeforeAreReadUnderTheirCurrentNames) {
    const CsvTable table = parse_statistics(previous_statistics_header() + "\n", "stats.csv");

    EXPECT_NE(previous_statistics_header().find("adaption_J"), std::string::npos);
    EXPECT_EQ(table.columns, parse_csv(statistics_header() + "\n", "stats.csv").columns);
}

} // namespace
} // namespace weft

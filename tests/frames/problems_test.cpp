#include "base/error.h"
#include "frames/problems.h"
#include "support/contact_world.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

/// Cloth "sheet0" and obstacle "obstacle0".
World world_of_two() {
    World world;
    test::add_sheet(world, 2, 1.0, 0.5, {});
    test::add_floor(world, 2.0, 0.0);
    return world;
}

const std::vector<UnresolvedPair> k_problems{
    {.triangles = {3, 7}, .place = Vec3(0.1, -0.2, 1e-9), .time = 0.25},
    {.objects = {{{ObjectKind::Cloth, 0}, {ObjectKind::Obstacle, 0}}},
     .triangles = {4, 1},
     .place = Vec3(1.0, 2.0, 3.0),
     .fault = PairFault::Pinched,
     .time = 0.5}};

CsvTable table_of(const std::vector<std::string>& rows) {
    std::string text = std::string(problems_header()) + "\n";
    for (const std::string& row : rows) {
        text += row + "\n";
    }
    return parse_csv(text, "problems.csv");
}

} // namespace

TEST(Problems, NameObjectsTrianglesAndPlace) {
    const CsvTable table = table_of(problem_rows(12, k_problems, world_of_two()));

    const auto cell = [&](std::size_t row, const char* name) {
        return table.rows[row][static_cast<std::size_t>(table.find_column(name))];
    };
    EXPECT_EQ(cell(0, "frame"), "12");
    EXPECT_EQ(cell(0, "time_s"), "0.25");
    EXPECT_EQ(cell(0, "kind"), "crossing");
    EXPECT_EQ(cell(0, "object_a"), "sheet0");
    EXPECT_EQ(cell(0, "triangle_b"), "7");
    EXPECT_EQ(cell(0, "z_m"), "1e-09");
    EXPECT_EQ(cell(1, "object_b"), "obstacle0");
    EXPECT_EQ(cell(1, "kind"), "pinched");
}

TEST(Problems, PlacesAreTheSameFromTheTableAsFromTheRun) {
    const CsvTable table = table_of(problem_rows(12, k_problems, world_of_two()));

    const auto places = problem_places(table, "problems.csv");

    ASSERT_EQ(places.size(), 1U);
    EXPECT_EQ(places.at(12), places_of(k_problems));
}

TEST(Problems, TableWithoutPlacesIsADiskError) {
    const auto code_of = [](const std::string& text) {
        try {
            problem_places(parse_csv(text, "problems.csv"), "problems.csv");
        } catch (const Error& error) {
            return error.code();
        }
        return ExitCode::Done;
    };

    EXPECT_EQ(code_of("frame,x_m,y_m\n1,2,3\n"), ExitCode::Disk);
    EXPECT_EQ(code_of("frame,x_m,y_m,z_m\n1,2,3,here\n"), ExitCode::Disk);
    EXPECT_EQ(code_of("frame,x_m,y_m,z_m\n1,2,3,4\n"), ExitCode::Done);
}

} // namespace weft

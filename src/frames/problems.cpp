#include "frames/problems.h"

#include "base/error.h"
#include "state/world.h"

#include <fmt/core.h>

#include <cmath>

namespace weft {

namespace {

constexpr std::string_view k_header =
    "frame,time_s,kind,object_a,triangle_a,object_b,triangle_b,x_m,y_m,z_m";

std::string_view name_of(PairFault fault) {
    switch (fault) {
    case PairFault::Crossing:
        return "crossing";
    case PairFault::TooNear:
        return "too_near";
    case PairFault::Pinched:
        return "pinched";
    }
    return "";
}

} // namespace

std::string_view problems_header() {
    return k_header;
}

std::vector<std::string>
problem_rows(int frame, std::span<const UnresolvedPair> problems, const World& world) {
    std::vector<std::string> rows;
    for (const UnresolvedPair& pair : problems) {
        rows.push_back(fmt::format("{},{},{},{},{},{},{},{},{},{}", frame, csv_number(pair.time),
                                   name_of(pair.fault), object_name(world, pair.objects[0]),
                                   pair.triangles[0], object_name(world, pair.objects[1]),
                                   pair.triangles[1], csv_number(pair.place.x()),
                                   csv_number(pair.place.y()), csv_number(pair.place.z())));
    }
    return rows;
}

std::vector<Vec3f> places_of(std::span<const UnresolvedPair> problems) {
    std::vector<Vec3f> places;
    for (const UnresolvedPair& problem : problems) {
        places.push_back(problem.place.cast<float>());
    }
    return places;
}

std::map<int, std::vector<Vec3f>> problem_places(const CsvTable& table, const std::string& place) {
    std::map<int, std::vector<Vec3f>> places;
    const int x = table.find_column("x_m");
    const int y = table.find_column("y_m");
    const int z = table.find_column("z_m");
    const int frame = table.find_column("frame");
    if (frame < 0 || x < 0 || y < 0 || z < 0) {
        fail_disk("{}: must have the columns frame, x_m, y_m and z_m", place);
    }
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const Vec3 at(table.number(row, x), table.number(row, y), table.number(row, z));
        const double number = table.number(row, frame);
        if (!at.allFinite() || !std::isfinite(number)) {
            fail_disk("{}:{}: frame and place must be numbers", place, row + 2);
        }
        places[static_cast<int>(number)].push_back(at.cast<float>());
    }
    return places;
}

} // namespace weft

#include "frames/statistics_columns.h"

#include "frames/statistics.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace weft {

namespace {

using S = FrameStatistics;

std::string text(double value) {
    return csv_number(value);
}

std::string text(int value) {
    return std::to_string(value);
}

std::string text(std::size_t value) {
    return std::to_string(value);
}

std::string text(std::string value) {
    return value;
}

template <std::size_t N> std::string level(const S& s) {
    return text(s.levels[N]);
}

constexpr std::array k_columns{
    StatisticsColumn{"frame", "", "Number of the frame, from 1",
                     [](const S& s) { return text(s.frame); }},
    StatisticsColumn{"time_s", "s", "Simulated time of the frame",
                     [](const S& s) { return text(s.time); }},
    StatisticsColumn{"substeps", "", "Substeps on the way to the frame",
                     [](const S& s) { return text(s.report.substeps); }},
    StatisticsColumn{"retries", "",
                     "Substeps that were thrown away and repeated with half the length",
                     [](const S& s) { return text(s.report.retries); }},
    StatisticsColumn{"cg_iterations", "",
                     "Iterations of the conjugate gradients, summed over the frame",
                     [](const S& s) { return text(s.report.cg_iterations); }},
    StatisticsColumn{"residual", "", "Largest relative residual of a linear solve",
                     [](const S& s) { return text(s.report.residual); }},
    StatisticsColumn{"vertices", "", "Vertices and particles that move by forces",
                     [](const S& s) { return text(s.vertices); }},
    StatisticsColumn{"triangles", "", "Triangles of everything that moves by forces",
                     [](const S& s) { return text(s.triangles); }},
    StatisticsColumn{"refined", "", "Vertices that refinement inserted on the way to the frame",
                     [](const S& s) { return text(s.report.refined); }},
    StatisticsColumn{"coarsened", "", "Vertices that coarsening removed on the way to the frame",
                     [](const S& s) { return text(s.report.coarsened); }},
    StatisticsColumn{
        "contacts_obstacle", "",
        "Pairs with an obstacle nearer than their thickness, greatest over the substeps",
        [](const S& s) { return text(s.report.contact.contacts_obstacle); }},
    StatisticsColumn{
        "contacts_self", "",
        "Pairs without an obstacle nearer than their thickness, greatest over the substeps",
        [](const S& s) { return text(s.report.contact.contacts_self); }},
    StatisticsColumn{
        "unresolved", "",
        "Pairs that cross at the frame (with `--verify`: after any substep) or that contact could "
        "not keep apart: 0 in a good run",
        [](const S& s) { return text(std::max(s.report.contact.unresolved, s.crossings)); }},
    StatisticsColumn{"min_gap_m", "m", "Least distance met; inf without contact",
                     [](const S& s) { return text(s.report.contact.min_gap); }},
    StatisticsColumn{"stretch_min", "",
                     "Least principal stretch, 1 = rest; of edge models the edges' length over "
                     "their rest length",
                     [](const S& s) { return text(s.strain.stretch_min); }},
    StatisticsColumn{"stretch_mean", "",
                     "Mean of each triangle's greater principal stretch, weighted by rest area",
                     [](const S& s) { return text(s.strain.stretch_mean); }},
    StatisticsColumn{"stretch_p95", "", "95th percentile of the same",
                     [](const S& s) { return text(s.strain.stretch_p95); }},
    StatisticsColumn{"stretch_max", "", "Greatest principal stretch",
                     [](const S& s) { return text(s.strain.stretch_max); }},
    StatisticsColumn{"shear_max_deg", "deg",
                     "Greatest deviation of the angle between weft and warp from a right angle",
                     [](const S& s) { return text(s.strain.shear_max_deg); }},
    StatisticsColumn{"kinetic_J", "J", "Kinetic energy",
                     [](const S& s) { return text(s.motion.kinetic); }},
    StatisticsColumn{"membrane_J", "J",
                     "Elastic energy of stretching and shear; edges of solids are included",
                     [](const S& s) { return text(s.motion.membrane); }},
    StatisticsColumn{"bending_J", "J", "Elastic energy of bending",
                     [](const S& s) { return text(s.motion.bending); }},
    StatisticsColumn{"gravity_J", "J", "Potential energy of gravity, 0 at the origin",
                     [](const S& s) { return text(s.motion.gravity); }},
    StatisticsColumn{"com_x_m", "m", "Centre of mass, x",
                     [](const S& s) { return text(s.motion.centre_of_mass.x()); }},
    StatisticsColumn{"com_y_m", "m", "Centre of mass, y",
                     [](const S& s) { return text(s.motion.centre_of_mass.y()); }},
    StatisticsColumn{"com_z_m", "m", "Centre of mass, z",
                     [](const S& s) { return text(s.motion.centre_of_mass.z()); }},
    StatisticsColumn{"max_speed_m_s", "m/s", "Greatest speed of a vertex or particle",
                     [](const S& s) { return text(s.motion.max_speed); }},
    StatisticsColumn{"state_hash", "",
                     "Hash of every position and velocity: equal rows, equal states",
                     [](const S& s) { return text(fmt::format("{:016x}", s.state_hash)); }},
    StatisticsColumn{"impacts", "", "Pairs that continuous detection met",
                     [](const S& s) { return text(s.report.contact.impacts); }},
    StatisticsColumn{"impact_zones", "", "Groups of impacts that were solved together",
                     [](const S& s) { return text(s.report.contact.zones); }},
    StatisticsColumn{"scaled_islands", "", "Groups whose motion was scaled down to stay apart",
                     [](const S& s) { return text(s.report.contact.scaled_zones); }},
    StatisticsColumn{"substeps_impacts", "", "Substeps of the frame that met impacts",
                     [](const S& s) { return text(s.report.substeps_impacts); }},
    StatisticsColumn{"substeps_zones", "", "Substeps of the frame that needed impact zones",
                     [](const S& s) { return text(s.report.substeps_zones); }},
    StatisticsColumn{"substeps_scaled", "", "Substeps of the frame that scaled motion down",
                     [](const S& s) { return text(s.report.substeps_scaled); }},
    StatisticsColumn{"attached_pairs", "", "Pairs of points that `[[attach]]` holds",
                     [](const S& s) { return text(s.attachments.pairs); }},
    StatisticsColumn{"welded_pairs", "", "Pairs of points that are welded",
                     [](const S& s) { return text(s.attachments.welded); }},
    StatisticsColumn{"attached_gap_m", "m",
                     "Greatest distance between acting pairs of points beyond their intended one",
                     [](const S& s) { return text(s.attachments.greatest_gap); }},
    StatisticsColumn{"level_0", "", "Triangles on refinement level 0, that of the imported mesh",
                     level<0>},
    StatisticsColumn{"level_1", "", "Triangles on refinement level 1", level<1>},
    StatisticsColumn{"level_2", "", "Triangles on refinement level 2", level<2>},
    StatisticsColumn{"level_3", "", "Triangles on refinement level 3", level<3>},
    StatisticsColumn{"level_4", "", "Triangles on refinement level 4", level<4>},
    StatisticsColumn{"level_5", "", "Triangles on refinement level 5", level<5>},
    StatisticsColumn{"level_6", "", "Triangles on refinement level 6", level<6>},
    StatisticsColumn{"level_7", "", "Triangles on refinement level 7", level<7>},
    StatisticsColumn{"level_8", "", "Triangles on refinement level 8", level<8>},
    StatisticsColumn{"volume_m3", "m^3", "Volume inside the surfaces of all solids",
                     [](const S& s) { return text(s.volume); }},
    StatisticsColumn{"inverted_cells", "", "Lattice cells of solids that are turned inside out",
                     [](const S& s) { return text(s.inverted_cells); }},
    StatisticsColumn{"least_angle_deg", "deg",
                     "Least angle of the triangles of all cloth in their rest shape",
                     [](const S& s) { return text(s.least_angle_deg); }},
    StatisticsColumn{"adaptation_J", "J",
                     "Kinetic, elastic and gravity energy that changes of the meshes gave all "
                     "cloth; negative: took",
                     [](const S& s) { return text(s.report.adaptation_energy); }},
};

/// A column that the version before this one wrote under another name.
struct RenamedColumn {
    std::string_view before, now;
};
constexpr std::array k_renamed{RenamedColumn{"adaption_J", "adaptation_J"}};

/// Joins one text of each column by commas.
template <typename Text> std::string join(const Text& text_of) {
    std::string line;
    for (const StatisticsColumn& column : k_columns) {
        line += (line.empty() ? "" : ",") + std::string(text_of(column));
    }
    return line;
}

} // namespace

std::span<const StatisticsColumn> statistics_columns() {
    return k_columns;
}

std::string statistics_header() {
    return join([](const StatisticsColumn& column) { return column.name; });
}

std::string statistics_row(const FrameStatistics& statistics) {
    return join([&](const StatisticsColumn& column) { return column.cell(statistics); });
}

std::string statistics_page() {
    std::string page = "# Columns of `stats.csv`\n\n"
                       "One row a frame, the same bytes for any number of threads. "
                       "`weft check --columns` prints this page.\n\n"
                       "| column | unit | meaning |\n|---|---|---|\n";
    for (const StatisticsColumn& column : k_columns) {
        page += fmt::format("| `{}` | {} | {} |\n", column.name, column.unit, column.meaning);
    }
    return page;
}

std::string_view current_column_name(std::string_view name) {
    const auto renamed = std::find_if(k_renamed.begin(), k_renamed.end(),
                                      [&](const RenamedColumn& r) { return r.before == name; });
    return renamed == k_renamed.end() ? name : renamed->now;
}

CsvTable parse_statistics(std::string_view text, const std::string& place) {
    CsvTable table = parse_csv(text, place);
    for (std::string& column : table.columns) {
        column = current_column_name(column);
    }
    return table;
}

std::string previous_statistics_header() {
    return join([](const StatisticsColumn& column) {
        const auto renamed =
            std::find_if(k_renamed.begin(), k_renamed.end(),
                         [&](const RenamedColumn& r) { return r.now == column.name; });
        return renamed == k_renamed.end() ? column.name : renamed->before;
    });
}

} // namespace weft

#include "app/inspect_run.h"

#include "app/summary.h"
#include "base/error.h"
#include "frames/csv.h"
#include "frames/run_folder.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace weft {

namespace {

const char* state_name(RunState state) {
    switch (state) {
    case RunState::Running:
        return "running, or killed";
    case RunState::Done:
        return "done";
    case RunState::Failed:
        return "failed";
    case RunState::Stopped:
        return "stopped with a checkpoint";
    }
    return "";
}

/// Columns that tell whether a run went well.
constexpr std::array<const char*, 10> k_shown{
    "triangles",    "contacts_obstacle", "contacts_self", "unresolved",    "min_gap_m",
    "stretch_mean", "stretch_max",       "kinetic_J",     "max_speed_m_s", "substeps"};

void describe_column(const CsvTable& table, const char* name, SummaryLines& sheet) {
    const int column = table.find_column(name);
    if (column < 0) {
        return;
    }
    double least = std::numeric_limits<double>::infinity();
    double greatest = -least;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const double value = table.number(row, column);
        if (!std::isnan(value)) {
            least = std::min(least, value);
            greatest = std::max(greatest, value);
        }
    }
    sheet.row("", "{:<18} {:>12.5g} {:>12.5g} {:>12.5g}", name,
              table.number(table.rows.size() - 1, column), least, greatest);
}

CsvTable read_table(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    return parse_csv(text, file.string());
}

} // namespace

InspectReport describe_run(const std::filesystem::path& folder) {
    const RunPaths paths{folder};
    SummaryLines sheet;
    sheet.text = folder.string() + "\n";
    try {
        const RunStatus status = read_status(paths.status());
        sheet.row("run", "{}: frame {} of {}, {:.3g} s a frame", state_name(status.state),
                  status.frame, status.frames, status.seconds_per_frame);
        if (!status.message.empty()) {
            sheet.row("", "{}", status.message);
        }
        const CsvTable table = read_table(paths.stats());
        if (!table.rows.empty()) {
            sheet.row("statistics", "{:<18} {:>12} {:>12} {:>12}", "", "last frame", "least",
                      "greatest");
            for (const char* name : k_shown) {
                describe_column(table, name, sheet);
            }
        }
    } catch (const Error& error) {
        sheet.row("REFUSED", "{}", error.what());
        return {sheet.text, true};
    }
    return {sheet.text, false};
}

} // namespace weft

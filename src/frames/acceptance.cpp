#include "frames/acceptance.h"

#include "base/error.h"
#include "frames/statistics.h"
#include "scene/nearest_key.h"

namespace weft {

void check_rules(std::span<const Rule> rules) {
    const CsvTable table = parse_csv(std::string(statistics_header()) + "\n", "stats.csv");
    for (const Rule& rule : rules) {
        if (table.find_column(rule.column) < 0) {
            throw Error(ExitCode::CommandLine,
                        fmt::format("--fail-on {}: '{}' is no column of stats.csv; did you mean "
                                    "'{}'?",
                                    rule.text, rule.column,
                                    nearest_key(rule.column, table.columns)));
        }
    }
}

std::vector<std::string> broken_rules(std::span<const Rule> rules, const CsvTable& statistics) {
    std::vector<std::string> lines;
    for (const Rule& rule : rules) {
        const int column = statistics.find_column(rule.column);
        for (std::size_t row = 0; column >= 0 && row < statistics.rows.size(); ++row) {
            if (rule.is_broken_by(statistics.number(row, column))) {
                const auto& cells = statistics.rows[row];
                lines.push_back(fmt::format("frame {}: {} = {}: fails --fail-on {}", cells[0],
                                            rule.column, cells[static_cast<std::size_t>(column)],
                                            rule.text));
                break;
            }
        }
    }
    return lines;
}

} // namespace weft

#include "validation/table.h"

#include "frames/csv.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace weft {

namespace {

std::string csv_cell(std::string text) {
    std::replace(text.begin(), text.end(), ',', ';');
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

std::string markdown_cell(const std::string& text) {
    std::string cell;
    for (const char c : text) {
        cell += c == '|' ? "\\|" : c == '\n' ? " " : std::string(1, c);
    }
    return cell;
}

/// An error or tolerance: in percent where that is easy to read.
std::string amount(double value, const ValidationRow& row) {
    if (!row.relative) {
        return row.unit.empty() ? fmt::format("{:.2g}", value)
                                : fmt::format("{:.2g} {}", value, row.unit);
    }
    return value >= 1e-4 ? fmt::format("{:.3g} %", 100.0 * value) : fmt::format("{:.2g}", value);
}

std::string with_unit(double value, const ValidationRow& row) {
    return row.unit.empty() ? fmt::format("{:.6g}", value)
                            : fmt::format("{:.6g} {}", value, row.unit);
}

std::string markdown_row(const ValidationRow& row) {
    return fmt::format("| {} | {} | {} | {} | {} | {} | {:.2f} | {} |\n", markdown_cell(row.what),
                       with_unit(row.theory, row), with_unit(row.measured, row),
                       amount(error_of(row), row), amount(row.tolerance, row), verdict(row),
                       row.seconds, markdown_cell(row.note));
}

} // namespace

double error_of(const ValidationRow& row) {
    const double difference = std::abs(row.measured - row.theory);
    return row.relative ? difference / std::abs(row.theory) : difference;
}

bool is_within(const ValidationRow& row) {
    return error_of(row) <= row.tolerance;
}

std::string verdict(const ValidationRow& row) {
    if (is_within(row)) {
        return "ok";
    }
    return std::isfinite(row.measured) ? "missed by " + amount(error_of(row) - row.tolerance, row)
                                       : "missed: no result";
}

std::string summary(std::span<const ValidationRow> rows) {
    const auto within = std::count_if(rows.begin(), rows.end(), is_within);
    return fmt::format("{} of {} rows are within their tolerance", within, rows.size());
}

std::string csv_text(std::span<const ValidationRow> rows) {
    std::string text = "experiment,what,unit,theory,measured,error,error_kind,tolerance,verdict,"
                       "missed_by,time_s,note\n";
    for (const ValidationRow& row : rows) {
        const double error = error_of(row);
        const bool ok = is_within(row);
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{:.3f},{}\n", csv_cell(row.experiment),
                            csv_cell(row.what), csv_cell(row.unit), csv_number(row.theory),
                            csv_number(row.measured), csv_number(error),
                            row.relative ? "relative" : "absolute", csv_number(row.tolerance),
                            ok ? "ok" : "missed", ok ? "0" : csv_number(error - row.tolerance),
                            row.seconds, csv_cell(row.note));
    }
    return text;
}

std::string markdown_text(std::span<const ValidationRow> rows) {
    std::string text = "# Validation: theory against measured\n\n" + summary(rows) + ".\n";
    std::string missed;
    for (const ValidationRow& row : rows) {
        if (!is_within(row)) {
            missed += fmt::format("- {}: {}: {}\n", row.experiment, row.what, verdict(row));
        }
    }
    text += missed.empty() ? "" : "\n" + missed;
    std::string experiment;
    for (const ValidationRow& row : rows) {
        if (row.experiment != experiment) {
            experiment = row.experiment;
            text += fmt::format("\n## {}\n\n| what | theory | measured | error | tolerance | "
                                "verdict | time (s) | note |\n|---|---|---|---|---|---|---|---|\n",
                                experiment);
        }
        text += markdown_row(row);
    }
    return text;
}

std::string terminal_text(std::span<const ValidationRow> rows) {
    std::size_t width = 4;
    for (const ValidationRow& row : rows) {
        width = std::max(width, row.experiment.size() + 2 + row.what.size());
    }
    std::string text = fmt::format("{:<{}}  {:>16} {:>16} {:>10} {:>10} {:>8}  verdict\n", "what",
                                   width, "theory", "measured", "error", "tolerance", "time (s)");
    for (const ValidationRow& row : rows) {
        text += fmt::format("{:<{}}  {:>16} {:>16} {:>10} {:>10} {:>8.2f}  {}\n",
                            row.experiment + ": " + row.what, width, with_unit(row.theory, row),
                            with_unit(row.measured, row), amount(error_of(row), row),
                            amount(row.tolerance, row), row.seconds, verdict(row));
        if (!is_within(row) && !row.note.empty()) {
            text += "    " + row.note + "\n";
        }
    }
    return text + summary(rows) + "\n";
}

} // namespace weft

#pragma once

#include <span>
#include <string>

/// The rows that experiments return and the validation table as text. All three formats say by how
/// much a row misses.
namespace weft {

/// One line of the validation table: what theory says, what the program gives.
struct ValidationRow {
    std::string what; ///< the case in words; no commas
    std::string unit; ///< unit of theory and measured; empty: a ratio
    double theory = 0.0;
    double measured = 0.0;
    double tolerance = 0.0;   ///< the greatest error allowed, >= 0
    bool relative = true;     ///< error as a fraction of |theory|; false: in `unit`
    std::string note{};       ///< mesh, source, what else a reader needs; no commas
    double seconds = 0.0;     ///< wall time; 0: part of the experiment's
    std::string experiment{}; ///< filled in by run_experiments
};

/// |measured - theory|, relative to |theory| where the row says so.
double error_of(const ValidationRow& row);

/// Error no greater than the tolerance; a measurement that is not a number is not.
bool is_within(const ValidationRow& row);
/// `ok`, or `missed by 0.012` (the error above the tolerance).
std::string verdict(const ValidationRow& row);

/// `12 of 13 rows are within their tolerance` and the like; no line break.
std::string summary(std::span<const ValidationRow> rows);

/// A header line, then one line a row: experiment, what, unit, theory, measured, error, error_kind
/// (relative or absolute), tolerance, verdict (ok or missed), missed_by, time_s, note. Numbers read
/// back to the same bits; commas in texts become semicolons.
std::string csv_text(std::span<const ValidationRow> rows);

/// A page with the summary, the rows that miss, and the table of each experiment.
std::string markdown_text(std::span<const ValidationRow> rows);

/// The rows in columns for a terminal.
std::string terminal_text(std::span<const ValidationRow> rows);

} // namespace weft

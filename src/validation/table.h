#pragma once

#include <span>
#include <string>

#include "validation/row.h"

/// The validation table as text. All three say of a row that misses by how much.
namespace weft {

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

#pragma once

#include "frames/csv.h"

#include <span>
#include <string>
#include <string_view>

namespace weft {

struct FrameStatistics;

/// All that the program knows of one column of stats.csv. The header, the rows and
/// docs/statistics.md are made of this table alone: a new column is one entry.
struct StatisticsColumn {
    std::string_view name;    ///< ends with its unit where it has one
    std::string_view unit;    ///< empty: a count, a ratio or text
    std::string_view meaning; ///< one sentence, Markdown, without a full stop
    std::string (*cell)(const FrameStatistics&);
};

/// The columns in the order of the file.
std::span<const StatisticsColumn> statistics_columns();

/// Names of the columns, joined by commas.
std::string statistics_header();

/// The row of a frame; depends on the numbers alone (no times), the shortest text of each.
std::string statistics_row(const FrameStatistics& statistics);

/// The columns as a page for people: docs/statistics.md.
std::string statistics_page();

/// The name that a column has now. Names of the version before this one are still understood.
std::string_view current_column_name(std::string_view name);

/// Reads stats.csv of this version or the one before; its columns get the names that they have now.
/// Throws Error (Disk) as parse_csv().
CsvTable parse_statistics(std::string_view text, const std::string& place);

/// The header that the version before this one wrote; its columns mean the same.
std::string previous_statistics_header();

} // namespace weft

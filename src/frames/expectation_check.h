#pragma once

#include "frames/csv.h"
#include "scene/expectations.h"

namespace weft {

/// How a table misses an expectation, in one line naming frame or summary, column and value; ""
/// when it holds. A table without rows in the range of frames misses it, and so does a cell that is
/// no number.
///
/// @param table its first column is the frame
/// @param name  of the table, for messages
/// Throws Error (BadInput) naming the nearest column when the table does not have the one asked
/// for.
std::string find_miss(const Expectation& expect, const CsvTable& table, const std::string& name);

} // namespace weft

#pragma once

#include "frames/csv.h"
#include "frames/rule.h"

#include <span>

namespace weft {

/// Refuses rules on columns that stats.csv does not have, naming the nearest one.
/// Throws Error (CommandLine).
void check_rules(std::span<const Rule> rules);

/// One line for each rule that a frame of the statistics breaks: the first such frame, the value
/// and the rule.
std::vector<std::string> broken_rules(std::span<const Rule> rules, const CsvTable& statistics);

} // namespace weft

#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace weft {

/// What of a column is compared: every value, or one number made of them.
enum class ExpectAt { Each, First, Last, Max, Mean, Min };

/// One `[[expect]]` of an expectations file: bounds on a column of a run's table.
struct Expectation {
    std::string file = "stats"; ///< "stats", "images" or "timing"
    std::string column;
    ExpectAt at = ExpectAt::Each;
    int first_frame = 1; ///< the first that is looked at
    int last_frame = std::numeric_limits<int>::max();
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    std::string place; ///< file and table, for messages
};

/// Reads expectations:
///
///     [[expect]]
///     file = "stats"          # or images, timing; stats when left out
///     column = "stretch_max"
///     max = 1.25              # and / or min; or equals = 1.0 with tolerance = 0.01
///     at = "each"             # each, first, last, max, mean, min
///     frames = "10-50"        # all when left out
///
/// Throws Error: Disk when the file cannot be read, otherwise BadInput with line and column.
std::vector<Expectation> read_expectations(const std::filesystem::path& file);

} // namespace weft

#pragma once

#include "frames/csv.h"
#include "scene/expectations.h"

#include <functional>
#include <span>

namespace weft {

/// Receives a line for the user.
using Warn = std::function<void(const std::string&)>;

/// A condition on a column of stats.csv that makes a run fail when a frame meets it.
struct Rule {
    enum class Op { Less, LessEqual, Greater, GreaterEqual };

    std::string column;
    Op op = Op::Greater;
    double bound = 0.0;
    std::string text; ///< as the user wrote it, for messages

    /// True where the frame's value makes the run fail; NaN does.
    bool is_broken_by(double value) const;
};

/// Reads `penetration` (unresolved > 0), `retries` (retries > 0) or COLUMN followed by >, >=, < or
/// <= and a number, e.g. `stretch_max>1.3`. Whether the column exists is for check_rules() to say.
/// Throws Error (CommandLine) in one line when the text is none of these.
Rule parse_rule(std::string_view text);

/// Gives columns that rules name as the version before this one did their current names, with a
/// line to `warn` for each such name. Refuses rules on columns that stats.csv does not have, naming
/// the nearest one. Throws Error (CommandLine).
void check_rules(std::span<Rule> rules, const Warn& warn);

/// One line for each rule that a frame of the statistics breaks: the first such frame, the value
/// and the rule.
std::vector<std::string> broken_rules(std::span<const Rule> rules, const CsvTable& statistics);

/// Gives columns of stats.csv that expectations name as the version before this one did their
/// current names, with a line to `warn` for each such name.
void take_current_names(std::span<Expectation> expectations, const Warn& warn);

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

#pragma once

#include <string>
#include <string_view>

namespace weft {

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
/// <= and a number, e.g. `stretch_max>1.3`. Whether the column exists is for the statistics to say.
/// Throws Error (CommandLine) in one line when the text is none of these.
Rule parse_rule(std::string_view text);

} // namespace weft

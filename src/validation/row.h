#pragma once

#include <string>

namespace weft {

/// One line of the validation table: what theory says, what the program gives.
struct ValidationRow {
    std::string what; ///< the case in words; no commas
    std::string unit; ///< of theory and measured; empty: a ratio
    double theory = 0.0;
    double measured = 0.0;
    double tolerance = 0.0;   ///< the greatest error allowed, >= 0
    bool relative = true;     ///< error as a share of |theory|; false: in `unit`
    std::string note{};       ///< mesh, source, what else a reader needs; no commas
    double seconds = 0.0;     ///< wall time; 0: a share of the experiment's
    std::string experiment{}; ///< filled in by run_experiments
};

/// |measured - theory|, relative to |theory| where the row says so.
double error_of(const ValidationRow& row);

/// Error no greater than the tolerance; a measurement that is not a number is not.
bool is_within(const ValidationRow& row);

} // namespace weft

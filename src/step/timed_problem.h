#pragma once

#include "collide/contact.h"

namespace weft {

/// A pair that was unresolved when a substep ended.
struct TimedProblem {
    double time; ///< of the substep's end, s
    ContactProblem pair;
};

/// Appends what was found at `time` (s).
void add_problems(std::vector<TimedProblem>& all,
                  double time,
                  std::span<const ContactProblem> found);

/// Sorts them by objects, triangles and kind, and of those that tell of one pair the same keeps the
/// last.
void keep_last_of_each(std::vector<TimedProblem>& problems);

} // namespace weft

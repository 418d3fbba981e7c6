#pragma once

#include "state/world.h"

namespace weft {

/// Takes up what the world's positions at `time` (s) mean for its attached pairs: which begin to
/// act, which are closed and weld, which contact takes as one. Called when the world is built and
/// after each substep.
void update_attachments(World& world, double time);

/// How far the attached pairs have come.
struct AttachmentReport {
    int pairs = 0;
    int welded = 0;
    double greatest_gap = 0.0; ///< m, of the pairs that act, beyond their rest gap
};

AttachmentReport measure_attachments(const World& world);

} // namespace weft

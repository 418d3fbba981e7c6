#pragma once

#include "step/frame_report.h"
#include "step/prepared.h"

#include <functional>
#include <memory>
#include <optional>

namespace weft {

/// Advances a world in time. Keeps matrices and trees between calls; the results depend on the
/// start and on the world given to each call alone.
class Stepper {
public:
    explicit Stepper(const Prepared& start);
    ~Stepper();
    Stepper(Stepper&&) noexcept;

    /// From now on, looks for crossings exactly after every substep.
    void verify_substeps(const World& world);

    /// From the world's frame to the next one. Throws Error (Diverged) when a substep fails at the
    /// floor of its length; the world then stands at its last good substep.
    /// @param should_stop asked between substeps; true makes it return early, with the world back
    ///                    at the frame it started from, and nullopt
    std::optional<FrameReport> advance_frame(World& world,
                                             const std::function<bool()>& should_stop);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace weft

#pragma once

#include "base/eigen.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace weft {

/// The vertex positions of a deforming obstacle in its own frame: a function of time alone, so that
/// a run that was stopped and resumed sees the same bits. The last results are kept, as several
/// callers ask for the start and the end of a substep.
class Deformation {
public:
    using Positions = std::shared_ptr<const std::vector<Vec3>>;
    /// Writes the positions (#V, m) at time t (s); must depend on nothing else.
    using Evaluate = std::function<void(double t, std::span<Vec3> positions)>;

    /// @param fingerprint  hash of the files' content: differs where the motion differs
    Deformation(std::size_t vertices, std::uint64_t fingerprint, Evaluate evaluate);

    /// Positions at time t. May be called from several threads.
    Positions at(double t) const;

    std::size_t vertex_count() const { return vertices_; }
    std::uint64_t fingerprint() const { return fingerprint_; }

private:
    struct Answer {
        double time = 0.0;
        std::shared_ptr<std::vector<Vec3>> positions; ///< null: none yet
    };

    std::size_t vertices_;
    std::uint64_t fingerprint_;
    Evaluate evaluate_;
    mutable std::mutex mutex_;
    /// Start, end, and the two of a substep that was cut in half. The oldest makes room.
    mutable std::array<Answer, 4> answers_;
    mutable std::size_t oldest_ = 0;
};

} // namespace weft

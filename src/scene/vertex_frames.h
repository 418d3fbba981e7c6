#pragma once

#include "base/eigen.h"
#include "scene/params.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace weft {

/// Positions of the same vertices at ascending times, read when they are needed. As many as fit
/// into `memory` stay in memory: what that is changes the speed alone, not the numbers.
class VertexFrames {
public:
    /// Fills the positions (#V) of frame k; throws Error when it cannot.
    using Read = std::function<void(std::size_t k, std::vector<Vec3f>& positions)>;

    /// Bytes of frames kept. Smaller: read again when the motion goes back or loops.
    static constexpr std::size_t k_memory = std::size_t{256} << 20U;

    /// @param times  of the frames, s, ascending, at least one
    VertexFrames(std::vector<double> times, Read read, std::size_t memory = k_memory);

    double duration() const { return times_.back() - times_.front(); }
    std::size_t count() const { return times_.size(); }

    /// Positions `t` seconds after the first frame: linear between two frames, which creases the
    /// motion at a frame but never leaves what the frames span; constant outside. Not for several
    /// threads at once.
    void positions_at(double t, const Mat3& to_world, std::span<Vec3> positions);

    /// Reads every frame once; differs where any of their numbers differs.
    std::uint64_t fingerprint();

private:
    using Frame = std::shared_ptr<const std::vector<Vec3f>>;
    struct Kept {
        std::size_t k;
        Frame frame;
    };
    Frame frame(std::size_t k);

    std::vector<double> times_;
    Read read_;
    std::size_t memory_;
    std::vector<Kept> kept_; ///< by last use
};

/// Time inside an animation of `duration` (s) at scene time t (s): (t - start) * speed, its first
/// pose before, and behind its end the last pose or, looped, from the first again.
double time_in_animation(const AnimationParams& params, double duration, double t);

} // namespace weft

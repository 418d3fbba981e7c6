#include "scene/vertex_frames.h"

#include "base/hash.h"
#include "base/parallel.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace weft {

VertexFrames::VertexFrames(std::vector<double> times, Read read, std::size_t memory)
    : times_(std::move(times)), read_(std::move(read)), memory_(memory) {
    assert(!times_.empty() && std::is_sorted(times_.begin(), times_.end()));
}

VertexFrames::Frame VertexFrames::frame(std::size_t k) {
    const auto found =
        std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.k == k; });
    if (found != kept_.end()) {
        std::rotate(found, found + 1, kept_.end());
        return kept_.back().frame;
    }
    auto positions = std::make_shared<std::vector<Vec3f>>();
    read_(k, *positions);
    const std::size_t bytes = positions->size() * sizeof(Vec3f);
    if (!kept_.empty() && (kept_.size() + 1) * bytes > memory_) {
        kept_.erase(kept_.begin());
    }
    kept_.push_back({k, positions});
    return positions;
}

void VertexFrames::positions_at(double t, const Mat3& to_world, std::span<Vec3> positions) {
    const double time = times_.front() + t;
    const auto next = std::upper_bound(times_.begin(), times_.end(), time);
    const auto last = static_cast<std::size_t>(std::max<std::ptrdiff_t>(
        0, std::min<std::ptrdiff_t>(next - times_.begin(),
                                    static_cast<std::ptrdiff_t>(times_.size()) - 1)));
    const std::size_t first = next == times_.end() || last == 0 ? last : last - 1;
    const Frame a = frame(first);
    const Frame b = frame(last);
    assert(a->size() == positions.size() && b->size() == positions.size());
    const double span = times_[last] - times_[first];
    const double weight = span > 0.0 ? (time - times_[first]) / span : 0.0;
    parallel_for(positions.size(), [&](std::size_t i) {
        const Vec3 from = (*a)[i].cast<double>();
        const Vec3 to = (*b)[i].cast<double>();
        positions[i] = to_world * (from + weight * (to - from));
    });
}

std::uint64_t VertexFrames::fingerprint() {
    Hash hash;
    hash.add(std::span<const double>(times_));
    for (std::size_t k = 0; k < times_.size(); ++k) {
        hash.add(std::span<const Vec3f>(*frame(k)));
    }
    return hash.value();
}

double time_in_animation(const AnimationParams& params, double duration, double t) {
    const double inside = std::max(0.0, (t - params.start) * params.speed);
    if (params.end == AnimationEnd::Hold || duration <= 0.0) {
        return std::min(inside, duration);
    }
    return std::fmod(inside, duration);
}

} // namespace weft

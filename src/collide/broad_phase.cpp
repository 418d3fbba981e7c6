#include "collide/broad_phase.h"

#include "base/parallel.h"

#include <cassert>

namespace weft {

namespace {

/// Fraction of the thickness by which a vertex may end aside of the path that was searched.
/// Smaller: impulses send the search back more often; larger: more candidates.
constexpr double k_slack = 0.5;

/// Pieces a tree comparison is cut into. Fewer: threads wait for the longest; more: overhead.
constexpr std::size_t k_tasks = 128;

Vec3 mean(std::span<const Vec3> v) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& one : v) {
        sum += one;
    }
    return v.empty() ? sum : Vec3(sum / static_cast<double>(v.size()));
}

/// Does the line to `end` stay in the box of the line to `seen`, larger by `slack`? Both begin at
/// the origin.
bool stays_within(const Vec3& end, const Vec3& seen, double slack) {
    return (end.array() >= seen.array().min(0.0) - slack).all() &&
           (end.array() <= seen.array().max(0.0) + slack).all();
}

/// Pairs of corners of two triangles: bit 3 i + j is that of the first one's i and the other's j.
using CornerPairs = std::uint32_t;

/// Pairs with one corner of the first triangle, and of the second.
constexpr std::array<CornerPairs, 3> k_with_first{0b000'000'111, 0b000'111'000, 0b111'000'000};
constexpr std::array<CornerPairs, 3> k_with_second{0b001'001'001, 0b010'010'010, 0b100'100'100};

/// The corners of two triangles that are one vertex.
CornerPairs same_corners(const ContactSurface& surface, const Triangle& a, const Triangle& b) {
    CornerPairs same = 0;
    const auto look = [&](const auto& are_one) {
#pragma GCC unroll 9
        for (std::size_t k = 0; k < 9; ++k) {
            same |= CornerPairs{are_one(a[k / 3], b[k % 3])} << k;
        }
    };
    if (surface.joined_begin.empty()) {
        look([](Index v, Index w) { return v == w; });
    } else {
        look([&](Index v, Index w) { return surface.are_one(v, w); });
    }
    return same;
}

bool same_pose(const Pose& a, const Pose& b) {
    return a.rotation == b.rotation && a.translation == b.translation;
}

} // namespace

bool BroadPhase::FittedMotion::operator==(const FittedMotion& other) const {
    return same_pose(start, other.start) && same_pose(end, other.end) && number == other.number;
}

BroadPhase::BroadPhase(const ContactSurface& surface, bool self) : self_(self) {
    double largest = 0.0;
    for (const ContactObject& object : surface.objects) {
        largest = std::max(largest, object.thickness);
    }
    for (const ContactObject& object : surface.objects) {
        // Half from each side: a pair's boxes then lie together by at least its thickness.
        const double thickness = object.id.is_obstacle() ? largest : object.thickness;
        reach_.push_back(0.5 * k_reach * thickness);
        slack_.push_back(object.id.is_obstacle() ? 0.0 : k_slack * object.thickness);
    }
    is_any_off_ = std::any_of(surface.rules.begin(), surface.rules.end(),
                              [](const PairRule& rule) { return rule.is_off; });
    vertex_boxes_.resize(surface.start.size());
    triangle_boxes_.resize(surface.triangles.size());
    side_boxes_.resize(surface.triangles.size());
    obstacles_.resize(surface.objects.size());
    fitted_motions_.resize(surface.objects.size());
    is_fitted_.assign(surface.objects.size(), 0);
}

void BroadPhase::find(const ContactSurface& surface,
                      double dt,
                      std::vector<Candidate>& candidates) {
    candidates.clear();
    const auto moving = std::span(surface.velocity).first(at(surface.deformable_vertices));
    seen_velocity_.assign(moving.begin(), moving.end());
    frame_velocity_ = mean(moving);
    const Range deformable{0, at(surface.deformable_vertices), 0, at(surface.deformable_triangles)};
    if (self_) {
        // Among deformables only relative motion counts: what falls as a whole sweeps no space.
        fit(surface, deformable, frame_velocity_, dt, deformables_);
        gather(surface, deformables_, deformables_, 0, candidates);
    }
    fit(surface, deformable, Vec3::Zero(), dt, deformables_);
    for (std::size_t o = 0; o < surface.objects.size(); ++o) {
        const ContactObject& object = surface.objects[o];
        if (object.id.is_obstacle()) {
            const std::size_t vertex = at(object.first_vertex);
            const std::size_t triangle = at(object.first_triangle);
            const FittedMotion motion{object.start, object.end, object.motion_number};
            if (is_fitted_[o] == 0 || motion != fitted_motions_[o]) {
                fit(surface,
                    {vertex, vertex + at(object.vertex_count), triangle,
                     triangle + at(object.triangle_count)},
                    Vec3::Zero(), dt, obstacles_[o]);
                fitted_motions_[o] = motion;
                is_fitted_[o] = 1;
            }
            gather(surface, deformables_, obstacles_[o], object.first_triangle, candidates);
        }
    }
}

void BroadPhase::gather(const ContactSurface& surface,
                        const BoxTree& a,
                        const BoxTree& b,
                        Index first_b,
                        std::vector<Candidate>& candidates) {
    BoxTree::split(a, b, k_tasks, tasks_);
    parallel_collect(
        tasks_.size(),
        [&](std::size_t i, std::vector<Candidate>& found) {
            BoxTree::overlaps(a, b, tasks_[i],
                              [&](Index s, Index t) { look_at(surface, s, first_b + t, found); });
        },
        tasks_found_, candidates, 1);
}

void BroadPhase::remesh(const ContactSurface& surface, std::span<const Vec3> start) {
    vertex_boxes_.resize(surface.start.size());
    triangle_boxes_.resize(surface.triangles.size());
    side_boxes_.resize(surface.triangles.size());
    fitted_motions_.assign(surface.objects.size(), {}); // their boxes stand elsewhere now
    std::fill(is_fitted_.begin(), is_fitted_.end(), 0);
    const std::size_t count = at(surface.deformable_triangles);
    parallel_for(count, [&](std::size_t i) {
        const Triangle& t = surface.triangles[i];
        triangle_boxes_[i] = unite(segment_box(start[at(t[0])], start[at(t[1])], 0.0),
                                   segment_box(start[at(t[2])], start[at(t[2])], 0.0));
    });
    deformables_ = BoxTree(std::span(triangle_boxes_).first(count));
}

bool BroadPhase::covers(const ContactSurface& surface, double dt) const {
    return parallel_reduce(
        seen_velocity_.size(), true,
        [&](std::size_t i) {
            const double slack = slack_[at(surface.object_of_vertex[i])];
            const Vec3 end = dt * surface.velocity[i];
            const Vec3 seen = dt * seen_velocity_[i];
            const Vec3 frame = dt * frame_velocity_;
            return stays_within(end, seen, slack) &&
                   (!self_ || stays_within(end - frame, seen - frame, slack));
        },
        [](bool a, bool b) { return a && b; });
}

void BroadPhase::fit(const ContactSurface& surface,
                     const Range& range,
                     const Vec3& frame_velocity,
                     double dt,
                     BoxTree& tree) {
    parallel_for(range.end_vertex - range.first_vertex, [&](std::size_t k) {
        const std::size_t i = range.first_vertex + k;
        const std::size_t object = at(surface.object_of_vertex[i]);
        const Vec3& from = surface.start[i];
        const Vec3 to = from + dt * (surface.velocity[i] - frame_velocity);
        vertex_boxes_[i] = segment_box(from, to, reach_[object] + slack_[object]);
    });
    parallel_for(range.end_triangle - range.first_triangle, [&](std::size_t k) {
        const std::size_t i = range.first_triangle + k;
        const Triangle& t = surface.triangles[i];
        const std::array<Box, 3> corners{vertex_boxes_[at(t[0])], vertex_boxes_[at(t[1])],
                                         vertex_boxes_[at(t[2])]};
        side_boxes_[i] = {unite(corners[1], corners[2]), unite(corners[2], corners[0]),
                          unite(corners[0], corners[1])};
        triangle_boxes_[i] = unite(side_boxes_[i][2], corners[2]);
    });
    const auto boxes =
        std::span(triangle_boxes_)
            .subspan(range.first_triangle, range.end_triangle - range.first_triangle);
    if (tree.empty()) {
        tree = BoxTree(boxes);
    } else {
        tree.refit(boxes);
    }
}

void BroadPhase::look_at(const ContactSurface& surface,
                         Index s,
                         Index t,
                         std::vector<Candidate>& out) const {
    if (is_any_off_ && surface.is_off(s, t)) {
        return;
    }
    const Triangle& a = surface.triangles[at(s)];
    const Triangle& b = surface.triangles[at(t)];
    const CornerPairs same = same_corners(surface, a, b);
    const auto add = [&](std::array<Index, 4> v, std::array<Index, 2> triangles, PairKind kind) {
        const bool movable =
            surface.inverse_mass[at(v[0])] > 0.0 || surface.inverse_mass[at(v[1])] > 0.0 ||
            surface.inverse_mass[at(v[2])] > 0.0 || surface.inverse_mass[at(v[3])] > 0.0;
        if (movable) {
            out.push_back({v, triangles, surface.rule_of(v[0], v[3]), kind});
        }
    };
    for (std::size_t k = 0; k < 3; ++k) {
        if (surface.owns_corner(s, k) && (same & k_with_first[k]) == 0 &&
            overlap(vertex_boxes_[at(a[k])], triangle_boxes_[at(t)])) {
            add({a[k], b[0], b[1], b[2]}, {t, t}, PairKind::VertexFace);
        }
    }
    for (std::size_t k = 0; k < 3; ++k) {
        if (surface.owns_corner(t, k) && (same & k_with_second[k]) == 0 &&
            overlap(vertex_boxes_[at(b[k])], triangle_boxes_[at(s)])) {
            add({b[k], a[0], a[1], a[2]}, {s, s}, PairKind::VertexFace);
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const Box& box = side_boxes_[at(s)][i];
        if (!surface.owns_side(s, i) || !overlap(box, triangle_boxes_[at(t)])) {
            continue;
        }
        for (std::size_t j = 0; j < 3; ++j) {
            const CornerPairs others = same & ~k_with_first[i] & ~k_with_second[j];
            if (surface.owns_side(t, j) && others == 0 && overlap(box, side_boxes_[at(t)][j])) {
                add({a[(i + 1) % 3], a[(i + 2) % 3], b[(j + 1) % 3], b[(j + 2) % 3]}, {s, t},
                    PairKind::EdgeEdge);
            }
        }
    }
}

} // namespace weft

#include "state/attachment.h"

#include "base/error.h"
#include "base/parallel.h"
#include "geometry/distance.h"
#include "state/build_world.h"
#include "state/seam_chain.h"
#include "state/world.h"

#include <algorithm>

namespace weft {

namespace {

/// A seam whose sides differ in length by more than this fraction puckers.
constexpr double k_length_difference = 0.03;

/// A pair within this fraction of the contact thickness of its rest gap is closed.
constexpr double k_tolerance = 0.5;

/// A point of a cloth: weights on up to three of its vertices.
struct ClothPoint {
    std::array<Index, 3> vertices{k_no_index, k_no_index, k_no_index}; ///< the cloth's own
    std::array<double, 3> weights{0.0, 0.0, 0.0};
};

ClothPoint vertex_point(Index v) {
    return {{v, k_no_index, k_no_index}, {1.0, 0.0, 0.0}};
}

Vec3 place_of(const ClothPoint& point, std::span<const Vec3> positions) {
    Vec3 x = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
        if (point.vertices[k] != k_no_index) {
            x += point.weights[k] * positions[at(point.vertices[k])];
        }
    }
    return x;
}

/// Point of the cloth nearest to x.
ClothPoint nearest_point(const Cloth& cloth, const Vec3& x, std::span<const Vec3> positions) {
    ClothPoint nearest;
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& t : cloth.triangles) {
        const Vec3 w = closest_weights_on_triangle(x, positions[at(t[0])], positions[at(t[1])],
                                                   positions[at(t[2])]);
        const ClothPoint point{t, {w[0], w[1], w[2]}};
        const double distance = (place_of(point, positions) - x).squaredNorm();
        if (distance < least) {
            least = distance;
            nearest = point;
        }
    }
    for (std::size_t k = 0; k < 3; ++k) {
        if (nearest.weights[k] == 0.0) {
            nearest.vertices[k] = k_no_index;
        }
    }
    return nearest;
}

/// Builds the pairs of one `[[attach]]`.
class Builder {
public:
    Builder(World& world, const AttachParams& params)
        : world_(world), params_(params), place_(fmt::format("attach '{}'", params.name)) {}

    void build(const Warn& warn) {
        attachment_ = {.name = params_.name,
                       .kind = params_.kind,
                       .start = params_.start,
                       .close = params_.close,
                       .until = params_.until,
                       .weld = params_.weld,
                       .cloth = {cloth_of(params_.a), cloth_of(params_.b)}};
        set_material();
        if (params_.kind == AttachKind::Seam) {
            build_seam(warn);
        } else {
            build_buttons();
        }
        world_.attachments.push_back(attachment_);
    }

private:
    const Cloth& cloth(std::size_t side) const {
        return world_.cloths[at(attachment_.cloth[side])];
    }
    std::span<const Vec3> positions(std::size_t side) const {
        return world_.positions_of(cloth(side));
    }
    Index cloth_of(const AttachSide& side) const;
    void set_material();
    void build_seam(const Warn& warn);
    void build_buttons();
    ClothPoint button_point(std::size_t side, std::size_t number, const Vec3& near) const;
    void add_pair(const ClothPoint& a, const ClothPoint& b, double limit);

    World& world_;
    const AttachParams& params_;
    std::string place_;
    Attachment attachment_;
};

Index Builder::cloth_of(const AttachSide& side) const {
    const auto found = std::find_if(world_.cloths.begin(), world_.cloths.end(),
                                    [&](const Cloth& cloth) { return cloth.name == side.cloth; });
    if (found == world_.cloths.end()) {
        fail_input("{}: cloth = \"{}\": no cloth has this name", place_, side.cloth);
    }
    return static_cast<Index>(found - world_.cloths.begin());
}

/// Stiffness of the softer cloth, and of both what contact keeps between them.
void Builder::set_material() {
    const FabricParams& a = cloth(0).params.fabric;
    const FabricParams& b = cloth(1).params.fabric;
    const double thickness = 0.5 * (a.thickness + b.thickness);
    attachment_.stiffness = std::min(mean_stretch_stiffness(a), mean_stretch_stiffness(b));
    attachment_.tolerance = k_tolerance * thickness;
    attachment_.rest_gap = params_.kind == AttachKind::Button ? thickness : 0.0;
}

/// Adds the pair, unless both points are the same: the end of a dart.
void Builder::add_pair(const ClothPoint& a, const ClothPoint& b, double limit) {
    AttachedPair pair{.vertices = {},
                      .weights = {},
                      .attachment = static_cast<Index>(world_.attachments.size()),
                      .limit = limit};
    pair.vertices.fill(k_no_index);
    pair.weights.fill(0.0);
    std::size_t count = 0;
    const auto add = [&](const ClothPoint& point, Index first, double sign) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (point.vertices[k] == k_no_index) {
                continue;
            }
            const Index v = first + point.vertices[k];
            const auto end = pair.vertices.begin() + static_cast<long>(count);
            const auto known = std::find(pair.vertices.begin(), end, v) - pair.vertices.begin();
            const auto slot = static_cast<std::size_t>(known);
            pair.vertices[slot] = v;
            pair.weights[slot] += sign * point.weights[k];
            count = std::max(count, slot + 1);
        }
    };
    add(a, cloth(0).first_vertex, 1.0);
    add(b, cloth(1).first_vertex, -1.0);
    const bool is_one = std::all_of(pair.weights.begin(), pair.weights.end(),
                                    [](double w) { return std::abs(w) < 1e-12; });
    if (!is_one) {
        world_.attached_pairs.push_back(pair);
    }
}

void Builder::build_seam(const Warn& warn) {
    const SeamChain a =
        build_seam_chain(cloth(0), params_.a, params_.radius, place_ + ".a", positions(0));
    const SeamChain b =
        build_seam_chain(cloth(1), params_.b, params_.radius, place_ + ".b", positions(1));
    attachment_.length = {a.length(), b.length()};
    const double difference = std::abs(a.length() / b.length() - 1.0);
    if (difference > k_length_difference) {
        warn(fmt::format("{}: side a is {:.4g} m long and side b {:.4g} m, {:.1f} % apart: the "
                         "longer one will pucker",
                         place_, a.length(), b.length(), 100.0 * difference));
    }
    const bool a_is_fine = a.vertices.size() > b.vertices.size();
    const SeamChain& fine = a_is_fine ? a : b;
    const SeamChain& coarse = a_is_fine ? b : a;
    for (const SeamMatch& match : match_chains(fine, coarse)) {
        const std::size_t i = match.vertex;
        const ClothPoint one = vertex_point(fine.vertices[i]);
        const Index first = coarse.vertices[match.segment];
        const Index second = coarse.vertices[match.segment + 1];
        const ClothPoint other =
            match.weight == 0.0 ? vertex_point(first)
            : match.weight == 1.0
                ? vertex_point(second)
                : ClothPoint{{first, second, k_no_index}, {1.0 - match.weight, match.weight, 0.0}};
        const double before = fine.along[i == 0 ? 0 : i - 1];
        const double after = fine.along[std::min(i + 1, fine.along.size() - 1)];
        add_pair(a_is_fine ? one : other, a_is_fine ? other : one,
                 params_.strength * 0.5 * (after - before));
    }
}

void Builder::build_buttons() {
    const std::size_t count = params_.a.at ? 1 : params_.a.vertices.size();
    for (std::size_t i = 0; i < count; ++i) {
        const ClothPoint a = button_point(0, i, Vec3::Zero());
        const ClothPoint b = button_point(1, i, place_of(a, positions(0)));
        add_pair(a, b, params_.strength);
    }
}

/// The point of a side that its list, its place or else the other side's point `near` names.
ClothPoint Builder::button_point(std::size_t side, std::size_t number, const Vec3& near) const {
    const AttachSide& params = side == 0 ? params_.a : params_.b;
    const std::string place = place_ + (side == 0 ? ".a" : ".b");
    if (!params.vertices.empty()) {
        const Index v = params.vertices[number];
        if (v >= cloth(side).vertex_count) {
            fail_input("{}.vertices: {}: must be 0 to {} (vertices after welding)", place, v,
                       cloth(side).vertex_count - 1);
        }
        return vertex_point(v);
    }
    if (!params.at && attachment_.cloth[0] == attachment_.cloth[1]) {
        fail_input("{}: must have vertices or at: both sides are one cloth", place);
    }
    const Vec3& x = params.at ? *params.at : near;
    const ClothPoint point = nearest_point(cloth(side), x, positions(side));
    const double distance = (place_of(point, positions(side)) - x).norm();
    if (distance > params_.radius) {
        fail_input("{}: the nearest point of '{}' is {:.4g} m from ({:.4g}, {:.4g}, {:.4g}) m: "
                   "must be within radius, {} m",
                   place, cloth(side).name, distance, x.x(), x.y(), x.z(), params_.radius);
    }
    return point;
}

} // namespace

void build_attachments(World& world, std::span<const AttachParams> params, const Warn& warn) {
    for (const AttachParams& attach : params) {
        Builder(world, attach).build(warn);
    }
    world.attached_states.assign(world.attached_pairs.size(), {});
    update_attachments(world, 0.0);
}

namespace {

/// Rounding of the times of substeps, s.
constexpr double k_slack = 1e-9;

/// The points of a seam that has let go are two again to contact when this many weld tolerances
/// apart, which is the contact thickness: sooner, they would count as crossing.
constexpr double k_parted = 2.0;

bool is_joined(const Attachment& attachment, double gap, bool acts, bool before) {
    if (attachment.kind == AttachKind::Button) {
        return false; // its cloths lie on each other
    }
    return acts || (before && gap < k_parted * attachment.tolerance);
}

void update(const Attachment& attachment, double gap, double time, AttachedState& state) {
    const bool acts = acts_at(attachment, time);
    state.is_joined = is_joined(attachment, gap, acts, state.is_joined != 0) ? 1 : 0;
    if (!acts) {
        state.welded_since = -1.0;
        return;
    }
    if (state.start_gap < 0.0) {
        state.start_gap = gap;
    }
    const bool should_be_closed = time >= attachment.start + attachment.close - k_slack;
    if (attachment.weld && state.welded_since < 0.0 && should_be_closed &&
        gap <= attachment.rest_gap + attachment.tolerance) {
        state.welded_since = time;
    }
}

} // namespace

Vec3 pair_gap(const AttachedPair& pair, std::span<const Vec3> positions) {
    Vec3 gap = Vec3::Zero();
    for (std::size_t i = 0; i < 6; ++i) {
        if (pair.vertices[i] != k_no_index) {
            gap += pair.weights[i] * positions[static_cast<std::size_t>(pair.vertices[i])];
        }
    }
    return gap;
}

double allowed_gap(const Attachment& attachment, double start_gap, double t) {
    const double closed = attachment.close > 0.0
                              ? std::clamp((t - attachment.start) / attachment.close, 0.0, 1.0)
                              : 1.0;
    const double open = 1.0 - closed * closed * (3.0 - 2.0 * closed);
    return attachment.rest_gap + open * std::max(0.0, start_gap - attachment.rest_gap);
}

bool acts_at(const Attachment& attachment, double t) {
    return t >= attachment.start - k_slack && t <= attachment.until + k_slack;
}

void update_attachments(World& world, double time) {
    parallel_for(world.attached_pairs.size(), [&](std::size_t i) {
        const AttachedPair& pair = world.attached_pairs[i];
        const double gap = pair_gap(pair, world.positions).norm();
        update(world.attachments[static_cast<std::size_t>(pair.attachment)], gap, time,
               world.attached_states[i]);
    });
}

AttachmentReport measure_attachments(const World& world) {
    AttachmentReport report{.pairs = static_cast<int>(world.attached_pairs.size())};
    for (std::size_t i = 0; i < world.attached_pairs.size(); ++i) {
        const AttachedPair& pair = world.attached_pairs[i];
        const auto& attachment = world.attachments[static_cast<std::size_t>(pair.attachment)];
        report.welded += world.attached_states[i].welded_since >= 0.0 ? 1 : 0;
        if (acts_at(attachment, world.time)) {
            const double gap = pair_gap(pair, world.positions).norm() - attachment.rest_gap;
            report.greatest_gap = std::max(report.greatest_gap, gap);
        }
    }
    return report;
}

} // namespace weft

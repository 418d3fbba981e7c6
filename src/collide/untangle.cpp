#include "collide/untangle.h"

#include "collide/untangle_bodies.h"

#include <set>

namespace weft {

namespace {

/// Wanted distance after, as a fraction of the contact thickness. Larger: cloth moves more than it
/// must; smaller: the simulation starts with contacts that hardly have space to act.
constexpr double k_clearance = 0.5;

/// Rounds after which a layer counts as not to be untangled.
constexpr int k_max_rounds = 300;

/// Rounds without fewer crossings than ever before after which it is given up. Smaller: cures that
/// get worse before they get better are missed; larger: more time for what is hopeless.
constexpr int k_stalled_rounds = 60;

/// Rounds that widen gaps once nothing crosses any more.
constexpr int k_clearance_rounds = 20;

/// Sweeps over springs and pushes a round. More: fewer, dearer rounds.
constexpr int k_sweeps = 6;

/// Rounds in which the springs yield to a third, as cloth that only fits stretched must stay so.
/// Smaller: fewer rounds, more distorted triangles.
constexpr double k_yield_rounds = 20.0;

/// Longest displacement of a push, and step of a contour push, as fractions of the mean edge.
/// Larger: cloth is torn past what it should stop at; smaller: more rounds.
constexpr double k_longest_push = 0.25;
constexpr double k_contour_step = 0.1;

/// Keeps two vertices at the distance that they had.
struct Spring {
    Index a, b;
    double length;   ///< m
    double strength; ///< fraction of the error that a sweep takes away
};

/// The edges, and across them the diagonals, which resist folding.
std::vector<Spring> springs_of(const Tangle& tangle, const Cloth& cloth) {
    constexpr double k_edge = 0.5;
    constexpr double k_diagonal = 0.1;
    std::vector<Spring> springs;
    const auto add = [&](Index a, Index b, double strength) {
        const Index i = a + cloth.first_vertex;
        const Index j = b + cloth.first_vertex;
        springs.push_back({i, j, (tangle.x[at(i)] - tangle.x[at(j)]).norm(), strength});
    };
    for (const MeshEdge& edge : cloth.topology.edges) {
        add(edge.v[0], edge.v[1], k_edge);
        if (!edge.is_boundary()) {
            add(edge.apex[0], edge.apex[1], k_diagonal);
        }
    }
    return springs;
}

void pull(const Spring& spring, double elasticity, Tangle& tangle) {
    Vec3& a = tangle.x[at(spring.a)];
    Vec3& b = tangle.x[at(spring.b)];
    const double length = (b - a).norm();
    if (length > 0.0) {
        const Vec3 displacement =
            0.5 * elasticity * spring.strength * (1.0 - spring.length / length) * (b - a);
        a += displacement;
        b -= displacement;
    }
}

std::size_t count_crossing(std::span<const NearPair> pairs) {
    return static_cast<std::size_t>(
        std::count_if(pairs.begin(), pairs.end(), [](const NearPair& p) { return p.crosses; }));
}

/// One layer against what stands and against itself.
class LayerUntangler {
public:
    LayerUntangler(Tangle& tangle, std::span<const Cloth> cloths, bool self);

    std::size_t run(UntangleReport& report);

private:
    std::size_t find_pairs();
    void relax(double elasticity);
    void widen_gaps();

    Tangle& tangle_;
    BodyPushes bodies_;
    NearPairSearch search_;
    std::vector<Spring> springs_;
    double mean_edge_ = 0.0;
    double margin_ = 0.0; ///< the widest clearance, m
    std::vector<NearPair> pairs_;
    std::vector<Push> pushes_;
};

LayerUntangler::LayerUntangler(Tangle& tangle, std::span<const Cloth> cloths, bool self)
    : tangle_(tangle), bodies_(tangle), search_(tangle, self) {
    double length = 0.0;
    std::size_t edges = 0;
    for (std::size_t c = 0; c < cloths.size(); ++c) {
        const Cloth& cloth = cloths[c];
        const Index object = tangle.surface.number_of({ObjectKind::Cloth, static_cast<Index>(c)});
        if (tangle.roles[at(object)] == TangleRole::Moves) {
            const auto springs = springs_of(tangle, cloth);
            springs_.insert(springs_.end(), springs.begin(), springs.end());
            margin_ = std::max(margin_, k_clearance * cloth.params.fabric.thickness);
            for (const MeshEdge& edge : cloth.topology.edges) {
                const Index first = cloth.first_vertex;
                length +=
                    (tangle.x[at(first + edge.v[0])] - tangle.x[at(first + edge.v[1])]).norm();
            }
            edges += cloth.topology.edges.size();
        }
    }
    mean_edge_ = length / static_cast<double>(std::max<std::size_t>(edges, 1));
}

std::size_t LayerUntangler::find_pairs() {
    search_.find(tangle_, margin_, pairs_);
    return count_crossing(pairs_);
}

/// Springs and pushes in turn; the pushes have the last word.
void LayerUntangler::relax(double elasticity) {
    const double limit = k_longest_push * mean_edge_;
    for (int sweep = 0; sweep < k_sweeps; ++sweep) {
        for (const Spring& spring : springs_) {
            pull(spring, elasticity, tangle_);
        }
        for (const Push& push : pushes_) {
            apply(push, limit, tangle_);
        }
    }
}

/// Returns how many pairs are left crossing.
std::size_t LayerUntangler::run(UntangleReport& report) {
    std::size_t least = find_pairs();
    int stalled = 0;
    for (int round = 0; round < k_max_rounds && stalled < k_stalled_rounds; ++round) {
        pushes_.clear();
        if (count_crossing(pairs_) == 0) {
            widen_gaps();
            return 0;
        }
        bodies_.find(tangle_, pairs_, k_clearance, pushes_);
        find_contour_pushes(tangle_, pairs_, k_contour_step * mean_edge_, pushes_);
        relax(std::exp(-round / k_yield_rounds));
        ++report.rounds;
        const std::size_t crossing = find_pairs();
        stalled = crossing < least ? 0 : stalled + 1;
        least = std::min(least, crossing);
    }
    return count_crossing(pairs_);
}

/// Pushes apart what is too near, as long as nothing crosses for it and it helps.
void LayerUntangler::widen_gaps() {
    std::vector<Vec3> apart = tangle_.x;
    std::size_t least = std::numeric_limits<std::size_t>::max();
    for (int round = 0; round < k_clearance_rounds; ++round) {
        pushes_.clear();
        find_clearance_pushes(tangle_, pairs_, k_clearance, pushes_);
        if (pushes_.empty() || pushes_.size() >= least) {
            return;
        }
        least = pushes_.size();
        for (const Push& push : pushes_) {
            apply(push, 0.5 * margin_, tangle_);
        }
        if (find_pairs() > 0) {
            tangle_.x = apart;
            return;
        }
        apart = tangle_.x;
    }
}

/// Takes the layers in their order from the body outwards.
class Untangler {
public:
    Untangler(Tangle& tangle, std::span<const Cloth> cloths, const UntangleFrom& from)
        : tangle_(tangle), cloths_(cloths), from_(from) {}

    /// Lets the cloths of a layer move together; what does not come apart evenly that way is tried
    /// again one cloth after the other, as if each were outside of those before it.
    void run_layer(int layer, UntangleReport& report) {
        const std::vector<Vec3> before = tangle_.x;
        const auto role = [&](std::size_t c) { return order(cloths_[c].params.layer, layer); };
        if (run(role, report) == 0 || count(layer) == 1) {
            return;
        }
        tangle_.x = before;
        for (std::size_t next = 0; next < cloths_.size(); ++next) {
            if (cloths_[next].params.layer == layer) {
                run(
                    [&](std::size_t c) {
                        return cloths_[c].params.layer == layer ? order(c, next) : role(c);
                    },
                    report);
            }
        }
    }

    std::size_t count_crossings() {
        set_roles([](std::size_t) { return TangleRole::Moves; });
        std::vector<NearPair> pairs;
        NearPairSearch(tangle_, from_.cloth).find(tangle_, 0.0, pairs);
        return count_crossing(pairs);
    }

private:
    template <typename T> TangleRole order(T own, T turn) const {
        return own == turn ? TangleRole::Moves : own > turn ? TangleRole::Absent : below();
    }
    TangleRole below() const { return from_.cloth ? TangleRole::Stands : TangleRole::Absent; }

    std::ptrdiff_t count(int layer) const {
        return std::count_if(cloths_.begin(), cloths_.end(),
                             [&](const Cloth& cloth) { return cloth.params.layer == layer; });
    }

    template <typename Role> void set_roles(const Role& role_of_cloth) {
        for (std::size_t o = 0; o < tangle_.roles.size(); ++o) {
            const ObjectId object = tangle_.surface.objects[o].id;
            set_role(tangle_, o,
                     object.kind == ObjectKind::Cloth ? role_of_cloth(at(object.index))
                     : from_.obstacles                ? TangleRole::Stands
                                                      : TangleRole::Absent);
        }
    }

    template <typename Role> std::size_t run(const Role& role_of_cloth, UntangleReport& report) {
        set_roles(role_of_cloth);
        return LayerUntangler(tangle_, cloths_, from_.cloth).run(report);
    }

    Tangle& tangle_;
    std::span<const Cloth> cloths_;
    UntangleFrom from_;
};

} // namespace

UntangleReport untangle(World& world, const UntangleFrom& from) {
    Tangle tangle = make_tangle(world);
    Untangler untangler(tangle, world.cloths, from);
    UntangleReport report;
    report.pairs_before = untangler.count_crossings();
    if (report.pairs_before == 0) {
        return report;
    }
    std::set<int> layers;
    for (const Cloth& cloth : world.cloths) {
        layers.insert(cloth.params.layer);
    }
    for (const int layer : layers) {
        untangler.run_layer(layer, report);
    }
    report.pairs_after = untangler.count_crossings();
    for (std::size_t v = 0; v < world.vertex_count(); ++v) {
        const double displacement = (tangle.x[v] - world.positions[v]).norm();
        report.max_displacement = std::max(report.max_displacement, displacement);
        world.positions[v] = tangle.x[v];
    }
    return report;
}

} // namespace weft

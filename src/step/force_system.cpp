#include "step/force_system.h"

#include "forces/cloth_forces.h"
#include "forces/rigid_elements.h"

#include <cassert>
#include <iterator>
#include <numeric>
#include <type_traits>

namespace weft {

namespace {

std::vector<VertexRange> vertex_ranges(const World& world) {
    std::vector<VertexRange> ranges;
    for (const Cloth& cloth : world.cloths) {
        ranges.push_back({cloth.first_vertex, cloth.vertex_count});
    }
    for_each_body(world, [&](const Body& body) {
        ranges.push_back({body.first_particle, body.particle_count});
    });
    return ranges;
}

} // namespace

/// One set of elements, seen alike by the loops below.
class ForceSystem::Group {
public:
    virtual ~Group() = default;
    virtual ElementSet set() const = 0;

    /// Returns the slots that changed.
    virtual std::vector<Index> remesh(const World& world,
                                      std::span<const ClothChanges> changes) = 0;

    virtual void start_substep(std::span<const Vec3>) {}
    virtual void evaluate(std::span<const Vec3> x,
                          std::span<const Vec3> v,
                          SystemScales scales,
                          std::span<Vec3> forces,
                          std::span<Mat3> blocks) const = 0;
    virtual void
    forces(std::span<const Vec3> x, std::span<const Vec3> v, std::span<Vec3> forces) const = 0;
};

namespace {

/// Whose elements a group has: where the vertices that they number stand in World, and how they
/// follow a change of meshes, returning the slots that changed.
struct OfCloth {
    std::size_t cloth;

    VertexRange vertices(const World& world) const {
        return {world.cloths[cloth].first_vertex, world.cloths[cloth].vertex_count};
    }
    template <typename Elements>
    std::vector<Index>
    remesh(Elements& elements, const World& world, std::span<const ClothChanges> changes) const {
        if constexpr (requires { elements.remesh(world.cloths[cloth], changes[cloth]); }) {
            return elements.remesh(world.cloths[cloth], changes[cloth]);
        } else {
            return {};
        }
    }
};

struct OfSolid {
    std::size_t solid;

    VertexRange vertices(const World& world) const {
        const Body& body = world.solids[solid].body;
        return {body.first_particle, body.particle_count};
    }
    std::vector<Index> remesh(EdgeElements&, const World&, std::span<const ClothChanges>) const {
        return {};
    }
};

/// Elements that join vertices of several objects, or stand behind all cloths: made of the world,
/// with its own indices, and made anew when a mesh before them changes.
struct OfWorld {
    VertexRange vertices(const World& world) const {
        return {0, static_cast<Index>(world.vertex_count())};
    }
    template <typename Elements>
    std::vector<Index>
    remesh(Elements& elements, const World& world, std::span<const ClothChanges>) const {
        elements = Elements(world);
        std::vector<Index> slots(elements.size());
        std::iota(slots.begin(), slots.end(), 0);
        return slots;
    }
};

template <typename Elements>
constexpr bool k_is_constant = std::is_same_v<Elements, ConstantBending>;

} // namespace

template <typename Elements, typename Owner> class ForceSystem::GroupOf : public Group {
public:
    GroupOf(const World& world, Owner owner, Elements elements)
        : owner_(owner), vertices_(owner.vertices(world)), elements_(std::move(elements)) {}

    Elements& elements() { return elements_; }

    ElementSet set() const override {
        if constexpr (k_is_constant<Elements>) { // the assembler has the blocks
            return {elements_.nodes_per_element(), elements_.nodes(), vertices_.first, true,
                    elements_.stiffness()};
        } else {
            return {.nodes_per_element = Elements::k_nodes,
                    .nodes = elements_.nodes(),
                    .first_vertex = vertices_.first,
                    .is_difference = Elements::k_is_difference};
        }
    }
    std::vector<Index> remesh(const World& world, std::span<const ClothChanges> changes) override {
        vertices_ = owner_.vertices(world);
        return owner_.remesh(elements_, world, changes);
    }
    void start_substep(std::span<const Vec3> v) override {
        if constexpr (requires { elements_.linearise_at(v); }) {
            elements_.linearise_at(own(v));
        }
    }
    void evaluate(std::span<const Vec3> x,
                  std::span<const Vec3> v,
                  SystemScales scales,
                  std::span<Vec3> forces,
                  std::span<Mat3> blocks) const override {
        if constexpr (k_is_constant<Elements>) {
            elements_.forces(own(x), forces);
        } else {
            elements_.evaluate(own(x), own(v), scales, forces, blocks);
        }
    }
    void forces(std::span<const Vec3> x,
                std::span<const Vec3> v,
                std::span<Vec3> forces) const override {
        if constexpr (k_is_constant<Elements>) {
            elements_.forces(own(x), forces);
        } else {
            elements_.forces(own(x), own(v), forces);
        }
    }

private:
    std::span<const Vec3> own(std::span<const Vec3> values) const {
        return values.subspan(at(vertices_.first), at(vertices_.count));
    }

    Owner owner_;
    VertexRange vertices_;
    Elements elements_;
};

/// Forces are summed in the order of the groups; constant ones come last.
ForceSystem::ForceSystem(const World& world, const SceneParams& params) {
    std::vector<std::unique_ptr<Group>> constant;
    const auto add = [&](auto owner, auto elements) {
        using Elements = decltype(elements);
        auto group =
            std::make_unique<GroupOf<Elements, decltype(owner)>>(world, owner, std::move(elements));
        auto* added = group.get();
        (k_is_constant<Elements> ? constant : groups_).push_back(std::move(group));
        return &added->elements();
    };
    for (std::size_t c = 0; c < world.cloths.size(); ++c) {
        for_each_force(world.cloths[c], params,
                       [&](auto elements) { add(OfCloth{c}, std::move(elements)); });
    }
    for (std::size_t s = 0; s < world.solids.size(); ++s) {
        add(OfSolid{s}, EdgeElements(world.solids[s]));
    }
    add(OfWorld{}, RigidElements(world));
    attachments_ = add(OfWorld{}, AttachmentElements(world));
    std::move(constant.begin(), constant.end(), std::back_inserter(groups_));
    assembler_ = std::make_unique<Assembler>(vertex_ranges(world), sets());
    resize_arrays();
}

ForceSystem::~ForceSystem() = default;

std::vector<ElementSet> ForceSystem::sets() const {
    std::vector<ElementSet> sets;
    for (const auto& group : groups_) {
        sets.push_back(group->set());
    }
    return sets;
}

void ForceSystem::remesh(const World& world, std::span<const ClothChanges> changes) {
    assert(changes.size() == world.cloths.size());
    std::vector<std::vector<Index>> changed;
    for (const auto& group : groups_) {
        changed.push_back(group->remesh(world, changes));
    }
    assembler_->remesh(vertex_ranges(world), sets(), changed);
    resize_arrays();
}

/// What elements wrote is not kept: each evaluation writes all of it.
void ForceSystem::resize_arrays() {
    if (element_forces_.size() != assembler_->force_count()) {
        element_forces_.clear();
        element_forces_.resize(assembler_->force_count());
    }
    if (element_blocks_.size() != assembler_->block_count()) {
        element_blocks_.clear();
        element_blocks_.resize(assembler_->block_count());
    }
}

void ForceSystem::start_substep(std::span<const Vec3> v) {
    for (const auto& group : groups_) {
        group->start_substep(v);
    }
}

void ForceSystem::set_attachments(const World& world, double end_time) {
    attachments_->set(world, end_time);
}

void ForceSystem::evaluate(std::span<const Vec3> x,
                           std::span<const Vec3> v,
                           SystemScales scales,
                           std::span<Vec3> forces) {
    scales_ = scales;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        groups_[g]->evaluate(x, v, scales, assembler_->forces_of(g, element_forces_),
                             assembler_->blocks_of(g, element_blocks_));
    }
    assembler_->gather_forces(element_forces_, forces);
}

void ForceSystem::forces_only(std::span<const Vec3> x,
                              std::span<const Vec3> v,
                              std::span<Vec3> forces) {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        groups_[g]->forces(x, v, assembler_->forces_of(g, element_forces_));
    }
    assembler_->gather_forces(element_forces_, forces);
}

void ForceSystem::assemble(std::span<const double> diagonal, BlockMatrix& matrix) const {
    assembler_->assemble(element_blocks_, scales_.stiffness, diagonal, matrix);
}

} // namespace weft

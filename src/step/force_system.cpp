#include "step/force_system.h"

#include "forces/air.h"
#include "forces/bend_damping.h"
#include "forces/edge_elements.h"
#include "forces/membrane_elements.h"
#include "forces/rigid_elements.h"
#include "forces/stvk_triangle_elements.h"

#include <cassert>
#include <numeric>

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

/// True for elements of one symmetric block, see ElementSet.
template <typename Elements> constexpr bool k_is_difference = requires {
    Elements::k_is_difference;
};

} // namespace

/// One kind of element on one cloth or on all, seen alike by the loops below.
class ForceSystem::Group {
public:
    virtual ~Group() = default;
    virtual ElementSet set() const = 0;

    /// Returns the slots that changed.
    virtual std::vector<Index> adapt(const World& world, std::span<const ClothChanges> changes) = 0;

    virtual void start_substep(std::span<const Vec3>) {}
    virtual void evaluate(std::span<const Vec3> x,
                          std::span<const Vec3> v,
                          SystemScales scales,
                          std::span<Vec3> forces,
                          std::span<Mat3> blocks) const = 0;
    virtual void
    forces(std::span<const Vec3> x, std::span<const Vec3> v, std::span<Vec3> forces) const = 0;
};

template <typename Elements> class ForceSystem::ClothGroup : public Group {
public:
    ClothGroup(const World& world, std::size_t cloth, Elements elements)
        : cloth_(cloth), elements_(std::move(elements)) {
        find_vertices(world.cloths[cloth]);
    }

    ElementSet set() const override {
        return {.nodes_per_element = Elements::k_nodes,
                .nodes = elements_.nodes(),
                .first_vertex = static_cast<Index>(first_),
                .is_difference = k_is_difference<Elements>};
    }
    std::vector<Index> adapt(const World& world, std::span<const ClothChanges> changes) override {
        find_vertices(world.cloths[cloth_]);
        return elements_.update(world.cloths[cloth_], changes[cloth_]);
    }
    void start_substep(std::span<const Vec3> v) override {
        if constexpr (requires { elements_.linearise_at(v); }) {
            elements_.linearise_at(v.subspan(first_, count_));
        }
    }
    void evaluate(std::span<const Vec3> x,
                  std::span<const Vec3> v,
                  SystemScales scales,
                  std::span<Vec3> forces,
                  std::span<Mat3> blocks) const override {
        elements_.evaluate(x.subspan(first_, count_), v.subspan(first_, count_), scales, forces,
                           blocks);
    }
    void forces(std::span<const Vec3> x,
                std::span<const Vec3> v,
                std::span<Vec3> forces) const override {
        elements_.forces(x.subspan(first_, count_), v.subspan(first_, count_), forces);
    }

private:
    void find_vertices(const Cloth& cloth) {
        first_ = static_cast<std::size_t>(cloth.first_vertex);
        count_ = static_cast<std::size_t>(cloth.vertex_count);
    }

    std::size_t cloth_;
    Elements elements_;
    std::size_t first_ = 0, count_ = 0;
};

/// The edges of a solid, between its particles.
class ForceSystem::SolidGroup : public Group {
public:
    SolidGroup(const World& world, std::size_t solid)
        : solid_(solid), elements_(world.solids[solid].network,
                                   world.solids[solid].params.model,
                                   world.solids[solid].params.spring) {
        find_particles(world);
    }

    ElementSet set() const override {
        return {.nodes_per_element = EdgeElements::k_nodes,
                .nodes = elements_.nodes(),
                .first_vertex = static_cast<Index>(first_),
                .is_difference = EdgeElements::k_is_difference};
    }
    std::vector<Index> adapt(const World& world, std::span<const ClothChanges>) override {
        find_particles(world);
        return {};
    }
    void evaluate(std::span<const Vec3> x,
                  std::span<const Vec3> v,
                  SystemScales scales,
                  std::span<Vec3> forces,
                  std::span<Mat3> blocks) const override {
        elements_.evaluate(x.subspan(first_), v.subspan(first_), scales, forces, blocks);
    }
    void forces(std::span<const Vec3> x,
                std::span<const Vec3> v,
                std::span<Vec3> forces) const override {
        elements_.forces(x.subspan(first_), v.subspan(first_), forces);
    }

private:
    void find_particles(const World& world) {
        first_ = static_cast<std::size_t>(world.solids[solid_].body.first_particle);
    }

    std::size_t solid_;
    EdgeElements elements_;
    std::size_t first_ = 0;
};

/// Blocks never change: the assembler has them.
class ForceSystem::BendingGroup : public Group {
public:
    BendingGroup(const World& world, std::size_t cloth)
        : cloth_(cloth), elements_(world.cloths[cloth]), first_(world.cloths[cloth].first_vertex) {}

    ElementSet set() const override {
        return {elements_.nodes_per_element(), elements_.nodes(), first_, true,
                elements_.stiffness()};
    }
    std::vector<Index> adapt(const World& world, std::span<const ClothChanges> changes) override {
        first_ = world.cloths[cloth_].first_vertex;
        return elements_.update(world.cloths[cloth_], changes[cloth_]);
    }
    void evaluate(std::span<const Vec3> x,
                  std::span<const Vec3> v,
                  SystemScales,
                  std::span<Vec3> forces,
                  std::span<Mat3>) const override {
        this->forces(x, v, forces);
    }
    void
    forces(std::span<const Vec3> x, std::span<const Vec3>, std::span<Vec3> forces) const override {
        elements_.forces(x.subspan(static_cast<std::size_t>(first_)), forces);
    }

private:
    std::size_t cloth_;
    ConstantBending elements_;
    Index first_;
};

/// Elements that join vertices of several objects, or stand behind all cloths: made of the world,
/// with its own indices, and made anew when a mesh before them changes.
template <typename Elements> class ForceSystem::WorldGroup : public Group {
public:
    explicit WorldGroup(const World& world) : elements_(world) {}

    Elements& elements() { return elements_; }

    ElementSet set() const override { return {Elements::k_nodes, elements_.nodes(), 0}; }
    std::vector<Index> adapt(const World& world, std::span<const ClothChanges>) override {
        elements_ = Elements(world);
        std::vector<Index> slots(elements_.size());
        std::iota(slots.begin(), slots.end(), 0);
        return slots;
    }
    void evaluate(std::span<const Vec3> x,
                  std::span<const Vec3> v,
                  SystemScales scales,
                  std::span<Vec3> forces,
                  std::span<Mat3> blocks) const override {
        elements_.evaluate(x, v, scales, forces, blocks);
    }
    void forces(std::span<const Vec3> x,
                std::span<const Vec3> v,
                std::span<Vec3> forces) const override {
        elements_.forces(x, v, forces);
    }

private:
    Elements elements_;
};

ForceSystem::ForceSystem(const World& world, const SceneParams& params) {
    const auto add = [&](std::size_t cloth, auto elements) {
        groups_.push_back(
            std::make_unique<ClothGroup<decltype(elements)>>(world, cloth, std::move(elements)));
    };
    for (std::size_t c = 0; c < world.cloths.size(); ++c) {
        const Cloth& cloth = world.cloths[c];
        if (cloth.params.model == Model::Corotational) {
            add(c, MembraneElements(cloth));
            add(c, BendDampingElements(cloth));
        } else {
            add(c, EdgeElements(cloth.network, cloth.params.model, cloth.params.spring));
        }
        if (cloth.params.model == Model::StvkTriangle) {
            add(c, StvkTriangleElements(cloth));
        }
        add(c, AirElements(cloth, params));
    }
    for (std::size_t s = 0; s < world.solids.size(); ++s) {
        groups_.push_back(std::make_unique<SolidGroup>(world, s));
    }
    groups_.push_back(std::make_unique<WorldGroup<RigidElements>>(world));
    auto attachments = std::make_unique<WorldGroup<AttachmentElements>>(world);
    attachments_ = attachments.get();
    groups_.push_back(std::move(attachments));
    for (std::size_t c = 0; c < world.cloths.size(); ++c) {
        if (world.cloths[c].params.model == Model::Corotational) {
            groups_.push_back(std::make_unique<BendingGroup>(world, c));
        }
    }
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

void ForceSystem::adapt(const World& world, std::span<const ClothChanges> changes) {
    assert(changes.size() == world.cloths.size());
    std::vector<std::vector<Index>> changed;
    for (const auto& group : groups_) {
        changed.push_back(group->adapt(world, changes));
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
    attachments_->elements().set(world, end_time);
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

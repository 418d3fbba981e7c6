#include "step/force_system.h"

#include "forces/air.h"
#include "forces/bend_damping.h"
#include "forces/membrane_elements.h"

namespace weft {

/// One kind of element on one cloth or on all, seen alike by the loops below.
class ForceSystem::Group {
public:
    virtual ~Group() = default;
    virtual ElementSet set() const = 0;
    virtual void start_substep(std::span<const Vec3> v) = 0;
    virtual void evaluate(std::span<const Vec3> x,
                          std::span<const Vec3> v,
                          SystemScales scales,
                          std::span<Vec3> forces,
                          std::span<Mat3> blocks) const = 0;
    virtual void
    forces(std::span<const Vec3> x, std::span<const Vec3> v, std::span<Vec3> forces) const = 0;
};

template <typename Elements> class ForceSystem::GroupOf : public Group {
public:
    GroupOf(Index first_vertex, std::size_t vertex_count, Elements elements)
        : elements_(std::move(elements)), first_(static_cast<std::size_t>(first_vertex)),
          count_(vertex_count) {}

    Elements& elements() { return elements_; }

    ElementSet set() const override {
        return {Elements::k_nodes, elements_.nodes(), static_cast<Index>(first_)};
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
    Elements elements_;
    std::size_t first_, count_;
};

template <typename Elements> void ForceSystem::add_group(const Cloth& cloth, Elements elements) {
    if (elements.size() > 0) {
        groups_.push_back(std::make_unique<GroupOf<Elements>>(
            cloth.first_vertex, static_cast<std::size_t>(cloth.vertex_count), std::move(elements)));
    }
}

void ForceSystem::add_attachments(const World& world) {
    if (!world.attached_pairs.empty()) {
        auto group = std::make_unique<GroupOf<AttachmentElements>>(0, world.vertex_count(),
                                                                   AttachmentElements(world));
        attachments_ = &group->elements();
        groups_.push_back(std::move(group));
    }
}

ForceSystem::ForceSystem(const World& world, const SceneParams& params) {
    for (const Cloth& cloth : world.cloths) {
        add_group(cloth, MembraneElements(cloth));
        add_group(cloth, BendDampingElements(cloth));
        add_group(cloth, AirElements(cloth, params));
        bendings_.push_back({ConstantBending(cloth), cloth.first_vertex, cloth.vertex_count});
    }
    add_attachments(world);
    std::vector<ElementSet> sets;
    for (const auto& group : groups_) {
        sets.push_back(group->set());
    }
    std::vector<ElementSet> constant_sets;
    std::vector<double> constant_blocks;
    for (const Bending& bending : bendings_) {
        const ConstantBending& elements = bending.elements;
        constant_sets.push_back(
            {elements.nodes_per_element(), elements.nodes(), bending.first_vertex});
        constant_blocks.insert(constant_blocks.end(), elements.stiffness().begin(),
                               elements.stiffness().end());
    }
    assembler_ =
        std::make_unique<Assembler>(world.vertex_count(), sets, constant_sets, constant_blocks);
    element_forces_.resize(assembler_->force_count());
    element_blocks_.resize(assembler_->block_count());
}

ForceSystem::~ForceSystem() = default;

void ForceSystem::start_substep(std::span<const Vec3> v) {
    for (const auto& group : groups_) {
        group->start_substep(v);
    }
}

void ForceSystem::set_attachments(const World& world, double end_time) {
    if (attachments_ != nullptr) {
        attachments_->set(world, end_time);
    }
}

void ForceSystem::evaluate(std::span<const Vec3> x,
                           std::span<const Vec3> v,
                           SystemScales scales,
                           std::span<Vec3> forces) {
    scales_ = scales;
    std::size_t at_force = 0;
    std::size_t at_block = 0;
    for (const auto& group : groups_) {
        const ElementSet set = group->set();
        const std::size_t block_count = set.count() * set.blocks_per_element();
        group->evaluate(x, v, scales,
                        std::span(element_forces_).subspan(at_force, set.nodes.size()),
                        std::span(element_blocks_).subspan(at_block, block_count));
        at_force += set.nodes.size();
        at_block += block_count;
    }
    bending_forces(x);
    assembler_->gather_forces(element_forces_, forces);
}

void ForceSystem::forces_only(std::span<const Vec3> x,
                              std::span<const Vec3> v,
                              std::span<Vec3> forces) {
    std::size_t at_force = 0;
    for (const auto& group : groups_) {
        const std::size_t count = group->set().nodes.size();
        group->forces(x, v, std::span(element_forces_).subspan(at_force, count));
        at_force += count;
    }
    bending_forces(x);
    assembler_->gather_forces(element_forces_, forces);
}

void ForceSystem::bending_forces(std::span<const Vec3> x) {
    std::size_t at_force = element_forces_.size();
    for (const Bending& bending : bendings_) {
        at_force -= bending.elements.nodes().size();
    }
    for (const Bending& bending : bendings_) {
        const std::size_t count = bending.elements.nodes().size();
        bending.elements.forces(x.subspan(static_cast<std::size_t>(bending.first_vertex),
                                          static_cast<std::size_t>(bending.vertex_count)),
                                std::span(element_forces_).subspan(at_force, count));
        at_force += count;
    }
}

void ForceSystem::assemble(std::span<const double> diagonal, BlockMatrix& matrix) const {
    assembler_->assemble(element_blocks_, scales_.stiffness, diagonal, matrix);
}

} // namespace weft

#include "state/join_to_rigid.h"

#include "state/rigid_motion.h"

#include <cassert>

namespace weft {

void join_to_rigid(World& world, const Joint& joint) {
    assert(world.attached_states.empty());
    const RigidBody& rigid = world.rigids[static_cast<std::size_t>(joint.rigid)];
    const Pose pose = nearest_pose(rigid.rest, particles_of(rigid, world.positions));
    for (const Index v : joint.vertices) {
        const Vec3 arm = pose.rotation.transpose() *
                         (world.positions[static_cast<std::size_t>(v)] - pose.translation);
        const auto weights = carrying_weights(rigid.rest, arm);
        AttachedPair pair{
            .vertices = {v, k_no_index, k_no_index, k_no_index, k_no_index, k_no_index},
            .weights = {1.0, 0.0, 0.0, 0.0, 0.0, 0.0},
            .attachment = static_cast<Index>(world.attachments.size()),
            .limit = std::numeric_limits<double>::infinity()};
        for (std::size_t k = 0; k < 4; ++k) {
            pair.vertices[k + 1] = rigid.body.first_particle + static_cast<Index>(k);
            pair.weights[k + 1] = -weights[k];
        }
        world.attached_pairs.push_back(pair);
    }
    world.attachments.push_back({.name = joint.name,
                                 .kind = AttachKind::Button,
                                 .close = 0.0,
                                 .until = joint.until,
                                 .stiffness = joint.stiffness,
                                 .is_joint = true});
}

} // namespace weft

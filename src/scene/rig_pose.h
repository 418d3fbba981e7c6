#pragma once

#include "scene/rig.h"

#include <cstdint>
#include <span>

namespace weft {

/// The value of keys at time t: linear between two, constant outside.
Vec3 value_at(const KeyFrames<Vec3>& keys, double t);
/// The same on the unit sphere, at constant speed (slerp).
Eigen::Quaterniond value_at(const KeyFrames<Eigen::Quaterniond>& keys, double t);
std::vector<double> value_at(const KeyFrames<std::vector<double>>& keys, double t);

/// Transform of every node to the file's frame at time t (s) of an animation.
std::vector<Affine> node_transforms(const Rig& rig, const Animation& animation, double t);

/// Positions in the file's frame of vertices of a rig at time t (s) of an animation: morph targets
/// first, then linear blend skinning, sum over bones of weight * node * offset; without bones the
/// part's node.
/// Source: Lander 1998, "Skin them bones".
void pose_vertices(const Rig& rig,
                   const Animation& animation,
                   double t,
                   std::span<const SourceVertex> vertices,
                   std::span<Vec3> positions);

/// Parts that may be sewn where they meet have the same number: those with bones, and of the others
/// those that hang on the same animated node (or on none). Others only touch, and part when they
/// move.
std::vector<Index> motion_groups(const Rig& rig);

/// Differs where any of the numbers of a rig or an animation differs.
std::uint64_t fingerprint(const Rig& rig, const Animation& animation);

} // namespace weft

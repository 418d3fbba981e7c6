#pragma once

#include "scene/object_kind.h"
#include "state/world.h"

#include <compare>

namespace weft {

/// Which object of a world.
struct ObjectId {
    ObjectKind kind = ObjectKind::Cloth;
    Index index = 0; ///< of World::cloths, solids, rigids or obstacles

    bool is_obstacle() const { return kind == ObjectKind::Obstacle; } ///< else it moves by forces
    auto operator<=>(const ObjectId&) const = default;
};

/// All objects of a world in their order.
std::vector<ObjectId> objects_of(const World& world);

const std::string& object_name(const World& world, ObjectId object);

/// Positions (m, at the world's time) and triangles of one object.
TriangleMesh object_mesh(const World& world, ObjectId object);

} // namespace weft

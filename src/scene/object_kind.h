#pragma once

namespace weft {

/// The kinds of objects, in the order in which the objects of a world and of a frame are listed.
enum class ObjectKind { Cloth, Solid, Rigid, Obstacle };

} // namespace weft

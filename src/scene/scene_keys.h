#pragma once

#include "scene/key.h"

/// The keys of the scene file, described once. A new key is a member in scene/params.h and a row
/// here; the reader, its checks, the writer, `weft keys` and docs/scene-keys.md follow.
///
/// `keys_of` binds the rows to the values of `params`, in the order in which they are written.
namespace weft {

Keys keys_of(SceneParams& params);
Keys keys_of(ContactParams& params);
Keys keys_of(FrictionPair& params);
Keys keys_of(FabricParams& params);
Keys keys_of(AdaptParams& params);
Keys keys_of(PinParams& params);
Keys keys_of(ClothParams& params);
Keys keys_of(SolidParams& params);
Keys keys_of(RigidParams& params);
Keys keys_of(ObstacleParams& params);
Keys keys_of(PoseKey& params);
Keys keys_of(AttachParams& params);
/// A seam knows other keys than a button.
Keys keys_of(AttachSide& params, AttachKind kind);
Keys keys_of(RenderParams& params);

/// The rows `friction` and `static_friction` of all that has them.
Keys friction_keys(double& friction, std::optional<double>& at_rest);

enum class SpringOwner { Cloth, Solid };
Keys keys_of(SpringParams& params, Model model, SpringOwner owner);

/// What is wrong, as `key = value: must be ...` with the key as in the scene file, or "". What
/// hangs below in tables of its own (fabric, pins) is asked on its own.
template <typename Params> std::string problem(Params params) {
    return problem_of(keys_of(params));
}
std::string problem(PinParams params);
std::string problem(SolidParams params);
std::string problem(ObstacleParams params);
std::string problem(RenderParams params);

} // namespace weft

#pragma once

#include "scene/scene.h"
#include "scene/toml_table.h"

/// One function a part of the scene file: reads the keys of its table over the defaults, refuses
/// unknown ones and values out of range. All throw Error (BadInput).
namespace weft {

SceneParams read_scene_params(TomlTable table);
/// @param movers, obstacles  names that `[[contact.friction]]` may speak of
ContactParams read_contact(TomlTable table,
                           const std::vector<std::string>& movers,
                           const std::vector<std::string>& obstacles);
/// @param base_dir   what the path of a fabric file is relative to
/// @param leaders    names of obstacles and rigid bodies that a pin may follow
ClothParams read_cloth(TomlTable table,
                       const std::filesystem::path& base_dir,
                       const std::vector<std::string>& leaders);
/// One `[[cloth.pin]]`.
PinParams read_pin(TomlTable table, const std::vector<std::string>& leaders);
ObstacleParams read_obstacle(TomlTable table);
/// @param leaders  names that a pin may follow
SolidParams read_solid(TomlTable table, const std::vector<std::string>& leaders);
RigidParams read_rigid(TomlTable table);
/// @param cloths  names that a side may have
AttachParams read_attach(TomlTable table, const std::vector<std::string>& cloths);
RenderParams read_render(TomlTable table);

/// The keys `fabric` of a cloth: a preset, a file, or a table. Leaves the default when missing.
void read_fabric(TomlTable& cloth, const std::filesystem::path& base_dir, FabricParams& fabric);
/// The keys that say what a fabric is: of a preset, a fabric file or `[cloth.fabric]`.
void read_fabric_values(TomlTable& table, FabricParams& fabric);

enum class SpringOwner { Cloth, Solid };
/// The key `model`, one of those that such an object can have.
void read_model(TomlTable& owner, Model& model, SpringOwner kind);
/// The table `spring` of a cloth or solid. Keys of the cubic law are passed over by other laws, so
/// that one scene serves to compare them; others that the object has no use for are refused.
void read_spring(TomlTable& owner, Model model, SpringParams& params, SpringOwner kind);

/// `name`: usable as a file name; "" when it is missing, for the caller to refuse after finish().
std::string read_name(TomlTable& table);
/// mesh (or another key for the file), object, units, up, repair; `source.file` stays empty without
/// it.
void read_mesh_source(TomlTable& table, MeshSource& source, std::string_view key = "mesh");
/// friction, static_friction; a new friction takes the static one along unless that is given too.
/// Returns whether friction was there.
bool read_friction(TomlTable& table, double& friction, std::optional<double>& static_friction);
/// translate, rotate_deg, scale.
void read_placement(TomlTable& table, Placement& placement);

} // namespace weft

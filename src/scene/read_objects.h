#pragma once

#include "scene/scene_keys.h"
#include "scene/toml_table.h"

#include <filesystem>
#include <string>
#include <vector>

/// One function an object of the scene file: reads the keys of its table over the defaults, refuses
/// unknown ones, values out of range and keys that do not fit together. All throw Error (BadInput).
namespace weft {

/// @param base_dir  what the path of a fabric file is relative to
/// @param leaders   names of obstacles and rigid bodies that a pin may follow
ClothParams read_cloth(TomlTable table,
                       const std::filesystem::path& base_dir,
                       const std::vector<std::string>& leaders);
SolidParams read_solid(TomlTable table, const std::vector<std::string>& leaders);
RigidParams read_rigid(TomlTable table);
ObstacleParams read_obstacle(TomlTable table);

/// One `[[cloth.pin]]` or `[[solid.pin]]`.
PinParams read_pin(TomlTable table, const std::vector<std::string>& leaders);
/// The table `spring` of a cloth or solid. Keys of the cubic law are passed over by other laws, so
/// that one scene serves to compare them; others that the object has no use for are refused.
void read_spring(TomlTable& owner, Model model, SpringParams& params, SpringOwner kind);
/// The keys that say what a fabric is: of a preset, a fabric file or `[cloth.fabric]`. A new
/// friction takes the static one along unless that is given too.
void read_fabric_values(TomlTable& table, FabricParams& fabric);

/// Refuses a name that is no file name.
void check_name(TomlTable& table, const std::string& name);
/// Notes which keys of the mesh were given, and refuses those that have no file to describe.
/// @param key  the key of the file
void check_mesh_source(TomlTable& table, MeshSource& source, std::string_view key = "mesh");

} // namespace weft

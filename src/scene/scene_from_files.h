#pragma once

#include "scene/params.h"

#include <span>
#include <string>
#include <vector>

namespace weft {

/// What the command line says of a scene that has no scene file.
struct SceneFiles {
    std::filesystem::path garment;
    std::vector<std::filesystem::path> obstacles;
    std::string fabric = "cotton"; ///< preset or .toml file
    std::vector<std::string> pins; ///< SPEC or SPEC@OBSTACLE, see write_pin_spec
    std::string units; ///< every file's: m, cm, mm, in or a number; empty: as each file says
    std::string up;    ///< every file's: y or z; empty: as each file says
};

/// A pin as `weft simulate --pin` takes it, as the lines of a `[[cloth.pin]]`: `corners`, `top`,
/// `bottom`, `loop:0`, `vertices:0,31` or `box:x0,y0,z0,x1,y1,z1`, each with `@OBSTACLE` to follow
/// one. Throws Error (CommandLine) in one line when it is none of these.
std::string write_pin_spec(const std::string& spec);

/// The scene of one garment and its obstacles with defaults for all else; paths are relative to the
/// current folder, names come from the files' stems. Then `KEY=VALUE` overrides as in read_scene.
/// Throws Error: CommandLine for the pins, BadInput for the rest.
Scene scene_from_files(const SceneFiles& files, std::span<const std::string> sets = {});

} // namespace weft

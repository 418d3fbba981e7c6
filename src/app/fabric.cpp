#include "scene/fabric.h"

#include "app/commands.h"
#include "scene/key.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

namespace weft {
namespace {

void list_fabrics() {
    fmt::print("{:<10} {:>7} {:>15} {:>6} {:>9}  {}\n", "name", "kg/m^2", "weft/warp N/m", "shear",
               "bend uN m", "description");
    for (const Fabric& fabric : fabric_library()) {
        const FabricParams& f = fabric.params;
        fmt::print("{:<10} {:>7.3f} {:>15} {:>6.4g} {:>9.1f}  {}\n", fabric.name, f.area_density,
                   fmt::format("{:.0f}/{:.0f}", f.stretch_stiffness[0], f.stretch_stiffness[1]),
                   f.shear_stiffness, 1e6 * f.bend_stiffness, fabric.description);
    }
}

void show_fabric(const std::string& name) {
    const Fabric* fabric = find_fabric(name);
    if (fabric == nullptr) {
        throw Error(ExitCode::CommandLine,
                    fmt::format("fabric {}: must be a name of weft fabric list; the nearest is {}",
                                name, nearest_key(name, fabric_names())));
    }
    fmt::print("{}", fabric->toml);
}

} // namespace

void add_fabric_command(CLI::App& app, ExitCode&) {
    CLI::App* fabric = app.add_subcommand("fabric", "the fabric presets and where they come from");
    fabric->require_subcommand(1);
    fabric->add_subcommand("list", "all presets in a table")->callback(list_fabrics);
    CLI::App* show = fabric->add_subcommand("show", "one preset as TOML, ready to be changed");
    const auto name = std::make_shared<std::string>();
    show->add_option("name", *name, "a name of weft fabric list")->required()->type_name("NAME");
    show->callback([name] { show_fabric(*name); });
}

} // namespace weft

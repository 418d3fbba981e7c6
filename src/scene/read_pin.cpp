#include "scene/nearest_key.h"
#include "scene/read_parts.h"

#include <algorithm>

namespace weft {
namespace {

/// The keys that say which vertices; returns how many of them were given.
int read_selection(TomlTable& table, PinParams& pin) {
    int given = 0;
    if (table.read("vertices", pin.vertices)) {
        ++given;
        if (pin.vertices.empty()) {
            table.fail("vertices", "must name at least one vertex");
        }
    }
    if (table.has("box")) {
        ++given;
        pin.has_box = true;
        TomlTable box = table.table("box");
        const bool has_min = box.read("min", pin.box_min);
        const bool has_max = box.read("max", pin.box_max);
        box.finish();
        if (!has_min || !has_max) {
            box.fail("needs min and max");
        }
    }
    if (table.read("corners", pin.corners) && pin.corners) {
        ++given;
    }
    if (table.has("loop")) {
        ++given;
        if (table.is_string("loop")) {
            table.read_choice<std::string>("loop", pin.loop_side,
                                           {{"top", "top"}, {"bottom", "bottom"}});
        } else {
            table.read("loop", pin.loop);
            if (pin.loop < 0) {
                table.fail("loop", "must be >= 0 (0: the longest), \"top\" or \"bottom\"");
            }
        }
    }
    return given;
}

} // namespace

PinParams read_pin(TomlTable table, const std::vector<std::string>& leaders) {
    PinParams pin;
    const int selections = read_selection(table, pin);
    table.read("until", pin.until);
    table.read("move", pin.move);
    const bool follows = table.read("to", pin.to);
    table.finish();
    table.refuse(problem(pin));
    if (selections != 1) {
        table.fail("must have exactly one of vertices, box, corners = true and loop");
    }
    if (follows && std::find(leaders.begin(), leaders.end(), pin.to) == leaders.end()) {
        const std::string nearest = nearest_key(pin.to, leaders);
        table.fail("to", nearest.empty()
                             ? "must be the name of an obstacle or rigid body; the scene has none"
                             : "must be the name of an obstacle or rigid body; the nearest is " +
                                   nearest);
    }
    return pin;
}

} // namespace weft

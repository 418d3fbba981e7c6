#include "scene/nearest_key.h"
#include "scene/read_parts.h"

#include <fmt/core.h>

#include <algorithm>

namespace weft {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::array<std::string, 2> read_between(TomlTable& table,
                                        const std::vector<std::string>& movers,
                                        const std::vector<std::string>& obstacles) {
    std::vector<std::string> names;
    table.read("between", names);
    if (names.size() != 2) {
        table.fail("between", "must be the names of two objects");
    }
    std::vector<std::string> known = movers;
    known.insert(known.end(), obstacles.begin(), obstacles.end());
    for (const std::string& name : names) {
        if (!contains(known, name)) {
            table.fail("between", fmt::format("{} is no object; the nearest is {}", name,
                                              nearest_key(name, known)));
        }
    }
    if (!contains(movers, names[0]) && !contains(movers, names[1])) {
        table.fail("between", "must name one that moves: obstacles do not touch each other");
    }
    return {names[0], names[1]};
}

bool same_objects(const FrictionPair& a, const FrictionPair& b) {
    return std::is_permutation(a.between.begin(), a.between.end(), b.between.begin());
}

} // namespace

bool read_friction(TomlTable& table, double& friction, std::optional<double>& static_friction) {
    const bool given = table.read("friction", friction);
    if (given) {
        static_friction.reset();
    }
    if (table.has("static_friction")) {
        table.read("static_friction", static_friction.emplace());
    }
    return given;
}

ContactParams read_contact(TomlTable table,
                           const std::vector<std::string>& movers,
                           const std::vector<std::string>& obstacles) {
    ContactParams params;
    table.read_choice("start_overlap", params.start_overlap,
                      {{"error", StartOverlap::Error},
                       {"grow", StartOverlap::Grow},
                       {"untangle", StartOverlap::Untangle}});
    table.read("self", params.self);
    table.read("enabled", params.enabled);
    for (TomlTable& entry : table.tables("friction")) {
        FrictionPair pair{.between = read_between(entry, movers, obstacles)};
        const bool given = read_friction(entry, pair.friction, pair.static_friction);
        entry.finish();
        if (!given) {
            entry.fail("needs friction");
        }
        entry.refuse(problem(pair));
        for (const FrictionPair& earlier : params.friction) {
            if (same_objects(earlier, pair)) {
                entry.fail("between", "must be unique: an earlier entry has the same two");
            }
        }
        params.friction.push_back(std::move(pair));
    }
    table.finish();
    return params;
}

} // namespace weft

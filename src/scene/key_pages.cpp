#include "scene/key_pages.h"

#include "scene/scene_keys.h"
#include "scene/toml_keys.h"

#include <fmt/core.h>

#include <algorithm>

namespace weft {
namespace {

/// One table of the scene file.
struct Section {
    std::string header; ///< as in the file
    std::string before; ///< what the table is for, in Markdown
    Keys keys;          ///< bound to defaults
    std::string after{};
};

/// The values that hold without a scene file; the rows of the pages are bound to them.
struct Defaults {
    SceneParams scene;
    ContactParams contact;
    FrictionPair friction;
    ClothParams cloth;
    AdaptParams adapt{.levels = k_default_levels};
    SpringParams spring;
    PinParams pin;
    SolidParams solid;
    RigidParams rigid;
    ObstacleParams obstacle;
    PoseKey pose;
    AttachParams attach;
    AttachSide side;
    RenderParams render;
};

std::vector<Section> cloth_sections(Defaults& d) {
    return {
        {"[[cloth]]", "One for each cloth object.", keys_of(d.cloth)},
        {"[cloth.fabric]",
         "Or a file with these keys. Weft runs along u (x of a grid), warp along v.",
         keys_of(d.cloth.fabric),
         "`weft fabric list` prints the presets, `weft fabric show denim` the numbers of one with "
         "their source and\nconversion (`assets/fabrics`). Most are estimates from published "
         "ranges; the files say which are measured."},
        {"[cloth.adapt]",
         "The mesh is refined where cloth folds, and coarsened again where it is flat; without "
         "the table it stays as\nimported. A level cuts triangles to a third. Refinement is undone "
         "exactly: cloth that comes to rest flat has\nits imported mesh again.",
         keys_of(d.adapt)},
        {"[cloth.spring]",
         "Also `[solid.spring]`: the edges of edge models. The tension g of an edge of rest length "
         "L at length r has\ng(L) = 0 and the slopes K at L, and, of \"cubic\", K1 at a1 L and K2 "
         "at a2 L. A cloth's edges are those of its\ntriangles, both diagonals of each quad or "
         "grid cell, and one across each inner edge against bending.",
         keys_of(d.spring, Model::Cubic, SpringOwner::Cloth)},
        {"[[cloth.pin]]",
         "Also `[[solid.pin]]`, which takes `box`, `until`, `move` and `to`. Exactly one of the "
         "first four keys says which\nvertices are held.",
         keys_of(d.pin)},
    };
}

std::vector<Section> body_sections(Defaults& d) {
    return {
        {"[[solid]]",
         "Particles on a lattice, each joined to its 26 neighbours. A closed mesh is filled, and "
         "is what touches and what\npictures show.",
         keys_of(d.solid)},
        {"[[rigid]]", "A body that moves as a whole, of uniform density.", keys_of(d.rigid)},
        {"[[obstacle]]", "A body that moves as the scene says, whatever touches it.",
         keys_of(d.obstacle)},
        {"[[obstacle.motion]]",
         "Or `motion = [{ t = 0.5 }, { t = 1.5, translate = [0.2, 0.1, 0.0] }]`.", keys_of(d.pose)},
        {"[[attach]]", "Cloth attached to cloth, or to itself.", keys_of(d.attach),
         "A seam whose sides differ by more than 3 % in length is sewn with a warning: the longer "
         "side puckers. Where the\nborders differ in fineness the finer one is tied to the edges "
         "of the coarser one. Contact takes the two sides of\na seam as one surface from `start` "
         "on; buttons leave contact as it is."},
        {"[attach.a]", "And `[attach.b]`, or `a = { cloth = \"front\", vertices = [3, 4, 5] }`.",
         keys_of(d.side, AttachKind::Seam)},
    };
}

const std::vector<Section>& sections() {
    static Defaults d;
    static const std::vector<Section> all = [] {
        std::vector<Section> list{
            {"[scene]", "Time, gravity and air.", keys_of(d.scene)},
            {"[contact]", "Contact of all objects.", keys_of(d.contact),
             "What each way to part overlapping garments does is in\n"
             "[running.md](running.md#garments-that-overlap-at-the-start)."},
            {"[[contact.friction]]",
             "One for each two objects that do not have the friction mixed from their own.",
             keys_of(d.friction)},
        };
        for (const Section& section : cloth_sections(d)) {
            list.push_back(section);
        }
        for (const Section& section : body_sections(d)) {
            list.push_back(section);
        }
        list.push_back({"[render]", "The pictures.", keys_of(d.render)});
        return list;
    }();
    return all;
}

std::string path_of(const Section& section, const Key& key) {
    const std::size_t first = section.header.find_first_not_of('[');
    return section.header.substr(first, section.header.find(']') - first) + "." + key.name;
}

/// The keys of a section, with those of tables on one line below their own key as `grid.size`.
Keys rows_of(const Section& section) {
    Keys rows;
    for (const Key& key : section.keys) {
        rows.push_back(key);
        const Inline* const table = std::get_if<Inline>(&key.value);
        if (table == nullptr || !key.is_read) {
            continue; // a table that is read by itself has its own section
        }
        for (Key inner : table->keys) {
            inner.name = key.name + "." + inner.name;
            rows.push_back(std::move(inner));
        }
    }
    return rows;
}

/// The default in words, or the value in backticks or not.
std::string default_of(Key key, bool is_markdown) {
    if (!key.default_text.empty()) {
        return key.default_text;
    }
    key.is_written = true;
    const std::string value =
        value_text(key, [](const std::string& path) { return path; }).value_or("");
    return is_markdown && !value.empty() ? "`" + value + "`" : value;
}

/// The words, or the range and the unit of the value.
std::string allowed_of(const Key& key) {
    std::string text;
    const auto add = [&](const std::string& part, const char* separator) {
        text += (text.empty() || part.empty() ? "" : separator) + part;
    };
    if (const Words* const words = std::get_if<Words>(&key.value)) {
        for (const std::string& word : words->words) {
            add('"' + word + '"', ", ");
        }
    }
    for (const Range& range : key.ranges.each()) {
        const std::string allowed = key.allowed(range);
        add(allowed.substr(0, allowed.find(',')), "; ");
    }
    if ((text + " ").find(" " + key.unit + " ") == std::string::npos) {
        add(key.unit, ", ");
    }
    return text;
}

} // namespace

std::string key_page() {
    std::string page = "# Keys of a scene file\n\n"
                       "TOML. Paths are relative to the file. An unknown key is an error that "
                       "names the nearest known one. `weft keys`\nprints this page in the "
                       "terminal, `weft keys fabric` what has to do with fabrics, and "
                       "`weft simulate SCENE.toml\n--print-config` a scene with every default.\n";
    for (const Section& section : sections()) {
        page += fmt::format("\n## `{}`\n\n{}\n\n| key | default | allowed | meaning |\n"
                            "|---|---|---|---|\n",
                            section.header, section.before);
        for (const Key& key : rows_of(section)) {
            page += fmt::format("| `{}` | {} | {} | {} |\n", key.name, default_of(key, true),
                                allowed_of(key), key.meaning);
        }
        if (!section.after.empty()) {
            page += "\n" + section.after + "\n";
        }
    }
    return page;
}

std::string key_list(std::span<const std::string> words) {
    std::string list;
    for (const Section& section : sections()) {
        std::string rows;
        for (const Key& key : rows_of(section)) {
            const std::string path = path_of(section, key);
            const bool is_meant =
                words.empty() || std::any_of(words.begin(), words.end(), [&](const auto& word) {
                    return path.find(word) != std::string::npos;
                });
            if (is_meant) {
                const std::string allowed = allowed_of(key);
                rows += fmt::format("  {:<17} {}{}\n      {}\n", key.name, default_of(key, false),
                                    allowed.empty() ? "" : "  (" + allowed + ")", key.meaning);
            }
        }
        if (!rows.empty()) {
            list += fmt::format("{}{}\n{}", list.empty() ? "" : "\n", section.header, rows);
        }
    }
    return list;
}

std::vector<std::string> key_paths() {
    std::vector<std::string> paths;
    for (const Section& section : sections()) {
        for (const Key& key : rows_of(section)) {
            paths.push_back(path_of(section, key));
        }
    }
    return paths;
}

} // namespace weft

#include "base/atomic_file.h"
#include "scene/key_pages.h"
#include "scene/scene_reader.h"
#include "scene/scene_writer.h"
#include "support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace weft {
namespace {

TEST(KeyPages, TheDocumentationIsWhatTheProgramSays) {
    EXPECT_EQ(read_file(test::source_path("docs/scene-keys.md")), key_page())
        << "run: weft keys --markdown > docs/scene-keys.md";
}

/// The path of each `key = value` line of a written scene, with solids' springs and pins as those
/// of cloth.
std::vector<std::string> written_paths(const std::string& scene) {
    std::vector<std::string> paths;
    std::string table;
    std::istringstream lines(scene);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with('[')) {
            const std::size_t first = line.find_first_not_of('[');
            table = line.substr(first, line.find(']') - first);
            if (table == "solid.spring" || table == "solid.pin") {
                table.replace(0, 5, "cloth");
            }
        } else if (const std::size_t equals = line.find(" = ");
                   equals != std::string::npos && line[0] != ' ') {
            paths.push_back(table + "." + line.substr(0, equals));
        }
    }
    return paths;
}

TEST(KeyPages, HaveEachKeyOfAFullScene) {
    const Scene scene = read_scene(test::source_path("tests/scenes/every_key.toml"));
    const std::vector<std::string> known = key_paths();

    const std::vector<std::string> written = written_paths(write_scene(scene, scene.base_dir));

    EXPECT_GT(written.size(), 100u);
    for (const std::string& path : written) {
        EXPECT_NE(std::find(known.begin(), known.end(), path), known.end()) << path;
    }
}

TEST(KeyPages, ListWhatIsAskedFor) {
    const std::vector<std::string> words{"fabric.bend", "camera"};

    const std::string list = key_list(words);

    EXPECT_NE(list.find("[cloth.fabric]\n  bend              1e-05  (>= 0 N m)\n"),
              std::string::npos)
        << list;
    EXPECT_NE(list.find("camera.fov_deg"), std::string::npos);
    EXPECT_EQ(list.find("density"), std::string::npos);
}

TEST(KeyPages, ListNothingForAWordThatNoKeyHas) {
    const std::vector<std::string> words{"no such key"};

    EXPECT_EQ(key_list(words), "");
}

} // namespace
} // namespace weft

#include "app/inspect_run.h"
#include "app/inspect_scene.h"
#include "frames/run_folder.h"
#include "support/paths.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

namespace weft {

namespace {

const std::string k_square = "o Cloth\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                             "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";

bool has(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

int run_inspect(const std::string& arguments, const std::filesystem::path& output) {
    const std::string command =
        test::weft_binary().string() + " inspect " + arguments + " > " + output.string() + " 2>&1";
    return WEXITSTATUS(std::system(command.c_str()));
}

} // namespace

TEST(Inspect, SaysWhatIsInAMesh) {
    const test::TempFolder folder;
    const auto file = test::write_file(folder / "cloth.obj", k_square);

    const InspectReport report = describe_mesh_file(file, {.file = "cloth.obj"}, true);

    EXPECT_FALSE(report.is_refused);
    for (const char* words :
         {"cloth.obj\n", "Cloth", "4 in the file, 4 after welding", "2 in 1 part", "1 x 1 x 0 m",
          "1 loop", "4 edges, 4.000 m", "5: least 1.000 m, mean 1.083 m, greatest 1.414 m",
          "angle 45 deg", "area          1 m^2", "1 island", "defects       none",
          "crossings     none"}) {
        EXPECT_TRUE(has(report.text, words)) << words << " is not in\n" << report.text;
    }
}

TEST(Inspect, NamesWhatOnlyClothRefuses) {
    const test::TempFolder folder;
    const auto file = test::write_file(folder / "fin.obj", k_square + "v 0 0 1\nf 1 3 5\n");

    const InspectReport report = describe_mesh_file(file, {.file = "fin.obj"}, false);

    EXPECT_FALSE(report.is_refused);
    EXPECT_TRUE(has(report.text, "not as cloth  object \"Cloth\": 1 edge has more than two"))
        << report.text;
    EXPECT_TRUE(describe_mesh_file(file, {.file = "fin.obj"}, true).is_refused);
}

TEST(Inspect, ABrokenFileDoesNotHideTheOthersAndExitsWithThree) {
    const test::TempFolder folder;
    const auto good = test::write_file(folder / "good.obj", k_square);
    const auto bad = test::write_file(folder / "bad.obj", "v 0 0 0\nf 1 2 3\n");

    const int code = run_inspect(bad.string() + " " + good.string(), folder / "out.txt");

    std::ifstream stream(folder / "out.txt");
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_EQ(code, 3);
    EXPECT_TRUE(has(text, "REFUSED")) << text;
    EXPECT_TRUE(has(text, "a face names vertex 3, but the file has 1")) << text;
    EXPECT_TRUE(has(text, "4 in the file, 4 after welding")) << text;
}

TEST(Inspect, TakesUnitsUpAxisAndRepairFromTheCommandLine) {
    const test::TempFolder folder;
    const auto file = test::write_file(folder / "c.obj", k_square + "f 1/1 1/1 2/2\n");

    EXPECT_EQ(run_inspect(file.string(), folder / "a.txt"), 3);
    EXPECT_EQ(
        run_inspect("--units cm --up z --repair --object Cloth " + file.string(), folder / "b.txt"),
        0);
    EXPECT_EQ(run_inspect("--units stone " + file.string(), folder / "c.txt"), 2);

    std::ifstream stream(folder / "b.txt");
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_TRUE(has(text, "0.01 x 0 x 0.01 m")) << text;
    EXPECT_TRUE(has(text, "repair dropped 1 triangle")) << text;
}

TEST(Inspect, ASceneListsItsObjectsAndTheirMeshes) {
    const test::TempFolder folder;
    test::write_file(folder / "cloth.obj", k_square);
    test::write_file(folder / "fin.obj", k_square + "v 0 0 1\nf 1 3 5\n");
    const auto good =
        test::write_file(folder / "good.toml", "[[cloth]]\nname = \"flag\"\nmesh = \"cloth.obj\"\n"
                                               "[[obstacle]]\nname = \"fin\"\nmesh = \"fin.obj\"\n"
                                               "translate = [0.0, 0.0, -2.0]\n");
    const auto bad =
        test::write_file(folder / "bad.toml", "[[cloth]]\nname = \"flag\"\nmesh = \"fin.obj\"\n");

    const InspectReport report = describe_scene(good);

    EXPECT_FALSE(report.is_refused) << report.text;
    EXPECT_TRUE(has(report.text, "cloth         flag")) << report.text;
    EXPECT_TRUE(has(report.text, "obstacle      fin: mesh, no pose keys")) << report.text;
    EXPECT_TRUE(describe_scene(bad).is_refused); // cloth does not take the third triangle
}

TEST(Inspect, ARunShowsHowFarItCameAndItsExtremes) {
    const test::TempFolder folder;
    const RunPaths paths{folder.path()};
    write_status(paths.status(), {.state = RunState::Done, .frame = 3, .frames = 3});
    test::write_file(paths.stats(), "frame,stretch_max\n1,1\n2,1.25\n3,1.125\n");

    const InspectReport report = describe_run(folder.path());

    EXPECT_FALSE(report.is_refused) << report.text;
    EXPECT_TRUE(has(report.text, "done: frame 3 of 3")) << report.text;
    EXPECT_TRUE(has(report.text, "stretch_max               1.125            1         1.25"))
        << report.text;
    EXPECT_TRUE(describe_run(folder / "nothing").is_refused);
}

TEST(Inspect, ListsWhatCrossesAtTheStartOfASceneAndWritesItAsAPly) {
    const test::TempFolder folder;
    const std::string text = "[[cloth]]\nname = 'flag'\ngrid = { cells = [8, 8] }\n"
                             "[[obstacle]]\nname = 'ball'\nshape = 'sphere'\nradius = 0.2\n";
    const auto scene = test::write_file(folder / "s.toml", text);

    const InspectReport report = describe_scene(scene, {.ply = folder / "c.ply"});

    EXPECT_TRUE(report.is_refused);
    for (const char* words :
         {"pairs of triangles cross", "flag and ball: ", "flag triangle ", "ball triangle ",
          "more: --pairs lists all", "\"untangle\"", "c.ply"}) {
        EXPECT_TRUE(has(report.text, words)) << words << " is not in\n" << report.text;
    }
    std::ifstream stream(folder / "c.ply");
    const std::string ply{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_TRUE(has(ply, "element face ")) << ply.substr(0, 500);
    EXPECT_TRUE(has(ply, "element edge "));
    EXPECT_FALSE(has(ply, "nan"));
}

TEST(Inspect, OfASceneThatUntanglesRefusesNothingAndListsEveryPairWhenAsked) {
    const test::TempFolder folder;
    const std::string text = "[contact]\nstart_overlap = 'untangle'\n"
                             "[[cloth]]\nname = 'flag'\ngrid = { cells = [8, 8] }\n"
                             "[[obstacle]]\nname = 'ball'\nshape = 'sphere'\nradius = 0.2\n";
    const auto scene = test::write_file(folder / "s.toml", text);

    const InspectReport report = describe_scene(scene, {.all_pairs = true});

    EXPECT_FALSE(report.is_refused) << report.text;
    EXPECT_FALSE(has(report.text, "--pairs")) << report.text;
    EXPECT_EQ(run_inspect(scene.string() + " " + scene.string() + " -o x.ply", folder / "o.txt"),
              2);
}

TEST(Inspect, SaysThatNothingCrosses) {
    const test::TempFolder folder;
    const auto scene = test::write_file(folder / "s.toml",
                                        "[[cloth]]\nname = 'flag'\ngrid = { cells = [8, 8] }\n");

    const InspectReport report = describe_scene(scene);

    EXPECT_FALSE(report.is_refused);
    EXPECT_TRUE(has(report.text, "nothing crosses")) << report.text;
}

} // namespace weft

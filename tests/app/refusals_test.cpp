#include "support/process.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <gtest/gtest.h>

#include <sstream>

namespace weft {
namespace {

namespace fs = std::filesystem;

const std::string k_square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string k_mesh = k_square + "f 1 2 3\nf 1 3 4\n";
const std::string k_scene = "[[cloth]]\nname = 'flag'\ngrid = { cells = [2, 2] }\n";
const std::string k_render = "[render]\nenabled = false\n";

/// A scene, mesh or command line that is wrong in one place.
struct Refusal {
    const char* what;
    std::string input;              ///< content of the scene or mesh, or the arguments, one a line
    std::vector<std::string> words; ///< of the one line that the user reads: place, value, allowed
    int exit_code = 3;
};

std::string cloth(const std::string& keys) {
    return k_scene + keys;
}

const std::vector<Refusal> k_scenes{
    {"nothing", "", {"s.toml:1:1", "[[cloth]]"}},
    {"not TOML", "[scene]\nframes = = 3\n", {"s.toml:2:10"}},
    {"cut off", "[scene]\ngravity = [0.0, -9.8", {"s.toml:2"}},
    {"not text", std::string("\xff\xfe\x00\x01", 4), {"s.toml:1"}},
    {"key twice", "[scene]\nfps = 25\nfps = 30\n" + k_scene, {"s.toml:3", "fps"}},
    {"unknown key", "[scene]\nframe = 3\n" + k_scene, {"s.toml:2:1", "scene.frame", "frames"}},
    {"unknown table", "[scnee]\n" + k_scene, {"s.toml:1", "scnee", "scene"}},
    {"wrong type", "[scene]\nframes = 'ten'\n" + k_scene, {"s.toml:2:10", "\"ten\"", "integer"}},
    {"out of range", "[scene]\nfps = 0.0\n" + k_scene, {"s.toml:2:7", "scene.fps = 0", "> 0"}},
    {"NaN", "[scene]\nwind = [nan, 0.0, 0.0]\n" + k_scene, {"wind[0] = nan", "finite"}},
    {"huge integer", "[scene]\nframes = 99999999999999\n" + k_scene, {"s.toml:2:10", "frames"}},
    {"same name twice", k_scene + k_scene, {"s.toml:5:8", "\"flag\"", "unique"}},
    {"name as a path", "[[cloth]]\nname = '../x'\ngrid = {}\n", {"\"../x\"", "letters"}},
    {"missing mesh", "[[cloth]]\nname = 'a'\nmesh = 'none.obj'\n", {"none.obj", "no such file"}},
    {"unknown fabric", cloth("fabric = 'denimm'\n"), {"s.toml:4:10", "denimm", "denim"}},
    {"negative density", cloth("fabric = { density = -1 }\n"), {"density = -1", "> 0 kg/m^2"}},
    {"solid between two sizes",
     "[[solid]]\nname = 'a'\nbox = [0.1, 0.1, 0.14]\nspacing = 0.05\n",
     {"s.toml:3:18", "box[2] = 0.14", "0.15 m"}},
    {"pin of a vertex that is not there", cloth("pin = [{ vertices = [99] }]\n"), {"99", "pin"}},
    {"pin to nobody", cloth("pin = [{ corners = true, to = 'b' }]\n"), {"\"b\"", "obstacle"}},
    {"pin in an empty box",
     cloth("pin = [{ box = { min = [5, 5, 5], max = [6, 6, 6] } }]\n"),
     {"pin", "box"}},
    {"too many cells", "[[cloth]]\nname = 'a'\ngrid = { cells = [9999, 2] }\n", {"9999", "4096"}},
    {"bad motion",
     cloth("[[obstacle]]\nname='b'\nshape='sphere'\nmotion=[{t=1},{t=0}]\n"),
     {"t = 0"}},
    {"cloth through an obstacle",
     cloth("[[obstacle]]\nname = 'ball'\nshape = 'sphere'\nradius = 0.2\n"),
     {"flag", "ball", "cross"}},
    {"camera that looks nowhere", cloth("[render]\ncamera = { eye = [0, 0, 1] }\n"), {"target"}},
};

const std::vector<Refusal> k_meshes{
    {"empty", "", {"m.obj", "empty"}},
    {"words", "It was a dark and stormy night.\n", {"m.obj"}},
    {"bytes", std::string("\x00\x01\x02\xff\x00", 5), {"m.obj"}},
    {"no triangles", k_square, {"m.obj", "no triangles"}},
    {"index too large", k_square + "f 1 2 9\n", {"m.obj:5", "9", "4"}},
    {"huge index", k_square + "f 1 2 99999999999999999999\n", {"m.obj:5", "99999999999999999999"}},
    {"index 0", k_square + "f 0 1 2\n", {"m.obj:5", "vertex 0"}},
    {"NaN", "v 0 nan 0\n" + k_mesh, {"m.obj:1", "nan", "finite"}},
    {"infinite", "v 1e999 0 0\n" + k_mesh, {"m.obj:1", "1e999", "finite"}},
    {"missing number", "v 0 0\n" + k_mesh, {"m.obj:1"}},
    {"face of two", k_mesh + "f 1 2\n", {"m.obj:7", "2 corners"}},
    {"fin", k_mesh + "v 0 0 1\nf 1 3 5\n", {"m.obj", "more than two triangles", "edge"}},
    {"no area", k_mesh + "v 2 0 0\nf 1 2 5\n", {"m.obj", "degenerate", "face 2"}},
    {"same triangle twice", k_mesh + "f 1 2 3\n", {"m.obj"}},
    {"cut off", k_square + "f 1 2 3\nf 1 3", {"m.obj"}},
};

const std::vector<Refusal> k_lines{
    {"unknown verb", "simulat\nSCENE\n-o\nOUT", {"simulat", "simulate"}, 2},
    {"nothing to do", "", {"weft"}, 2},
    {"unknown option", "simulate\nSCENE\n-o\nOUT\n--frobnicate", {"--frobnicate"}, 2},
    {"no -o", "simulate\nSCENE", {"-o"}, 2},
    {"no scene", "simulate\n-o\nOUT", {"inputs"}, 2},
    {"no such scene", "simulate\nnone.toml\n-o\nOUT", {"none.toml"}, 5},
    {"frames backwards", "simulate\nSCENE\n-o\nOUT\n-f\n9-3", {"9-3"}, 2},
    {"frames past the end", "simulate\nSCENE\n-o\nOUT\n-f\n1-9999", {"9999"}, 2},
    {"frames in words", "simulate\nSCENE\n-o\nOUT\n-f\nall", {"all"}, 2},
    {"unknown key", "simulate\nSCENE\n-o\nOUT\n-s\nscene.frame=3", {"frame", "frames"}},
    {"bad value", "simulate\nSCENE\n-o\nOUT\n-s\nscene.frames=many", {"scene.frames", "many"}},
    {"rule of no column", "simulate\nSCENE\n-o\nOUT\n--fail-on\nstrech_max>1", {"strech_max"}, 2},
    {"rule of no kind", "simulate\nSCENE\n-o\nOUT\n--fail-on\nbad", {"bad", "penetration"}, 2},
    {"threads", "simulate\nSCENE\n-o\nOUT\n-j\n-3", {"-3"}, 2},
    {"both", "simulate\nSCENE\n-o\nOUT\n--resume\n--overwrite", {"--resume", "--overwrite"}, 2},
    {"quiet and not", "simulate\nSCENE\n-o\nOUT\n-q\n-v", {"--verbose"}, 2},
    {"pin", "simulate\nMESH\n-o\nOUT\n--pin\nmiddle", {"middle", "corners"}, 2},
    {"fabric", "simulate\nMESH\n-o\nOUT\n--fabric\nsteel", {"steel"}},
    {"up", "simulate\nMESH\n-o\nOUT\n--up\nx", {"x"}, 2},
    {"run that is none", "render\nnowhere", {"nowhere"}, 5},
    {"fabric of no name", "fabric\nshow\nsteel", {"steel"}, 2},
};

/// Runs weft in an own folder with each input and asks for one line, in words, and no output.
class Refusals : public testing::Test {
protected:
    Refusals() {
        test::write_file(folder_ / "good.toml", k_scene + k_render);
        test::write_file(folder_ / "good.obj", k_mesh);
    }

    void expect_refused(const Refusal& refusal, const std::vector<std::string>& arguments) {
        const test::ProcessResult result = test::run_weft(arguments, folder_.path());

        SCOPED_TRACE(std::string(refusal.what) + ": " + result.err);
        EXPECT_EQ(result.exit_code, refusal.exit_code);
        EXPECT_TRUE(result.err.starts_with("weft: error: "));
        EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << "must be one line";
        for (const std::string& word : refusal.words) {
            EXPECT_NE(result.err.find(word), std::string::npos) << "must name " << word;
        }
        EXPECT_EQ(result.out, "");
        EXPECT_FALSE(fs::exists(folder_ / "out")) << "must write nothing";
    }

    std::vector<std::string> simulate(const std::string& input) const {
        return {"simulate", (folder_ / input).string(), "-o", (folder_ / "out").string()};
    }

    /// The arguments, one a line, with the places of the test's folder filled in.
    std::vector<std::string> arguments(const std::string& lines) const {
        std::vector<std::string> words;
        std::istringstream stream(lines);
        for (std::string word; std::getline(stream, word);) {
            words.push_back(word == "SCENE"  ? (folder_ / "good.toml").string()
                            : word == "MESH" ? (folder_ / "good.obj").string()
                            : word == "OUT"  ? (folder_ / "out").string()
                                             : word);
        }
        return words;
    }

    test::TempFolder folder_;
};

TEST_F(Refusals, OfBrokenScenesNamePlaceAndValueInOneLine) {
    for (const Refusal& refusal : k_scenes) {
        test::write_file(folder_ / "s.toml", refusal.input);

        expect_refused(refusal, simulate("s.toml"));
    }
}

TEST_F(Refusals, OfBrokenMeshesNameFileAndElementInOneLine) {
    for (const Refusal& refusal : k_meshes) {
        test::write_file(folder_ / "m.obj", refusal.input);

        expect_refused(refusal, simulate("m.obj"));
    }
}

TEST_F(Refusals, OfWrongCommandLinesNameTheWordInOneLine) {
    for (const Refusal& refusal : k_lines) {
        expect_refused(refusal, arguments(refusal.input));
    }
}

TEST_F(Refusals, OfAFolderAsMeshOrSceneNameIt) {
    fs::create_directory(folder_ / "m.obj");
    fs::create_directory(folder_ / "s.toml");

    expect_refused({"mesh", "", {"m.obj", "folder"}}, simulate("m.obj"));
    expect_refused({"scene", "", {"s.toml", "folder"}, 5}, simulate("s.toml"));
}

TEST_F(Refusals, KeepWhatStandsInTheFolderOfTheRun) {
    fs::create_directory(folder_ / "full");
    test::write_file(folder_ / "full" / "letter.txt", "Dear Ada");
    std::vector<std::string> words = simulate("good.toml");
    words.back() = (folder_ / "full").string();

    expect_refused({"full folder", "", {"full", "--overwrite"}, 2}, words);

    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "full"), {}), 1);
}

TEST_F(Refusals, DoNotMeetTheInputsThatTheOthersWereMadeFrom) {
    EXPECT_EQ(test::run_weft({"simulate", (folder_ / "good.toml").string(), "-n"}, folder_.path())
                  .exit_code,
              0);
    EXPECT_EQ(test::run_weft({"simulate", (folder_ / "good.obj").string(), "-n"}, folder_.path())
                  .exit_code,
              0);
}

} // namespace
} // namespace weft

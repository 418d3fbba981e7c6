#include "base/atomic_file.h"
#include "base/error.h"
#include "scene/scene_reader.h"
#include "support/paths.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {
namespace {

/// A scene that is wrong in one place, and the whole line that the user should read.
struct Broken {
    const char* what;
    std::string text;
    std::string message;
};

/// The smallest right cloth in three lines, then more of its keys.
std::string cloth(const std::string& keys) {
    return "[[cloth]]\nname = \"flag\"\ngrid = {}\n" + keys;
}

/// A solid in two lines, then its keys.
std::string solid(const std::string& keys) {
    return "[[solid]]\nname = \"cube\"\n" + keys;
}

std::string message_of(const std::string& text) {
    try {
        read_scene_text(text, "a.toml", "");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::BadInput);
        return error.what();
    }
    return "";
}

const std::string k_ball = "[[obstacle]]\nname = \"ball\"\nshape = \"sphere\"\n";

/// An entry of the friction table in three lines.
std::string friction(const std::string& between, double coefficient = 0.5) {
    return fmt::format("[[contact.friction]]\nbetween = {}\nfriction = {}\n", between, coefficient);
}

const std::vector<Broken> k_broken{
    {"nothing", "", "a.toml:1:1: needs a [[cloth]], [[solid]] or [[rigid]]: nothing would move"},
    {"unknown table", "[secne]\nframes = 3\n" + cloth(""),
     "a.toml:1:2: secne: unknown key; the nearest is scene"},
    {"unknown key", "[scene]\nframe = 3\n" + cloth(""),
     "a.toml:2:1: scene.frame: unknown key; the nearest is frames"},
    {"unknown key of a fabric", cloth("[cloth.fabric]\nbending = 1e-5\n"),
     "a.toml:5:1: cloth[0].fabric.bending: unknown key; the nearest is bend"},
    {"unknown key of a pin", cloth("[[cloth.pin]]\ncorner = true\n"),
     "a.toml:5:1: cloth[0].pin[0].corner: unknown key; the nearest is corners"},
    {"wrong type", "[scene]\nframes = \"ten\"\n" + cloth(""),
     "a.toml:2:10: scene.frames = \"ten\": must be an integer"},
    {"number for an integer", "[scene]\nframes = 10.5\n" + cloth(""),
     "a.toml:2:10: scene.frames = 10.5: must be an integer"},
    {"wrong length", "[scene]\ngravity = [0.0, -9.81]\n" + cloth(""),
     "a.toml:2:11: scene.gravity = [0, -9.81]: must be an array of 3 numbers"},
    {"wrong element", "[scene]\nwind = [0.0, \"x\", 0.0]\n" + cloth(""),
     "a.toml:2:14: scene.wind[1] = \"x\": must be a number"},
    {"not a number", "[scene]\nwind = [0.0, nan, 0.0]\n" + cloth(""),
     "a.toml:2:14: scene.wind[1] = nan: must be finite"},
    {"infinite", "[scene]\nfps = inf\n" + cloth(""), "a.toml:2:7: scene.fps = inf: must be finite"},
    {"not a boolean", "[contact]\nself = 1\n" + cloth(""),
     "a.toml:2:8: contact.self = 1: must be true or false"},
    {"out of range", "[scene]\nframes = 0\n" + cloth(""),
     "a.toml:2:10: scene.frames = 0: must be 1 to 1000000"},
    {"negative density", cloth("[cloth.fabric]\ndensity = -0.1\n"),
     "a.toml:5:11: cloth[0].fabric.density = -0.1: must be > 0 kg/m^2"},
    {"one of two out of range", cloth("[cloth.fabric]\nstretch = [100.0, 0.0]\n"),
     "a.toml:5:19: cloth[0].fabric.stretch[1] = 0: must be > 0 N/m"},
    {"poisson", cloth("fabric = { poisson = 1.0 }\n"),
     "a.toml:4:22: cloth[0].fabric.poisson = 1: must be >= 0 and < 1"},
    {"unknown preset", cloth("fabric = \"denimm\"\n"),
     "a.toml:4:10: cloth[0].fabric = \"denimm\": must be a preset (weft fabric list) or a .toml "
     "file; the nearest preset is denim"},
    {"missing fabric file", cloth("fabric = \"no/such.toml\"\n"),
     "a.toml:4:10: cloth[0].fabric = \"no/such.toml\": there is no file no/such.toml"},
    {"no name", "[[cloth]]\ngrid = {}\n", "a.toml:1:1: cloth[0]: needs name"},
    {"name as a path", "[[cloth]]\nname = \"a/b\"\ngrid = {}\n",
     "a.toml:2:8: cloth[0].name = \"a/b\": must be letters, digits, '_' or '-', at most 64: it "
     "names files"},
    {"twice the same name", k_ball + "[[cloth]]\nname = \"ball\"\ngrid = {}\n",
     "a.toml:5:8: cloth[0].name = \"ball\": must be unique: another one has it"},
    {"no mesh", "[[cloth]]\nname = \"flag\"\n", "a.toml:1:1: cloth[0]: needs mesh or grid"},
    {"mesh and grid", cloth("mesh = \"a.obj\"\n"),
     "a.toml:1:1: cloth[0]: has mesh and grid: must be one of them"},
    {"units without mesh", cloth("units = \"cm\"\n"),
     "a.toml:4:9: cloth[0].units = \"cm\": needs mesh, whose file it describes"},
    {"unknown unit", "[[cloth]]\nname = \"a\"\nmesh = \"a.obj\"\nunits = \"ft\"\n",
     "a.toml:4:9: cloth[0].units = \"ft\": must be \"m\", \"cm\", \"mm\" or \"in\""},
    {"unit of nothing", "[[cloth]]\nname = \"a\"\nmesh = \"a.obj\"\nunits = 0\n",
     "a.toml:4:9: cloth[0].units = 0: must be > 0 m, or \"m\", \"cm\", \"mm\" or \"in\""},
    {"object list", "[[cloth]]\nname = \"a\"\nmesh = \"a.obj\"\nobject = [\"b\", 3]\n",
     "a.toml:4:16: cloth[0].object[1] = 3: must be a string"},
    {"pin of nothing", cloth("[[cloth.pin]]\nuntil = 1.0\n"),
     "a.toml:4:1: cloth[0].pin[0]: must have exactly one of vertices, box, corners = true and "
     "loop"},
    {"pin to nobody", k_ball + cloth("[[cloth.pin]]\ncorners = true\nto = \"bal\"\n"),
     "a.toml:9:6: cloth[0].pin[0].to = \"bal\": must be the name of an obstacle or rigid body; the "
     "nearest "
     "is "
     "ball"},
    {"pin back in time",
     cloth("[[cloth.pin]]\ncorners = true\n"
           "move = [[1.0, 0, 0, 0], [0.5, 0, 0, 0]]\n"),
     "a.toml:6:26: cloth[0].pin[0].move[1][0] = 0.5: must be > 1 s, the time before"},
    {"pin at a vertex below 0", cloth("[[cloth.pin]]\nvertices = [0, -1]\n"),
     "a.toml:5:16: cloth[0].pin[0].vertices[1] = -1: must be >= 0, the index of a vertex"},
    {"pin in an empty box", cloth("pin = [{ box = { min = [1, 0, 0], max = [0, 0, 0] } }]\n"),
     "a.toml:4:25: cloth[0].pin[0].box.min[0] = 1: must be <= box.max[0], 0 m"},
    {"obstacle of nothing", "[[obstacle]]\nname = \"b\"\n" + cloth(""),
     "a.toml:1:1: obstacle[0]: needs mesh, sequence or shape"},
    {"radius of a box", "[[obstacle]]\nname = \"b\"\nshape = \"box\"\nradius = 1.0\n" + cloth(""),
     "a.toml:4:10: obstacle[0].radius = 1: needs shape = \"sphere\""},
    {"mesh and sequence",
     "[[obstacle]]\nname = \"b\"\nmesh = \"a.obj\"\nsequence = \"a.#.obj\"\n" + cloth(""),
     "a.toml:1:1: obstacle[0]: has mesh and sequence: must be one of them"},
    {"animation of a sphere", k_ball + "animation = \"Run\"\n" + cloth(""),
     "a.toml:4:13: obstacle[0].animation = \"Run\": needs mesh, whose file it is in"},
    {"speed of a mesh backwards",
     "[[obstacle]]\nname = \"b\"\nmesh = \"a.x\"\nanimation_speed = -1\n" + cloth(""),
     "a.toml:4:19: obstacle[0].animation_speed = -1: must be > 0 and <= 1000000"},
    {"unknown end of an animation",
     "[[obstacle]]\nname = \"b\"\nmesh = \"a.x\"\nanimation_end = \"stop\"\n" + cloth(""),
     "a.toml:4:17: obstacle[0].animation_end = \"stop\": must be \"hold\" or \"loop\""},
    {"rate of a single mesh",
     "[[obstacle]]\nname = \"b\"\nmesh = \"a.x\"\nsequence_fps = 25.0\n" + cloth(""),
     "a.toml:4:16: obstacle[0].sequence_fps = 25: needs sequence or cache"},
    {"cache and animation",
     "[[obstacle]]\nname = \"b\"\nmesh = \"a.x\"\nanimation = \"r\"\ncache = \"a.pc2\"\n" +
         cloth(""),
     "a.toml:5:9: obstacle[0].cache = \"a.pc2\": has animation and cache: must be one of them"},
    {"motion without time", k_ball + "motion = [{ translate = [0, 0, 0] }]\n" + cloth(""),
     "a.toml:4:11: obstacle[0].motion[0]: needs t, the time in s"},
    {"motion back in time", k_ball + "motion = [{ t = 1 }, { t = 1 }]\n" + cloth(""),
     "a.toml:4:28: obstacle[0].motion[1].t = 1: must be > 1 s, the time before"},
    {"static friction below the kinetic",
     k_ball + "friction = 0.5\nstatic_friction = 0.4\n" + cloth(""),
     "a.toml:5:19: obstacle[0].static_friction = 0.4: must be >= friction, 0.5"},
    {"static friction below the default", cloth("fabric = { static_friction = 0.2 }\n"),
     "a.toml:4:30: cloth[0].fabric.static_friction = 0.2: must be >= friction, 0.3"},
    {"friction of nobody", k_ball + cloth("") + friction("[\"flag\", \"bal\"]"),
     "a.toml:8:11: contact.friction[0].between = [\"flag\", \"bal\"]: bal is no object; the "
     "nearest "
     "is ball"},
    {"friction of one", cloth("") + friction("\"flag\""),
     "a.toml:5:11: contact.friction[0].between = \"flag\": must be the names of two objects"},
    {"friction of obstacles", k_ball + cloth("") + friction("[\"ball\", \"ball\"]"),
     "a.toml:8:11: contact.friction[0].between = [\"ball\", \"ball\"]: must name one that moves: "
     "obstacles "
     "do not touch each other"},
    {"friction without a number",
     cloth("") + "[[contact.friction]]\nbetween = [\"flag\", \"flag\"]\n",
     "a.toml:4:1: contact.friction[0]: needs friction"},
    {"negative friction of a pair", cloth("") + friction("[\"flag\", \"flag\"]", -0.5),
     "a.toml:6:12: contact.friction[0].friction = -0.5: must be >= 0"},
    {"friction twice",
     k_ball + cloth("") + friction("[\"flag\", \"ball\"]") + friction("[\"ball\", \"flag\"]"),
     "a.toml:11:11: contact.friction[1].between = [\"ball\", \"flag\"]: must be unique: an earlier "
     "entry has the same two"},
    {"range the wrong way", cloth("") + "[render]\nrange = [1.2, 0.9]\n",
     "a.toml:5:15: render.range[1] = 0.9: must be > range[0], 1.2"},
    {"solid of nothing", "[[solid]]\nname = \"cube\"\n", "a.toml:1:1: solid[0]: needs mesh or box"},
    {"solid of two things", "[[solid]]\nname = \"cube\"\nmesh = \"a.obj\"\nbox = [1.0, 1.0, 1.0]\n",
     "a.toml:1:1: solid[0]: has mesh and box: must be one of them"},
    {"box between two numbers of cells", solid("spacing = 0.02\nbox = [0.16, 0.165, 0.16]\n"),
     "a.toml:4:14: solid[0].box[1] = 0.165: must be a whole number of spacings; the nearest is "
     "0.16 m"},
    {"box without depth", solid("box = [1.0, 1.0, 0.0]\n"),
     "a.toml:3:18: solid[0].box[2] = 0: must be > 0 m"},
    {"filling of a box", solid("box = [1.0, 1.0, 1.0]\nfill = \"winding\"\n"),
     "a.toml:4:8: solid[0].fill = \"winding\": needs mesh, whose inside it tells"},
    {"model of cloth", solid("box = [1.0, 1.0, 1.0]\nmodel = \"stvk_triangle\"\n"),
     "a.toml:4:9: solid[0].model = \"stvk_triangle\": must be \"cubic\", \"linear\" or "
     "\"stvk_edge\""},
    {"slip in a solid", solid("box = [1.0, 1.0, 1.0]\nspaceing = 0.1\n"),
     "a.toml:4:1: solid[0].spaceing: unknown key; the nearest is spacing"},
    {"vertices of a solid", solid("box = [1.0, 1.0, 1.0]\n[[solid.pin]]\nvertices = [1]\n"),
     "a.toml:5:12: solid[0].pin[0].vertices = [1]: is of cloth; particles are held by box"},
    {"solid and cloth of one name", cloth("") + "[[solid]]\nname = \"flag\"\nbox = [1, 1, 1]\n",
     "a.toml:5:8: solid[0].name = \"flag\": must be unique: another one has it"},
    {"camera without target", cloth("") + "[render]\ncamera = { eye = [0, 0, 1] }\n",
     "a.toml:5:10: render.camera: needs eye and target"},
    {"unknown map", cloth("") + "[render]\nmap = \"jet\"\n",
     "a.toml:5:7: render.map = \"jet\": must be \"seed\", \"coolwarm\", \"viridis\", \"turbo\" or "
     "\"cividis\""},
    {"picture too small", cloth("") + "[render]\nsize = [640, 0]\n",
     "a.toml:5:14: render.size[1] = 0: must be 16 to 8192 pixels"},
};

TEST(BrokenScenes, AreRefusedInOneLineThatNamesPlaceValueAndWhatIsAllowed) {
    for (const Broken& broken : k_broken) {
        EXPECT_EQ(message_of(broken.text), broken.message) << broken.what;
    }
}

const std::vector<Broken> k_out_of_place{
    {"springs without a model that has them", cloth("[cloth.spring]\nK = 1000.0\n"),
     "a.toml:4:1: cloth[0].spring: is of edge models: needs model = \"cubic\", \"linear\", "
     "\"stvk_edge\" or \"stvk_triangle\""},
    {"a law that snaps through",
     cloth("model = \"cubic\"\n[cloth.spring]\nK1 = 100000.0\nstrict = true\n"),
     "a.toml:7:10: cloth[0].spring.strict = true: refuses this law: stiffness is negative between "
     "the stretches 0.9041 and 0.9979"},
    {"a limit of triangles",
     cloth("model = \"stvk_triangle\"\n[cloth.spring]\nlimit = [0.9, 1.1]\n"),
     "a.toml:6:9: cloth[0].spring.limit = [0.9, 1.1]: must be left out: stvk_triangle has no "
     "edges to limit"},
    {"a limit the wrong way", cloth("model = \"linear\"\n[cloth.spring]\nlimit = [1.1, 0.9]\n"),
     "a.toml:6:10: cloth[0].spring.limit[0] = 1.1: must be >= 0 and < 1, the least stretch"},
    {"refinement of springs", cloth("model = \"cubic\"\n[cloth.adapt]\nlevels = 2\n"),
     "a.toml:5:1: cloth[0].adapt = {...}: must be left out: only corotational cloth is refined"},
    {"refinement", cloth("[cloth.adapt]\nlevels = 9\n"),
     "a.toml:5:10: cloth[0].adapt.levels = 9: must be 0 to 8"},
    {"refinement's budget", cloth("[cloth.adapt]\nmax_triangles = 0\n"),
     "a.toml:5:17: cloth[0].adapt.max_triangles = 0: must be >= 1"},
    {"compression", cloth("[cloth.adapt]\ncompression = 1.0\n"),
     "a.toml:5:15: cloth[0].adapt.compression = 1: must be 0 to below 1"},
    {"curvature", cloth("[cloth.adapt]\ncurvature = -0.1\n"),
     "a.toml:5:13: cloth[0].adapt.curvature = -0.1: must be >= 0"},
    {"rigid body without a shape", "[[rigid]]\nname = \"ball\"\n",
     "a.toml:1:1: rigid[0]: needs mesh or shape"},
    {"rigid body with two shapes", "[[rigid]]\nname = \"a\"\nshape = \"box\"\nmesh = \"a.obj\"\n",
     "a.toml:1:1: rigid[0]: has mesh and shape: must be one of them"},
    {"rigid plane", "[[rigid]]\nname = \"a\"\nshape = \"plane\"\n",
     "a.toml:3:9: rigid[0].shape = \"plane\": must be \"sphere\" or \"box\""},
    {"rigid body without mass", "[[rigid]]\nname = \"a\"\nshape = \"box\"\nmass = 0\n",
     "a.toml:4:8: rigid[0].mass = 0: must be > 0 kg"},
    {"radius of a rigid box", "[[rigid]]\nname = \"a\"\nshape = \"box\"\nradius = 1\n",
     "a.toml:4:10: rigid[0].radius = 1: needs shape = \"sphere\""},
};

TEST(BrokenScenes, AreRefusedWhereKeysDoNotFitTheirObject) {
    for (const Broken& broken : k_out_of_place) {
        EXPECT_EQ(message_of(broken.text), broken.message) << broken.what;
    }
}

TEST(BrokenScenes, SayWhereTheParserStopped) {
    const std::string message = message_of("[scene]\nframes = = 3\n");

    EXPECT_EQ(message.substr(0, message.find(": not TOML")), "a.toml:2:10");
    EXPECT_EQ(message.find('\n'), std::string::npos);
}

/// Whatever a slip of the keyboard makes of a scene: it is read, or refused in one line with a
/// place.
TEST(BrokenScenes, AnySlipIsReadOrRefusedInOneLine) {
    const std::string scene = read_file(test::source_path("tests/scenes/every_key.toml"));
    const std::string keys = "=[]{}\".,-#\nx0";
    std::mt19937 random(1);
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
        std::string text = scene;
        const std::size_t at = random() % text.size();
        if (i % 3 == 0) {
            text.erase(at, 1);
        } else if (i % 3 == 1) {
            text.insert(at, 1, keys[random() % keys.size()]);
        } else {
            text.resize(at);
        }
        try {
            read_scene_text(text, "a.toml", "");
        } catch (const Error& error) {
            const std::string message = error.what();
            EXPECT_EQ(error.code(), ExitCode::BadInput);
            EXPECT_TRUE(message.starts_with("a.toml:")) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            EXPECT_EQ(message.find(":0:"), std::string::npos) << message;
            ++refused;
        }
    }
    EXPECT_GT(refused, 1000);
}

TEST(BrokenScenes, AFileThatIsNotThereIsTheDisksFault) {
    try {
        read_scene("no/such/scene.toml");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::Disk);
    }
}

} // namespace
} // namespace weft

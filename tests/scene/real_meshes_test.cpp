#include "base/error.h"
#include "geometry/mesh_measure.h"
#include "scene/mesh_import.h"
#include "support/real_models.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

namespace weft {

namespace {

ImportedMesh import_model(const std::string& name, const MeshSource& options = {}) {
    return import_mesh(test::k_real_models / name, options, false);
}

MeshMeasure measure_model(const std::string& name, const MeshSource& options = {}) {
    return measure_mesh(import_model(name, options).mesh);
}

Vec3 size_of(const MeshMeasure& m) {
    return m.high - m.low;
}

/// Vertices of an OBJ text that lie further than `tolerance` from all before, straight from its
/// lines.
std::size_t distinct_vertices_in_obj(const std::filesystem::path& file, double tolerance) {
    std::ifstream stream(file);
    std::vector<Vec3> distinct;
    for (std::string line; std::getline(stream, line);) {
        std::istringstream words(line);
        std::string word;
        Vec3 p;
        if (words >> word >> p.x() >> p.y() >> p.z() && word == "v" &&
            std::none_of(distinct.begin(), distinct.end(),
                         [&](const Vec3& q) { return (p - q).norm() <= tolerance; })) {
            distinct.push_back(p);
        }
    }
    return distinct.size();
}

std::string read_bytes(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace

TEST(RealMeshes, OneModelIsTheSameInFiveFormats) {
    WEFT_NEEDS_REAL_MODELS();
    const MeshMeasure obj = measure_model("OBJ/WusonOBJ.obj");
    const std::size_t vertices = distinct_vertices_in_obj(test::k_real_models / "OBJ/WusonOBJ.obj",
                                                          1e-6 * size_of(obj).norm());
    const double area = obj.area;

    for (const char* name :
         {"OBJ/WusonOBJ.obj", "PLY/Wuson.ply", "STL/Wuson.stl", "OFF/Wuson.off", "X/Testwuson.X"}) {
        const ImportedMesh imported = import_model(name);

        EXPECT_EQ(imported.mesh.triangles.size(), 3732U) << name; // the second line of Wuson.off
        EXPECT_EQ(imported.mesh.positions.size(), vertices) << name;
        EXPECT_NEAR(measure_mesh(imported.mesh).area, area, 1e-5 * area) << name;
    }
}

TEST(RealMeshes, OffIsWeldedFromTheCountsInItsHeader) {
    WEFT_NEEDS_REAL_MODELS();
    const ImportedMesh cube = import_model("OFF/Cube.off"); // "8 6 0": six quads

    EXPECT_EQ(import_model("OFF/Wuson.off").vertices_in_file, 3205U);
    EXPECT_EQ(cube.vertices_in_file, 8U);
    EXPECT_EQ(cube.mesh.triangles.size(), 12U);
    EXPECT_EQ(cube.mesh.positions[1], Vec3(0.5, -0.5, 0.5)); // the order of the file
}

TEST(RealMeshes, BinaryAndTextStlAgree) {
    WEFT_NEEDS_REAL_MODELS();
    const ImportedMesh text = import_model("STL/Spider_ascii.stl", {.repair = true});
    const ImportedMesh binary = import_model("STL/Spider_binary.stl", {.repair = true});

    EXPECT_EQ(binary.triangles_in_file, 1368U); // bytes 80..83 of the binary one
    EXPECT_EQ(text.triangles_in_file, 1368U);
    EXPECT_EQ(text.triangles_removed, binary.triangles_removed);
    EXPECT_EQ(text.mesh.positions.size(), binary.mesh.positions.size());
}

TEST(RealMeshes, PlyInTextAndBinaryIsTheUnitCube) {
    WEFT_NEEDS_REAL_MODELS();
    for (const char* name : {"PLY/cube.ply", "PLY/cube_binary.ply"}) {
        const MeshMeasure m = measure_model(name);

        EXPECT_TRUE(m.is_closed) << name;
        EXPECT_NEAR(m.volume, 1.0, 1e-6) << name;
    }
}

TEST(RealMeshes, APolygonOfSixtySixCornersKeepsItsArea) {
    WEFT_NEEDS_REAL_MODELS();
    // concave_polygon.obj and ConcavePolygon.dae: one ring, cut open, of 66 corners.
    const MeshMeasure obj = measure_model("OBJ/concave_polygon.obj");
    const MeshMeasure dae = measure_model("Collada/ConcavePolygon.dae");

    EXPECT_EQ(obj.loops.size(), 2U);
    EXPECT_NEAR(obj.area, dae.area, 1e-6);
    // A ring of 32-sided outlines of perimeters P and p has the area (P^2 - p^2) / (128
    // tan(pi/32)).
    const double outer = obj.loops[0].length;
    const double inner = obj.loops[1].length;
    EXPECT_NEAR(obj.area, (outer * outer - inner * inner) / (128.0 * std::tan(M_PI / 32.0)),
                2e-3 * obj.area);
}

TEST(RealMeshes, GltfAppliesTheTransformsOfItsNodes) {
    WEFT_NEEDS_REAL_MODELS();
    const ImportedMesh both = import_model("glTF/TwoBoxes/TwoBoxes.gltf");
    const MeshMeasure top = measure_model("glTF/TwoBoxes/TwoBoxes.gltf", {.objects = {"TopBox"}});

    // Unit cube; the second one, half as large, has its centre 1 m above, by a z-up root.
    EXPECT_EQ(both.objects, (std::vector<std::string>{"BottomBox", "TopBox"}));
    EXPECT_TRUE(size_of(measure_mesh(both.mesh)).isApprox(Vec3(1.0, 1.75, 1.0), 1e-6));
    EXPECT_TRUE(top.low.isApprox(Vec3(-0.25, 0.75, -0.25), 1e-6));
}

TEST(RealMeshes, GlbIsTheTexturedUnitCube) {
    WEFT_NEEDS_REAL_MODELS();
    const ImportedMesh box = import_model("glTF2/BoxTextured-glTF-Binary/BoxTextured.glb");

    EXPECT_EQ(box.vertices_in_file, 24U); // split along the uv seams
    EXPECT_EQ(box.mesh.positions.size(), 8U);
    EXPECT_EQ(box.corner_uv.size(), 12U);
    EXPECT_NEAR(measure_mesh(box.mesh).volume, 1.0, 1e-6);
}

TEST(RealMeshes, GltfWithAnIndexOutOfRangeIsRefused) {
    WEFT_NEEDS_REAL_MODELS();
    EXPECT_THROW(import_model("glTF2/IndexOutOfRange/IndexOutOfRange.gltf"), Error);
    EXPECT_THROW(import_model("glTF2/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb"), Error);
}

TEST(RealMeshes, FbxFollowsItsOwnUnitAndUpAxis) {
    WEFT_NEEDS_REAL_MODELS();
    // Corners at +-23.62 and 0..47.24, scaled by 0.0254; UnitScaleFactor 100 cm; UpAxis 2 (z).
    const MeshMeasure box = measure_model("FBX/embedded_ascii/box.FBX");
    EXPECT_TRUE(box.low.isApprox(Vec3(-0.6, 0.0, -0.6), 1e-5));
    EXPECT_TRUE(box.high.isApprox(Vec3(0.6, 1.2, 0.6), 1e-5));

    // A cube of one unit; UnitScaleFactor 1 cm.
    EXPECT_NEAR(measure_model("FBX/phong_cube.fbx").largest_dimension(), 0.01, 1e-9);
}

TEST(RealMeshes, AUnitThatIsGivenReplacesTheOneOfTheFile) {
    WEFT_NEEDS_REAL_MODELS();
    const MeshSource metres{.metres_per_unit = 1.0, .units_given = true};

    EXPECT_NEAR(measure_model("FBX/phong_cube.fbx", metres).largest_dimension(), 1.0, 1e-6);
    EXPECT_NEAR(measure_model("Collada/cube_triangulate.dae", metres).largest_dimension(), 100.0,
                1e-4);
}

TEST(RealMeshes, ColladaFollowsItsUnitAndUpAxis) {
    WEFT_NEEDS_REAL_MODELS();
    // unit meter="0.01", Y_UP; the floor's corners are at x = +-400, z = +-200.
    const MeshMeasure floor = measure_model("Collada/COLLADA.dae", {.objects = {"Floor"}});
    EXPECT_TRUE(size_of(floor).isApprox(Vec3(8.0, 0.0, 4.0), 1e-6));

    // Z_UP; 64 unit boxes that stand on their z = 0 faces.
    const ImportedMesh boxes = import_model("Collada/anims_with_full_rotations_between_keys.DAE",
                                            {.objects = {"Box001-Pivot"}});
    EXPECT_NEAR(measure_mesh(boxes.mesh).low.y(), 0.0, 1e-6);
    EXPECT_NEAR(measure_mesh(boxes.mesh).high.y(), 1.0, 1e-6);
}

TEST(RealMeshes, BlenderFilesStandUpright) {
    WEFT_NEEDS_REAL_MODELS();
    const MeshMeasure cube = measure_model("BLEND/box.blend");
    const MeshMeasure human = measure_model("BLEND/HUMAN.blend");

    EXPECT_NEAR(cube.volume, 8.0, 1e-5); // Blender's default cube, 2 m
    // Two halves, one the mirror image: welded they are one closed body, taller than wide.
    EXPECT_EQ(human.parts, 1);
    EXPECT_TRUE(human.is_closed);
    EXPECT_GT(size_of(human).y(), 2.0 * size_of(human).x());
}

TEST(RealMeshes, DirectXIsTheSameInTextBinaryAndCompressed) {
    WEFT_NEEDS_REAL_MODELS();
    for (const char* name :
         {"X/test_cube_text.x", "X/test_cube_binary.x", "X/test_cube_compressed.x"}) {
        const MeshMeasure m = measure_model(name);

        EXPECT_TRUE(m.is_closed) << name;
        EXPECT_NEAR(m.volume, 8.0, 1e-5) << name;
    }
}

TEST(RealMeshes, ATruncatedFileIsRefusedAtAnyLength) {
    WEFT_NEEDS_REAL_MODELS();
    const test::TempFolder folder;
    for (const char* name :
         {"OBJ/spider.obj", "PLY/Wuson.ply", "PLY/cube_binary.ply", "STL/Wuson.stl",
          "STL/Spider_ascii.stl", "OFF/Wuson.off", "X/Testwuson.X", "FBX/phong_cube.fbx",
          "FBX/embedded_ascii/box.FBX", "Collada/duck.dae", "BLEND/BlenderDefault_248.blend",
          "glTF2/BoxTextured-glTF-Binary/BoxTextured.glb",
          "glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf"}) {
        const std::filesystem::path whole = test::k_real_models / name;
        const std::string bytes = read_bytes(whole);
        for (const double share : {0.01, 0.1, 0.3, 0.5, 0.7, 0.8, 0.9}) {
            const auto length = static_cast<std::size_t>(share * static_cast<double>(bytes.size()));
            const std::filesystem::path cut = test::write_file(
                folder / ("cut" + whole.extension().string()), bytes.substr(0, length));

            EXPECT_THROW(import_mesh(cut, {}, false), Error) << name << " cut at " << share;
        }
    }
}

TEST(RealMeshes, NoiseIsRefusedInEveryFormat) {
    const test::TempFolder folder;
    std::string noise;
    std::uint32_t state = 12345;
    for (int i = 0; i < 20000; ++i) {
        state = 1664525U * state + 1013904223U; // Numerical Recipes' linear congruences
        noise += static_cast<char>(state >> 24U);
    }
    for (const char* extension : {".obj", ".ply", ".stl", ".off", ".gltf", ".glb", ".fbx", ".dae",
                                  ".blend", ".x", ".3ds", ".lwo"}) {
        const std::filesystem::path file =
            test::write_file(folder / (std::string("noise") + extension), noise);

        EXPECT_THROW(import_mesh(file, {}, false), Error) << extension;
    }
}

} // namespace weft

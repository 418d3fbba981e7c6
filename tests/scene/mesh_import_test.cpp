#include "base/error.h"
#include "scene/mesh_import.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

/// Two triangles over the unit square in x-y with a uv seam along the diagonal.
const char* const k_seamed_square = "o Square\n"
                                    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                    "vt 0 0\nvt 1 0\nvt 1 1\nvt 5 5\nvt 6 6\nvt 5 6\n"
                                    "f 1/1 2/2 3/3\nf 1/4 3/5 4/6\n";

ImportedMesh import_text(const std::string& name, const std::string& text, MeshSource source = {}) {
    const test::TempFolder folder;
    const std::filesystem::path file = test::write_file(folder / name, text);
    source.file = name;
    return import_mesh(file, source, true);
}

} // namespace

TEST(MeshImport, VerticesSplitAlongAUvSeamAreWeldedAndKeepTheirUv) {
    const ImportedMesh imported = import_text("square.obj", k_seamed_square);

    EXPECT_EQ(imported.vertices_in_file, 6U);
    EXPECT_EQ(imported.mesh.positions.size(), 4U);
    ASSERT_EQ(imported.mesh.triangles.size(), 2U);
    EXPECT_EQ(imported.mesh.triangles[1], (Triangle{0, 2, 3}));
    EXPECT_EQ(imported.corner_uv[0][2], Vec2(1.0, 1.0));
    EXPECT_EQ(imported.corner_uv[1][1], Vec2(6.0, 6.0));
    EXPECT_EQ(imported.objects, std::vector<std::string>{"Square"});
}

TEST(MeshImport, UnitsAndUpAxisAreConverted) {
    const ImportedMesh imported =
        import_text("square.obj", k_seamed_square,
                    {.metres_per_unit = 0.5, .units_given = true, .up = 'z', .up_given = true});

    // (1, 1, 0) of a z-up file lies on the ground: (x, z, -y).
    EXPECT_TRUE(imported.mesh.positions[2].isApprox(Vec3(0.5, 0.0, -0.5)));
}

TEST(MeshImport, PlyKeepsTheOrderOfItsVertices) {
    const ImportedMesh imported =
        import_text("t.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                             "property float y\nproperty float z\nelement face 1\n"
                             "property list uchar int vertex_indices\nend_header\n"
                             "0 0 0\n1 0 0\n0 1 0\n3 2 0 1\n");

    EXPECT_EQ(imported.mesh.triangles[0], (Triangle{2, 0, 1}));
    EXPECT_EQ(imported.mesh.positions[1], Vec3(1.0, 0.0, 0.0));
}

TEST(MeshImport, AMissingFileIsRefusedByName) {
    try {
        import_mesh("/nowhere/shirt.obj", {.file = "shirt.obj"}, true);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::BadInput);
        EXPECT_STREQ(error.what(), "shirt.obj: no such file");
    }
}

TEST(MeshImport, OneOfSeveralObjectsIsPickedByName) {
    const std::string two = "o A\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
                            "o B\nv 0 0 5\nv 1 0 5\nv 0 1 5\nv 1 1 5\nf 4 5 7 6\n";

    const ImportedMesh all = import_text("two.obj", two);
    const ImportedMesh b = import_text("two.obj", two, {.objects = {"B"}});

    EXPECT_EQ(all.objects, (std::vector<std::string>{"A", "B"}));
    EXPECT_EQ(all.mesh.triangles.size(), 3U);
    EXPECT_EQ(b.objects, std::vector<std::string>{"B"});
    EXPECT_EQ(b.mesh.positions.size(), 4U);
    EXPECT_EQ(b.mesh.positions[0], Vec3(0, 0, 5));
}

TEST(MeshImport, TrianglesWoundAgainstTheirNeighboursAreTurnedWithTheirUv) {
    const ImportedMesh imported =
        import_text("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\n"
                             "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 2 0\n"
                             "f 1/1 2/2 3/3\nf 1/1 4/4 3/3\nf 2/2 5/5 3/3\n");

    EXPECT_EQ(imported.mesh.triangles[1], (Triangle{0, 2, 3}));
    EXPECT_EQ(imported.corner_uv[1][1], Vec2(1, 1));
    EXPECT_EQ(imported.warnings,
              std::vector<std::string>{"1 triangle was wound against the neighbours and turned"});
}

TEST(MeshImport, AClosedSurfaceInsideOutIsTurned) {
    const ImportedMesh imported = import_text(
        "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");

    EXPECT_EQ(imported.mesh.triangles[0], (Triangle{0, 2, 1}));
    ASSERT_EQ(imported.warnings.size(), 1U);
    EXPECT_EQ(imported.warnings[0], "the closed surface was inside out and has been turned");
}

TEST(MeshImport, RepairDropsWhatIsDegenerateAndCountsIt) {
    const ImportedMesh imported = import_text(
        "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.5 0 0\nf 1 2 3\nf 1 4 2\nf 1 1 3\nf 3 1 2\n",
        {.repair = true});

    EXPECT_EQ(imported.triangles_in_file, 4U);
    EXPECT_EQ(imported.triangles_removed, 3U);
    EXPECT_EQ(imported.mesh.positions.size(), 3U);
    EXPECT_EQ(imported.mesh.triangles, std::vector<Triangle>({{0, 1, 2}}));
}

TEST(MeshImport, ASizeOutsideOneCentimetreToTenMetresNamesTheLikelyUnit) {
    const std::string body = "v 0 0 0\nv 60 0 0\nv 0 175 0\nf 1 2 3\n";

    const ImportedMesh as_metres = import_text("a.obj", body);
    const ImportedMesh as_centimetres =
        import_text("a.obj", body, {.metres_per_unit = 0.01, .units_given = true});

    EXPECT_EQ(as_metres.warnings, std::vector<std::string>{
                                      "the largest dimension is 175 m, outside 1 cm to 10 m: units "
                                      "may be \"cm\" (1.75 m) or \"mm\" (0.175 m)"});
    EXPECT_TRUE(as_centimetres.warnings.empty());
}

TEST(MeshImport, VerticesInNoFaceAreReportedAndLeftOut) {
    const ImportedMesh imported =
        import_text("a.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n");

    EXPECT_EQ(imported.mesh.positions.size(), 3U);
    EXPECT_EQ(
        imported.warnings,
        std::vector<std::string>{"1 of 4 vertices in the file are in no face and were left out"});
}

TEST(MeshImport, ObjLinesMayGoOnBehindABackslash) {
    const ImportedMesh imported =
        import_text("a.obj", "v 0 0 \\\n0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3\n");

    EXPECT_EQ(imported.mesh.triangles, std::vector<Triangle>({{0, 1, 2}}));
}

} // namespace weft

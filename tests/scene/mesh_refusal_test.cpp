#include "base/error.h"
#include "scene/mesh_import.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

const std::string k_tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                  "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

std::string ply(int vertices, int faces, const std::string& body) {
    return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
           std::to_string(faces) + "\nproperty list uchar int vertex_indices\nend_header\n" + body;
}

/// The message that refuses `bytes` as a mesh file of this name; "" when it is taken.
std::string refusal(const std::string& name,
                    const std::string& bytes,
                    const MeshSource& options = {},
                    bool cloth = true) {
    const test::TempFolder folder;
    const std::filesystem::path file = test::write_file(folder / name, bytes);
    MeshSource source = options;
    source.file = name;
    try {
        import_mesh(file, source, cloth);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::BadInput);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return "";
}

} // namespace

TEST(MeshRefusal, FilesThatAreNoneAreRefused) {
    const test::TempFolder folder;

    EXPECT_EQ(refusal("empty.obj", ""), "empty.obj: is empty");
    EXPECT_EQ(refusal("notes.xyz", "some words"),
              "notes.xyz: cannot be read: not in a format that can be read, or damaged");
    EXPECT_THROW(import_mesh(folder.path(), {}, true), Error);
    EXPECT_THROW(import_mesh(folder / "missing.fbx", {}, true), Error);
}

TEST(MeshRefusal, ObjErrorsNameTheLine) {
    EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\n"),
              "a.obj:5: a face names vertex 9, but the file has 3");
    EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n"),
              "a.obj:4: face 1 names vertex 0: allowed are 1 to 3, or -1 to -3");
    EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n"),
              "a.obj:4: face 1 names vertex -4: allowed are 1 to 3, or -1 to -3");
    EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n"),
              "a.obj:2: vertex 2: \"nan\": a coordinate must be a finite number");
    EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 0 1e60\nv 0 1 0\nf 1 2 3\n"),
              "a.obj:2: vertex 2: \"1e60\": a coordinate must be a finite number");
    EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 x 0\nv 0 1 0\nf 1 2 3\n"),
              "a.obj:2: vertex 2: \"x\" is not a number");
    EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/2 3/1\n"),
              "a.obj:5: a face names uv 2, but the file has 1");
    EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n"),
              "a.obj:4: face 1 has 2 corners: a face needs 3 (damaged or truncated file)");
}

TEST(MeshRefusal, ObjThatEndsInsideALineIsTruncated) {
    const std::string cut = k_tetrahedron.substr(0, k_tetrahedron.find("f 1 4 3") - 1);

    EXPECT_EQ(refusal("t.obj", cut.substr(0, cut.find("f 1 2 4") - 1)),
              "t.obj:5: truncated: the file ends inside a line, and 1 of its 4 vertices are in no "
              "face");
    EXPECT_EQ(refusal("t.obj", k_tetrahedron), "");
}

TEST(MeshRefusal, PlyErrorsNameTheElement) {
    EXPECT_EQ(refusal("a.ply", ply(3, 1, "0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n")),
              "a.ply: face 0 names vertex 7: allowed are 0 to 2");
    EXPECT_EQ(refusal("a.ply", ply(3, 2, "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")),
              "a.ply: damaged or truncated: 2 of type face announced, number 1 is incomplete");
    EXPECT_EQ(refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"),
              "a.ply:3: truncated: the header has no end_header");
    EXPECT_EQ(
        refusal("a.ply", ply(3, 1, "0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n")),
        "a.ply: object \"a\": 1 vertex has a coordinate that is not a finite number: vertex 1 "
        "in the file");
}

TEST(MeshRefusal, OffErrorsNameTheLine) {
    EXPECT_EQ(refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"),
              "a.off:6: face 0 names vertex 7: allowed are 0 to 2");
    EXPECT_EQ(refusal("a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
              "a.off:6: truncated: 2 faces announced, 1 found");
}

TEST(MeshRefusal, StlTextMustEnd) {
    const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                              "vertex 0 1 0\nendloop\nendfacet\n";

    EXPECT_EQ(refusal("a.stl", "solid a\n" + facet + "endsolid a\n"), "");
    EXPECT_EQ(refusal("a.stl", "solid a\n" + facet),
              "a.stl:8: truncated: ends in triangle 0, without endsolid");
}

TEST(MeshRefusal, AMeshWithoutTrianglesIsRefused) {
    EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n# only a line here\n"),
              "a.obj: has no triangles: 1 point or line was left out: only faces are simulated");
}

TEST(MeshRefusal, DegenerateTrianglesAreRefusedUnlessRepaired) {
    const std::string text = k_tetrahedron + "v 0.5 0 0\nf 1 2 5\nf 1 1 2\n";

    EXPECT_EQ(refusal("a.obj", text, {}, false),
              "a.obj: object \"defaultobject\": face 4, 5: 2 triangles are degenerate (no area, or "
              "an altitude below 1e-06 of the size): mend the file or set repair = true");
    EXPECT_EQ(refusal("a.obj", text, {.repair = true}), "");
}

TEST(MeshRefusal, NonManifoldEdgesAreRefusedInClothAlone) {
    const std::string fin = "o Fin\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\n"
                            "f 1 2 3\nf 2 1 4\nf 2 1 5\n";

    EXPECT_EQ(refusal("a.obj", fin),
              "a.obj: object \"Fin\": 1 edge has more than two triangles: edge 0-1 (vertices after "
              "welding): cloth allows one or two");
    EXPECT_EQ(refusal("a.obj", fin, {}, false), "");
}

TEST(MeshRefusal, AnUnknownObjectNamesTheNearest) {
    EXPECT_EQ(
        refusal("a.obj", "o Shirt\n" + k_tetrahedron, {.objects = {"Skirt"}}),
        "a.obj: object = \"Skirt\": not in the file; nearest is \"Shirt\" (it has \"Shirt\")");
}

} // namespace weft

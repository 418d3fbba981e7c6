#include "base/error.h"
#include "scene/mesh_file.h"
#include "scene/mesh_sequence.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

/// A pyramid of given height on a square; a face of it is a quad.
std::string pyramid(double height) {
    return fmt::format("v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 {} 0\n"
                       "f 1 2 3 4\nf 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n",
                       height);
}

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::BadInput);
        return error.what();
    }
    return "";
}

SequenceReader open(const test::TempFolder& folder, const std::string& pattern) {
    SequenceFiles files = find_sequence(folder.path(), pattern);
    const MeshSource source{.file = files.names[0]};
    const ImportedMesh first = import_mesh(files.files[0], source, false);
    return {std::move(files), source, first};
}

} // namespace

TEST(MeshSequence, FindsItsFilesByTheirNumbers) {
    const test::TempFolder folder;
    for (const char* name : {"body.0009.obj", "body.0010.obj", "body.0011.obj", "body.0012.ply",
                             "body.rest.obj", "bodies.0013.obj", "body.00010.obj"}) {
        test::write_file(folder / name, "");
    }

    const SequenceFiles files = find_sequence(folder.path(), "body.####.obj");

    EXPECT_EQ(files.names,
              (std::vector<std::string>{"body.0009.obj", "body.0010.obj", "body.0011.obj"}));
}

TEST(MeshSequence, OneMarkStandsForNumbersWithoutZeros) {
    const test::TempFolder folder;
    for (int number = 8; number <= 11; ++number) {
        test::write_file(folder / fmt::format("b{}.obj", number), "");
    }

    EXPECT_EQ(find_sequence(folder.path(), "b#.obj").names.back(), "b11.obj");
}

TEST(MeshSequence, RefusesPatternsAndGapsInOneLine) {
    const test::TempFolder folder;
    test::write_file(folder / "b.01.obj", "");
    test::write_file(folder / "b.04.obj", "");
    const auto refusal = [&](const std::string& pattern) {
        return message_of([&] { find_sequence(folder.path(), pattern); });
    };

    EXPECT_EQ(refusal("b.##.obj"), "b.##.obj: number 2 is missing: b.04.obj follows b.01.obj");
    EXPECT_EQ(refusal("c.##.obj"), "c.##.obj: no file has such a name");
    EXPECT_EQ(refusal("b.obj"), "sequence = \"b.obj\": must have one group of # in its file name, "
                                "which stands for the number");
    EXPECT_EQ(refusal("b#.#.obj").substr(0, 30), "sequence = \"b#.#.obj\": must ha");
}

TEST(MeshSequence, ReadsThePosesOfTheSameVertices) {
    const test::TempFolder folder;
    for (int k = 0; k < 3; ++k) {
        test::write_file(folder / fmt::format("p.{}.obj", k), pyramid(1.0 + k));
    }
    const SequenceReader reader = open(folder, "p.#.obj");

    std::vector<Vec3f> positions;
    reader.read(2, positions);

    ASSERT_EQ(positions.size(), 5u);
    EXPECT_EQ(std::count(positions.begin(), positions.end(), Vec3f(0.0F, 3.0F, 0.0F)), 1);
}

TEST(MeshSequence, RefusesAnotherMeshWithFileAndCounts) {
    const test::TempFolder folder;
    test::write_file(folder / "p.1.obj", pyramid(1.0));
    test::write_file(folder / "p.2.obj", pyramid(1.0) + "v 3 0 0\nf 1 2 6\n");
    test::write_file(folder / "p.3.obj", "v 0 nan 0\n" + pyramid(1.0));
    const SequenceReader reader = open(folder, "p.#.obj");
    std::vector<Vec3f> positions;

    EXPECT_EQ(message_of([&] { reader.read(1, positions); }),
              "p.2.obj: 19 vertices and 7 triangles, p.1.obj has 16 and 6: must be the same mesh "
              "in each file");
    EXPECT_NE(message_of([&] { reader.read(2, positions); }), "");
}

} // namespace weft

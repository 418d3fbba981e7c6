#include "base/error.h"
#include "frames/ply.h"

#include <gtest/gtest.h>

#include <cstring>

namespace weft {
namespace {

/// Of a vertex: x y z, u v, the quantities.
constexpr std::size_t k_floats = 5 + k_quantities.size();

FrameObject two_triangles() {
    FrameObject cloth;
    cloth.positions = {{0, 0, 0}, {1, 0, 0.25F}, {1, 1, 0}, {0, 1, -0.1F}};
    cloth.material_positions = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    cloth.triangles = {{0, 1, 2}, {0, 2, 3}};
    for (std::size_t q = 0; q < k_quantities.size(); ++q) {
        for (int i = 0; i < 4; ++i) {
            cloth.values[q].push_back(static_cast<float>(q) + 0.1F * static_cast<float>(i));
        }
    }
    return cloth;
}

std::string message_of(const std::string& bytes) {
    try {
        decode_ply(bytes, "a.ply");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::Disk);
        return error.what();
    }
    return "";
}

std::size_t body_begin(const std::string& bytes) {
    return bytes.find("end_header\n") + std::strlen("end_header\n");
}

TEST(Ply, ReadsBackEveryBitOfACloth) {
    const FrameObject cloth = two_triangles();

    const FrameObject read = decode_ply(encode_ply(cloth, "a comment"), "a.ply");

    EXPECT_EQ(read.kind, ObjectKind::Cloth);
    EXPECT_EQ(read.positions, cloth.positions);
    EXPECT_EQ(read.material_positions, cloth.material_positions);
    EXPECT_EQ(read.triangles, cloth.triangles);
    EXPECT_EQ(read.values, cloth.values);
}

TEST(Ply, ReadsAnObjectWithoutMaterialPositionsAsAnObstacle) {
    FrameObject obstacle = two_triangles();
    obstacle.material_positions.clear();
    obstacle.values = {};

    const FrameObject read = decode_ply(encode_ply(obstacle, "c"), "a.ply");

    EXPECT_EQ(read.kind, ObjectKind::Obstacle);
    EXPECT_EQ(read.positions, obstacle.positions);
    EXPECT_TRUE(read.values[0].empty());
}

TEST(Ply, LaysRowsOutAsItsHeaderSays) {
    const std::string bytes = encode_ply(two_triangles(), "c");
    const std::size_t body = body_begin(bytes);

    float third_of_vertex_1 = 0; // x y z u v stretch ..
    std::memcpy(&third_of_vertex_1, bytes.data() + body + (k_floats + 2) * 4, 4);

    EXPECT_EQ(bytes.size(), body + 4 * k_floats * 4 + 2 * 13);
    EXPECT_EQ(third_of_vertex_1, 0.25F);
    EXPECT_NE(bytes.find("property float u\nproperty float v\nproperty float stretch\n"),
              std::string::npos);
}

TEST(Ply, RefusesEveryTruncation) {
    const std::string bytes = encode_ply(two_triangles(), "c");

    for (std::size_t length = 0; length < bytes.size(); ++length) {
        EXPECT_NE(message_of(bytes.substr(0, length)), "") << length;
    }
}

TEST(Ply, RefusesAVertexIndexOutOfRange) {
    std::string bytes = encode_ply(two_triangles(), "c");
    const std::int32_t far_vertex = 4;
    std::memcpy(bytes.data() + bytes.size() - 4, &far_vertex, 4);

    EXPECT_EQ(message_of(bytes), "a.ply: face 1: vertex 4: must be 0 to 3");
}

TEST(Ply, RefusesCoordinatesThatAreNotFinite) {
    std::string bytes = encode_ply(two_triangles(), "c");
    const float infinite = std::numeric_limits<float>::infinity();
    std::memcpy(bytes.data() + body_begin(bytes) + 2 * k_floats * 4, &infinite, 4);

    EXPECT_EQ(message_of(bytes), "a.ply: vertex 2: its coordinates are not finite");
}

TEST(Ply, RefusesVerticesWithoutAllCoordinates) {
    std::string bytes = encode_ply(two_triangles(), "c");
    bytes.replace(bytes.find("property float z"), 16, "property float w");

    EXPECT_EQ(message_of(bytes),
              "a.ply: vertices must have x, y and z, cloth u and v too, each once");
}

TEST(Ply, NamesTheLineOfAForeignHeader) {
    EXPECT_EQ(message_of("ply\nformat ascii 1.0\nend_header\n"),
              "a.ply:2: 'format ascii 1.0': not a PLY that weft wrote");
}

} // namespace
} // namespace weft

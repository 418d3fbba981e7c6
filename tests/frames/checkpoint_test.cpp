#include "frames/checkpoint.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace weft {
namespace {

/// Any bits will do: also denormals, negative zero and the NaN that marks a vertex without history.
Checkpoint random_checkpoint(std::size_t vertices) {
    std::mt19937_64 random(7);
    Checkpoint checkpoint{.scene_hash = random(), .frame = 40, .time = 1.56, .history_dt = 1e-3};
    for (auto* array : {&checkpoint.positions, &checkpoint.velocities,
                        &checkpoint.previous_positions, &checkpoint.previous_velocities}) {
        array->resize(vertices);
        for (Vec3& value : *array) {
            const std::array<std::uint64_t, 3> bits{random(), random(), random()};
            std::memcpy(value.data(), bits.data(), sizeof bits);
        }
    }
    checkpoint.friction_history.resize(vertices / 2);
    for (FrictionHistory& memory : checkpoint.friction_history) {
        memory = {{1, 2, 3, static_cast<Index>(random() % 100)}, 1e-3, checkpoint.positions[0], 1};
    }
    for (std::size_t i = 0; i < 3; ++i) {
        checkpoint.attached_states.push_back(
            {.start_gap = 0.1 * static_cast<double>(i), .welded_since = 1.5, .is_joined = 1});
    }
    return checkpoint;
}

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

TEST(Checkpoint, GivesBackEveryBit) {
    const Checkpoint checkpoint = random_checkpoint(100);

    Checkpoint read;
    EXPECT_EQ(decode_checkpoint(encode_checkpoint(checkpoint), read), "");

    EXPECT_EQ(read.scene_hash, checkpoint.scene_hash);
    EXPECT_EQ(read.frame, 40);
    EXPECT_EQ(read.time, 1.56);
    EXPECT_EQ(read.history_dt, 1e-3);
    EXPECT_TRUE(same_bits(read.positions, checkpoint.positions));
    EXPECT_TRUE(same_bits(read.velocities, checkpoint.velocities));
    EXPECT_TRUE(same_bits(read.previous_positions, checkpoint.previous_positions));
    EXPECT_TRUE(same_bits(read.previous_velocities, checkpoint.previous_velocities));
    ASSERT_EQ(read.friction_history.size(), checkpoint.friction_history.size());
    EXPECT_EQ(std::memcmp(read.friction_history.data(), checkpoint.friction_history.data(),
                          read.friction_history.size() * sizeof(FrictionHistory)),
              0);
    ASSERT_EQ(read.attached_states.size(), 3U);
    EXPECT_EQ(std::memcmp(read.attached_states.data(), checkpoint.attached_states.data(),
                          3 * sizeof(AttachedState)),
              0);
}

TEST(Checkpoint, OfEqualStatesHasEqualBytes) {
    EXPECT_EQ(encode_checkpoint(random_checkpoint(50)), encode_checkpoint(random_checkpoint(50)));
}

TEST(Checkpoint, IsRefusedAtEveryTruncation) {
    const std::string bytes = encode_checkpoint(random_checkpoint(5));

    Checkpoint read;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        EXPECT_EQ(decode_checkpoint(bytes.substr(0, length), read), "truncated");
    }
    EXPECT_EQ(decode_checkpoint(bytes + "x", read), "truncated");
}

TEST(Checkpoint, IsRefusedWhenAnyByteIsChanged) {
    const std::string bytes = encode_checkpoint(random_checkpoint(5));

    Checkpoint read;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::string damaged = bytes;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
        EXPECT_NE(decode_checkpoint(damaged, read), "") << "byte " << i;
    }
}

TEST(Checkpoint, RestoresTheMovingPartOfAWorld) {
    const Checkpoint checkpoint = random_checkpoint(3);
    World world;
    world.positions.resize(3, Vec3::Zero());
    world.attached_states.resize(checkpoint.attached_states.size());

    restore(checkpoint, world);
    const Checkpoint again = make_checkpoint(world, checkpoint.scene_hash);

    EXPECT_EQ(encode_checkpoint(again), encode_checkpoint(checkpoint));
}

TEST(GeometryHash, ChangesWithAMesh) {
    World world;
    world.obstacles.resize(1);
    world.obstacles[0].mesh.positions = {Vec3(0, 0, 0)};
    const std::uint64_t before = geometry_hash(world);

    world.obstacles[0].mesh.positions[0].x() = 1e-300;

    EXPECT_NE(geometry_hash(world), before);
}

} // namespace
} // namespace weft

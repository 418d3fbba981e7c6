#include "base/error.h"
#include "scene/point_cache.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

namespace weft {

namespace {

/// Bytes of 32 bit words in either order.
class Words {
public:
    explicit Words(bool is_big_endian) : is_big_endian_(is_big_endian) {}

    Words& add(std::int32_t value) { return add_bits(std::bit_cast<std::uint32_t>(value)); }
    Words& add(float value) { return add_bits(std::bit_cast<std::uint32_t>(value)); }
    std::string bytes;

private:
    Words& add_bits(std::uint32_t bits) {
        for (unsigned k = 0; k < 4; ++k) {
            bytes.push_back(static_cast<char>(bits >> (8 * (is_big_endian_ ? 3 - k : k))));
        }
        return *this;
    }

    bool is_big_endian_;
};

/// Three samples of two points: sample k has x = k, y = point, z = 0.5.
void add_samples(Words& words) {
    for (int k = 0; k < 3; ++k) {
        for (int p = 0; p < 2; ++p) {
            words.add(static_cast<float>(k)).add(static_cast<float>(p)).add(0.5F);
        }
    }
}

std::string pc2(std::int32_t points = 2, std::int32_t samples = 3, float rate = 2.0F) {
    Words words(false);
    words.bytes = std::string("POINTCACHE2\0", 12);
    words.add(1).add(points).add(1.0F).add(rate).add(samples);
    add_samples(words);
    return words.bytes;
}

std::string mdd(std::int32_t points = 2, std::int32_t samples = 3) {
    Words words(true);
    words.add(samples).add(points).add(0.0F).add(0.25F).add(1.0F);
    add_samples(words);
    return words.bytes;
}

std::string refusal(const std::filesystem::path& file, double fps = 10.0) {
    try {
        const PointCache cache = open_point_cache(file, "cache", fps);
        for (std::size_t k = 0; k < cache.samples; ++k) {
            read_sample(cache, k);
        }
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(PointCache, ReadsPc2AndMdd) {
    const test::TempFolder folder;
    test::write_file(folder / "a.pc2", pc2());
    test::write_file(folder / "a.mdd", mdd());

    const PointCache a = open_point_cache(folder / "a.pc2", "a.pc2", 10.0);
    const PointCache b = open_point_cache(folder / "a.mdd", "a.mdd", 0.0);

    EXPECT_EQ(a.times, (std::vector<double>{0.0, 0.2, 0.4}));  // two frames a sample
    EXPECT_EQ(b.times, (std::vector<double>{0.0, 0.25, 1.0})); // its own
    EXPECT_EQ(open_point_cache(folder / "a.mdd", "a.mdd", 4.0).times,
              (std::vector<double>{0.0, 0.25, 0.5}));
    for (const PointCache& cache : {a, b}) {
        EXPECT_EQ(read_sample(cache, 2),
                  (std::vector<Vec3f>{{2.0F, 0.0F, 0.5F}, {2.0F, 1.0F, 0.5F}}));
    }
}

TEST(PointCache, RefusesEveryTruncation) {
    const test::TempFolder folder;
    for (const auto& [name, bytes] :
         std::vector<std::pair<std::string, std::string>>{{"a.pc2", pc2()}, {"a.mdd", mdd()}}) {
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            test::write_file(folder / name, bytes.substr(0, size));
            EXPECT_NE(refusal(folder / name), "") << name << " " << size;
        }
    }
}

TEST(PointCache, RefusesHostileHeadersInOneLine) {
    const test::TempFolder folder;
    const auto of = [&](const char* name, const std::string& bytes) {
        test::write_file(folder / name, bytes);
        return refusal(folder / name);
    };
    constexpr std::int32_t k_most = std::numeric_limits<std::int32_t>::max();

    EXPECT_EQ(of("a.pc2", pc2(k_most, k_most)).substr(0, 60),
              "cache: truncated: 2147483647 samples of 2147483647 points ne");
    EXPECT_EQ(of("b.mdd", mdd(k_most, k_most)).substr(0, 17), "cache: truncated:");
    EXPECT_EQ(of("c.pc2", pc2(-2)), "cache: says it has 3 samples of -2 points: must be 1 or more");
    EXPECT_EQ(of("d.pc2", pc2(2, 3, 0.0F)), "cache: says that a sample is 0 frames: must be > 0");
    EXPECT_EQ(of("e.pc2", "POINTCACHE3" + std::string(40, '\0')),
              "cache: does not begin as a PC2 point cache of version 1");
    EXPECT_EQ(of("f.abc", pc2()), "cache: a point cache must end in .pc2 or .mdd");
    EXPECT_EQ(refusal(folder / "none.pc2"), "cache: No such file or directory");
}

TEST(PointCache, RefusesNumbersThatAreNotFinite) {
    const test::TempFolder folder;
    Words words(false);
    words.bytes = std::string("POINTCACHE2\0", 12);
    words.add(1).add(1).add(0.0F).add(1.0F).add(1);
    words.add(0.0F).add(std::numeric_limits<float>::quiet_NaN()).add(0.0F);
    test::write_file(folder / "a.pc2", words.bytes);

    EXPECT_EQ(refusal(folder / "a.pc2"),
              "cache: sample 0: point 0 has a coordinate that is not a finite number");
}

TEST(CacheOrder, IsThatOfTheLinesOfAnObjFile) {
    // Faces name the vertices in another order than they stand, one stands in no face, and two
    // stand in one place.
    const test::TempFolder folder;
    test::write_file(folder / "a.obj", "v 0 0 0\nv 9 9 9\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 1 0 0\n"
                                       "f 5 4 3\nf 1 6 4\n");
    const MeshSource source{.file = "a.obj"};
    const ImportedMesh mesh = import_mesh(folder / "a.obj", source, false);

    const std::vector<Index> order = cache_order(folder / "a.obj", source, mesh, 6, "a.pc2");

    const std::vector<Vec3> lines{{0, 0, 0}, {9, 9, 9}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}};
    ASSERT_EQ(order.size(), 4u);
    for (std::size_t v = 0; v < order.size(); ++v) {
        EXPECT_EQ(lines[static_cast<std::size_t>(order[v])], mesh.mesh.positions[v]);
        EXPECT_NE(order[v], 5); // the first of two
    }
    try {
        cache_order(folder / "a.obj", source, mesh, 4, "a.pc2");
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "a.pc2: has 4 points, a.obj has 6 vertices: must be as many, in "
                                   "the file's order");
    }
}

} // namespace weft

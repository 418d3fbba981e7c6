#include "render/surface.h"

#include <cassert>
#include <cmath>

namespace weft {

namespace {

Vec3f area_normal(const FrameObject& object, const Triangle& t) {
    const auto at = [&](std::size_t corner) {
        return object.positions[static_cast<std::size_t>(t[corner])];
    };
    return (at(1) - at(0)).cross(at(2) - at(0));
}

Vec3f unit_or_up(const Vec3f& v) {
    const float length = v.norm();
    return length > 0.0F && std::isfinite(length) ? Vec3f(v / length) : Vec3f::UnitY();
}

void check(const FrameObject& object) {
    for ([[maybe_unused]] const Triangle& t : object.triangles) {
        for ([[maybe_unused]] const Index v : t) {
            assert(v >= 0 && static_cast<std::size_t>(v) < object.positions.size());
        }
    }
}

/// For each vertex the corners (3 * triangle + corner) that use it, ascending.
struct Corners {
    std::vector<std::size_t> first; ///< #V + 1, into list
    std::vector<std::size_t> list;

    explicit Corners(const FrameObject& object)
        : first(object.positions.size() + 1), list(3 * object.triangles.size()) {
        for (const Triangle& t : object.triangles) {
            for (const Index v : t) {
                ++first[static_cast<std::size_t>(v) + 1];
            }
        }
        for (std::size_t v = 1; v < first.size(); ++v) {
            first[v] += first[v - 1];
        }
        std::vector<std::size_t> next(first.begin(), first.end() - 1);
        for (std::size_t t = 0; t < object.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                list[next[static_cast<std::size_t>(object.triangles[t][k])]++] = 3 * t + k;
            }
        }
    }
};

void push_vertex(Surface& surface, const Vec3f& position, const Vec3f& normal, float value) {
    surface.positions.push_back(position.allFinite() ? position : Vec3f::Zero().eval());
    surface.normals.push_back(normal);
    surface.values.push_back(value);
    surface.ambient.emplace_back();
}

} // namespace

void append_smooth(Surface& surface, const FrameObject& object, std::span<const float> values) {
    check(object);
    assert(values.empty() || values.size() == object.positions.size());
    std::vector<Vec3f> normals(object.positions.size(), Vec3f::Zero());
    for (const Triangle& t : object.triangles) {
        const Vec3f normal = area_normal(object, t);
        for (const Index v : t) {
            normals[static_cast<std::size_t>(v)] += normal;
        }
    }
    const auto base = static_cast<Index>(surface.positions.size());
    for (std::size_t v = 0; v < normals.size(); ++v) {
        push_vertex(surface, object.positions[v], unit_or_up(normals[v]),
                    values.empty() ? 0.0F : values[v]);
    }
    for (const Triangle& t : object.triangles) {
        surface.triangles.push_back({base + t[0], base + t[1], base + t[2]});
    }
}

void append_creased(Surface& surface,
                    const FrameObject& object,
                    std::span<const float> values,
                    float crease_cosine) {
    check(object);
    assert(values.empty() || values.size() == object.positions.size());
    const Corners corners(object);
    std::vector<Vec3f> area_normals(object.triangles.size());
    std::vector<Vec3f> unit_normals(object.triangles.size());
    for (std::size_t t = 0; t < object.triangles.size(); ++t) {
        area_normals[t] = area_normal(object, object.triangles[t]);
        unit_normals[t] = unit_or_up(area_normals[t]);
    }
    const std::size_t base = surface.triangles.size();
    surface.triangles.resize(base + object.triangles.size());

    std::vector<Vec3f> group_seed;   // unit normal of the triangle that opened the group
    std::vector<Vec3f> group_normal; // sum over its triangles
    std::vector<std::size_t> group_of;
    for (std::size_t v = 0; v < object.positions.size(); ++v) {
        group_seed.clear();
        group_normal.clear();
        group_of.clear();
        const std::size_t begin = corners.first[v];
        const std::size_t end = corners.first[v + 1];
        for (std::size_t c = begin; c < end; ++c) {
            const std::size_t t = corners.list[c] / 3;
            std::size_t group = 0;
            while (group < group_seed.size() &&
                   group_seed[group].dot(unit_normals[t]) < crease_cosine) {
                ++group;
            }
            if (group == group_seed.size()) {
                group_seed.push_back(unit_normals[t]);
                group_normal.push_back(Vec3f::Zero());
            }
            group_normal[group] += area_normals[t];
            group_of.push_back(group);
        }
        const auto first_copy = static_cast<Index>(surface.positions.size());
        for (const Vec3f& normal : group_normal) {
            push_vertex(surface, object.positions[v], unit_or_up(normal),
                        values.empty() ? 0.0F : values[v]);
        }
        for (std::size_t c = begin; c < end; ++c) {
            surface.triangles[base + corners.list[c] / 3][corners.list[c] % 3] =
                first_copy + static_cast<Index>(group_of[c - begin]);
        }
    }
}

} // namespace weft

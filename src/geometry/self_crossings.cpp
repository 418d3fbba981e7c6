#include "geometry/self_crossings.h"

#include "geometry/box_tree.h"
#include "geometry/crossing.h"

#include <algorithm>

namespace weft {

std::vector<std::array<Index, 2>> find_self_crossings(const TriangleMesh& mesh) {
    const auto x = [&](Index v) -> const Vec3& {
        return mesh.positions[static_cast<std::size_t>(v)];
    };
    std::vector<Box> boxes;
    boxes.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        boxes.push_back(
            unite(segment_box(x(t[0]), x(t[1]), 0.0), segment_box(x(t[2]), x(t[2]), 0.0)));
    }
    std::vector<std::array<Index, 2>> crossings;
    if (boxes.empty()) {
        return crossings;
    }
    const BoxTree tree{std::span<const Box>(boxes)};
    std::vector<BoxTree::Task> tasks;
    BoxTree::split(tree, tree, 1, tasks);
    for (const BoxTree::Task& task : tasks) {
        BoxTree::overlaps(tree, tree, task, [&](Index s, Index t) {
            if (triangles_cross(mesh.triangles[static_cast<std::size_t>(s)],
                                mesh.triangles[static_cast<std::size_t>(t)], mesh.positions)) {
                crossings.push_back({std::min(s, t), std::max(s, t)});
            }
        });
    }
    std::sort(crossings.begin(), crossings.end());
    return crossings;
}

} // namespace weft

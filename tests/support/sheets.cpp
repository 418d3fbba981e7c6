#include "support/sheets.h"

namespace weft::test {

Cloth cloth_of(const Sheet& sheet, const FabricParams& fabric, BendModel bend_model) {
    Cloth cloth;
    cloth.name = "sheet";
    cloth.params.fabric = fabric;
    cloth.params.bend_model = bend_model;
    cloth.vertex_count = static_cast<Index>(sheet.points.size());
    cloth.triangles = sheet.triangles;
    cloth.topology = build_edges(sheet.triangles);
    cloth.material_positions = sheet.points;
    for (const Triangle& t : sheet.triangles) {
        const Vec2& m0 = sheet.points[static_cast<std::size_t>(t[0])];
        Mat2 edges;
        edges.col(0) = sheet.points[static_cast<std::size_t>(t[1])] - m0;
        edges.col(1) = sheet.points[static_cast<std::size_t>(t[2])] - m0;
        const double det = edges(0, 0) * edges(1, 1) - edges(1, 0) * edges(0, 1);
        Mat2 inverse;
        inverse << edges(1, 1), -edges(0, 1), -edges(1, 0), edges(0, 0);
        cloth.rest.push_back({Mat2(inverse / det), 0.5 * det});
    }
    return cloth;
}

std::vector<Vec3> placed(const Sheet& sheet, const std::function<Vec3(const Vec2&)>& map) {
    std::vector<Vec3> positions;
    for (const Vec2& p : sheet.points) {
        positions.push_back(map(p));
    }
    return positions;
}

} // namespace weft::test

#include "support/sheets.h"

#include "state/build_world.h"

namespace weft::test {

Cloth cloth_of(const Sheet& sheet, const FabricParams& fabric, BendModel bend_model) {
    ClothParams params{.name = "sheet"};
    params.fabric = fabric;
    params.bend_model = bend_model;
    World world;
    return std::move(add_cloth(world, params, imported(sheet)));
}

std::vector<Vec3> placed(const Sheet& sheet, const std::function<Vec3(const Vec2&)>& map) {
    std::vector<Vec3> positions;
    for (const Vec2& p : sheet.points) {
        positions.push_back(map(p));
    }
    return positions;
}

} // namespace weft::test

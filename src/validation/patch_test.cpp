#include <cmath>

#include "validation/experiments.h"
#include "validation/sheet_world.h"
#include "validation/statics.h"

namespace weft {

namespace {

/// The orthotropic fabric of the off-axis table.
FabricParams woven() {
    FabricParams fabric;
    fabric.stretch_stiffness = Vec2(1500.0, 600.0);
    fabric.shear_stiffness = 90.0;
    fabric.poisson = 0.25 * std::sqrt(600.0 / 1500.0); // sqrt(nu12 nu21) of nu12 = 0.25
    fabric.bend_stiffness = 0.0;
    return fabric;
}

bool on_rim(const Vec2& p) {
    return p.x() <= 0.0 || p.x() >= 1.0 || p.y() <= 0.0 || p.y() >= 1.0;
}

/// 20 % along the weft, 10 % across, 15 % shear, in a plane that is turned in space.
Vec3 stretched(const Vec2& p) {
    const Vec3 in_plane(1.2 * p.x() + 0.1 * p.y(), 0.05 * p.x() + 1.1 * p.y(), 0.0);
    return Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized()) * in_plane;
}

} // namespace

ValidationRows validate_patch_test() {
    const Sheet sheet = irregular_sheet(8, 8, 1.0, 1.0, 0.3, 5);
    ClothParams cloth;
    cloth.fabric = woven();
    World world = sheet_world(sheet, cloth, stretched);
    const std::vector<Vec3> affine = world.positions;
    const Eigen::VectorXd force = element_forces(world, empty_space());

    StaticLoad load(world.vertex_count());
    double on_inner = 0.0;
    double greatest = 0.0;
    for (std::size_t i = 0; i < sheet.points.size(); ++i) {
        const double size = force.segment<3>(static_cast<Eigen::Index>(3 * i)).norm();
        greatest = std::max(greatest, size);
        if (on_rim(sheet.points[i])) {
            load.hold(static_cast<Index>(i));
        } else {
            on_inner = std::max(on_inner, size);
            world.positions[i] += Vec3(0.02, -0.01, 0.015); // to be taken back by settling
        }
    }
    settle(world, empty_space(), load, {.tolerance = 1e-13});
    double off = 0.0;
    for (std::size_t i = 0; i < affine.size(); ++i) {
        off = std::max(off, (world.positions[i] - affine[i]).norm());
    }
    return {{.what = "force on inner vertices / on the rim",
             .theory = 0.0,
             .measured = on_inner / greatest,
             .tolerance = 1e-12,
             .relative = false,
             .note = "irregular mesh; orthotropic; 20 % strain"},
            {.what = "inner vertices after settling",
             .unit = "m",
             .theory = 0.0,
             .measured = off,
             .tolerance = 1e-12,
             .relative = false,
             .note = "from a start 2.7 cm away; distance to the affine field"}};
}

} // namespace weft

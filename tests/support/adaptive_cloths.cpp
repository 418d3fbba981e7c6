#include "support/adaptive_cloths.h"

#include "adapt/adaptive_cloth.h"
#include "state/build_world.h"
#include "state/rest_shape.h"
#include "support/sheets.h"

#include <functional>
#include <numbers>
#include <random>

namespace weft::test {

namespace {

void complete(Cloth& cloth) {
    cloth.rest_areas = mixed_rest_areas(cloth);
    make_refinement(cloth);
}

/// Triangles whose centre is chosen get another rest size and grain than the others.
Cloth pieced_sheet(int cells, const std::function<bool(const Vec2&)>& is_larger) {
    const Sheet sheet = union_jack_sheet(cells, cells, 1.0, 1.0);
    Cloth cloth = cloth_of(sheet);
    const double turn = std::numbers::pi / 6.0;
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        const Triangle& v = cloth.triangles[t];
        const Vec2 centre =
            (sheet.points[at(v[0])] + sheet.points[at(v[1])] + sheet.points[at(v[2])]) / 3.0;
        if (is_larger(centre)) {
            cloth.rest[t].inverse_edges *= Eigen::Rotation2Dd(turn).toRotationMatrix() / 1.1;
            cloth.rest[t].area *= 1.21;
        }
    }
    complete(cloth);
    return cloth;
}

} // namespace

Cloth adaptive_sheet(const Sheet& sheet) {
    Cloth cloth = cloth_of(sheet);
    complete(cloth);
    return cloth;
}

Sheet rough_sheet(int cells, double jitter, unsigned seed) {
    Sheet sheet = one_diagonal_sheet(cells, cells, 1.0, 1.0);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-jitter / cells, jitter / cells);
    for (Vec2& point : sheet.points) {
        point += Vec2(shift(random), shift(random));
    }
    for (std::size_t t = 0; t + 1 < sheet.triangles.size(); t += 2) { // the two of a cell
        Triangle& first = sheet.triangles[t];
        Triangle& second = sheet.triangles[t + 1];
        if (random() % 2 == 0) {
            continue;
        }
        for (std::size_t k = 0; k < 3; ++k) { // turn the diagonal where both have it
            for (std::size_t l = 0; l < 3; ++l) {
                if (first[k] == second[(l + 1) % 3] && first[(k + 1) % 3] == second[l]) {
                    const Index a = first[k], b = first[(k + 1) % 3];
                    const Index P = first[(k + 2) % 3], Q = second[(l + 2) % 3];
                    first = {P, a, Q};
                    second = {Q, b, P};
                    k = l = 3;
                }
            }
        }
    }
    return sheet;
}

Cloth adaptive_cylinder(int around, int up, bool is_lying) {
    ImportedMesh mesh;
    for (int j = 0; j <= up; ++j) {
        for (int i = 0; i < around; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / around;
            const double height = static_cast<double>(j) / up;
            const Vec3 x(std::cos(angle), height, std::sin(angle));
            mesh.mesh.positions.push_back(is_lying ? Vec3(x.y(), x.z(), x.x()) : x);
        }
    }
    for (int j = 0; j < up; ++j) {
        for (int i = 0; i < around; ++i) {
            const Index a = j * around + i, b = j * around + (i + 1) % around;
            mesh.mesh.triangles.push_back({a, a + around, b});
            mesh.mesh.triangles.push_back({b, a + around, b + around});
        }
    }
    World world;
    Cloth& cloth = add_cloth(world, {}, mesh);
    make_refinement(cloth);
    return std::move(cloth);
}

Cloth flat_torus(int cells) {
    const Sheet open = one_diagonal_sheet(cells, cells, 1.0, 1.0);
    Cloth cloth = cloth_of(open);
    const auto wrapped = [&](Index v) {
        const Index row = v / (cells + 1) % cells;
        const Index column = v % (cells + 1) % cells;
        return row * cells + column;
    };
    for (Triangle& t : cloth.triangles) {
        t = {wrapped(t[0]), wrapped(t[1]), wrapped(t[2])};
    }
    cloth.vertex_count = cells * cells;
    cloth.material_positions.resize(at(cloth.vertex_count));
    cloth.topology = build_edges(cloth.triangles);
    complete(cloth);
    return cloth;
}

Sheet pinched_sheet() {
    return {
        {Vec2(0, 0), Vec2(1, 0), Vec2(-0.5, 0.9), Vec2(-0.5, -0.9), Vec2(2, -0.5), Vec2(2, 0.5)},
        {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 4, 5}}};
}

Cloth seamed_sheet(int cells) {
    return pieced_sheet(cells, [](const Vec2& centre) { return centre.x() > 0.5; });
}

Cloth patched_sheet(int cells) {
    const double half = 1.0 / cells;
    return pieced_sheet(cells, [=](const Vec2& centre) {
        return (centre - Vec2(0.5, 0.5)).lpNorm<Eigen::Infinity>() < half;
    });
}

Cloth some_cloth(unsigned seed) {
    switch (seed % 9) {
    case 0:
        return adaptive_sheet(equilateral_sheet(2, 2, 0.1));
    case 1:
        return adaptive_sheet(one_diagonal_sheet(2, 2, 1.0, 1.0));
    case 2:
        return adaptive_sheet(union_jack_sheet(2, 3, 1.0, 1.0));
    case 3:
        return adaptive_sheet(rough_sheet(3, 0.25, seed));
    case 4:
        return adaptive_cylinder(16, 1, seed % 2 == 0);
    case 5:
        return seamed_sheet(2);
    case 6:
        return flat_torus(3);
    case 7:
        return adaptive_sheet(pinched_sheet());
    default:
        return patched_sheet(4);
    }
}

} // namespace weft::test

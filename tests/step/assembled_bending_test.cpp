#include "forces/constant_bending.h"
#include "support/changing_sheet.h"

#include <gtest/gtest.h>

#include "solver/assembler.h"

namespace weft {

TEST(Assembler, VertexAtTwoNodesOfAnElementGetsBothBlocks) {
    // All three neighbours of a triangle that was split in three have the same apex in pairs.
    test::ChangingSheet sheet({.points = {{0.0, 0.0}, {1.0, 0.0}, {0.3, 0.9}, {0.4, 0.3}},
                               .triangles = {{3, 0, 1}, {3, 1, 2}, {3, 2, 0}}},
                              {.bend_stiffness = 1.0}, BendModel::MidEdge, 1);
    const ConstantBending bending(sheet.cloth());
    const std::vector<VertexRange> objects{{0, 4}};
    const std::vector<ElementSet> sets{{6, bending.nodes(), 0, true, bending.stiffness()}};
    const Assembler assembler(objects, sets);
    const std::vector<Vec3> x{{0.0, 0.1, 0.0}, {1.0, 0.2, 0.1}, {0.4, -0.2, 0.9}, {0.4, 0.3, 0.3}};
    std::vector<Vec3> element_forces(assembler.force_count()), forces(4), product(4), by_row(4);
    bending.forces(x, element_forces);
    assembler.gather_forces(element_forces, forces);
    BlockMatrix matrix = assembler.pattern();
    const std::vector<double> nothing(4, 0.0);

    assembler.assemble({}, 1.0, nothing, matrix);

    for (std::size_t v = 0; v < 4; ++v) {
        by_row[static_cast<std::size_t>(assembler.row_of_vertex()[v])] = x[v];
    }
    multiply(matrix, by_row, product);
    for (std::size_t v = 0; v < 4; ++v) { // f = -Q x
        const Vec3& row = product[static_cast<std::size_t>(assembler.row_of_vertex()[v])];
        EXPECT_LT((row + forces[v]).norm(), 1e-12 * forces[v].norm());
    }
}

} // namespace weft

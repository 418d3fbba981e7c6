#pragma once

#include "adapt/sqrt3_mesh.h"

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <tuple>

namespace weft::test {

/// A cloth that is refined and coarsened, and what its vertices are: a name for each that says
/// which point of the imported mesh it is, whenever it came.
class MeshHistory {
public:
    using Name = std::uint64_t;

    MeshHistory(const Cloth& cloth, unsigned seed, Index max_level = 4);

    /// Adaptations of a few random edits each; after each the cloth is looked through (failures are
    /// GoogleTest's). `share` of the edits refine, the others remove.
    void run(int adaptations, int edits, double share);

    /// Refines every triangle that there is once, in one adaptation.
    void refine_all();

    /// Refines, in one adaptation, the triangles whose corners are nearest to a place, in material
    /// positions.
    void refine_around(const Vec2& place);

    /// Level of the finest triangle.
    int finest_level() const;

    /// Removes all that was put in, at random, with as few adaptations as it takes.
    void coarsen_all();

    /// Tries all flips that wait.
    void retry_flips();

    /// Puts in the vertices of that set, in random order, and nothing else.
    void insert(const std::map<Name, int>& names);

    /// The vertices put in.
    std::map<Name, int> inserted() const;

    /// Mesh, levels and rest shapes by the vertices' names: equal for equal meshes in other slots.
    using Part = std::tuple<std::array<Name, 3>, int, std::array<double, 5>>;
    std::map<Part, int> content() const;

    /// From now on this share of flips and of removals is refused, at random.
    void refuse(double share) { refused_ = share; }

    Cloth cloth;
    Sqrt3Mesh mesh;
    std::mt19937 random;

private:
    void begin();
    void finish();
    AdaptationHooks hooks();
    bool chance(double share);
    Name name_of(const VertexParents& place) const;
    void expect_true_changes(const ClothChanges& changes) const;

    Index max_level_, adaptation_ = 0;
    double refused_ = 0.0;
    std::vector<Name> names_; ///< by vertex
    Cloth before_;            ///< at begin
    std::vector<Name> names_before_;
};

} // namespace weft::test

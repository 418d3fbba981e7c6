#pragma once

#include "geometry/shapes.h"
#include "state/cloth.h"
#include "state/refinement.h"

#include <random>

namespace weft::test {

/// What differs between two states of a cloth, found slot by slot.
/// @param old_ids, new_ids  of the vertices of each, by which they are told apart
ClothChanges diff_cloths(const Cloth& old_cloth,
                         std::span<const Index> old_ids,
                         const Cloth& new_cloth,
                         std::span<const Index> new_ids);

/// A flat sheet at rest whose mesh changes at random: triangles are split in three, inner edges
/// flipped, inner vertices of three triangles taken out. What stays keeps its slots, as far as no
/// gap is left among them.
class ChangingSheet {
public:
    ChangingSheet(Sheet sheet, const FabricParams& fabric, BendModel bend_model, unsigned seed);

    const Cloth& cloth() const { return cloth_; }
    Cloth& cloth() { return cloth_; }
    std::span<const Vec2> points() const { return sheet_.points; } ///< #V, m

    /// Tries `edits` edits, no two at the same triangle.
    /// @param growth  fraction of splits among the edits that change the number of triangles
    /// @param window  fraction of the triangles, the first ones, that are edited
    ClothChanges change(int edits, double growth = 0.5, double window = 1.0);

    /// What would change if this sheet became that earlier or later state of it.
    ClothChanges changes_to(const ChangingSheet& other) const {
        return diff_cloths(cloth_, ids_, other.cloth_, other.ids_);
    }

private:
    void split(std::size_t t);
    void flip(std::size_t t);
    void take_out(std::size_t t);
    Index new_vertex(const Vec2& point);
    std::size_t new_triangle(const Triangle& corners);
    void close_gaps();
    void rebuild_cloth();

    std::mt19937 random_;
    Sheet sheet_;
    std::vector<Index> ids_; ///< #V, never used again
    Index next_id_;
    Cloth cloth_;
    // during a change
    std::vector<char> is_used_;  ///< #T, touched by an edit
    std::vector<int> valence_;   ///< #V; 0 on the boundary
    std::vector<Index> removed_; ///< vertices
    std::vector<std::size_t> free_triangles_;
};

} // namespace weft::test

#pragma once

#include "solver/block_matrix.h"
#include "solver/source_lists.h"

namespace weft {

/// Sums what elements wrote into vertices and matrix blocks, always in the order of the elements,
/// so that the result is the same bits for any thread count. Blocks of an element are its upper
/// triangle row by row; forces one a node. In the arrays of all elements each set has its room.
///
/// When elements change, what they have to do with is changed and nothing else, but for the order
/// of the rows and their columns, which are streamed anew. An assembler that has gone through any
/// changes gives the same bits as one made of what the sets are now.
class Assembler {
public:
    /// @param objects all vertices, one object after the other
    /// @param sets    in the order in which they are summed; constant blocks come before others
    Assembler(std::span<const VertexRange> objects, std::span<const ElementSet> sets);

    /// Takes up what the same objects and sets have become.
    /// @param changed for each set the slots whose nodes or constants are others, new ones included
    void update(std::span<const VertexRange> objects,
                std::span<const ElementSet> sets,
                std::span<const std::vector<Index>> changed);

    /// Lengths of the arrays of all elements' blocks, those of constant sets left out, and forces.
    std::size_t block_count() const { return rooms_.block_count(); }
    std::size_t force_count() const { return rooms_.force_count(); }

    /// The elements of a set in those arrays; a constant set has no blocks there.
    std::span<Mat3> blocks_of(std::size_t set, std::span<Mat3> element_blocks) const;
    std::span<Vec3> forces_of(std::size_t set, std::span<Vec3> element_forces) const;

    /// The pattern without blocks, rows ordered for locality; row_of_vertex maps to it, and is
    /// k_no_index for vertices of no object.
    const BlockMatrix& pattern() const { return pattern_; }
    std::span<const Index> row_of_vertex() const { return row_of_vertex_; }

    /// matrix.blocks = sum of element blocks + constant_scale * sum of constant blocks
    ///                 + diagonal[v] * I for vertex v.
    void assemble(std::span<const Mat3> element_blocks,
                  double constant_scale,
                  std::span<const double> diagonal,
                  BlockMatrix& matrix) const;

    /// forces[v] = sum of the element forces at vertex v; 0 where it is of no object.
    void gather_forces(std::span<const Vec3> element_forces, std::span<Vec3> forces) const;

private:
    /// Of a pair in matrix.blocks; equal on the diagonal.
    struct Place {
        Index place, mirror; ///< of the block whose row is the lower site, and of its transpose
    };

    void build(std::span<const ElementSet> sets);
    void list_vertices();
    void order_rows();
    void find_places();

    ElementRooms rooms_;
    SourceLists sources_;
    BlockMatrix pattern_;
    std::vector<Index> row_of_vertex_, vertex_of_row_, site_of_vertex_, site_of_row_;
    std::vector<Index> vertex_of_site_, row_of_site_;  ///< k_no_index: no vertex there
    std::vector<Index> vertex_of_dof_, dof_of_vertex_; ///< vertices of objects, in their order
    std::vector<Place> places_;                        ///< by pair; k_no_index: not used
    std::vector<Index> graph_begin_, graph_column_;    ///< neighbours, by vertex of objects
    std::vector<Index> next_;                          ///< free place of each row
};

} // namespace weft

#pragma once

#include "solver/block_matrix.h"
#include "solver/scatter_map.h"

namespace weft {

/// Sums element forces into vertices and element blocks into matrix blocks, always in the order of
/// the elements, so that the result is the same bits for any thread count. An element stores its
/// blocks as an upper triangle row by row, and its forces one a node. In the arrays of all elements
/// each set has its range.
///
/// Four numberings meet here:
///
///     vertex   as in World; vertices that no object has are not solved for
///     slot     vertices with spare capacity behind each object (AssemblyLayout): an object that
///              grows moves no other, so that the scatter map, which counts by slots, lasts
///     row      of the matrix: all slots that hold a vertex, reordered for locality
///     block    in BlockMatrix::blocks: rows one after the other
///
/// When elements change, only what depends on them is rebuilt, and the order of rows and columns,
/// which is streamed. An assembler that has gone through any changes gives the same bits as one
/// made of the sets as they are now.
class Assembler {
public:
    /// @param objects  all vertices, one object after the other
    /// @param sets     in the order in which they are summed; constant blocks come before others
    Assembler(std::span<const VertexRange> objects, std::span<const ElementSet> sets);

    /// Follows the same objects and sets through a change of the mesh.
    /// @param changed  by set: elements whose nodes or constants changed, new ones included
    void remesh(std::span<const VertexRange> objects,
                std::span<const ElementSet> sets,
                std::span<const std::vector<Index>> changed);

    /// Lengths of the arrays of all elements' blocks, those of constant sets left out, and forces.
    std::size_t block_count() const { return layout_.block_count(); }
    std::size_t force_count() const { return layout_.force_count(); }

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

    /// forces[v] = sum of the element forces at vertex v; 0 where no object has it.
    void gather_forces(std::span<const Vec3> element_forces, std::span<Vec3> forces) const;

private:
    /// The blocks of a pair in matrix.blocks; equal on the diagonal.
    struct PairBlocks {
        Index block, transpose; ///< block: its row is the lower slot
    };

    void build(std::span<const ElementSet> sets);
    void list_vertices();
    void order_rows();
    void number_blocks();

    AssemblyLayout layout_;
    ScatterMap scatter_;
    BlockMatrix pattern_;
    std::vector<Index> row_of_vertex_, vertex_of_row_, slot_of_vertex_, slot_of_row_;
    std::vector<Index> vertex_of_slot_, row_of_slot_;  ///< k_no_index: no vertex there
    std::vector<Index> vertex_of_dof_, dof_of_vertex_; ///< vertices of objects, without gaps
    std::vector<PairBlocks> pairs_;                    ///< by pair; k_no_index: not used
    std::vector<Index> graph_begin_, graph_column_;    ///< neighbours, by dof
    std::vector<Index> next_;                          ///< next free block of each row
};

} // namespace weft

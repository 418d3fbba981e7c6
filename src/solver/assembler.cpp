#include "solver/assembler.h"

#include "base/parallel.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace weft {

namespace {

/// Rows rebuilt since the map was built, as a multiple of all rows, after which the whole map is
/// built again: lists that are read in sequence have scattered in memory by then. Smaller: building
/// costs more than it saves; larger: assembly takes a third longer in the end.
constexpr double k_most_fragmentation = 2.0;

} // namespace

Assembler::Assembler(std::span<const VertexRange> objects, std::span<const ElementSet> sets) {
    layout_.fit(objects, sets);
    build(sets);
}

void Assembler::build(std::span<const ElementSet> sets) {
    assert(std::max(layout_.block_count(), layout_.constant_count()) <
           std::numeric_limits<std::uint32_t>::max() / k_placements);
    scatter_.build(layout_, sets);
    order_rows();
    scatter_.build_pairs(layout_, sets, slot_of_row_);
    number_blocks();
}

void Assembler::remesh(std::span<const VertexRange> objects,
                       std::span<const ElementSet> sets,
                       std::span<const std::vector<Index>> changed) {
    assert(changed.size() == sets.size());
    const double fragmentation =
        static_cast<double>(scatter_.changed_rows()) / static_cast<double>(slot_of_row_.size() + 1);
    if (!layout_.fit(objects, sets) || fragmentation > k_most_fragmentation) {
        build(sets);
        return;
    }
    scatter_.remesh(layout_, sets, changed);
    order_rows();
    number_blocks();
}

void Assembler::list_vertices() {
    slot_of_vertex_.assign(layout_.vertex_count(), k_no_index);
    dof_of_vertex_.assign(layout_.vertex_count(), k_no_index);
    vertex_of_slot_.assign(layout_.slot_count(), k_no_index);
    vertex_of_dof_.clear();
    for (const AssemblyLayout::Object& object : layout_.objects()) {
        for (std::size_t i = 0; i < object.count; ++i) {
            slot_of_vertex_[object.first + i] = static_cast<Index>(object.begin + i);
            vertex_of_slot_[object.begin + i] = static_cast<Index>(object.first + i);
            dof_of_vertex_[object.first + i] = static_cast<Index>(vertex_of_dof_.size());
            vertex_of_dof_.push_back(static_cast<Index>(object.first + i));
        }
    }
}

/// Orders rows by the graph of the vertices alone, so that the order depends on the elements as
/// they are and not on their history. The graph numbers vertices without gaps ("dof").
void Assembler::order_rows() {
    list_vertices();
    const std::size_t n = vertex_of_dof_.size();
    const auto slot_of_dof = [&](std::size_t i) {
        return at(slot_of_vertex_[at(vertex_of_dof_[i])]);
    };
    graph_begin_.assign(1, 0);
    for (std::size_t i = 0; i < n; ++i) {
        graph_begin_.push_back(graph_begin_.back() +
                               static_cast<Index>(scatter_.neighbours(slot_of_dof(i)).size()));
    }
    graph_column_.resize(at(graph_begin_.back()));
    parallel_for(n, [&](std::size_t i) {
        std::size_t k = at(graph_begin_[i]);
        for (const auto& neighbour : scatter_.neighbours(slot_of_dof(i))) {
            graph_column_[k++] = dof_of_vertex_[at(vertex_of_slot_[at(neighbour.slot)])];
        }
    });
    const std::vector<Index> row_of_dof = locality_order(graph_begin_, graph_column_);
    row_of_vertex_.assign(slot_of_vertex_.size(), k_no_index);
    vertex_of_row_.resize(n);
    slot_of_row_.resize(n);
    row_of_slot_.assign(layout_.slot_count(), k_no_index);
    for (std::size_t i = 0; i < n; ++i) {
        const Index vertex = vertex_of_dof_[i];
        const Index row = row_of_dof[i];
        row_of_vertex_[at(vertex)] = row;
        vertex_of_row_[at(row)] = vertex;
        slot_of_row_[at(row)] = static_cast<Index>(slot_of_dof(i));
        row_of_slot_[slot_of_dof(i)] = row;
    }
}

/// Writes the rows of the pattern, and which blocks each pair has in them. Columns are written in
/// ascending order, each into all rows, so that every row comes out sorted.
void Assembler::number_blocks() {
    const std::size_t n = slot_of_row_.size();
    pattern_.row_begin.assign(1, 0);
    for (const Index slot : slot_of_row_) {
        pattern_.row_begin.push_back(pattern_.row_begin.back() +
                                     static_cast<Index>(scatter_.neighbours(at(slot)).size()));
    }
    pattern_.column.resize(at(pattern_.row_begin.back()));
    pattern_.diagonal.resize(n);
    pairs_.assign(scatter_.pair_count(), {k_no_index, k_no_index});
    next_.assign(pattern_.row_begin.begin(), pattern_.row_begin.end() - 1);
    for (std::size_t column = 0; column < n; ++column) {
        const Index slot = slot_of_row_[column];
        for (const auto& [other, pair] : scatter_.neighbours(at(slot))) {
            const Index block = next_[at(row_of_slot_[at(other)])]++;
            pattern_.column[at(block)] = static_cast<Index>(column);
            (other <= slot ? pairs_[at(pair)].block : pairs_[at(pair)].transpose) = block;
            if (other == slot) {
                pairs_[at(pair)].transpose = block;
                pattern_.diagonal[column] = block;
            }
        }
    }
}

std::span<Mat3> Assembler::blocks_of(std::size_t set, std::span<Mat3> element_blocks) const {
    const AssemblyLayout::Set& range = layout_.sets()[set];
    return range.is_constant
               ? std::span<Mat3>()
               : element_blocks.subspan(range.block_begin, range.count * range.blocks_per_element);
}

std::span<Vec3> Assembler::forces_of(std::size_t set, std::span<Vec3> element_forces) const {
    const AssemblyLayout::Set& range = layout_.sets()[set];
    return element_forces.subspan(range.force_begin, range.count * range.nodes_per_element);
}

void Assembler::assemble(std::span<const Mat3> element_blocks,
                         double constant_scale,
                         std::span<const double> diagonal,
                         BlockMatrix& matrix) const {
    assert(element_blocks.size() == block_count());
    matrix.blocks.resize(pattern_.column.size());
    parallel_for(pairs_.size(), [&](std::size_t pair) {
        const auto [target, transpose] = pairs_[pair];
        if (target == k_no_index) {
            return;
        }
        Mat3 sum = (constant_scale * scatter_.constant(pair)) * Mat3::Identity();
        for (const std::uint32_t source : scatter_.blocks(pair)) {
            const Mat3& block = element_blocks[source / k_placements];
            switch (source % k_placements) {
            case k_transposed:
                sum += block.transpose();
                break;
            case k_negative:
                sum -= block;
                break;
            default:
                sum += block;
            }
        }
        matrix.blocks[at(target)] = sum;
        if (transpose != target) {
            matrix.blocks[at(transpose)] = sum.transpose();
        }
    });
    parallel_for(matrix.rows(), [&](std::size_t r) {
        Mat3& block = matrix.blocks[at(matrix.diagonal[r])];
        block.diagonal().array() += diagonal[at(vertex_of_row_[r])];
    });
}

void Assembler::gather_forces(std::span<const Vec3> element_forces, std::span<Vec3> forces) const {
    parallel_for(forces.size(), [&](std::size_t v) {
        Vec3 sum = Vec3::Zero();
        if (slot_of_vertex_[v] == k_no_index) {
            forces[v] = sum;
            return;
        }
        for (const std::uint32_t source : scatter_.forces(at(slot_of_vertex_[v]))) {
            sum += element_forces[source];
        }
        forces[v] = sum;
    });
}

} // namespace weft

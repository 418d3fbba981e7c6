#include "solver/assembler.h"

#include "base/parallel.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace weft {

namespace {

/// After so many rows listed anew, as a multiple of all, everything is made anew: what is read one
/// after the other has scattered by then. Smaller: it costs more than it brings; larger: assembly
/// takes a third longer in the end.
constexpr double k_greatest_wear = 2.0;

} // namespace

Assembler::Assembler(std::span<const VertexRange> objects, std::span<const ElementSet> sets) {
    rooms_.fit(objects, sets);
    build(sets);
}

void Assembler::build(std::span<const ElementSet> sets) {
    assert(std::max(rooms_.block_count(), rooms_.constant_count()) <
           std::numeric_limits<std::uint32_t>::max() / SourceLists::k_manners);
    sources_.build(rooms_, sets);
    order_rows();
    sources_.build_pairs(rooms_, sets, site_of_row_);
    find_places();
}

void Assembler::update(std::span<const VertexRange> objects,
                       std::span<const ElementSet> sets,
                       std::span<const std::vector<Index>> changed) {
    assert(changed.size() == sets.size());
    const double wear =
        static_cast<double>(sources_.changed_rows()) / static_cast<double>(site_of_row_.size() + 1);
    if (!rooms_.fit(objects, sets) || wear > k_greatest_wear) {
        build(sets);
        return;
    }
    sources_.change(rooms_, sets, changed);
    order_rows();
    find_places();
}

void Assembler::list_vertices() {
    site_of_vertex_.assign(rooms_.vertex_count(), k_no_index);
    dof_of_vertex_.assign(rooms_.vertex_count(), k_no_index);
    vertex_of_site_.assign(rooms_.site_count(), k_no_index);
    vertex_of_dof_.clear();
    for (const ElementRooms::Object& object : rooms_.objects()) {
        for (std::size_t i = 0; i < object.count; ++i) {
            site_of_vertex_[object.first + i] = static_cast<Index>(object.begin + i);
            vertex_of_site_[object.begin + i] = static_cast<Index>(object.first + i);
            dof_of_vertex_[object.first + i] = static_cast<Index>(vertex_of_dof_.size());
            vertex_of_dof_.push_back(static_cast<Index>(object.first + i));
        }
    }
}

/// Orders rows by the graph of the vertices alone: a function of the elements as they are.
void Assembler::order_rows() {
    list_vertices();
    const std::size_t n = vertex_of_dof_.size();
    const auto site_of_dof = [&](std::size_t i) {
        return at(site_of_vertex_[at(vertex_of_dof_[i])]);
    };
    graph_begin_.assign(1, 0);
    for (std::size_t i = 0; i < n; ++i) {
        graph_begin_.push_back(graph_begin_.back() +
                               static_cast<Index>(sources_.neighbours(site_of_dof(i)).size()));
    }
    graph_column_.resize(at(graph_begin_.back()));
    parallel_for(n, [&](std::size_t i) {
        std::size_t k = at(graph_begin_[i]);
        for (const auto& neighbour : sources_.neighbours(site_of_dof(i))) {
            graph_column_[k++] = dof_of_vertex_[at(vertex_of_site_[at(neighbour.site)])];
        }
    });
    const std::vector<Index> row_of_dof = locality_order(graph_begin_, graph_column_);
    row_of_vertex_.assign(site_of_vertex_.size(), k_no_index);
    vertex_of_row_.resize(n);
    site_of_row_.resize(n);
    row_of_site_.assign(rooms_.site_count(), k_no_index);
    for (std::size_t i = 0; i < n; ++i) {
        const Index vertex = vertex_of_dof_[i];
        const Index row = row_of_dof[i];
        row_of_vertex_[at(vertex)] = row;
        vertex_of_row_[at(row)] = vertex;
        site_of_row_[at(row)] = static_cast<Index>(site_of_dof(i));
        row_of_site_[site_of_dof(i)] = row;
    }
}

/// Writes the rows of the pattern, and where in them each pair stands. What is written column by
/// column, each into all rows, comes out sorted in every row.
void Assembler::find_places() {
    const std::size_t n = site_of_row_.size();
    pattern_.row_begin.assign(1, 0);
    for (const Index site : site_of_row_) {
        pattern_.row_begin.push_back(pattern_.row_begin.back() +
                                     static_cast<Index>(sources_.neighbours(at(site)).size()));
    }
    pattern_.column.resize(at(pattern_.row_begin.back()));
    pattern_.diagonal.resize(n);
    places_.assign(sources_.pair_count(), {k_no_index, k_no_index});
    next_.assign(pattern_.row_begin.begin(), pattern_.row_begin.end() - 1);
    for (std::size_t column = 0; column < n; ++column) {
        const Index site = site_of_row_[column];
        for (const auto& [other, pair] : sources_.neighbours(at(site))) {
            const Index place = next_[at(row_of_site_[at(other)])]++;
            pattern_.column[at(place)] = static_cast<Index>(column);
            (other <= site ? places_[at(pair)].place : places_[at(pair)].mirror) = place;
            if (other == site) {
                places_[at(pair)].mirror = place;
                pattern_.diagonal[column] = place;
            }
        }
    }
}

std::span<Mat3> Assembler::blocks_of(std::size_t set, std::span<Mat3> element_blocks) const {
    const ElementRooms::Set& room = rooms_.sets()[set];
    return room.is_constant
               ? std::span<Mat3>()
               : element_blocks.subspan(room.block_begin, room.count * room.blocks_per_element);
}

std::span<Vec3> Assembler::forces_of(std::size_t set, std::span<Vec3> element_forces) const {
    const ElementRooms::Set& room = rooms_.sets()[set];
    return element_forces.subspan(room.force_begin, room.count * room.nodes_per_element);
}

void Assembler::assemble(std::span<const Mat3> element_blocks,
                         double constant_scale,
                         std::span<const double> diagonal,
                         BlockMatrix& matrix) const {
    assert(element_blocks.size() == block_count());
    matrix.blocks.resize(pattern_.column.size());
    parallel_for(places_.size(), [&](std::size_t pair) {
        const auto [place, mirror] = places_[pair];
        if (place == k_no_index) {
            return;
        }
        Mat3 sum = (constant_scale * sources_.constant(pair)) * Mat3::Identity();
        for (const std::uint32_t source : sources_.blocks(pair)) {
            const Mat3& block = element_blocks[source / SourceLists::k_manners];
            switch (source % SourceLists::k_manners) {
            case SourceLists::k_transposed:
                sum += block.transpose();
                break;
            case SourceLists::k_negative:
                sum -= block;
                break;
            default:
                sum += block;
            }
        }
        matrix.blocks[at(place)] = sum;
        if (mirror != place) {
            matrix.blocks[at(mirror)] = sum.transpose();
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
        if (site_of_vertex_[v] == k_no_index) {
            forces[v] = sum;
            return;
        }
        for (const std::uint32_t source : sources_.forces(at(site_of_vertex_[v]))) {
            sum += element_forces[source];
        }
        forces[v] = sum;
    });
}

} // namespace weft

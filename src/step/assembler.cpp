#include "step/assembler.h"

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

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

} // namespace

Assembler::Assembler(std::span<const VertexRange> objects, std::span<const ElementSet> sets) {
    rooms_.fit(objects, sets);
    build(sets);
}

void Assembler::build(std::span<const ElementSet> sets) {
    assert(std::max(rooms_.block_count(), rooms_.constant_count()) <
           std::numeric_limits<std::uint32_t>::max() / 2);
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
    site_of_vertex_.resize(rooms_.vertex_count());
    vertex_of_site_.assign(rooms_.site_count(), k_no_index);
    for (const ElementRooms::Object& object : rooms_.objects()) {
        for (std::size_t i = 0; i < object.count; ++i) {
            site_of_vertex_[object.first + i] = static_cast<Index>(object.begin + i);
            vertex_of_site_[object.begin + i] = static_cast<Index>(object.first + i);
        }
    }
}

/// Orders rows by the graph of the vertices alone: a function of the elements as they are.
void Assembler::order_rows() {
    list_vertices();
    const std::size_t n = site_of_vertex_.size();
    graph_begin_.assign(1, 0);
    for (const Index site : site_of_vertex_) {
        graph_begin_.push_back(graph_begin_.back() +
                               static_cast<Index>(sources_.neighbours(at(site)).size()));
    }
    graph_column_.resize(at(graph_begin_.back()));
    parallel_for(n, [&](std::size_t v) {
        std::size_t k = at(graph_begin_[v]);
        for (const auto& neighbour : sources_.neighbours(at(site_of_vertex_[v]))) {
            graph_column_[k++] = vertex_of_site_[at(neighbour.site)];
        }
    });
    row_of_vertex_ = locality_order(graph_begin_, graph_column_);
    vertex_of_row_.resize(n);
    site_of_row_.resize(n);
    row_of_site_.assign(rooms_.site_count(), k_no_index);
    for (std::size_t v = 0; v < n; ++v) {
        const Index site = site_of_vertex_[v];
        const Index row = row_of_vertex_[v];
        vertex_of_row_[at(row)] = static_cast<Index>(v);
        site_of_row_[at(row)] = site;
        row_of_site_[at(site)] = row;
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
            const Mat3& block = element_blocks[source / 2];
            if (source % 2 == 0) {
                sum += block;
            } else {
                sum += block.transpose();
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
        for (const std::uint32_t source : sources_.forces(at(site_of_vertex_[v]))) {
            sum += element_forces[source];
        }
        forces[v] = sum;
    });
}

} // namespace weft

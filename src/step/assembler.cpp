#include "step/assembler.h"

#include "base/parallel.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace weft {

namespace {

/// Calls f(element block number, vertex a, vertex b) for each block of each element, in order.
template <typename F> void for_each_block(std::span<const ElementSet> sets, const F& f) {
    std::size_t block = 0;
    for (const ElementSet& set : sets) {
        const auto n = static_cast<std::size_t>(set.nodes_per_element);
        for (std::size_t e = 0; e < set.count(); ++e) {
            const Index* const node = set.nodes.data() + e * n;
            for (std::size_t a = 0; a < n; ++a) {
                for (std::size_t b = a; b < n; ++b, ++block) {
                    if (node[a] != k_no_index && node[b] != k_no_index) {
                        f(block, node[a] + set.first_vertex, node[b] + set.first_vertex);
                    }
                }
            }
        }
    }
}

/// Turns (target, source) pairs, given in the order of sources, into compressed lists by target.
void compress(std::span<const std::pair<Index, std::uint32_t>> pairs,
              std::size_t targets,
              std::vector<std::size_t>& begin,
              std::vector<std::uint32_t>& sources) {
    begin.assign(targets + 1, 0);
    for (const auto& [target, source] : pairs) {
        ++begin[static_cast<std::size_t>(target) + 1];
    }
    for (std::size_t i = 0; i < targets; ++i) {
        begin[i + 1] += begin[i];
    }
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    sources.resize(pairs.size());
    for (const auto& [target, source] : pairs) {
        sources[next[static_cast<std::size_t>(target)]++] = source;
    }
}

} // namespace

Assembler::Assembler(std::size_t vertex_count,
                     std::span<const ElementSet> sets,
                     std::span<const ElementSet> constant_sets,
                     std::span<const double> constant_blocks) {
    std::vector<ElementSet> all(sets.begin(), sets.end());
    all.insert(all.end(), constant_sets.begin(), constant_sets.end());
    for (const ElementSet& set : sets) {
        block_count_ += set.count() * set.blocks_per_element();
    }
    for (const ElementSet& set : all) {
        force_count_ += set.nodes.size();
    }
    assert(block_count_ < std::numeric_limits<std::uint32_t>::max() / 2);
    build_pattern(vertex_count, all);
    build_block_sources(sets);
    sum_constant_blocks(constant_sets, constant_blocks);
    build_force_sources(vertex_count, all);
}

void Assembler::build_pattern(std::size_t vertex_count, std::span<const ElementSet> sets) {
    std::vector<BlockEntry> entries;
    for_each_block(sets, [&](std::size_t, Index a, Index b) { entries.push_back({a, b}); });
    row_of_vertex_ = locality_order(make_pattern(vertex_count, entries));
    for (BlockEntry& entry : entries) {
        entry = {row_of_vertex_[static_cast<std::size_t>(entry.row)],
                 row_of_vertex_[static_cast<std::size_t>(entry.column)]};
    }
    pattern_ = make_pattern(vertex_count, entries);
    vertex_of_row_.resize(vertex_count);
    for (std::size_t v = 0; v < vertex_count; ++v) {
        vertex_of_row_[static_cast<std::size_t>(row_of_vertex_[v])] = static_cast<Index>(v);
    }
    upper_of_place_.assign(pattern_.blocks.size(), k_no_index);
    for (std::size_t r = 0; r < pattern_.rows(); ++r) {
        for (Index k = pattern_.diagonal[r]; k < pattern_.row_begin[r + 1]; ++k) {
            const Index c = pattern_.column[static_cast<std::size_t>(k)];
            upper_of_place_[static_cast<std::size_t>(k)] = static_cast<Index>(uppers_.size());
            uppers_.push_back({k, find_block(pattern_, c, static_cast<Index>(r))});
        }
    }
}

Index Assembler::upper_of(Index vertex_a, Index vertex_b, bool& transposed) const {
    const Index row = row_of_vertex_[static_cast<std::size_t>(vertex_a)];
    const Index col = row_of_vertex_[static_cast<std::size_t>(vertex_b)];
    transposed = row > col;
    const Index place = find_block(pattern_, std::min(row, col), std::max(row, col));
    return upper_of_place_[static_cast<std::size_t>(place)];
}

void Assembler::build_block_sources(std::span<const ElementSet> sets) {
    std::vector<std::pair<Index, std::uint32_t>> pairs;
    for_each_block(sets, [&](std::size_t block, Index a, Index b) {
        bool transposed = false;
        const Index upper = upper_of(a, b, transposed);
        pairs.emplace_back(upper, static_cast<std::uint32_t>(2 * block + (transposed ? 1 : 0)));
    });
    compress(pairs, uppers_.size(), source_begin_, sources_);
}

void Assembler::sum_constant_blocks(std::span<const ElementSet> sets,
                                    std::span<const double> blocks) {
    constant_.assign(uppers_.size(), 0.0);
    for_each_block(sets, [&](std::size_t block, Index a, Index b) {
        bool transposed = false; // a scalar times the identity is its own transpose
        constant_[static_cast<std::size_t>(upper_of(a, b, transposed))] += blocks[block];
    });
}

void Assembler::build_force_sources(std::size_t vertex_count, std::span<const ElementSet> sets) {
    std::vector<std::pair<Index, std::uint32_t>> pairs;
    std::uint32_t source = 0;
    for (const ElementSet& set : sets) {
        for (const Index node : set.nodes) {
            if (node != k_no_index) {
                pairs.emplace_back(node + set.first_vertex, source);
            }
            ++source;
        }
    }
    compress(pairs, vertex_count, force_begin_, force_sources_);
}

void Assembler::assemble(std::span<const Mat3> element_blocks,
                         double constant_scale,
                         std::span<const double> diagonal,
                         BlockMatrix& matrix) const {
    assert(element_blocks.size() == block_count_);
    matrix.blocks.resize(pattern_.blocks.size());
    parallel_for(uppers_.size(), [&](std::size_t u) {
        Mat3 sum = (constant_scale * constant_[u]) * Mat3::Identity();
        for (std::size_t s = source_begin_[u]; s < source_begin_[u + 1]; ++s) {
            const Mat3& block = element_blocks[sources_[s] / 2];
            if (sources_[s] % 2 == 0) {
                sum += block;
            } else {
                sum += block.transpose();
            }
        }
        const auto [place, mirror] = uppers_[u];
        matrix.blocks[static_cast<std::size_t>(place)] = sum;
        if (mirror != place) {
            matrix.blocks[static_cast<std::size_t>(mirror)] = sum.transpose();
        }
    });
    parallel_for(matrix.rows(), [&](std::size_t r) {
        Mat3& block = matrix.blocks[static_cast<std::size_t>(matrix.diagonal[r])];
        block.diagonal().array() += diagonal[static_cast<std::size_t>(vertex_of_row_[r])];
    });
}

void Assembler::gather_forces(std::span<const Vec3> element_forces, std::span<Vec3> forces) const {
    parallel_for(forces.size(), [&](std::size_t v) {
        Vec3 sum = Vec3::Zero();
        for (std::size_t s = force_begin_[v]; s < force_begin_[v + 1]; ++s) {
            sum += element_forces[force_sources_[s]];
        }
        forces[v] = sum;
    });
}

} // namespace weft

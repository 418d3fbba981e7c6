#pragma once

#include "base/eigen.h"

#include <vector>

namespace weft {

/// What an adaptation changed of a cloth, by slots of the arrays as they are after it: those whose
/// content is another one, ascending, each once. Slots at or beyond the present sizes are gone.
struct ClothChanges {
    /// A vertex that stands in another slot than before, or is new. Of the cloth, as all indices.
    struct Vertex {
        Index slot;
        Index from; ///< slot before the adaptation; k_no_index: it is new
    };
    std::vector<Vertex> vertices;
    std::vector<Index> masses;    ///< vertices whose rest area is another one, those above included
    std::vector<Index> triangles; ///< with another rest shape or other corners
    std::vector<Index> edges;     ///< with other ends, triangles or apexes

    bool empty() const { return triangles.empty() && edges.empty() && vertices.empty(); }
};

} // namespace weft

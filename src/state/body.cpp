#include "state/body.h"

#include "base/parallel.h"

namespace weft {

void carry(const Body& body, std::span<Vec3> values) {
    const auto first_vertex = static_cast<std::size_t>(body.first_vertex);
    const auto first_particle = static_cast<std::size_t>(body.first_particle);
    parallel_for(body.carriers.size(), [&](std::size_t i) {
        const Carrier& carrier = body.carriers[i];
        Vec3 sum = Vec3::Zero();
        for (std::size_t k = 0; k < 4 && carrier.particles[k] != k_no_index; ++k) {
            sum += carrier.weights[k] *
                   values[first_particle + static_cast<std::size_t>(carrier.particles[k])];
        }
        values[first_vertex + i] = sum;
    });
}

} // namespace weft

#include "state/body.h"

#include "base/parallel.h"
#include "state/world.h"

namespace weft {

void interpolate_embedded(const Body& body, std::span<Vec3> values) {
    const auto first_vertex = static_cast<std::size_t>(body.first_vertex);
    const auto first_particle = static_cast<std::size_t>(body.first_particle);
    parallel_for(body.embeddings.size(), [&](std::size_t i) {
        const Embedding& embedding = body.embeddings[i];
        Vec3 sum = Vec3::Zero();
        for (std::size_t k = 0; k < 4 && embedding.particles[k] != k_no_index; ++k) {
            sum += embedding.weights[k] *
                   values[first_particle + static_cast<std::size_t>(embedding.particles[k])];
        }
        values[first_vertex + i] = sum;
    });
}

EmbeddingTable make_embedding_table(const World& world) {
    EmbeddingTable table;
    for_each_body(world, [&](const Body& body) {
        table.slot.resize(world.vertex_count(), k_no_index);
        for (std::size_t i = 0; i < body.embeddings.size(); ++i) {
            table.slot[static_cast<std::size_t>(body.first_vertex) + i] =
                static_cast<Index>(table.embeddings.size());
            Embedding& embedding = table.embeddings.emplace_back(body.embeddings[i]);
            for (Index& particle : embedding.particles) {
                particle += particle == k_no_index ? 0 : body.first_particle;
            }
        }
    });
    return table;
}

void number_bodies(World& world) {
    Index next = 0;
    if (!world.cloths.empty()) {
        next = world.cloths.back().first_vertex + world.cloths.back().vertex_count;
    }
    const auto number = [&](Body& body) {
        body.first_vertex = next;
        body.first_particle = next + body.vertex_count;
        next += body.vertex_count + body.particle_count;
    };
    for (Solid& solid : world.solids) {
        number(solid.body);
    }
    for (RigidBody& rigid : world.rigids) {
        number(rigid.body);
    }
}

} // namespace weft

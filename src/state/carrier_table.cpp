#include "state/carrier_table.h"

namespace weft {

CarrierTable make_carrier_table(const World& world) {
    CarrierTable table;
    for_each_body(world, [&](const Body& body) {
        table.slot.resize(world.vertex_count(), k_no_index);
        for (std::size_t i = 0; i < body.carriers.size(); ++i) {
            table.slot[static_cast<std::size_t>(body.first_vertex) + i] =
                static_cast<Index>(table.carriers.size());
            Carrier& carrier = table.carriers.emplace_back(body.carriers[i]);
            for (Index& particle : carrier.particles) {
                particle += particle == k_no_index ? 0 : body.first_particle;
            }
        }
    });
    return table;
}

} // namespace weft

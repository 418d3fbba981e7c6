#include "start/prepare.h"

#include "state/build_world.h"

namespace weft {

std::optional<Preparation>
prepare(World built, const Scene& scene, const std::function<bool()>& should_stop) {
    const auto overlap = cure_start_overlap(built, scene, should_stop);
    if (!overlap) {
        return std::nullopt;
    }
    return Preparation{Prepared(std::move(built), scene.scene, scene.contact), *overlap};
}

Prepared prepare(const Scene& scene, const std::function<void(const std::string&)>& warn) {
    return prepare(build_world(scene, warn), scene, [] { return false; })->start;
}

} // namespace weft

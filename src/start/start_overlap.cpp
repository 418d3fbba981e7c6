#include "start/start_overlap.h"

#include "base/error.h"
#include "collide/untangle.h"
#include "state/build_pins.h"

#include "start/grow_obstacles.h"

namespace weft {

namespace {

/// Pairs named in a message; more would not be read.
constexpr std::size_t k_named = 3;

void refuse(std::span<const CrossingPair> pairs, const char* remedy) {
    if (!pairs.empty()) {
        fail_input("{} at the start: {}", describe_crossings(pairs), remedy);
    }
}

StartOverlapReport start_untangled(World& world, const ContactParams& contact) {
    const UntangleReport untangled = untangle(world, {.cloth = contact.self});
    return {.rounds = untangled.rounds, .greatest_way = untangled.greatest_way};
}

} // namespace

std::vector<CrossingPair> crossings_of_contact(const World& world, const ContactParams& contact) {
    if (!contact.enabled) {
        return {};
    }
    std::vector<CrossingPair> pairs =
        find_crossings(world, std::numeric_limits<std::size_t>::max());
    if (!contact.self) {
        std::erase_if(pairs, [&](const CrossingPair& pair) {
            return std::none_of(world.obstacles.begin(), world.obstacles.end(),
                                [&](const Obstacle& o) { return o.name == pair.object_b; });
        });
    }
    return pairs;
}

std::string describe_crossings(std::span<const CrossingPair> pairs) {
    std::string text;
    for (const CrossingPair& pair : pairs.first(std::min(pairs.size(), k_named))) {
        text +=
            fmt::format("{}{}: triangle {} crosses {} triangle {} at ({:.4g}, {:.4g}, {:.4g}) m",
                        text.empty() ? "" : "; ", pair.object_a, pair.triangle_a, pair.object_b,
                        pair.triangle_b, pair.place.x(), pair.place.y(), pair.place.z());
    }
    return fmt::format("{}; {} pair{} cross{}", text, pairs.size(), pairs.size() == 1 ? "" : "s",
                       pairs.size() == 1 ? "es" : "");
}

std::optional<StartOverlapReport>
cure_start_overlap(World& world, const Scene& scene, const std::function<bool()>& should_stop) {
    const std::vector<CrossingPair> before = crossings_of_contact(world, scene.contact);
    StartOverlapReport report;
    if (before.empty()) {
        return report;
    }
    switch (scene.contact.start_overlap) {
    case StartOverlap::Error:
        refuse(before, "must be apart; contact.start_overlap = \"untangle\" moves cloth apart, "
                       "\"grow\" lets obstacles grow into it; weft inspect lists the pairs");
        break;
    case StartOverlap::Untangle:
        report = start_untangled(world, scene.contact);
        refuse(crossings_of_contact(world, scene.contact),
               "untangling could not part them: move the cloth or try start_overlap = \"grow\"");
        break;
    case StartOverlap::Grow: {
        const auto grown = grow_obstacles(world, scene, should_stop);
        if (!grown) {
            return std::nullopt;
        }
        report = {.rounds = grown->rounds,
                  .greatest_way = grown->greatest_way,
                  .deepest_inset = grown->deepest_inset,
                  .preroll_substeps = grown->substeps};
        refuse(crossings_of_contact(world, scene.contact),
               "growing could not part them: move the cloth or try start_overlap = \"untangle\"");
        break;
    }
    }
    hold_pins_here(world);
    report.pairs_before = before.size();
    world.previous_positions = world.positions;
    return report;
}

} // namespace weft

#include "app/inspect_start.h"

#include "app/crossing_ply.h"
#include "app/inspect_attachments.h"
#include "app/summary_lines.h"
#include "base/atomic_file.h"
#include "collide/crossings.h"
#include "frames/measures.h"
#include "state/world_objects.h"

#include <map>
#include <numeric>

#include "start/start_overlap.h"

namespace weft {

namespace {

std::string describe_solids(const World& world) {
    SummaryLines sheet;
    for (const Solid& solid : world.solids) {
        const Body& body = solid.body;
        const auto begin = world.masses.begin() + body.first_particle;
        sheet.row("filled", "{}: {} particles, {} cells, {} edges, {:.4g} litres, {:.4g} kg",
                  body.name, body.particle_count, solid.cells.size(), solid.network.size(),
                  1e3 * body_volume(world, body),
                  std::accumulate(begin, begin + body.particle_count, 0.0));
    }
    return sheet.text;
}

/// Pairs listed of each two objects; the count tells of the rest.
constexpr std::size_t k_listed = 5;

using Couples = std::map<std::array<ObjectId, 2>, std::vector<UnresolvedPair>>;

void list_pairs(const World& world, const Couples& couples, bool all, SummaryLines& sheet) {
    for (const auto& [objects, pairs] : couples) {
        const std::string a = object_name(world, objects[0]);
        const std::string b = object_name(world, objects[1]);
        if (objects[0] == objects[1]) {
            sheet.row("", "{}: {} with itself", a, plural(pairs.size(), "pair"));
        } else {
            sheet.row("", "{} and {}: {}", a, b, plural(pairs.size(), "pair"));
        }
        const std::size_t listed = all ? pairs.size() : std::min(pairs.size(), k_listed);
        for (const UnresolvedPair& pair : std::span(pairs).first(listed)) {
            sheet.row("", "  {} triangle {:<6} {} triangle {:<6} at ({:.4f}, {:.4f}, {:.4f}) m", a,
                      pair.triangles[0], b, pair.triangles[1], pair.place.x(), pair.place.y(),
                      pair.place.z());
        }
        if (listed < pairs.size()) {
            sheet.row("", "  and {} more: --pairs lists all", pairs.size() - listed);
        }
    }
}

const char* what_is_done(StartOverlap way) {
    switch (way) {
    case StartOverlap::Grow:
        return "contact.start_overlap = \"grow\" will part them";
    case StartOverlap::Untangle:
        return "contact.start_overlap = \"untangle\" will part them";
    case StartOverlap::Error:
        break;
    }
    return "must be apart, or contact.start_overlap = \"untangle\" or \"grow\"";
}

} // namespace

InspectReport describe_start(const Scene& scene, const StartInspection& wanted) {
    InspectReport report;
    SummaryLines sheet;
    std::vector<std::string> warnings;
    const World world =
        build_world(scene, [&](const std::string& line) { warnings.push_back(line); });
    sheet.text = describe_solids(world) + describe_attachments(world, warnings);
    if (!scene.contact.enabled) {
        sheet.row("start", "contact is off: what crosses does not matter");
        return {sheet.text, false};
    }
    const auto pairs = WorldCrossings(world, scene.contact.self).find(world, world.time);
    if (pairs.empty()) {
        sheet.row("start", "nothing crosses");
    } else {
        Couples couples;
        for (const UnresolvedPair& pair : pairs) {
            couples[pair.objects].push_back(pair);
        }
        report.is_refused = scene.contact.start_overlap == StartOverlap::Error;
        sheet.row(report.is_refused ? "REFUSED" : "start", "{} of triangles cross: {}",
                  plural(pairs.size(), "pair"), what_is_done(scene.contact.start_overlap));
        list_pairs(world, couples, wanted.all_pairs, sheet);
    }
    if (!wanted.ply.empty()) {
        write_atomically(wanted.ply, std::string_view(encode_crossings(world, pairs)));
        sheet.row("written", "{}: the triangles that cross, and where", wanted.ply.string());
    }
    report.text = sheet.text;
    return report;
}

} // namespace weft

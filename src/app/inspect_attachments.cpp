#include "app/inspect_attachments.h"

#include "app/summary_lines.h"

#include <algorithm>
#include <limits>

namespace weft {

namespace {

const std::string& cloth_name(const World& world, Index cloth) {
    return world.cloths[static_cast<std::size_t>(cloth)].name;
}

void describe(const World& world, std::size_t number, SummaryLines& sheet) {
    const Attachment& attachment = world.attachments[number];
    const bool is_seam = attachment.kind == AttachKind::Seam;
    std::size_t pairs = 0;
    double least = std::numeric_limits<double>::infinity();
    double greatest = 0.0;
    for (const AttachedPair& pair : world.attached_pairs) {
        if (static_cast<std::size_t>(pair.attachment) == number) {
            const double gap = pair_gap(pair, world.positions).norm();
            least = std::min(least, gap);
            greatest = std::max(greatest, gap);
            ++pairs;
        }
    }
    sheet.row("attach", "{}: {} of {} and {}, {}", attachment.name, is_seam ? "seam" : "button",
              cloth_name(world, attachment.cloth[0]), cloth_name(world, attachment.cloth[1]),
              plural(pairs, "pair"));
    if (is_seam) {
        sheet.row("", "sides {:.4g} and {:.4g} m long", attachment.length[0], attachment.length[1]);
    }
    sheet.row("", "gaps {:.4g} to {:.4g} m at the start; closes from {:.4g} to {:.4g} s{}", least,
              greatest, attachment.start, attachment.start + attachment.close,
              attachment.weld ? ", then welds" : "");
}

} // namespace

std::string describe_attachments(const World& world, const std::vector<std::string>& warnings) {
    SummaryLines sheet;
    for (std::size_t i = 0; i < world.attachments.size(); ++i) {
        if (!world.attachments[i].is_joint) {
            describe(world, i, sheet);
        }
    }
    for (const std::string& line : warnings) {
        if (line.starts_with("attach")) {
            sheet.row("warning", "{}", line);
        }
    }
    return sheet.text;
}

} // namespace weft

#pragma once

#include "collide/contact_report.h"
#include "frames/csv.h"

#include <map>

namespace weft {

/// Names of the columns of problems.csv, joined by commas.
std::string_view problems_header();

/// A row for each pair that was unresolved on the way to a frame: the same text for the same pairs.
std::vector<std::string>
problem_rows(int frame, std::span<const UnresolvedPair> problems, const World& world);

/// Places (m) of the pairs that were unresolved on the way to a frame.
std::vector<Vec3f> places_of(std::span<const UnresolvedPair> problems);

/// The same from the table, by frame; frames without problems are left out.
/// Throws Error (Disk) naming `place` when a row is not as problem_rows() writes it.
std::map<int, std::vector<Vec3f>> problem_places(const CsvTable& table, const std::string& place);

} // namespace weft

#pragma once

#include "collide/contact.h"
#include "collide/impact.h"

namespace weft {

/// What is wrong with pairs that are still met after all stages: too near, or pinched where
/// obstacles push a cloth from opposite sides; sorted, each pair of triangles once.
/// @param ends #V of the surface: positions after the substep, m
std::vector<ContactProblem> describe_left(const ContactSurface& surface,
                                          std::span<const Candidate> candidates,
                                          std::span<const Impact> left,
                                          std::span<const Vec3> ends);

} // namespace weft

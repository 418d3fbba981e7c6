#pragma once

#include "adapt/state_transfer.h"
#include "collide/edit_guard.h"

namespace weft {

/// Of what moves the surface, lets only that be done that stretches no cloth and, where contact is
/// on, that it has room for. All that is given must outlive the hooks.
/// @param guard  null: contact is off
/// @param cloth  its number
void add_guard(AdaptationHooks& hooks,
               const StateTransfer& transfer,
               EditGuard* guard,
               std::size_t cloth);

/// Lets nothing be done that moves the surface.
void forbid_moves(AdaptationHooks& hooks);

} // namespace weft

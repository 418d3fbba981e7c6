#pragma once

#include "state/rigid_motion.h"

namespace weft {

/// A rigid body over one substep. An implicit step of its particles alone would stretch a turning
/// body along the tangents and lose its spin; so the step is taken from where the body gets when no
/// force acts, and what it then makes of the particles is brought back to a rigid motion.
struct RigidPrediction {
    FourPoints positions, velocities; ///< of the particles at the end
};

/// Free motion for dt (s): the centre goes straight on, and the body turns with its angular
/// momentum, which stays (Euler's equations by Runge and Kutta's fourth-order method, in pieces of
/// a twentieth of a radian).
RigidPrediction predict_rigid(const FourPoints& rest,
                              const FourPoints& positions,
                              const FourPoints& velocities,
                              double dt);

/// What the solve made of a free prediction, as a rigid motion: with the same momentum and, about
/// the prediction's end where forces acted, the same angular momentum.
RigidPrediction project_to_rigid(const FourPoints& rest,
                                 const RigidPrediction& prediction,
                                 const FourPoints& positions,
                                 const FourPoints& velocities);

} // namespace weft

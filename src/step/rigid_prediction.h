#pragma once

#include "state/rigid_motion.h"

namespace weft {

/// Where a rigid body gets in one substep when no force acts. An implicit step of its particles
/// alone would stretch a turning body along the tangents and lose its spin; so the step starts from
/// this prediction, and its result is projected to a rigid motion.
struct RigidPrediction {
    FourPoints positions, velocities; ///< the particles at the end
};

/// Free motion for dt (s): the centre goes straight on, and the body turns with its angular
/// momentum, which stays (Euler's equations by Runge and Kutta's fourth-order method, in pieces of
/// a twentieth of a radian).
RigidPrediction predict_rigid(const FourPoints& rest,
                              const FourPoints& positions,
                              const FourPoints& velocities,
                              double dt);

/// The rigid motion nearest to what the solve made of a prediction: with the same momentum and,
/// about the end of the prediction, where forces acted, the same angular momentum.
RigidPrediction project_to_rigid(const FourPoints& rest,
                                 const RigidPrediction& prediction,
                                 const FourPoints& positions,
                                 const FourPoints& velocities);

} // namespace weft

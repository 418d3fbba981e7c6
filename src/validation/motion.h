#pragma once

#include "scene/scene.h"
#include "state/world.h"
#include "step/implicit_step.h"

#include <functional>

/// How the dynamic experiments of the validation move their worlds and what they measure.
namespace weft {

/// A world that nothing touches, moved by the implicit step alone.
class FreeMotion {
public:
    /// Builds the world; a warning is a fault of the experiment and throws.
    explicit FreeMotion(const Scene& scene);

    /// One substep of length dt (s). Throws Error (Diverged) when it does not converge.
    void step(double dt);
    void steps(double dt, int count);

    World world; ///< may be disturbed before the first step

private:
    SceneParams params_;
    ImplicitStep implicit_;
    ConstrainedVertices constrained_;
    std::vector<Vec3> end_positions_, end_velocities_;
};

/// The fabric of the dynamic experiments: isotropic, 0.2 kg/m^2, no damping.
///
/// @param stretch  Young's modulus times thickness, N/m
FabricParams isotropic_fabric(double stretch, double poisson, double bend);

/// A sheet in vacuum without gravity, its corner edges along x and z, Newton's method and the
/// linear solver taken to round-off.
Scene vacuum_scene(const Vec2& size, const std::array<int, 2>& cells, const FabricParams& fabric);

/// Kinetic, membrane and bending energy, J.
double free_energy(const World& world);

/// Mean period (s) of a signal: the time between its first and its last rise through zero, each
/// interpolated linearly, by the number of rises between them; NaN when there are not two.
///
/// @param signal  at times dt, 2 dt, ...
double mean_period(std::span<const double> signal, double dt);

} // namespace weft

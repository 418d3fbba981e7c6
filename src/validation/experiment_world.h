#pragma once

#include "geometry/shapes.h"
#include "scene/params.h"
#include "state/world.h"
#include "step/implicit_step.h"

#include <functional>

/// How the dynamic experiments of the validation move their worlds and what they measure.
namespace weft {

/// Appends a cloth whose rest shape is the sheet, weft along x, warp along y; `place` says where
/// each of its points is (identity in the plane z = 0 when left out). It is at rest and not pinned.
Cloth& add_sheet(World& world,
                 const std::string& name,
                 const Sheet& sheet,
                 ClothParams params,
                 const std::function<Vec3(const Vec2&)>& place = {});

/// A world of that cloth alone.
World sheet_world(const Sheet& sheet,
                  const ClothParams& params,
                  const std::function<Vec3(const Vec2&)>& place = {});

/// A scene without air and gravity, and a solve to round-off.
SceneParams empty_space();

/// A fabric without bending stiffness that is equally stiff in all directions.
///
/// @param modulus  Young's modulus times thickness, N/m
FabricParams isotropic_membrane(double modulus, double poisson);

/// Vertices of the sheet that `is_in` picks.
std::vector<Index> vertices_where(const Sheet& sheet,
                                  const std::function<bool(const Vec2&)>& is_in);

/// A strip along x whose first column of cells is a clamp: points with x <= 0 are to be held.
///
/// An edge on the clamp's line bends like half a cell of the clamp and half a cell of the strip,
/// so that the strip begins half a cell before that line; its free end is `length` from there, at
/// x = length - cell/2. Without this its rigidity seems to be wrong by a cell in length.
struct ClampedStrip {
    Sheet sheet;
    double cell; ///< along x, m

    /// @param cells  along the strip, without the clamp's
    ClampedStrip(Pattern pattern, int cells, int cells_across, double length, double width);

    std::vector<Index> clamp() const;
    std::vector<Index> free_end() const;
};

/// Rows across that make the cells of a strip as square as can be; >= 1.
int square_cells_across(int cells, double length, double width);

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

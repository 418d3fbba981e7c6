#pragma once

#include "adapt/sqrt3_mesh.h"
#include "adapt/state_transfer.h"
#include "state/world.h"

#include <map>
#include <optional>
#include <random>

namespace weft::test {

/// How the sheets of an AdaptingWorld stand and move.
enum class SheetMotion {
    Spin,    ///< flat, turning as a rigid body, its centre moving on
    Wave,    ///< bent and moving in waves as long as the sheet, over that
    Crumple, ///< every vertex shifted by up to a quarter cell and with a speed of its own, over
             ///< that
};

/// Three sheets, of which the first and the last are adaptive, with pins along the side of the last
/// at z = -1.2 m, attached pairs, a history for BDF2, and a memory of contacts between all three.
/// Their meshes are changed at random; which points of the sheets their vertices are is kept
/// beside.
class AdaptingWorld {
public:
    AdaptingWorld(SheetMotion motion, unsigned seed);

    /// One adaptation of cloth number `index` of a few random edits; a fraction `growth` of them
    /// refine.
    ClothChanges adapt(std::size_t index, int edits, double growth);

    /// Adaptations of all adaptive cloths until nothing is left to take out.
    void coarsen_all();

    /// A name for each vertex of the world, that it keeps as long as it is there.
    std::vector<int> names() const;

    /// Where the vertex of that name is to be, m: the mean of its parents once it was put in.
    struct Place {
        Vec3 x, previous, start;
    };
    const Place& place(int name) const { return places_.at(name); }

    World world;
    std::mt19937 random;

private:
    void set_motion(SheetMotion motion);
    void name_all();
    AdaptationHooks follow(std::size_t index, StateTransfer& transfer);
    Vec3 noise(double size);

    std::vector<std::vector<int>> names_; ///< by cloth and vertex
    std::map<int, Place> places_;
    std::vector<std::optional<Sqrt3Mesh>> meshes_; ///< none where a cloth does not adapt
    int next_name_ = 0;
};

/// Mass and motion of one cloth, its angular momentum about a place.
PatchMomentum momentum_of(const World& world, const Cloth& cloth, const Vec3& about);

/// Root of the mean square speed of a cloth's vertices, m/s.
double rms_speed(const World& world, const Cloth& cloth);

} // namespace weft::test

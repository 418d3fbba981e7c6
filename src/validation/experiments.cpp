#include "validation/experiments.h"

#include "base/error.h"
#include "base/stopwatch.h"

#include <array>
#include <limits>

namespace weft {

namespace {

constexpr std::array k_experiments{
    Experiment{"patch", "affine stretch of an irregular orthotropic mesh", validate_patch_test},
    Experiment{"uniaxial", "Young's modulus and Poisson ratio of a pulled sheet",
               validate_uniaxial},
    Experiment{"off-axis", "modulus of an orthotropic sheet pulled across its yarns",
               validate_off_axis},
    Experiment{"cook", "Cook's membrane: the whole stiffness of the triangles", validate_cook},
    Experiment{"hanging-strip", "a strip that stretches under its own weight",
               validate_hanging_strip},
    Experiment{"catenary", "a limp strip hung between two points", validate_catenary},
    Experiment{"mesh-independence", "triangles against nets of springs on three patterns of mesh",
               validate_mesh_independence},
    Experiment{"cantilever", "a strip clamped at one end that bends under its own weight",
               validate_cantilever},
    Experiment{"cantilever-quadratic", "the same strip with the hinge model of bending",
               validate_cantilever_quadratic},
    Experiment{"buckling", "loads at which a flat strip leaves its plane", validate_buckling},
    Experiment{"free-fall", "falling sheet, against the sum of each integrator",
               validate_free_fall},
    Experiment{"spin", "sheet that spins freely", validate_spin},
    Experiment{"energy-decay", "what the integrators take out of a vibration",
               validate_energy_decay},
    Experiment{"momentum", "internal forces and contact between cloths keep momentum",
               validate_momentum},
    Experiment{"hanging-periods", "periods of a sheet that hangs by an edge",
               validate_hanging_periods},
    Experiment{"membrane-frequency", "first frequency of a stretched square membrane",
               validate_membrane_frequency},
    Experiment{"order-in-time", "convergence with the substep", validate_order_in_time},
    Experiment{"order-in-space", "convergence with the mesh", validate_order_in_space},
    Experiment{"adapt.periods", "strips that swing on meshes refined as they bend",
               validate_adaptive_periods},
    Experiment{"edges.loaded-chain", "columns of edges under five times their weight",
               validate_loaded_chain},
    Experiment{"edges.hanging-chain", "columns of edges under their own weight, edge by edge",
               validate_hanging_chain},
    Experiment{"edges.calibrated", "edges whose stiffness comes from the moduli of a fabric",
               validate_calibrated_edges},
    Experiment{.name = "friction.incline",
               .subject = "a sheet on an incline sticks and slides as Coulomb says",
               .run_repeats = validate_incline},
    Experiment{.name = "friction.sheets",
               .subject = "the same on another sheet",
               .run_repeats = validate_two_sheets},
    Experiment{.name = "friction.capstan",
               .subject = "tensions of a strip drawn over a cylinder",
               .run_repeats = validate_capstan},
    Experiment{.name = "friction.stick-slip",
               .subject = "when the foot of a bowing strip slips",
               .run_repeats = validate_stick_slip},
    Experiment{.name = "friction.drag",
               .subject = "cloth carried by a conveyor and by a sphere that turns",
               .run_repeats = validate_drag},
    Experiment{.name = "contact.stack",
               .subject = "ten sheets that come to rest on each other",
               .run_repeats = validate_stack},
    Experiment{.name = "contact.momentum",
               .subject = "two sheets that collide keep their momentum",
               .run_repeats = validate_contact_momentum},
    Experiment{.name = "contact.energy",
               .subject = "no energy appears in contact that does no work",
               .run_repeats = validate_contact_energy},
};

ValidationRows run(const Experiment& experiment, bool thorough) {
    try {
        return experiment.run ? experiment.run() : experiment.run_repeats(thorough);
    } catch (const Error& error) {
        return {{.what = "did not finish",
                 .measured = std::numeric_limits<double>::quiet_NaN(),
                 .note = error.what()}};
    }
}

} // namespace

std::span<const Experiment> experiments() {
    return k_experiments;
}

ValidationRows run_experiments(std::string_view only,
                               bool thorough,
                               const std::function<void(const Experiment&)>& starts) {
    ValidationRows all;
    for (const Experiment& experiment : experiments()) {
        if (experiment.name.find(only) == std::string_view::npos) {
            continue;
        }
        starts(experiment);
        const Stopwatch watch;
        ValidationRows rows = run(experiment, thorough);
        const double mean = watch.seconds() / static_cast<double>(rows.size());
        for (ValidationRow& row : rows) {
            row.experiment = experiment.name;
            row.seconds = row.seconds > 0.0 ? row.seconds : mean;
            all.push_back(std::move(row));
        }
    }
    return all;
}

} // namespace weft

#pragma once

#include "validation/table.h"

#include <functional>
#include <span>
#include <string_view>
#include <vector>

/// The experiments of `weft validate`: each builds its world in code, moves or settles it with the
/// same forces and integrators as a simulation, and compares with the mechanics of the textbook.
namespace weft {

using ValidationRows = std::vector<ValidationRow>;

struct Experiment {
    std::string_view name;    ///< for --only
    std::string_view subject; ///< one line
    ValidationRows (*run)() = nullptr;
    /// In place of run, where an experiment is repeated on more meshes and substeps when asked.
    ValidationRows (*run_repeats)(bool thorough) = nullptr;
};

/// All of them, in the order of the table. (A new one: declare it below, name it in
/// experiments.cpp.)
std::span<const Experiment> experiments();

/// Runs the experiments whose name contains `only` (empty: all), in order. `starts` is told of each
/// before it runs. One that throws Error gives a row that misses and carries the message.
///
/// @param thorough  all the repetitions that an experiment has
ValidationRows run_experiments(std::string_view only,
                               bool thorough,
                               const std::function<void(const Experiment&)>& starts);

ValidationRows validate_patch_test();
ValidationRows validate_uniaxial();
ValidationRows validate_off_axis();
ValidationRows validate_cook();
ValidationRows validate_hanging_strip();
ValidationRows validate_catenary();
ValidationRows validate_mesh_independence();
ValidationRows validate_cantilever();
ValidationRows validate_cantilever_quadratic();
ValidationRows validate_buckling();
ValidationRows validate_free_fall();
ValidationRows validate_spin();
ValidationRows validate_energy_decay();
ValidationRows validate_momentum();
ValidationRows validate_hanging_periods();
ValidationRows validate_membrane_frequency();
ValidationRows validate_order_in_time();
ValidationRows validate_order_in_space();
ValidationRows validate_adaptive_periods();
ValidationRows validate_loaded_chain();
ValidationRows validate_hanging_chain();
ValidationRows validate_calibrated_edges();
ValidationRows validate_incline(bool thorough);
ValidationRows validate_two_sheets(bool thorough);
ValidationRows validate_capstan(bool thorough);
ValidationRows validate_stick_slip(bool thorough);
ValidationRows validate_drag(bool thorough);
ValidationRows validate_stack(bool thorough);
ValidationRows validate_contact_momentum(bool thorough);
ValidationRows validate_contact_energy(bool thorough);

} // namespace weft

/// What most machines have in common.
#include "pipelines/scene/whole/machine_kind.h"

namespace pipelines {

void MachineKind::check_bodies(const Scene&, std::vector<SceneTable>&) const {}

Period MachineKind::period(const Scene&, int, bool) const {
  return {};
}

void MachineKind::refuse_open_balance(const Scene&, SceneTable&) const {}

std::optional<kinetics::LoadHistory> MachineKind::rehearse(const Scene& scene) const {
  if (!scene.masses_from_mesh.empty()) {
    check_without_masses(scene.machine);
    return std::nullopt;
  }
  // Samples and harmonics of a table need all their instants; what a mill refuses shows in a few.
  return compute_loads(scene.machine, scene.kinetics_effects(),
                       has_samples() ? scene.sampling : kinetics::TimeGrid{1, 8});
}

int MachineKind::instants_of_orders(const Machine&) const {
  return 0;
}

std::vector<std::string> MachineKind::added_loads(const Scene&) const {
  return {};
}

kinetics::LoadHistory MachineKind::loads(const Scene& scene, const Machine& machine) const {
  return compute_loads(machine, scene.kinetics_effects(), scene.sampling);
}

bool MachineKind::has_samples() const {
  return false;
}

std::optional<kinetics::LoadHistory> MachineKind::start_up(const Scene&, const Machine&) const {
  return std::nullopt;
}

std::string MachineKind::why_no_run_up_of_given_duration() const {
  return "this machine's start is not computed over time; leave it out: the stress then goes from nothing to "
         "that of running";
}

double MachineKind::drive_speed_rad_s(const Machine&) const {
  return 0;
}

std::vector<kinetics::ResamplingError> MachineKind::resampling_errors(const Machine&,
                                                                      const kinetics::TimeGrid&) const {
  return {};
}

std::optional<kinetics::LoadHistory> MachineKind::loads_passed_over(const Scene&, const Machine&) const {
  return std::nullopt;
}

std::vector<kinetics::CourseFigures> MachineKind::figures_over_the_course(
    const Scene& scene, const Machine& machine, const kinetics::TimeGrid& grid,
    const kinetics::LoadHistory& at_instants) const {
  constexpr int fine = 120;  // per turn: 24 in a period of the fifth harmonic
  // By the samples alone they would miss 4e-5 of a harmonic once a turn.
  constexpr int so_fine_that_they_tell = 360;
  if (has_samples() || grid.instants_per_turn >= so_fine_that_they_tell) return {};
  if (grid.instants_per_turn >= fine) return kinetics::course_figures(at_instants);
  Scene finer = scene;
  finer.sampling = {grid.turns,
                    (fine + grid.instants_per_turn - 1) / grid.instants_per_turn * grid.instants_per_turn};
  return kinetics::course_figures(loads(finer, machine));
}

std::vector<kinetics::Spring> MachineKind::springs(const Machine&) const {
  return {};
}

bool MachineKind::is_torsional() const {
  return false;
}

std::vector<double> MachineKind::natural_frequencies_rad_s(const Machine&) const {
  return {};
}

void MachineKind::check_without_masses(const Machine&) const {}

}  // namespace pipelines

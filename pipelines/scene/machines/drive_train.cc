#include <algorithm>
#include <cmath>

#include "kinetics/train_crests.h"
#include "kinetics/values/machine_refused.h"
#include "pipelines/scene/bodies/scene_body.h"
#include "pipelines/scene/machines/coarse_transient.h"
#include "pipelines/scene/machines/drive_train_reader.h"
#include "pipelines/scene/machines/kinds.h"
#include "pipelines/scene/reader/scene_effects.h"
#include "pipelines/scene/whole/body_effects.h"
#include "pipelines/scene/whole/plausibility.h"

namespace pipelines {
namespace {

const kinetics::DriveTrain& train_in(const Machine& machine) {
  return std::get<kinetics::DriveTrain>(machine);
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Only the inertia that [shaft] is can come from its mesh.
void check_from_mesh(SceneTable& machine, const Scene& scene) {
  if (scene.masses_from_mesh.empty()) return;
  const auto* shaft = scene.body("shaft");
  for (SceneTable& entry : machine.tables("inertias")) {
    if (!entry.has("from_mesh") || !entry.flag_or("from_mesh", false, "")) continue;
    const std::string name = entry.text("name");
    if (shaft == nullptr)
      entry.refuse("from_mesh", "needs a [shaft] whose mesh gives the inertia; add it, or the inertia");
    else if (const auto& own = std::get<TrainShaftOptions>(shaft->options).inertia; name != own)
      entry.refuse("from_mesh", "the mesh is that of [shaft], which is \"" + own +
                                    "\" in the train; give the inertia of \"" + name + "\"");
  }
}

/// Across the shaft, in whose axes it goes round.
bool has_force_in_space(const Scene& scene, const BodyScene& shaft) {
  const auto& forces = std::get<TrainShaftOptions>(shaft.options).forces;
  return std::any_of(forces.begin(), forces.end(), [&](const GivenForce& force) {
    return !force.turns_with_shaft && (force.force_N[0] != 0 || force.force_N[1] != 0) &&
           scene.has_effect(force.effect);
  });
}

class DriveTrainKind : public MachineKind {
public:
  std::string type() const override { return "drive_train"; }

  /// The bodies first: forces on a shaft are effects too.
  void read(SceneReading& reading) const override {
    auto& [root, machine, scene, findings, bodies] = reading;
    const auto train = read_drive_train(machine, scene.torsion, scene.masses_from_mesh);
    root.know("effects");
    scene.machine = train;
    bodies = read_bodies(root, scene, findings);
    if (findings.errors.empty()) check_from_mesh(machine, scene);
    if (findings.errors.empty() && scene.body("shaft") != nullptr)
      check_start_up_instants(machine, train, scene.torsion);
    if (!findings.errors.empty()) return;
    try {
      EffectRules rules{effect_table(scene)};
      add_own_effects(rules, type(), root);
      read_effects(root, rules, scene, findings);
    } catch (const kinetics::MachineRefused& error) {
      machine.refuse_missing("", "the load stage refuses it: " + std::string(error.what()));
    }
  }
  /// A turn of the reference shaft, or as many as bring a [shaft] round to forces that stand still in space;
  /// excitations that do not fit are warned of by the load stage.
  Period period(const Scene& scene, int most_turns, bool is_sound) const override {
    const auto* shaft = scene.body("shaft");
    if (!is_sound || shaft == nullptr || !has_force_in_space(scene, *shaft)) return {};
    const auto& train = train_in(scene.machine);
    const auto& inertia = std::get<TrainShaftOptions>(shaft->options).inertia;
    double ratio = 0;
    try {
      ratio = kinetics::mean_speed_rad_s(train, inertia) / train.reference_speed_rad_s;
    } catch (const kinetics::MachineRefused&) {
      return {};  // told where the load stage is rehearsed
    }
    for (int q = 1; q <= most_turns; ++q)
      if (std::abs(ratio - std::round(ratio * q) / q) <= 1e-9 * std::abs(ratio)) return {true, q};
    return {true, 0};
  }
  void doubt(const Scene& scene, Doubts& doubts) const override {
    doubts.speed("machine.reference", train_in(scene.machine).reference_speed_rad_s);
  }
  std::vector<kinetics::EffectInfo> effects(const Machine& machine) const override {
    return kinetics::drive_train_effects(train_in(machine));
  }
  std::optional<kinetics::LoadHistory> start_up(const Scene& scene, const Machine& machine) const override {
    if (!scene.torsion.transient) return std::nullopt;
    const auto effects = scene.kinetics_effects();
    const auto train = kinetics::with_effects(train_in(machine), effects);
    auto loads = kinetics::compute_transient_loads(train_in(machine), effects, transient_run(scene.torsion));
    Eigen::ArrayXd largest_Nm(train.elements.size());
    for (std::size_t e = 0; e < train.elements.size(); ++e)
      largest_Nm[Eigen::Index(e)] =
          loads.quantity(train.elements[e].name + ".torque").values.abs().maxCoeff();
    if (const auto coarse = coarse_transient(train, scene.torsion, largest_Nm))
      loads.warnings.push_back(*coarse);
    return loads;
  }
  std::optional<kinetics::LoadHistory> loads_passed_over(const Scene& scene,
                                                         const Machine& machine) const override {
    return kinetics::loads_between_instants(train_in(machine), scene.kinetics_effects(), scene.sampling);
  }
  std::vector<kinetics::CourseFigures> figures_over_the_course(
      const Scene& scene, const Machine& machine, const kinetics::TimeGrid& grid,
      const kinetics::LoadHistory& at_instants) const override {
    return kinetics::figures_over_the_course(train_in(machine), scene.kinetics_effects(), grid, &at_instants);
  }
  std::string why_no_run_up_of_given_duration() const override {
    return "a train's start is [machine.transient], which says how long it takes; leave it out";
  }
  bool is_headline(const std::string& quantity) const override {
    return ends_with(quantity, ".torque") || ends_with(quantity, ".shear_stress");
  }
  bool is_torsional() const override { return true; }
  std::vector<double> natural_frequencies_rad_s(const Machine& machine) const override {
    const auto modes = kinetics::natural_modes(train_in(machine), kinetics::Shapes::none);
    return {modes.frequency_rad_s.begin(), modes.frequency_rad_s.end()};
  }

protected:
  void check_without_masses(const Machine& machine) const override {
    const auto& train = train_in(machine);
    kinetics::mean_speed_rad_s(train, train.inertias.at(0).name);
  }
};

}  // namespace

const MachineKind& drive_train_kind() {
  static const DriveTrainKind kind;
  return kind;
}

}  // namespace pipelines

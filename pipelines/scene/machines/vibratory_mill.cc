#include <cmath>

#include "pipelines/base/names/name_lists.h"
#include "pipelines/scene/machines/kinds.h"
#include "pipelines/scene/machines/vibratory_mill_reader.h"
#include "pipelines/scene/reader/scene_effects.h"
#include "pipelines/scene/values/effect_names.h"
#include "pipelines/scene/whole/plausibility.h"

namespace pipelines {
namespace {

/// Mills of this kind run at 3 to 12 g, eccentric ones of high energy at up to 16 g.
constexpr double most_vibratory_m_s2 = 20 * 9.81;

/// Effects of kinetics under the convention; what is known under the other one only is refused with that
/// reason.
EffectRules vibratory_mill_rules(kinetics::Convention convention, const SceneTable& root) {
  using kinetics::Convention;
  const bool is_published = convention == Convention::published;
  EffectRules rules{kinetics::vibratory_mill_effects(convention)};
  add_own_effects(rules, "vibratory_mill", root);
  const Convention other = is_published ? Convention::consistent : Convention::published;
  for (const auto& name : names_of(kinetics::vibratory_mill_effects(other)))
    if (!has_effect(rules.table, name))
      rules.refused.push_back({name, "unknown under convention \"" +
                                         std::string(is_published ? "published" : "consistent") +
                                         "\", only under the other one; remove it, or change "
                                         "machine.convention"});
  return rules;
}

/// The published formulas leave out terms that a body would feel as a resultant without a counterpart.
void refuse_published(SceneTable& machine, const kinetics::VibratoryMill& mill) {
  const double omega2 = mill.speed_rad_s * mill.speed_rad_s;
  const auto kN = [](double force_N) { return shown(std::round(force_N / 10) / 100) + " kN"; };
  machine.refuse("convention",
                 "the published formulas do not close: they leave out m r omega^2 = " +
                     kN(mill.charge_mass_kg * mill.charge_offset_m * omega2) +
                     " of the charge and (m1 + m2) ecc omega^2 = " +
                     kN((mill.structure_mass_kg + mill.exciter_mass_kg) * mill.eccentricity_m * omega2) +
                     " of the moving structure, which a body in equilibrium needs; write \"consistent\", or "
                     "remove the bodies for "
                     "the load stage alone");
}

class VibratoryMillKind : public MachineKind {
public:
  std::string type() const override { return "vibratory_mill"; }

  void read(SceneReading& reading) const override {
    auto& [root, machine, scene, findings, bodies] = reading;
    const auto convention = read_convention(machine);
    EffectRules rules = vibratory_mill_rules(convention, root);
    if (!machine.has("charge") || !machine.table("charge").has("lag"))
      rules.lacking = {effect_name::charge_lag};
    if (!machine.has("springs"))
      for (const char* effect : {effect_name::springs, effect_name::spring_damping})
        rules.lacking.push_back(effect);
    read_effects(root, rules, scene, findings);
    scene.run_up = read_run_up(machine);
    auto mill = read_vibratory_mill(machine, convention, scene.effects, scene.milling_space,
                                    root.has("chamber") ? &scene.masses_from_mesh : nullptr);
    const bool has_bodies = root.has("shaft") || root.has("chamber");
    if (scene.run_up && has_bodies)
      machine.refuse("run_up", "a run-up belongs to the load stage; remove it, or the bodies, so far");
    if (convention == kinetics::Convention::published && has_bodies) refuse_published(machine, mill);
    scene.machine = std::move(mill);
  }
  Period period(const Scene& scene, int most_turns, bool) const override {
    const auto& mill = scene.vibratory_mill();
    if (!std::isfinite(mill.speed_rad_s) || !std::isfinite(mill.charge_relative_speed_rad_s))
      return {false, 0};
    return {true, kinetics::period_in_turns(mill, most_turns).value_or(0)};
  }
  void doubt(const Scene& scene, Doubts& doubts) const override {
    const auto& mill = scene.vibratory_mill();
    double speed_rad_s = mill.speed_rad_s;
    if (scene.run_up)
      for (const double speed : scene.run_up->speed_rad_s) speed_rad_s = std::max(speed_rad_s, speed);
    doubts.speed("machine.drive", speed_rad_s);
    doubts.acceleration("the chamber", mill.eccentricity_m * speed_rad_s * speed_rad_s, most_vibratory_m_s2);
  }
  std::optional<kinetics::LoadHistory> rehearse(const Scene& scene) const override {
    if (!scene.run_up) return MachineKind::rehearse(scene);
    kinetics::check_run_up(scene.vibratory_mill(), scene.kinetics_effects(), *scene.run_up);
    return std::nullopt;
  }
  std::vector<kinetics::EffectInfo> effects(const Machine& machine) const override {
    return kinetics::vibratory_mill_effects(std::get<kinetics::VibratoryMill>(machine).convention);
  }
  kinetics::LoadHistory loads(const Scene& scene, const Machine& machine) const override {
    if (!scene.run_up) return MachineKind::loads(scene, machine);
    return kinetics::compute_run_up(scene.vibratory_mill(), scene.kinetics_effects(), *scene.run_up);
  }
  std::optional<kinetics::LoadHistory> start_up(const Scene& scene, const Machine& machine) const override {
    if (!scene.run_up) return std::nullopt;
    return kinetics::compute_run_up(std::get<kinetics::VibratoryMill>(machine), scene.kinetics_effects(),
                                    *scene.run_up);
  }
  std::string why_no_run_up_of_given_duration() const override { return ""; }
  double drive_speed_rad_s(const Machine& machine) const override {
    return std::get<kinetics::VibratoryMill>(machine).speed_rad_s;
  }
  std::vector<kinetics::Spring> springs(const Machine& machine) const override {
    return std::get<kinetics::VibratoryMill>(machine).springs;
  }
  bool is_headline(const std::string& quantity) const override {
    return contains({"R_E", "R_E_shaft", "X_E", "Y_E", "B", "T", "T_shaft", "theta", "spring_force",
                     "spring_force_from_moments", "drive_power"},
                    quantity);
  }
};

}  // namespace

const MachineKind& vibratory_mill_kind() {
  static const VibratoryMillKind kind;
  return kind;
}

}  // namespace pipelines

#include "pipelines/base/names/name_lists.h"
#include "pipelines/scene/machines/kinds.h"
#include "pipelines/scene/machines/planetary_mill_reader.h"
#include "pipelines/scene/reader/scene_effects.h"
#include "pipelines/scene/values/effect_names.h"
#include "pipelines/scene/whole/plausibility.h"

namespace pipelines {
namespace {

/// Mills of laboratories end there.
constexpr double most_planetary_m_s2 = 100 * 9.81;

/// The one effect that has two names under the conventions is refused under the wrong one.
EffectRules planetary_mill_rules(kinetics::PlanetaryConvention convention) {
  const bool is_consistent = convention == kinetics::PlanetaryConvention::consistent;
  EffectRules rules{kinetics::planetary_mill_effects(convention)};
  rules.refused.push_back(
      {is_consistent ? effect_name::charge_relative : effect_name::charge_offset,
       is_consistent ? "is called \"charge_offset\" under the convention \"consistent\", where it is the "
                       "transport inertia of the centroid; write that"
                     : "is called \"charge_relative\" under the paper's conventions; write that"});
  return rules;
}

const kinetics::PlanetaryMill& mill_in(const Scene& scene) {
  return std::get<kinetics::PlanetaryMill>(scene.machine);
}

class PlanetaryMillKind : public MachineKind {
public:
  static constexpr const char* turning = "trunnions_turning";

  std::string type() const override { return "planetary_mill"; }

  void read(SceneReading& reading) const override {
    auto& [root, machine, scene, findings, bodies] = reading;
    const auto convention = read_planetary_convention(machine);
    EffectRules rules = planetary_mill_rules(convention);
    add_own_effects(rules, type(), root);
    for (const auto& effect : rules.table)
      if ((effect.name == effect_name::belt && !machine.has("belt")) ||
          (effect.name.rfind("charge_", 0) == 0 && !machine.has("charge")))
        rules.lacking.push_back(effect.name);
    read_effects(root, rules, scene, findings);
    bool from_mesh = false;
    scene.machine =
        read_planetary_mill(machine, convention, scene.effects, scene.drum_axes, root.has("drum"), from_mesh);
    if (from_mesh) scene.masses_from_mesh.push_back("drum");
  }
  void check_bodies(const Scene& scene, std::vector<SceneTable>& bodies) const override {
    if (scene.body("drum") && scene.body("axle"))
      bodies.back().refuse_missing("", "a drum with trunnions needs no stub axle: analyse one of the two");
  }
  /// Loads repeat in the carrier's frame every turn; seen from the drum after a few.
  Period period(const Scene& scene, int most_turns, bool is_sound) const override {
    if (!scene.drum_axes || !is_sound) return {};
    return {true, kinetics::period_in_turns(mill_in(scene), most_turns).value_or(0)};
  }
  void doubt(const Scene& scene, Doubts& doubts) const override {
    const auto& mill = mill_in(scene);
    const auto lengths = kinetics::planetary_geometry(mill);
    doubts.speed("machine.carrier", mill.speed_rad_s);
    doubts.acceleration("a drum's centre", lengths.carrier_m * mill.speed_rad_s * mill.speed_rad_s,
                        most_planetary_m_s2);
    if (scene.has_effect(effect_name::belt))
      doubts.peripheral("the belt", mill.speed_rad_s * lengths.central_pulley_m);
  }
  /// The conventions of the paper leave a resultant, unless they agree with the consistent one.
  void refuse_open_balance(const Scene& scene, SceneTable& machine) const override {
    if (mill_in(scene).convention == kinetics::PlanetaryConvention::consistent) return;
    if (!scene.masses_from_mesh.empty()) return;
    const auto loads = compute_loads(scene.machine, scene.kinetics_effects(), {1, 360});
    const double force = loads.quantity("closure_force").values.maxCoeff(),
                 moment = loads.quantity("closure_moment").values.maxCoeff();
    if (force <= 1e-12 && moment <= 1e-12) return;
    machine.refuse("convention", "leaves " + shown(100 * force, 2) + " % of the forces and " +
                                     shown(100 * moment, 2) +
                                     " % of the moments without a counterpart, which a body in equilibrium "
                                     "needs; write \"consistent\", or remove the bodies for the load stage "
                                     "alone");
  }
  std::vector<std::string> added_loads(const Scene& scene) const override {
    return scene.drum_axes ? std::vector<std::string>{turning} : std::vector<std::string>{};
  }
  std::vector<kinetics::EffectInfo> effects(const Machine& machine) const override {
    return kinetics::planetary_mill_effects(std::get<kinetics::PlanetaryMill>(machine).convention);
  }
  /// Loads with what a trunnion that turns with the drum feels: constant loads of the carrier's frame reverse
  /// fully.
  kinetics::LoadHistory loads(const Scene& scene, const Machine& machine) const override {
    auto loads = MachineKind::loads(scene, machine);
    if (!scene.drum_axes) return loads;
    auto turned = kinetics::turned_with_drum(loads, loads.resultant("trunnions"));
    turned.role = turning;
    turned.description = "the same load in axes that turn with the drum";
    loads.resultants.push_back(std::move(turned));
    return loads;
  }
  bool is_headline(const std::string& quantity) const override {
    return contains({"X_A", "Y_A", "R_A", "M_A", "T1", "T2", "belt_power"}, quantity);
  }

protected:
  void check_without_masses(const Machine& machine) const override {
    kinetics::planetary_geometry(std::get<kinetics::PlanetaryMill>(machine));
  }
};

}  // namespace

const MachineKind& planetary_mill_kind() {
  static const PlanetaryMillKind kind;
  return kind;
}

}  // namespace pipelines

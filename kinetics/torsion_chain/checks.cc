#include "kinetics/torsion_chain/checks.h"

#include <algorithm>
#include <set>

#include "kinetics/torsion_chain/effects.h"
#include "kinetics/values/machine_refused.h"
#include "kinetics/values/wrong_input.h"

namespace kinetics::torsion {
namespace {

void require_positive(const std::string& parameter, double value, const std::string& meaning) {
  require_finite(parameter, value);
  if (!(value > 0)) refuse(parameter, value, "must be positive; give " + meaning);
}

void require_not_negative(const std::string& parameter, double value, const std::string& meaning) {
  require_finite(parameter, value);
  if (value < 0) refuse(parameter, value, "must not be negative; give " + meaning);
}

void require_name(const std::string& what, const std::string& name, std::set<std::string>& taken) {
  if (name.empty()) throw MachineRefused(what + ": has no name; give it one");
  if (!taken.insert(name).second)
    throw MachineRefused(what + ": the name " + name + " is taken; names are unique within a train");
}

void check_shaft_data(const TrainElement& e) {
  const std::string name = e.name + ".";
  require_not_negative(name + "diameter", e.diameter_m, "the shaft's outer diameter");
  require_not_negative(name + "bore", e.bore_m, "the shaft's inner diameter");
  if (e.bore_m > 0 && e.bore_m >= e.diameter_m)
    refuse(name + "bore", e.bore_m, "must be smaller than diameter = " + number(e.diameter_m));
  require_finite(name + "stress_concentration", e.stress_concentration);
  if (e.stress_concentration < 1)
    refuse(name + "stress_concentration", e.stress_concentration,
           "must be at least 1: the nominal stress times K_t is the peak");
  if (e.rigid || e.stiffness_N_m_rad) return;
  require_positive(name + "shear_modulus", e.shear_modulus_Pa, "stiffness or the shear modulus");
  require_positive(name + "length", e.length_m, "stiffness or the segment's length");
  require_positive(name + "diameter", e.diameter_m, "stiffness or the shaft's diameter");
}

void check_transmission(const DriveTrain& train, const TrainElement& e) {
  if (e.diameter_m != 0 || e.bore_m != 0)
    refuse(e.name + ".diameter", e.diameter_m,
           "belts and gears have no shear stress of a shaft; give the diameter to a shaft segment");
  if (e.rigid) return;
  if (!e.stiffness_N_m_rad)
    throw MachineRefused(e.name + ".stiffness: missing; give it, or say that it is rigid");
  const std::string& first = train.inertias[inertia_at(train, e.first, e.name + ".first")].shaft;
  const std::string& second = train.inertias[inertia_at(train, e.second, e.name + ".second")].shaft;
  if (e.stiffness_on != first && e.stiffness_on != second)
    throw MachineRefused(e.name + ".stiffness_on = \"" + e.stiffness_on +
                         "\": the stiffness of a belt or gear refers to one of its shafts; give \"" + first +
                         "\" or \"" + second + "\"");
}

void check_element(const DriveTrain& train, const TrainElement& e) {
  const std::string name = e.name + ".";
  if (inertia_at(train, e.first, name + "first") == inertia_at(train, e.second, name + "second"))
    throw MachineRefused(name + "second = " + e.second + ": joins an inertia with itself");
  require_finite(name + "ratio", e.ratio);
  if (e.ratio == 0)
    refuse(name + "ratio", e.ratio, "must not be zero; give speed of second / speed of first");
  if (e.kind == ElementKind::shaft && e.ratio != 1)
    refuse(name + "ratio", e.ratio, "a shaft has one speed; make it a belt or gear, or take the ratio out");
  if (e.stiffness_N_m_rad)
    require_positive(name + "stiffness", *e.stiffness_N_m_rad,
                     "the torsional stiffness, or say that the element is rigid");
  require_not_negative(name + "damping", e.damping_N_m_s, "the viscous damping");
  require_not_negative(name + "loss_factor", e.loss_factor, "the structural loss factor");
  if (e.rigid && (e.stiffness_N_m_rad || e.damping_N_m_s != 0 || e.loss_factor != 0))
    throw MachineRefused(name + "rigid: a rigid element has no stiffness and no damping; take them out");
  e.kind == ElementKind::shaft ? check_shaft_data(e) : check_transmission(train, e);
}

/// A frequency, or an order of a shaft line: exactly one of both.
void check_rhythm(const DriveTrain& train, const std::string& name,
                  const std::optional<double>& frequency_rad_s, const std::optional<double>& order,
                  const std::string& order_of) {
  if (bool(frequency_rad_s) == bool(order))
    throw MachineRefused(name + ": frequency and order are " + (order ? "both given" : "both missing") +
                         "; it needs exactly one of them");
  if (frequency_rad_s)
    require_positive(name + ".frequency", *frequency_rad_s, "a constant torque by its key constant");
  if (!order) return;
  require_positive(name + ".order", *order, "a constant torque by its key constant");
  const auto on_it = [&](const TrainInertia& i) { return order_of.empty() || i.shaft == order_of; };
  if (std::any_of(train.inertias.begin(), train.inertias.end(), on_it)) return;
  std::vector<std::string> shafts;
  for (const auto& inertia : train.inertias) shafts.push_back(inertia.shaft);
  throw MachineRefused(name + ".order_of = \"" + order_of + "\": no such shaft line; did you mean " +
                       nearest(order_of, shafts) + "?");
}

}  // namespace

Eigen::Index inertia_at(const DriveTrain& train, const std::string& name, const std::string& asked_by) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < train.inertias.size(); ++i) {
    if (train.inertias[i].name == name) return static_cast<Eigen::Index>(i);
    names.push_back(train.inertias[i].name);
  }
  throw MachineRefused(asked_by + " = \"" + name + "\": no inertia of that name; did you mean " +
                       nearest(name, names) + "?");
}

void check_parameters(const DriveTrain& train) {
  if (train.inertias.empty()) throw MachineRefused("inertias: none given; a train has at least one");
  std::set<std::string> taken;
  const TrainInertia* held = nullptr;
  for (const TrainInertia& inertia : train.inertias) {
    require_name("an inertia", inertia.name, taken);
    require_not_negative(inertia.name + ".inertia", inertia.inertia_kg_m2, "the inertia");
    require_not_negative(inertia.name + ".damping", inertia.damping_N_m_s, "the viscous damping");
    if (inertia.held && held)
      throw MachineRefused(inertia.name + ".held: " + held->name +
                           " is held too, so that statics cannot tell the mean torque between them; "
                           "hold one of them");
    if (inertia.held) held = &inertia;
  }
  for (const TrainElement& e : train.elements) require_name("an element", e.name, taken);
  for (const TrainElement& e : train.elements) check_element(train, e);
  require_positive("reference_speed", train.reference_speed_rad_s, "the mean speed of the reference shaft");
  require_not_negative("modal_damping_ratio", train.modal_damping_ratio, "the damping ratio of the modes");
}

void check_excitations(const DriveTrain& train) {
  std::set<std::string> taken;
  for (const EffectInfo& damping : damping_effects()) taken.insert(damping.name);
  for (const TrainExcitation& x : train.excitations) {
    require_name("an excitation", x.name, taken);
    inertia_at(train, x.inertia, x.name + ".inertia");
    require_finite(x.name + ".constant", x.constant_Nm);
    for (std::size_t k = 0; k < x.harmonics.size(); ++k) {
      const TorqueHarmonic& h = x.harmonics[k];
      const std::string name = x.name + ".harmonic_" + std::to_string(k + 1);
      require_finite(name + ".amplitude", h.amplitude_Nm);
      require_finite(name + ".phase", h.phase_rad);
      check_rhythm(train, name, h.frequency_rad_s, h.order, h.order_of);
    }
    if (x.table.torque_Nm.empty()) continue;
    for (const double torque_Nm : x.table.torque_Nm) require_finite(x.name + ".table.torque", torque_Nm);
    check_rhythm(train, x.name + ".table", x.table.frequency_rad_s, x.table.order, x.table.order_of);
  }
}

void check_effects(const DriveTrain& train, const std::vector<std::string>& effects) {
  const std::vector<EffectInfo> table = drive_train_effects(train);
  std::vector<std::string> known;
  for (const EffectInfo& info : table) known.push_back(info.name);
  std::set<std::string> seen;
  for (const std::string& effect : effects) {
    if (std::find(known.begin(), known.end(), effect) == known.end())
      throw MachineRefused("effect " + effect + ": this train has none of that name" +
                           (known.empty() ? "" : "; did you mean " + nearest(effect, known)) +
                           "? Known: " + listed(known));
    if (!seen.insert(effect).second)
      throw MachineRefused("effect " + effect + ": named twice; it counts once, take one out");
  }
  require_needs(table, effects);
}

}  // namespace kinetics::torsion

#include "pipelines/scene/machines/drive_train_reader.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "pipelines/base/names/nearest_name.h"

namespace pipelines {
namespace {

using kinetics::DriveTrain;
using kinetics::ElementKind;

constexpr double most_stiffness_N_m_rad = 1e15;
constexpr double most_ratio = 1e4;  // worm gears end at a few hundred
const Range torques = between(-1e12, 1e12);

/// A value that is zero, silently, where the scene does not give it.
double quantity_or_zero(SceneTable& table, const std::string& name, const std::string& unit,
                        const Range& range) {
  return table.quantity_if_given(name, unit, range).value_or(0);
}

/// Names are unique over inertias and elements, and over excitations.
void refuse_second(SceneTable& table, const std::string& name, std::set<std::string>& taken) {
  if (!name.empty() && !taken.insert(name).second)
    table.refuse("name", "is the name of two; names are unique within a train: rename one");
}

std::string text_if_given(SceneTable& table, const std::string& name) {
  return table.is_given(name) ? table.text(name) : "";
}

bool flag_if_given(SceneTable& table, const std::string& name) {
  return table.is_given(name) && table.flag_or(name, false, "");
}

kinetics::TrainInertia read_inertia(SceneTable& table, std::vector<std::string>& masses_from_mesh) {
  kinetics::TrainInertia inertia;
  inertia.name = table.name("name");
  inertia.shaft = table.name("shaft");
  if (flag_if_given(table, "from_mesh")) {
    masses_from_mesh.push_back(inertia.name);
    if (table.is_given("inertia"))
      table.refuse("inertia", "is given, and left to the mesh by from_mesh; keep one");
    inertia.inertia_kg_m2 = 1;  // until the mesh is there
  } else {
    inertia.inertia_kg_m2 = table.quantity("inertia", "kg m2", not_negative(1e12));
    if (inertia.inertia_kg_m2 > 0 && inertia.inertia_kg_m2 < 1e-15)
      table.refuse("inertia", "must be 0, or at least 1e-15 kg m2; check the number and its unit");
  }
  inertia.damping_N_m_s = quantity_or_zero(table, "damping", "N m s/rad", not_negative(1e12));
  inertia.held = flag_if_given(table, "held");
  table.finish();
  return inertia;
}

/// Reads the ratio of a belt or gear, which has limits: behind several of them speeds and reduced inertias go
/// with its powers.
double read_ratio(SceneTable& table) {
  const double ratio = table.ratio("ratio");
  if (std::abs(ratio) > most_ratio || (ratio != 0 && std::abs(ratio) < 1 / most_ratio))
    table.refuse("ratio", "is no ratio that one stage can have: its size must lie between " +
                              shown(1 / most_ratio) + " and " + shown(most_ratio) + "; check the number");
  return ratio;
}

kinetics::TrainElement read_element(SceneTable& table) {
  kinetics::TrainElement element;
  element.name = table.name("name");
  const std::string kind = table.text("kind");
  if (kind == "belt")
    element.kind = ElementKind::belt;
  else if (kind == "gear")
    element.kind = ElementKind::gear;
  else if (!kind.empty() && kind != "shaft")
    table.refuse("kind", "unknown element; write \"shaft\", \"belt\" or \"gear\"");
  const auto between_names = table.texts("between");
  if (table.has("between") && between_names.size() != 2)
    table.refuse("between", "joins " + std::to_string(between_names.size()) +
                                " inertias; name two, the driving one first");
  if (between_names.size() == 2) {
    element.first = between_names[0].text;
    element.second = between_names[1].text;
  }
  table.know("ratio");
  if (kind != "shaft" || table.has("ratio")) element.ratio = read_ratio(table);
  element.rigid = flag_if_given(table, "rigid");
  element.stiffness_N_m_rad =
      table.quantity_if_given("stiffness", "N m/rad", between(1e-9, most_stiffness_N_m_rad));
  element.stiffness_on = text_if_given(table, "stiffness_on");
  element.damping_N_m_s = quantity_or_zero(table, "damping", "N m s/rad", not_negative(1e12));
  element.loss_factor = quantity_or_zero(table, "loss_factor", "1", not_negative(10));
  element.shear_modulus_Pa = quantity_or_zero(table, "shear_modulus", "Pa", positive(1e13));
  element.length_m = quantity_or_zero(table, "length", "m", positive(1e4));
  element.diameter_m = quantity_or_zero(table, "diameter", "m", positive(100));
  element.bore_m = quantity_or_zero(table, "bore", "m", not_negative(100));
  element.stress_concentration =
      table.quantity_if_given("stress_concentration", "1", between(1, 100)).value_or(1);
  table.finish();
  return element;
}

/// "frequency" or "order" with "order_of".
template <typename Course>
void read_rate(SceneTable& table, Course& course) {
  course.frequency_rad_s = table.quantity_if_given("frequency", "rad/s", positive(1e9));
  course.order = table.quantity_if_given("order", "1", positive(1e6));
  course.order_of = text_if_given(table, "order_of");
  if (course.frequency_rad_s && course.order)
    table.refuse("order", "says the same as frequency; keep one of the two");
  else if (!course.frequency_rad_s && !course.order)
    table.refuse_missing(
        "frequency",
        "is missing, and so is order; add one of them: a frequency (\"50 Hz\"), or periods per "
        "turn of a shaft");
}

kinetics::TrainExcitation read_excitation(SceneTable& table) {
  kinetics::TrainExcitation excitation;
  excitation.name = table.name("name");
  excitation.inertia = table.text("inertia");
  excitation.constant_Nm = quantity_or_zero(table, "constant", "N m", torques);
  for (SceneTable& entry : table.tables_if_any("harmonics")) {
    kinetics::TorqueHarmonic harmonic;
    harmonic.amplitude_Nm = entry.quantity("amplitude", "N m", torques);
    harmonic.phase_rad = quantity_or_zero(entry, "phase", "rad", any_angle());
    read_rate(entry, harmonic);
    entry.finish();
    excitation.harmonics.push_back(harmonic);
  }
  if (table.is_given("table")) {
    SceneTable entry = table.table("table");
    excitation.table.torque_Nm = entry.list("torques", "N m", torques);
    read_rate(entry, excitation.table);
    entry.finish();
  }
  table.finish();
  return excitation;
}

void read_campbell(SceneTable campbell, double speed_rad_s, TorsionScene& torsion) {
  torsion.slowest_rad_s = campbell.quantity_or("slowest", "rad/s", not_negative(1e6), 0, "from standstill");
  torsion.fastest_rad_s = campbell.quantity_or("fastest", "rad/s", positive(1e6), 1.5 * speed_rad_s,
                                               "half as fast again as the operating speed");
  torsion.n_speeds = campbell.count_or("speeds", 2, 10'000, 16, "rows of the table");
  if (campbell.is_given("orders")) torsion.orders = campbell.list("orders", "1", positive(1e6));
  if (torsion.fastest_rad_s <= torsion.slowest_rad_s)
    campbell.refuse("fastest", "must exceed the slowest speed; raise it");
  campbell.finish();
}

void read_transient(SceneTable& machine, TorsionScene& torsion) {
  if (!machine.is_given("transient")) return;
  SceneTable table = machine.table("transient");
  kinetics::TransientRun run;
  const double duration_s = table.quantity("duration", "s", positive(1e6));
  run.time_step_s = table.quantity("step", "s", positive(1e3));
  run.store_every = table.count_or("store_every", 1, 1'000'000, 1, "every step is written");
  run.with_excitations = table.flag_or("excitations", true, "the train's excitations act from t = 0");
  run.loss_frequency_rad_s = quantity_or_zero(table, "loss_frequency", "rad/s", positive(1e9));
  const double n_steps = duration_s / run.time_step_s;
  if (n_steps > 1e8)
    table.refuse("step",
                 "makes " + shown(n_steps, 3) + " steps; at most 1e8 are followed, take a longer one");
  else if (std::isfinite(n_steps))
    run.n_steps = std::max(1L, std::lround(n_steps));
  for (SceneTable& entry : table.tables_if_any("torques")) {
    TorsionScene::Torque torque;
    torque.inertia = entry.text("inertia");
    torque.time_s = entry.list("times", "s", between(0, 1e6));
    torque.torque_Nm = entry.list("torques", "N m", torques);
    if (torque.time_s.size() != torque.torque_Nm.size())
      entry.refuse("torques", "has " + std::to_string(torque.torque_Nm.size()) + " entries where times has " +
                                  std::to_string(torque.time_s.size()) + "; give one torque for each time");
    entry.finish();
    torsion.torques.push_back(std::move(torque));
  }
  table.finish();
  torsion.transient = run;
}

/// An inertia of 0 is one only together with what rigid elements join it to.
void refuse_massless(std::vector<SceneTable>& tables, const DriveTrain& train) {
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const auto& inertia = train.inertias[i];
    const auto is_joined = [&](const kinetics::TrainElement& element) {
      return element.rigid && (element.first == inertia.name || element.second == inertia.name);
    };
    if (inertia.inertia_kg_m2 == 0 && std::none_of(train.elements.begin(), train.elements.end(), is_joined))
      tables[i].refuse("inertia",
                       "must be positive where no rigid element joins it to an inertia: write 1e-12, which "
                       "vibrates so fast by itself that nothing else feels it");
  }
}

}  // namespace

kinetics::DriveTrain read_drive_train(SceneTable& machine, TorsionScene& torsion,
                                      std::vector<std::string>& masses_from_mesh) {
  DriveTrain train;
  const std::string convention = machine.text_or(
      "convention", "consistent", "mechanics that closes; \"published\" adds the paper's own tables");
  torsion.published_tables = convention == "published";
  if (!convention.empty() && convention != "consistent" && convention != "published")
    machine.refuse(
        "convention",
        "unknown convention; write \"consistent\" (mechanics that closes) or \"published\" (the same, "
        "and the paper's Tables 1 to 7 beside it)");
  SceneTable reference = machine.table("reference");
  train.reference_shaft = reference.text("shaft");
  train.reference_speed_rad_s = reference.quantity("speed", "rad/s", positive(1e6));
  reference.finish();
  train.modal_damping_ratio = quantity_or_zero(machine, "modal_damping", "1", between(0, 0.999));
  std::set<std::string> taken, shafts;
  auto inertias = machine.tables("inertias");
  for (SceneTable& table : inertias) {
    train.inertias.push_back(read_inertia(table, masses_from_mesh));
    refuse_second(table, train.inertias.back().name, taken);
    shafts.insert(train.inertias.back().shaft);
  }
  for (SceneTable& table : machine.tables("elements")) {
    train.elements.push_back(read_element(table));
    refuse_second(table, train.elements.back().name, taken);
  }
  refuse_massless(inertias, train);
  taken.clear();
  for (SceneTable& table : machine.tables("excitations")) {
    train.excitations.push_back(read_excitation(table));
    refuse_second(table, train.excitations.back().name, taken);
  }
  if (!train.reference_shaft.empty() && shafts.count(train.reference_shaft) == 0)
    reference.refuse("shaft", "no inertia sits on this shaft; write one of " +
                                  listed(std::vector<std::string>(shafts.begin(), shafts.end())));
  read_campbell(machine.table_or_empty("campbell"), train.reference_speed_rad_s, torsion);
  read_transient(machine, torsion);
  machine.finish();
  return train;
}

void check_start_up_instants(SceneTable& machine, const kinetics::DriveTrain& train,
                             const TorsionScene& torsion) {
  if (!torsion.transient) return;
  constexpr long most_instants = 50'000, most_numbers = 40'000'000;
  const auto& run = *torsion.transient;
  const std::size_t n_parts = (run.with_excitations ? train.excitations.size() : 0) + torsion.torques.size();
  // Force and torque, 3 numbers, on both inertias of an element, in total and by part.
  const long per_instant = std::max(1L, long(train.elements.size() * 2 * 3 * (n_parts + 1)));
  const long most = std::clamp(most_numbers / per_instant, 2L, most_instants);
  const long n_instants = run.n_steps / run.store_every + 1;
  if (n_instants <= most) return;
  const long enough = (run.n_steps + most - 2) / (most - 1);
  SceneTable table = machine.table("transient");
  table.refuse(table.has("store_every") ? "store_every" : "step",
               "stores " + std::to_string(n_instants) +
                   " instants, and [shaft] takes its loads at each; at most " + std::to_string(most) +
                   " fit; write store_every = " + std::to_string(enough) +
                   ", take a longer step or a shorter duration, or remove [shaft]");
}

kinetics::TransientRun transient_run(const TorsionScene& torsion) {
  auto run = torsion.transient.value();
  for (const auto& torque : torsion.torques)
    run.loads.push_back({torque.inertia, kinetics::torque_table(torque.time_s, torque.torque_Nm)});
  return run;
}

}  // namespace pipelines

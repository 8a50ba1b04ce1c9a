#include "pipelines/judge/verdict/torsion_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/finite.h"
#include "pipelines/base/common/refusal_of.h"
#include "pipelines/loads/channels/load_figures.h"
#include "pipelines/scene/machines/coarse_transient.h"
#include "pipelines/scene/machines/drive_train_reader.h"

namespace pipelines {

namespace {

/// @throws NotFinite naming the first value that is not finite
void require_finite(const kinetics::PublishedTables& tables) {
  const auto check = [](const std::string& what, const auto& values) {
    if (!values.allFinite()) refuse_not_finite("torsion", what, "");
  };
  for (const auto& [name, table] : {std::pair("Table 4", &tables.table_4), {"Table 7", &tables.table_7}}) {
    check(fmt::format("a frequency of {} [rad/s]", name), table->frequency_rad_s);
    check(fmt::format("a mode of {}", name), table->mode);
    check(fmt::format("a forced angle of {} [rad]", name), table->forced_angle_rad);
    check(fmt::format("a forced angle of {} with the right sign [rad]", name), table->right_sign_angle_rad);
  }
}

/// Amplitude with which a frequency turns up in the elements' torques, over their largest.
double torque_share(const kinetics::ForcedResponse& forced, const std::vector<ElementTorque>& torques,
                    double frequency_rad_s) {
  constexpr double same = 1e-9;
  double most = 0;
  for (const auto& harmonic : forced.harmonics) {
    if (std::abs(harmonic.frequency_rad_s - frequency_rad_s) > same * frequency_rad_s) continue;
    for (std::size_t e = 0; e < torques.size(); ++e)
      if (torques[e].largest_Nm > 0)
        most = std::max(most, std::abs(harmonic.torque_Nm[Eigen::Index(e)]) / torques[e].largest_Nm);
  }
  return most;
}

TorsionReport report_of(const Scene& scene, const Machine& machine) {
  const auto* train = std::get_if<kinetics::DriveTrain>(&machine);
  if (!train)
    throw StageRefused(scene.machine_type_at +
                       ": torsion needs a scene whose machine.type is \"drive_train\"; see "
                       "pipelines/scenes/drive_train.toml");
  const auto effects = scene.kinetics_effects();
  const kinetics::DriveTrain on = kinetics::with_effects(*train, effects);
  TorsionReport report;
  report.modes = kinetics::natural_modes(on);
  report.forced = kinetics::forced_response(on);
  report.campbell = kinetics::campbell_table(on, scene.torsion.slowest_rad_s, scene.torsion.fastest_rad_s,
                                             scene.torsion.n_speeds, scene.torsion.orders);
  const auto history = compute_loads(machine, effects, scene.sampling);
  auto& warnings = report.forced.warnings;
  for (const auto& warning : history.warnings)  // the largest torques are those of the window
    if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
  const auto course = kinetics::figures_over_the_course(*train, effects, scene.sampling, &history);
  for (std::size_t e = 0; e < on.elements.size(); ++e) {
    const auto& name = on.elements[e].name;
    const auto largest = [&](const std::string& quantity) {
      const double at_instants = history.quantity(name + quantity).values.abs().maxCoeff();
      const auto* of = find_course(course, name + quantity);
      return of != nullptr ? std::max({at_instants, of->largest, -of->least}) : at_instants;
    };
    report.torques.push_back({name, report.forced.mean_torque_Nm[Eigen::Index(e)], largest(".torque"),
                              largest(".reduced_torque"),
                              on.elements[e].diameter_m > 0 ? largest(".shear_stress") : 0});
  }
  for (const auto& margin : kinetics::resonance_margins(on))
    report.margins.push_back(
        {margin, torque_share(report.forced, report.torques, margin.line.frequency_rad_s)});
  if (scene.torsion.transient) {
    report.transient = kinetics::transient(on, transient_run(scene.torsion));
    if (const auto coarse = coarse_transient(on, scene.torsion,
                                             report.transient->motion.torque_Nm.abs().rowwise().maxCoeff()))
      warnings.push_back(*coarse);
  }
  if (scene.torsion.published_tables) report.published = kinetics::published_tables(on);
  require_finite(report);
  return report;
}

}  // namespace

TorsionReport report_torsion(const Scene& scene, const Machine& machine) {
  return with_place(scene.machine_origin, [&] { return report_of(scene, machine); });
}

void require_finite(const TorsionReport& torsion) {
  const std::string stage = "torsion";
  const auto check = [&](const std::string& what, const auto& values) {
    if (values.size() > 0 && !values.allFinite()) refuse_not_finite(stage, what, "");
  };
  check("a natural frequency [rad/s]", torsion.modes.frequency_rad_s);
  check("a mode's shape", torsion.modes.shape);
  check("a mode's share of kinetic energy", torsion.modes.kinetic_share);
  check("a mode's share of potential energy", torsion.modes.potential_share);
  check("a mean torque [N m]", torsion.forced.mean_torque_Nm);
  for (const auto& harmonic : torsion.forced.harmonics) {
    check("a forced angle [rad]", harmonic.angle_rad.cwiseAbs().eval());
    check("a forced torque [N m]", harmonic.torque_Nm.cwiseAbs().eval());
  }
  for (const auto& t : torsion.torques)
    for (const double value : {t.mean_Nm, t.largest_Nm, t.largest_reduced_Nm, t.largest_shear_Pa})
      require_finite(stage, "the torque of \"" + t.element + "\" [N m] or its stress [Pa]", value);
  if (torsion.published) require_finite(*torsion.published);
  if (!torsion.transient) return;
  const auto& transient = *torsion.transient;
  check("a torque of the transient [N m]", transient.motion.torque_Nm);
  check("an angle of the transient [rad]", transient.motion.angle_rad);
  check("an energy of the transient [J]", (transient.kinetic_J + transient.potential_J).eval());
}

}  // namespace pipelines

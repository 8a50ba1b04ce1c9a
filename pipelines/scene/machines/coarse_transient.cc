#include "pipelines/scene/machines/coarse_transient.h"

#include <algorithm>
#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/scene/machines/drive_train_reader.h"
#include "pipelines/scene/whole/scene_findings.h"

namespace pipelines {

namespace {

/// The longest step that follows what is known to count.
double fine_step_s(const kinetics::DriveTrain& train, const TorsionScene& torsion) {
  constexpr double steps_per_period = 40, steps_per_line = 4;
  const auto& run = *torsion.transient;
  double step_s = run.time_step_s / 2;
  const auto follow = [&](double frequency_rad_s) {
    if (frequency_rad_s > 0) step_s = std::min(step_s, 2 * pi / frequency_rad_s / steps_per_period);
  };
  const auto natural = kinetics::natural_modes(train, kinetics::Shapes::none).frequency_rad_s;
  const auto elastic = std::find_if(natural.begin(), natural.end(), [](double w) { return w > 0; });
  if (elastic != natural.end()) follow(*elastic);
  if (run.with_excitations)
    for (const auto& harmonic : kinetics::forced_response(train).harmonics) follow(harmonic.frequency_rad_s);
  for (const auto& torque : torsion.torques)
    for (std::size_t i = 1; i < torque.time_s.size(); ++i)
      step_s = std::min(step_s, (torque.time_s[i] - torque.time_s[i - 1]) / steps_per_line);
  return step_s;
}

}  // namespace

std::optional<std::string> coarse_transient(const kinetics::DriveTrain& train, const TorsionScene& torsion,
                                            const Eigen::ArrayXd& largest_Nm) {
  constexpr double told_share = 0.05, negligible_share = 1e-3;
  constexpr double most_steps = 4e5, most_numbers = 2e6;
  const auto run = transient_run(torsion);
  const double duration_s = run.time_step_s * double(run.n_steps);
  auto finer = run;
  finer.n_steps =
      std::lround(std::clamp(std::ceil(duration_s / fine_step_s(train, torsion)), 2.0 * double(run.n_steps),
                             std::max(2.0 * double(run.n_steps), most_steps)));
  finer.time_step_s = duration_s / double(finer.n_steps);
  finer.store_every =
      std::max(1L, long(double(finer.n_steps) * double(train.inertias.size()) / most_numbers));
  const auto as_finer = kinetics::transient(train, finer).motion;
  const double scale = as_finer.reduced_torque_Nm.abs().maxCoeff();
  std::optional<std::string> warning;
  double worst = told_share;
  for (Eigen::Index e = 0; e < as_finer.torque_Nm.rows(); ++e) {
    if (!(as_finer.reduced_torque_Nm.row(e).abs().maxCoeff() > negligible_share * scale)) continue;
    const double finer_Nm = as_finer.torque_Nm.row(e).abs().maxCoeff();
    const double share = std::abs(largest_Nm[e] - finer_Nm) / finer_Nm;
    if (!(share > worst)) continue;
    worst = share;
    warning = "the transient's largest torque of " + train.elements[std::size_t(e)].name + " is " +
              shown(largest_Nm[e], 3) + " N m by the steps and stored instants that are asked for, " +
              shown(finer_Nm, 3) + " N m by steps of " + shown(finer.time_step_s, 2) +
              " s; take a shorter step, or store more of them";
  }
  return warning;
}

}  // namespace pipelines

#include "kinetics/planetary_mill.h"

#include <cmath>

#include "kinetics/planetary/balance.h"
#include "kinetics/planetary/checks.h"
#include "kinetics/planetary/feasibility.h"
#include "kinetics/planetary/hodograph.h"

namespace kinetics {
namespace {

/// @return warnings
std::vector<std::string> check(const PlanetaryMill& mill, const std::vector<std::string>& effects) {
  planetary::check_effects(mill.convention, effects);
  planetary::check_parameters(mill, effects);
  return planetary::check_feasibility(mill);
}

Eigen::Array3Xd turned(const Eigen::ArrayXd& angle_rad, const Eigen::Array3Xd& load) {
  const auto cosine = angle_rad.cos().transpose().eval(), sine = angle_rad.sin().transpose().eval();
  Eigen::Array3Xd seen(3, load.cols());
  seen.row(0) = cosine * load.row(0) + sine * load.row(1);
  seen.row(1) = cosine * load.row(1) - sine * load.row(0);
  seen.row(2) = load.row(2);
  return seen;
}

}  // namespace

LoadHistory compute_loads(const PlanetaryMill& mill, const std::vector<std::string>& effects,
                          const TimeGrid& grid) {
  const std::vector<std::string> warnings = check(mill, effects);
  check_grid(grid);
  const planetary::Machine machine = planetary::make_machine(mill);
  LoadHistory history = planetary::balance(machine, planetary::make_effects(machine, effects), grid);
  history.warnings.insert(history.warnings.begin(), warnings.begin(), warnings.end());
  return history;
}

std::optional<PlanetaryHodograph> hodograph(const PlanetaryMill& mill,
                                            const std::vector<std::string>& effects) {
  check(mill, effects);
  return planetary::ellipse(planetary::make_machine(mill), effects);
}

Resultant turned_with_drum(const LoadHistory& history, const Resultant& resultant) {
  const Eigen::ArrayXd& psi = history.quantity("psi").values;
  Resultant seen = resultant;
  seen.description += "; seen from axes that turn with the drum";
  seen.total = turned(psi, resultant.total);
  for (Contribution& part : seen.contributions) part.load = turned(psi, part.load);
  return seen;
}

std::optional<int> period_in_turns(const PlanetaryMill& mill, int most_turns) {
  const double ratio = planetary_geometry(mill).relative_speed_ratio;
  for (int q = 1; q <= most_turns; ++q)
    if (std::abs(ratio - std::round(ratio * q) / q) <= 1e-9) return q;
  return std::nullopt;
}

}  // namespace kinetics

#include <stdexcept>

#include "kinetics/drive_train.h"
#include "kinetics/torsion/spectrum.h"
#include "kinetics/torsion_chain/excitation.h"
#include "kinetics/values/wrong_input.h"

namespace kinetics {
namespace {

std::vector<ExcitationLine> lines_of(const DriveTrain& train, const torsion::ReducedTrain& reduced,
                                     const std::vector<double>& orders) {
  std::vector<ExcitationLine> lines;
  for (const auto& line : torsion::spectral(train, reduced).lines)
    lines.push_back({line.excitation, line.order, line.frequency_rad_s});
  for (const double order : orders) {
    require_finite("orders", order);
    if (order <= 0)
      refuse("orders", order, "must be positive; give multiples of the reference shaft's speed");
    lines.push_back({"", order, order * train.reference_speed_rad_s});
  }
  return lines;
}

}  // namespace

CampbellTable campbell_table(const DriveTrain& train, double slowest_rad_s, double fastest_rad_s,
                             int n_speeds, const std::vector<double>& orders) {
  require_finite("slowest", slowest_rad_s);
  require_finite("fastest", fastest_rad_s);
  if (slowest_rad_s < 0) refuse("slowest", slowest_rad_s, "must not be negative; give a range of speeds");
  if (fastest_rad_s <= slowest_rad_s)
    refuse("fastest", fastest_rad_s, "must exceed slowest = " + number(slowest_rad_s));
  if (n_speeds < 2) refuse("n_speeds", n_speeds, "must be at least 2; the range has two ends");
  const torsion::ReducedTrain reduced = torsion::reduce(train);
  CampbellTable table;
  table.speed_rad_s = Eigen::ArrayXd::LinSpaced(n_speeds, slowest_rad_s, fastest_rad_s);
  table.natural_frequency_rad_s = torsion::spectrum(reduced, false).frequency_rad_s;
  table.lines = lines_of(train, reduced, orders);
  table.line_frequency_rad_s.resize(static_cast<Eigen::Index>(table.lines.size()), n_speeds);
  for (std::size_t i = 0; i < table.lines.size(); ++i) {
    const ExcitationLine& line = table.lines[i];
    if (line.order == 0) {
      table.line_frequency_rad_s.row(i).setConstant(line.frequency_rad_s);
      continue;
    }
    table.line_frequency_rad_s.row(i) = (line.order * table.speed_rad_s).transpose();
    for (Eigen::Index k = 0; k < table.natural_frequency_rad_s.size(); ++k) {
      const double speed_rad_s = table.natural_frequency_rad_s[k] / line.order;
      if (speed_rad_s >= slowest_rad_s && speed_rad_s <= fastest_rad_s)
        table.crossings.push_back({line, k + (reduced.held ? 0 : 1), speed_rad_s});
    }
  }
  return table;
}

}  // namespace kinetics

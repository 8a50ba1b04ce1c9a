#include "pipelines/judge/estimates/time_sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "pipelines/base/common/constants.h"
#include "pipelines/superpose/between_instants/cycle_extremes.h"
#include "pipelines/superpose/between_instants/factor_spectrum.h"

namespace pipelines {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;

/// Polynomials through eight instants at twice the distance span as many.
constexpr Index least_for_pieces = 16;

/// Share of the sum of the channels' own stresses up to which the spectrum has no lines. Kinetics' angles
/// over a thousand turns are off by 1e-12.
constexpr double no_line = 1e-12;

/// Share of the largest value up to which an excess is the polynomial's rounding.
constexpr double no_excess = 64 * std::numeric_limits<double>::epsilon();

/// @param values  coordinates x instants, of size 1
CycleExtreme extreme_of(const ArrayXXd& values, SeriesKind kind) {
  if (kind == SeriesKind::transient && values.cols() >= least_for_pieces) return extreme_of_pieces(values);
  std::optional<CycleExtreme> of_polynomial;
  if (can_be_transformed(values.cols())) {
    const auto spectrum = factor_spectrum(values, no_line);
    const bool is_short = spectrum.lines.cols() <= most_lines;
    if (spectrum.is_resolved() && is_short) return extreme_of_polynomial(spectrum);
    if (values.cols() < least_for_pieces) return extreme_of_polynomial(spectrum);
    if (spectrum.is_decaying && is_short && is_closed(values))
      of_polynomial = extreme_of_polynomial(spectrum);
  }
  const auto of_pieces = extreme_of_pieces(values);
  const auto bound = [](const CycleExtreme& extreme) { return extreme.value + extreme.unresolved; };
  return of_polynomial && bound(*of_polynomial) < bound(of_pieces) ? *of_polynomial : of_pieces;
}

double largest_Pa(const Eigen::MatrixXd& coordinates, const ArrayXXd& values) {
  return std::sqrt((coordinates * values.matrix()).colwise().squaredNorm().maxCoeff());
}

Eigen::MatrixXd coordinates_of(const std::vector<std::array<double, 6>>& unit) {
  const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> tensors(unit.front().data(), 6,
                                                                           Index(unit.size()));
  return deviatoric_coordinates(tensors).matrix();
}

/// The polynomial of a spectrum of rows at `times` as many instants.
ArrayXXd denser_values(const FactorSpectrum& spectrum, Index times) {
  const Index m = times * spectrum.n_instants;
  ArrayXXd values = ArrayXXd::Zero(spectrum.lines.rows(), m);
  const Eigen::ArrayXd turn = Eigen::ArrayXd::LinSpaced(m, 0, double(m - 1)) * (2 * pi / double(m));
  for (Index h = 0; h < spectrum.lines.cols(); ++h) {
    const Eigen::VectorXcd line = spectrum.lines.col(h);
    if (line.isZero(0)) continue;
    const Eigen::RowVectorXd cosine = (double(h) * turn).cos().matrix().transpose(),
                             sine = (double(h) * turn).sin().matrix().transpose();
    values += (line.real() * cosine - line.imag() * sine).array();
  }
  return values;
}

}  // namespace

double passed_over_excess_Pa(const std::vector<std::array<double, 6>>& unit, const ChannelHistory& loads) {
  if (unit.empty() || loads.passed_over.cols() == 0) return 0;
  const auto coordinates = coordinates_of(unit);
  return std::max(0.0, largest_Pa(coordinates, loads.passed_over) - largest_Pa(coordinates, loads.values));
}

bool passes_over_much(const ChannelHistory& loads) {
  constexpr double much = 0.01;
  if (loads.passed_over.cols() == 0) return false;
  const auto &at = loads.values, &between = loads.passed_over;
  const Eigen::ArrayXd above = between.rowwise().maxCoeff() - at.rowwise().maxCoeff(),
                       below = at.rowwise().minCoeff() - between.rowwise().minCoeff();
  return (above.max(below) > much * between.abs().rowwise().maxCoeff()).any();
}

bool is_whole_course(const ChannelHistory& loads) {
  const Index n = loads.values.cols(), m = loads.passed_over.cols();
  if (n < 1 || m < 2 * n || m % n != 0) return false;
  const Eigen::ArrayXd rounding = 1e-9 * loads.values.abs().rowwise().maxCoeff();
  for (Index i = 0; i < n; ++i)
    if (((loads.passed_over.col(m / n * i) - loads.values.col(i)).abs() > rounding).any()) return false;
  return true;
}

BetweenInstants between_instants(const ChannelHistory& loads) {
  constexpr double enough = 24, most_work = 2e7;
  if (loads.passed_over.cols() > 0) return {loads.passed_over, is_whole_course(loads)};
  const Index n = loads.values.cols();
  if (n < 3 || loads.values.rows() == 0 || !can_be_transformed(n)) return {};
  const Eigen::ArrayXd sizes = loads.values.abs().rowwise().maxCoeff();
  const Eigen::ArrayXd scale = (sizes > 0).select(sizes, 1.0);
  auto spectrum = factor_spectrum(loads.values.colwise() / scale, no_line);
  const Index highest = spectrum.lines.cols() - 1;
  if (!spectrum.is_resolved() || highest < 1) return {};
  const auto times = Index(std::ceil(enough * double(highest) / double(n)));
  const double n_lines = double((spectrum.lines.abs2().colwise().sum() > 0).count());
  if (times < 2 || n_lines * double(times * n * loads.values.rows()) > most_work) return {};
  return {denser_values(spectrum, times).colwise() * scale, true};
}

std::optional<ChannelHistory> denser_course(const ChannelHistory& loads) {
  if (!is_whole_course(loads) || loads.passed_over_by_effect.size() != loads.effects.size())
    return std::nullopt;
  return ChannelHistory{loads.body, loads.channels, loads.effects, loads.passed_over,
                        loads.passed_over_by_effect};
}

double sampling_error_Pa(const std::vector<std::array<double, 6>>& unit, const ChannelHistory& loads) {
  const double between_Pa = passed_over_excess_Pa(unit, loads);
  if (is_whole_course(loads)) return between_Pa + time_sampling(unit, loads.passed_over).error_Pa();
  return std::max(time_sampling(unit, loads.values).error_Pa(), between_Pa);
}

TimeSampling time_sampling(const std::vector<std::array<double, 6>>& unit, const ArrayXXd& values,
                           SeriesKind kind) {
  if (unit.empty() || values.cols() < 3) return {};
  const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> tensors(unit.front().data(), 6,
                                                                           Index(unit.size()));
  const auto coordinates = deviatoric_coordinates(tensors);
  const Eigen::RowVectorXd sizes = coordinates.matrix().colwise().norm();
  const double scale_Pa = (sizes * values.abs().matrix()).maxCoeff();
  if (!(scale_Pa > 0)) return {};
  const ArrayXXd course = (coordinates.matrix() * (values / scale_Pa).matrix()).array();
  const double largest = std::sqrt(course.square().colwise().sum().maxCoeff());
  const auto extreme = extreme_of(course, kind);
  const double excess = extreme.value - largest;
  return {excess > no_excess * largest ? excess * scale_Pa : 0, extreme.unresolved * scale_Pa,
          extreme.instant};
}

}  // namespace pipelines

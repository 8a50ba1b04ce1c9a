#include "pipelines/superpose/between_instants/factor_course.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unsupported/Eigen/FFT>
#include <utility>
#include <vector>

#include "pipelines/base/common/constants.h"
#include "pipelines/superpose/between_instants/cycle_extremes.h"
#include "pipelines/superpose/between_instants/factor_spectrum.h"

namespace pipelines {
namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXcd;
using Eigen::ArrayXXd;
using Eigen::Index;

/// Share of the largest channel below which lines are rounding: kinetics' angles over a thousand turns are
/// off by 1e-12.
constexpr double no_line_of_course = 1e-12;
/// Share of the largest channel that a polynomial may leave unresolved. Steps leave more, kinks less from
/// some 300 instants on.
constexpr double most_unresolved = 0.01;
/// Share of the largest channel up to which the highest harmonics, in sum, ask for no places; others ask for
/// so many in a period, which polynomials through eight of them need.
constexpr double no_places_for = 1e-4, least_per_period = 8;
/// is_closed looks at polynomials through four instants on either side.
constexpr Index least_to_be_closed = 16;

/// The highest order beyond which lines come to less than `most` in sum.
Index highest_that_counts(const ArrayXd& line_size, double most) {
  double sum = 0;
  for (Index h = line_size.size() - 1; h > 0; --h) {
    sum += line_size[h];
    if (sum > most) return h;
  }
  return 0;
}

/// Crests are missed by no more of the largest channel than one harmonic's with `per_period` places:
/// sum of size (pi h / n)^2 / 2 (factor_spectrum.h, instants_for).
double places_for_crests(const ArrayXd& line_size, double largest, double per_period) {
  double curvature = 0;
  for (Index h = 1; h < line_size.size(); ++h) curvature += line_size[h] * double(h * h);
  return per_period * std::sqrt(curvature / largest);
}

}  // namespace

FactorCourse::FactorCourse(ArrayXXd values, const ArrayXd& size, double per_period)
    : values_(std::move(values)) {
  const Index n = values_.cols();
  if (n < 3 || !can_be_transformed(n)) return;
  const ArrayXXd stress = values_.colwise() * size;
  const double largest = stress.size() > 0 ? stress.abs().maxCoeff() : 0;
  if (!(largest > 0)) return;
  const auto spectrum = factor_spectrum(stress, no_line_of_course * largest);
  const auto& lines = spectrum.lines;
  ArrayXd line_size(lines.cols());
  for (Index h = 0; h < lines.cols(); ++h) line_size[h] = pipelines::line_size(spectrum, h);
  is_resolved_ = spectrum.is_resolved();
  is_polynomial_ = is_resolved_ || (spectrum.unresolved() <= most_unresolved * largest &&
                                    (n < least_to_be_closed || is_closed(stress)));
  take_strongest(lines, line_size);
  for (Index k = 0; k < strongest_.rows(); ++k) strongest_.row(k) /= size[k] > 0 ? size[k] : 1;
  if (!is_polynomial_) return;
  take_angles();
  line_sizes_ = lines.abs().colwise() / (size > 0).select(size, 1);
  const Index highest = highest_that_counts(line_size, no_places_for * largest);
  const double places =
      std::max(places_for_crests(line_size, largest, per_period), least_per_period * double(highest));
  constexpr double rounding = 1e-12;
  per_step_ = std::max<Index>(1, Index(std::ceil(places / double(n) * (1 - rounding))));
  if (per_step_ == 1) return;
  take_places();
}

/// Takes the values at the places by the inverse transform of the spectrum, with zeros above it.
void FactorCourse::take_places() {
  const ArrayXXcd lines = factor_spectrum(values_, 0).lines;
  const Index n = values_.cols() * per_step_;
  Eigen::FFT<double> transform;
  Eigen::VectorXcd spectrum(n), series(n);
  fine_.resize(values_.rows(), n);
  for (Index k = 0; k < values_.rows(); ++k) {
    spectrum.setZero();
    spectrum.head(lines.cols()) = lines.row(k).matrix().transpose() * double(n);
    transform.inv(series, spectrum);
    fine_.row(k) = series.real().transpose().array();
  }
  for (Index i = 0; i < values_.cols(); ++i) fine_.col(i * per_step_) = values_.col(i);
}

void FactorCourse::take_strongest(const ArrayXXcd& lines, const ArrayXd& line_size) {
  std::vector<Index> order(std::size_t(std::max<Index>(0, lines.cols() - 1)));
  std::iota(order.begin(), order.end(), Index(1));
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return line_size[a] > line_size[b]; });
  order.resize(std::min(order.size(), std::size_t(most_orders)));
  strongest_.resize(lines.rows(), Index(order.size()));
  orders_.resize(Index(order.size()));
  for (std::size_t i = 0; i < order.size(); ++i) {
    strongest_.col(Index(i)) = lines.col(order[i]);
    orders_[Index(i)] = double(order[i]);
  }
}

void FactorCourse::take_angles() {
  const Index n = values_.cols();
  cosines_.resize(n);
  sines_.resize(n);
  for (Index j = 0; j < n; ++j) {
    cosines_[j] = std::cos(pi * double(j) / double(n));
    sines_[j] = std::sin(pi * double(j) / double(n));
  }
}

std::optional<Index> FactorCourse::instant_alone(double instant) const {
  const Index n = values_.cols();
  const double nearest = std::round(instant);
  if (is_polynomial_ && std::abs(instant - nearest) >= 1e-13 * double(n)) return std::nullopt;
  return (Index(nearest) % n + n) % n;
}

Eigen::VectorXd FactorCourse::weights_at(double instant) const {
  const Index n = values_.cols();
  if (const auto alone = instant_alone(instant)) return Eigen::VectorXd::Unit(n, *alone);
  const double nearest = std::round(instant), beyond = instant - nearest;
  const Index first = (Index(nearest) % n + n) % n;
  Eigen::VectorXd weights(n);
  // Dirichlet's kernel; of an even number of instants the line at n / 2 is its cosine. The angle of the j-th
  // instant after the nearest one is pi (beyond - j) / n: no difference of its sine is of two that are alike.
  const double c = std::cos(pi * beyond / double(n)), s = std::sin(pi * beyond / double(n));
  const double comb = std::sin(pi * beyond) / double(n);
  const ArrayXd sine = s * cosines_ - c * sines_;
  ArrayXd kernel = n % 2 == 0 ? ArrayXd(comb * (c * cosines_ + s * sines_) / sine) : ArrayXd(comb / sine);
  for (Index j = 1; j < n; j += 2) kernel[j] = -kernel[j];
  weights.tail(n - first) = kernel.head(n - first);
  weights.head(first) = kernel.tail(first);
  return weights;
}

/// The transpose of take_places: its kernel is even, so that it is the same filter.
Eigen::MatrixXd FactorCourse::by_instant(const Eigen::MatrixXd& by_place) const {
  if (per_step_ == 1) return by_place;
  const Index n = values_.cols();
  const ArrayXXcd lines = factor_spectrum(by_place.array(), 0).lines;
  Eigen::FFT<double> transform;
  Eigen::VectorXcd spectrum(n), series(n);
  Eigen::MatrixXd result(by_place.rows(), n);
  for (Index k = 0; k < result.rows(); ++k) {
    const Index n_lines = std::min(n / 2 + 1, lines.cols());
    spectrum.setZero();
    spectrum.head(n_lines) = lines.row(k).head(n_lines).matrix().transpose() * double(n * per_step_);
    if (n % 2 == 0 && n / 2 < n_lines) spectrum[n / 2] *= 0.5;  // half of the places' line is the instants'
    transform.inv(series, spectrum);
    result.row(k) = series.real().transpose();
  }
  return result;
}

ArrayXd FactorCourse::missed_by(double n) const {
  ArrayXd missed = ArrayXd::Zero(values_.rows());
  for (Index h = 1; h < line_sizes_.cols(); ++h) {
    const double away = pi * double(h) / n;
    missed += line_sizes_.col(h) * std::min(2.0, away * away / 2);
  }
  return missed;
}

}  // namespace pipelines

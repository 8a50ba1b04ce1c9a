#include "pipelines/superpose/between_instants/factor_spectrum.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <stdexcept>
#include <unsupported/Eigen/FFT>

#include "pipelines/base/common/constants.h"

namespace pipelines {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;

/// Share of the largest factor below which lines are rounding: kinetics' angles over a thousand turns are off
/// by 1e-12.
constexpr double rounding_of_factors = 1e-12;

/// More instants than anyone asks for.
constexpr double most_instants_needed = 1e9;

/// Size of one line among n instants. The instants show of the line at n / 2 its cosine alone.
double size_of(const Eigen::ArrayXcd& line) {
  return std::sqrt(line.abs2().sum());
}

/// What n instants may miss of a crest, and leave unresolved.
double missed_by(const FactorSpectrum& spectrum, double n) {
  double missed = spectrum.unresolved() * double(spectrum.n_instants) / n;
  for (Index h = 1; h < spectrum.lines.cols(); ++h) {
    const double away = pi * double(h) / n, size = line_size(spectrum, h);
    missed += size * std::min(2.0, away * away / 2);
    if (double(3 * h) >= n) missed += 8 * size;
  }
  return missed;
}

}  // namespace

double line_size(const FactorSpectrum& spectrum, Index order) {
  return order < spectrum.lines.cols() ? size_of(spectrum.lines.col(order)) : 0;
}

bool can_be_transformed(Index n) {
  for (Index p = 2; p * p <= n; ++p)
    while (n % p == 0) n /= p;
  return n <= largest_transformed_prime;
}

FactorSpectrum factor_spectrum(const ArrayXXd& values, double rounding) {
  const Index n = values.cols(), n_lines = n / 2 + 1;
  if (n == 0 || !can_be_transformed(n))
    throw std::invalid_argument("factor spectrum: of so many instants there is none");
  FactorSpectrum spectrum;
  spectrum.n_instants = n;
  Eigen::FFT<double> transform;
  Eigen::ArrayXXcd lines(values.rows(), n_lines);
  for (Index k = 0; k < values.rows(); ++k) {
    const Eigen::VectorXcd series = values.row(k).matrix().transpose().cast<std::complex<double>>();
    Eigen::VectorXcd transformed(n);
    transform.fwd(transformed, series);
    lines.row(k) = transformed.head(n_lines).transpose().array() * (2 / double(n));
  }
  lines.col(0) *= 0.5;
  if (n % 2 == 0 && n > 1) lines.col(n_lines - 1) *= 0.5;

  Index highest = 0;
  double middle_third = 0;
  for (Index h = 1; h < n_lines; ++h) {
    const double size = size_of(lines.col(h));
    if (!(size > rounding)) {
      lines.col(h) = 0;
      continue;
    }
    highest = h;
    if (3 * h >= n)
      spectrum.upper_third += size;
    else if (6 * h >= n)
      middle_third += size;
  }
  spectrum.is_decaying = spectrum.upper_third <= middle_third;
  spectrum.lines = lines.leftCols(highest + 1);
  return spectrum;
}

double instants_for(const FactorSpectrum& spectrum, double most) {
  if (spectrum.lines.cols() < 2) return 1;
  double enough = 3;
  while (missed_by(spectrum, enough) > most && enough < most_instants_needed) enough *= 2;
  double below = enough / 2;
  while (enough - below > 1) {
    const double middle = std::floor((enough + below) / 2);
    (missed_by(spectrum, middle) > most ? below : enough) = middle;
  }
  return enough;
}

InstantsNeeded instants_needed(const ChannelHistory& loads, double share) {
  std::map<std::string, double> largest;  // by unit
  for (Index k = 0; k < loads.values.rows(); ++k) {
    double& size = largest[loads.channels[std::size_t(k)].unit];
    size = std::max(size, loads.values.row(k).abs().maxCoeff());
  }
  InstantsNeeded needed;
  for (Index k = 0; k < loads.values.rows(); ++k) {
    const auto& channel = loads.channels[std::size_t(k)];
    const double size = largest.at(channel.unit);
    const auto spectrum = factor_spectrum(loads.values.row(k), rounding_of_factors * size);
    const double n = instants_for(spectrum, share * size);
    if (n > needed.n_instants) needed = {n, channel.name, spectrum.is_resolved(), spectrum.lines.cols() - 1};
  }
  return needed;
}

}  // namespace pipelines

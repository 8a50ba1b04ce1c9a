#include "kinetics/series/harmonics.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "kinetics/values/constants.h"
#include "kinetics/values/wrong_input.h"

namespace kinetics {
namespace {

void require_all_finite(const std::string& name, const Eigen::ArrayXd& values) {
  for (Eigen::Index i = 0; i < values.size(); ++i)
    require_finite(name + "[" + std::to_string(i) + "]", values[i]);
}

}  // namespace

LineSpectrum line_spectrum(const Eigen::ArrayXd& values, int turns, int n_lines) {
  const Eigen::Index n = values.size();
  if (n == 0) throw std::invalid_argument("values: none given; a series has at least one instant");
  require_all_finite("values", values);
  if (turns < 1) refuse("turns", turns, "must be at least 1: whole turns of the drive that the values cover");
  const Eigen::Index most_lines = n / 2;
  if (n_lines < 0 || n_lines > most_lines)
    refuse("n_lines", n_lines,
           "must lie between 0 and " + number(double(most_lines)) +
               ", half the number of instants; sample more finely, or ask for fewer");

  // Angles are taken modulo one turn as whole numbers, so that high lines lose no digits.
  const Eigen::ArrayXd angle = Eigen::ArrayXd::LinSpaced(n, 0, double(n - 1)) * (2 * pi / double(n));
  const Eigen::ArrayXd cosine = angle.cos(), sine = angle.sin();
  LineSpectrum spectrum{values.mean(), {}};
  const double round_off = 16 * std::numeric_limits<double>::epsilon() * values.abs().maxCoeff();
  for (Eigen::Index k = 1; k <= n_lines; ++k) {
    double a = 0, b = 0;
    for (Eigen::Index i = 0, j = 0; i < n; ++i, j = (j + k) % n) {
      a += values[i] * cosine[j];
      b += values[i] * sine[j];
    }
    const double share = (2 * k == n ? 1.0 : 2.0) / double(n);
    const double amplitude = share * (2 * k == n ? std::abs(a) : std::hypot(a, b));
    const double phase_rad = 2 * k == n ? (a < 0 ? pi : 0) : std::atan2(b, a);
    spectrum.lines.push_back({double(k) / turns, amplitude, amplitude > round_off ? phase_rad : 0});
  }
  return spectrum;
}

PolarSeries polar(const Eigen::ArrayXd& fx, const Eigen::ArrayXd& fy) {
  if (fx.size() != fy.size())
    refuse("number of fy", double(fy.size()), "must be that of fx, " + number(double(fx.size())));
  require_all_finite("fx", fx);
  require_all_finite("fy", fy);
  PolarSeries series{Eigen::ArrayXd(fx.size()), Eigen::ArrayXd::Zero(fx.size())};
  for (Eigen::Index i = 0; i < fx.size(); ++i) {
    series.magnitude[i] = std::hypot(fx[i], fy[i]);
    // + 0.0 turns -0 into 0: a force along -x points to +pi, and no force to 0.
    if (series.magnitude[i] > 0) series.direction_rad[i] = std::atan2(fy[i] + 0.0, fx[i] + 0.0);
  }
  return series;
}

}  // namespace kinetics

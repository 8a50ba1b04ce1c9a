#include "pipelines/judge/verdict/local_laws.h"

#include <algorithm>
#include <cmath>

#include "fem/models/beam/fillet_factors.h"

namespace pipelines {
namespace {

/// The first size in (from, to) from which a condition holds that does not hold before; to a thousandth of
/// the step that finds it.
std::optional<double> first_that(double from_m, double to_m, const std::function<bool(double)>& does) {
  constexpr int n_steps = 400, n_halvings = 10;
  for (int i = 1; i < n_steps; ++i) {
    double least_m = from_m + (to_m - from_m) * (i - 1) / n_steps;
    double most_m = from_m + (to_m - from_m) * i / n_steps;
    if (!does(most_m)) continue;
    for (int n = 0; n < n_halvings; ++n) {
      const double middle_m = (least_m + most_m) / 2;
      (does(middle_m) ? most_m : least_m) = middle_m;
    }
    return most_m;
  }
  return std::nullopt;
}

double share_of_strength(const StrengthBySize& strength, double size_m, double now_m) {
  return strength ? strength(size_m) / strength(now_m) : 1;
}

double two_digits_m(double size_m, double (*round)(double)) {
  constexpr double rounding = 1e-9;
  const double unit_m = std::pow(10, std::floor(std::log10(size_m)) - 1);
  const double digits = size_m / unit_m, nearest = std::round(digits);
  return unit_m * (std::abs(digits - nearest) < rounding * digits ? nearest : round(digits));
}

}  // namespace

std::optional<double> radius_for(const ShoulderSize& shoulder, const DinTriple& nominal_Pa, double factor,
                                 const StrengthBySize& strength) {
  const auto stress_Pa = [&](double radius_m) {
    const auto k = fem::fillet_factors(shoulder.small_m, shoulder.large_m, radius_m);
    return std::hypot(k.tension * nominal_Pa.tension + k.bending * nominal_Pa.bending,
                      std::sqrt(3.0) * k.torsion * nominal_Pa.torsion);
  };
  const double now_m = shoulder.fillet_m, height_m = (shoulder.large_m - shoulder.small_m) / 2;
  const double now_Pa = stress_Pa(now_m);
  if (!(now_Pa > 0) || !(height_m > now_m)) return std::nullopt;
  return first_that(now_m, height_m, [&](double radius_m) {
    return factor * stress_Pa(radius_m) <= now_Pa * share_of_strength(strength, radius_m, now_m);
  });
}

PlateStress plate_stress(const Stress& face_Pa, const Stress& opposite_Pa) {
  PlateStress stress;
  for (std::size_t c = 0; c < face_Pa.size(); ++c) {
    stress.membrane[c] = (face_Pa[c] + opposite_Pa[c]) / 2;
    stress.bending[c] = (face_Pa[c] - opposite_Pa[c]) / 2;
  }
  return stress;
}

std::optional<double> thickness_for(const PlateStress& stress, double thickness_m, double own_share,
                                    double factor, const StrengthBySize& strength) {
  const auto stress_Pa = [&](double size_m) {
    const double x = size_m / thickness_m;
    Stress by_parts{}, bent{};
    for (std::size_t c = 0; c < bent.size(); ++c) {
      by_parts[c] = stress.membrane[c] / x + stress.bending[c] / (x * x);
      bent[c] = (stress.membrane[c] + stress.bending[c]) / (x * x);
    }
    return std::max(von_mises_Pa(by_parts), von_mises_Pa(bent)) * (1 - own_share + own_share * x);
  };
  const double now_Pa = stress_Pa(thickness_m);
  if (!(now_Pa > 0)) return std::nullopt;
  return first_that(thickness_m, thickest * thickness_m, [&](double size_m) {
    return factor * stress_Pa(size_m) <= now_Pa * share_of_strength(strength, size_m, thickness_m);
  });
}

double two_digits_up_m(double size_m) {
  return two_digits_m(size_m, std::ceil);
}
double two_digits_down_m(double size_m) {
  return two_digits_m(size_m, std::floor);
}

}  // namespace pipelines

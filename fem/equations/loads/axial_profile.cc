#include "fem/equations/loads/axial_profile.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace fem {

AxialProfile::AxialProfile(const LoadSurface& surface)
    : values_(surface.axial_profile), half_length_m_(surface.length_m / 2) {
  const bool sensible =
      std::all_of(values_.begin(), values_.end(), [](double v) { return std::isfinite(v) && v >= 0; });
  double mean = 0;  // trapezoidal rule, exact for straight lines
  for (std::size_t i = 0; i < values_.size(); ++i)
    mean += values_[i] * (i == 0 || i + 1 == values_.size() ? 0.5 : 1.0);
  if (values_.size() == 1)
    mean = values_.front();
  else
    mean /= double(values_.size()) - 1;
  if (values_.empty() || !sensible || !(mean > 0))
    throw std::invalid_argument("axial profile of the surface with boundary group " +
                                std::to_string(surface.boundary_id) +
                                ": needs values that are not negative, some of them positive");
  for (double& value : values_) value /= mean;
}

double AxialProfile::operator()(double z_m) const {
  if (values_.size() == 1) return values_.front();
  const double place = std::clamp((z_m / half_length_m_ + 1) / 2, 0.0, 1.0) * double(values_.size() - 1);
  const auto i = std::min(std::size_t(place), values_.size() - 2);
  const double t = place - double(i);
  return (1 - t) * values_[i] + t * values_[i + 1];
}

double AxialProfile::first_moment() const {
  if (values_.size() == 1) return 0;
  const double step = 2 / double(values_.size() - 1);
  double moment = 0;  // Simpson's rule on each straight piece, exact
  for (std::size_t i = 0; i + 1 < values_.size(); ++i) {
    const double a = -1 + double(i) * step, b = a + step;
    moment += step / 6 * (a * values_[i] + (a + b) * (values_[i] + values_[i + 1]) + b * values_[i + 1]);
  }
  return moment / 2;
}

}  // namespace fem

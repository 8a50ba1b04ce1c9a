/// Normal pressure along a seat. Internal to fem.
#pragma once

#include <vector>

#include "fem/base/values/unit_load.h"

namespace fem {

/// The seat's axial profile at z from its middle, scaled to the mean 1.
class AxialProfile {
public:
  /// @throws std::invalid_argument unless its values are finite, not negative, and some positive
  explicit AxialProfile(const LoadSurface& surface);
  double operator()(double z_m) const;
  /// Where its resultant acts, in half lengths from the middle.
  double first_moment() const;

private:
  std::vector<double> values_;
  double half_length_m_;
};

}  // namespace fem

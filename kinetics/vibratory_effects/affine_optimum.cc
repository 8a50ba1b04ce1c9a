#include "kinetics/vibratory_effects/affine_optimum.h"

#include <algorithm>
#include <cmath>

namespace kinetics::vibratory {
namespace {

Eigen::ArrayXd dots(const Eigen::Array2Xd& a, const Eigen::Array2Xd& b) {
  return (a * b).colwise().sum().transpose();
}

}  // namespace

double rms_norm(const Eigen::Array2Xd& R) {
  return std::sqrt(dots(R, R).mean());
}

double peak_norm(const Eigen::Array2Xd& R) {
  return std::sqrt(dots(R, R).maxCoeff());
}

double rms_optimum(const Eigen::Array2Xd& R0, const Eigen::Array2Xd& G) {
  return std::max(0.0, -dots(R0, G).mean() / dots(G, G).mean());
}

double peak_optimum(const Eigen::Array2Xd& R0, const Eigen::Array2Xd& G) {
  // |R|^2 of each column is c + 2 b k + a k^2.
  const Eigen::ArrayXd a = dots(G, G), b = dots(R0, G), c = dots(R0, R0);
  const double steepest = peak_norm(G);
  const auto falls = [&](double k) {
    const Eigen::ArrayXd square = c + k * (2 * b + k * a), slope = b + k * a;
    const double top = square.maxCoeff();
    const double right = (square >= top * (1 - 1e-14)).select(slope, slope.minCoeff()).maxCoeff();
    return right < -1e-12 * std::sqrt(top) * steepest;
  };
  // Beyond `high` the column with the largest |G| alone exceeds what k = 0 gives.
  double low = 0, high = 2 * peak_norm(R0) / steepest;
  if (!falls(low)) return low;
  for (int i = 0; i < 200 && high - low > 0; ++i) {
    const double middle = low + (high - low) / 2;
    if (middle == low || middle == high) break;
    (falls(middle) ? low : high) = middle;
  }
  return high;
}

}  // namespace kinetics::vibratory

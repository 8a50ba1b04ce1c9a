#include "fem/stress/recovery/patch_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fem/base/common/dense_algebra.h"

namespace fem {

namespace {

using Exponents = std::vector<std::array<int, 3>>;

Exponents tensor_space(int degree) {
  Exponents e;
  for (int c = 0; c <= degree; ++c)
    for (int b = 0; b <= degree; ++b)
      for (int a = 0; a <= degree; ++a) e.push_back({a, b, c});
  return e;
}

Exponents complete_space(int degree) {
  Exponents e;
  for (const auto& t : tensor_space(degree))
    if (t[0] + t[1] + t[2] <= degree) e.push_back(t);
  return e;
}

/// The complete space, then what is left of it without the highest power of one coordinate, and of two: where
/// a patch is thin in some direction, the others need not suffer.
std::vector<Exponents> spaces_within(int degree) {
  std::vector<Exponents> spaces{complete_space(degree)};
  for (const int limited : {1, 2, 4, 3, 5, 6}) {  // bit d: coordinate d
    auto& space = spaces.emplace_back();
    for (const auto& e : spaces.front()) {
      bool kept = true;
      for (int d = 0; d < 3; ++d) kept = kept && (e[d] < degree || (limited >> d & 1) == 0);
      if (kept) space.push_back(e);
    }
  }
  return spaces;
}

/// What stands for x and x^2 of each coordinate, both in [-1, 1] over the patch.
struct Scaled {
  Points first, second;
};

/// Products of Legendre polynomials: the same spaces as monomials, well conditioned on [-1, 1]^3.
Eigen::MatrixXd basis(const Exponents& exponents, const Scaled& points) {
  Eigen::MatrixXd values(points.first.cols(), exponents.size());
  for (Eigen::Index p = 0; p < points.first.cols(); ++p) {
    std::array<std::array<double, 4>, 3> legendre{};
    for (int d = 0; d < 3; ++d) {
      const double x = points.first(d, p), x2 = points.second(d, p);
      legendre[d] = {{1, x, (3 * x2 - 1) / 2, (5 * x2 - 3) * x / 2}};
    }
    for (std::size_t k = 0; k < exponents.size(); ++k)
      values(p, k) =
          legendre[0][exponents[k][0]] * legendre[1][exponents[k][1]] * legendre[2][exponents[k][2]];
  }
  return values;
}

/// The fit in one space, each sample's error times its weight (none: 1); an empty matrix if the samples do
/// not determine it well.
Eigen::MatrixXd fit_in(const Exponents& space, const Scaled& samples, const Scaled& targets,
                       const Eigen::VectorXd& weights = {}) {
  // The squared sine between a basis function and the span of the others, on the samples. Below this they are
  // as good as dependent: errors of the samples could grow thirtyfold. Sound patches of shafts have 0.003 and
  // more.
  constexpr double smallest_squared_sine = 1e-3;
  if (samples.first.cols() < static_cast<Eigen::Index>(space.size())) return {};
  Eigen::MatrixXd at_samples = basis(space, samples);
  if (weights.size() > 0) at_samples = weights.asDiagonal() * at_samples;
  const Eigen::VectorXd norm = at_samples.colwise().norm();
  if (!(norm.minCoeff() > 0)) return {};
  const Eigen::MatrixXd scaled = at_samples * norm.cwiseInverse().asDiagonal();
  const auto from_samples =
      solve_symmetric(transposed_product(scaled, scaled), scaled.transpose(), smallest_squared_sine);
  if (!from_samples) return {};
  const Eigen::MatrixXd at_targets = basis(space, targets) * norm.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd fit = product(at_targets, *from_samples);
  return weights.size() > 0 ? Eigen::MatrixXd(fit * weights.asDiagonal()) : fit;
}

struct ScaledPatch {
  Scaled samples, targets;
};

ScaledPatch scale(const PatchPoints& points) {
  ScaledPatch patch{{points.samples, points.samples}, {points.targets, points.targets}};
  auto &s = patch.samples, &t = patch.targets;
  for (int d = 0; d < 3; ++d) {
    const double low = std::min(points.samples.row(d).minCoeff(), points.targets.row(d).minCoeff());
    const double high = std::max(points.samples.row(d).maxCoeff(), points.targets.row(d).maxCoeff());
    if (d == points.angle_axis) {
      const double half = std::max(high, -low);
      for (auto* scaled : {&s, &t}) {
        const Eigen::ArrayXd angle = scaled->first.row(d).array();
        scaled->first.row(d) = angle.sin() / std::sin(half);
        scaled->second.row(d) = (1 - angle.cos()) / (1 - std::cos(half));
      }
    } else {
      const double centre = (low + high) / 2, half = high > low ? (high - low) / 2 : 1.0;
      for (auto* scaled : {&s, &t}) {
        scaled->first.row(d).array() = (scaled->first.row(d).array() - centre) / half;
        scaled->second.row(d) = scaled->first.row(d).cwiseAbs2();
      }
    }
  }
  return patch;
}

}  // namespace

Eigen::MatrixXd fit_operator(int degree, bool full_patch, const PatchPoints& points) {
  const auto [s, t] = scale(points);
  // Trilinear fits of one sample per cell would be interpolations that amplify the samples' errors: degree 1
  // goes straight to the complete space.
  if (full_patch && degree > 1)
    if (auto fit = fit_in(tensor_space(degree), s, t); fit.size() > 0) return fit;
  for (int p = degree; p > 0; --p)
    for (const auto& space : spaces_within(p))
      if (auto fit = fit_in(space, s, t); fit.size() > 0) return fit;
  return Eigen::MatrixXd::Constant(t.first.cols(), s.first.cols(), 1.0 / double(s.first.cols()));
}

Eigen::MatrixXd complete_fit(int degree, double concentration, const PatchPoints& points) {
  const auto [samples, targets] = scale(points);
  const Eigen::VectorXd distance2 = points.samples.colwise().squaredNorm().transpose();
  const Eigen::VectorXd weights =
      (-concentration / 2 * distance2.array() / distance2.maxCoeff()).exp().matrix();
  return fit_in(complete_space(degree), samples, targets, weights);
}

}  // namespace fem

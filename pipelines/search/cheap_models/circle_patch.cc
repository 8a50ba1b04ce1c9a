#include "pipelines/search/cheap_models/circle_patch.h"

#include <algorithm>
#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/superpose/envelope/superposition.h"

namespace pipelines {
namespace {

std::array<double, 3> vector_seen_from(double angle_rad, const double* u) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {c * u[0] + s * u[1], c * u[1] - s * u[0], u[2]};
}

/// xx, yy, zz, xy, yz, xz in axes that are turned by the angle about z.
std::array<double, 6> seen_from(double angle_rad, const double* s) {
  const double c = std::cos(angle_rad), n = std::sin(angle_rad);
  return {c * c * s[0] + n * n * s[1] + 2 * c * n * s[3],
          n * n * s[0] + c * c * s[1] - 2 * c * n * s[3],
          s[2],
          c * n * (s[1] - s[0]) + (c * c - n * n) * s[3],
          c * s[4] - n * s[5],
          n * s[4] + c * s[5]};
}

}  // namespace

std::size_t first_of_circle(const fem::Nodes& nodes, std::size_t node, int n_angles) {
  const double x = nodes.xyz_m[3 * node], y = nodes.xyz_m[3 * node + 1];
  if (x == 0 && y == 0) return node;
  const auto half_plane = std::lround(std::atan2(y, x) / (2 * pi / n_angles));
  return node - std::size_t((half_plane + n_angles) % n_angles);
}

CirclePatch::CirclePatch(const fem::UnitResponses& responses, int n_angles,
                         const std::array<std::size_t, 3>& circles)
    : responses_(responses), n_angles_(n_angles), circles_(circles) {
  for (std::size_t i = 0; i < 3; ++i) {
    const double* p = &responses.nodes.xyz_m[3 * circles[i]];
    zr_m_[i] = {p[2], std::hypot(p[0], p[1])};
  }
  const auto chord_m = [&](std::size_t a, std::size_t b) {
    return std::hypot(zr_m_[a][0] - zr_m_[b][0], zr_m_[a][1] - zr_m_[b][1]);
  };
  along_m_ = {-chord_m(0, 1), 0, chord_m(1, 2)};
}

std::size_t CirclePatch::node(std::size_t circle, int half_plane) const {
  return zr_m_[circle][1] > 0 ? circles_[circle] + std::size_t(half_plane) : circles_[circle];
}

void CirclePatch::load(const Eigen::ArrayXd& factors) {
  for (std::size_t i = 0; i < 3; ++i) {
    stress_Pa_[i].clear();
    for (int j = 0; j < n_angles_; ++j) {
      const double* unit = responses_.unit_stress_Pa(node(i, j));
      std::array<double, 6> sum{};
      for (Eigen::Index k = 0; k < factors.size(); ++k)
        for (std::size_t c = 0; c < 6; ++c) sum[c] += factors[k] * unit[6 * std::size_t(k) + c];
      stress_Pa_[i].push_back(seen_from(2 * pi * j / n_angles_, sum.data()));
    }
  }
}

std::array<double, 3> CirclePatch::weights_along(double along_m) const {
  std::array<double, 3> weights{1, 1, 1};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (j != i) weights[i] *= (along_m - along_m_[j]) / (along_m_[i] - along_m_[j]);
  return weights;
}

std::vector<double> CirclePatch::weights_around(double angle_rad) const {
  std::vector<double> weights;
  for (int j = 0; j < n_angles_; ++j) {
    const double half = (angle_rad - 2 * pi * j / n_angles_) / 2;
    const double tangent = std::tan(half);
    weights.push_back(std::abs(std::sin(half)) < 1e-9 ? 1
                                                      : std::sin(n_angles_ * half) / (n_angles_ * tangent));
  }
  return weights;
}

double CirclePatch::von_mises_Pa(const PatchLocation& at) const {
  const auto along = weights_along(at.along_m);
  const auto around = weights_around(at.angle_rad);
  Stress sum{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < around.size(); ++j)
      for (std::size_t c = 0; c < 6; ++c) sum[c] += along[i] * around[j] * stress_Pa_[i][j][c];
  return pipelines::von_mises_Pa(sum);
}

std::array<double, 3> CirclePatch::position_m(const PatchLocation& at) const {
  const auto along = weights_along(at.along_m);
  double z = 0, r = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    z += along[i] * zr_m_[i][0];
    r += along[i] * zr_m_[i][1];
  }
  return {r * std::cos(at.angle_rad), r * std::sin(at.angle_rad), z};
}

template <std::size_t n, typename Unit>
std::vector<double> CirclePatch::interpolated(const PatchLocation& at, const Unit& unit,
                                              std::array<double, n> (*turned)(double, const double*)) const {
  const auto along = weights_along(at.along_m);
  const auto around = weights_around(at.angle_rad);
  const std::size_t n_channels = responses_.channels.size();
  std::vector<double> result(n * n_channels, 0);
  for (std::size_t i = 0; i < 3; ++i)
    for (int j = 0; j < n_angles_; ++j) {
      const double turn = 2 * pi * j / n_angles_ - at.angle_rad, weight = along[i] * around[std::size_t(j)];
      const double* own = unit(node(i, j));
      for (std::size_t k = 0; k < n_channels; ++k) {
        const auto values = turned(turn, own + n * k);
        for (std::size_t c = 0; c < n; ++c) result[n * k + c] += weight * values[c];
      }
    }
  return result;
}

std::vector<double> CirclePatch::unit_stress_Pa(const PatchLocation& at) const {
  return interpolated(
      at, [&](std::size_t i) { return responses_.unit_stress_Pa(i); }, seen_from);
}

std::vector<double> CirclePatch::unit_displacement_m(const PatchLocation& at) const {
  return interpolated(
      at, [&](std::size_t i) { return responses_.unit_displacement_m(i); }, vector_seen_from);
}

}  // namespace pipelines

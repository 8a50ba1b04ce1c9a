/// Bodies of two materials: a tube of two layers under pressure from inside, and Lame's solution of it.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/verification/fem/bodies/block_mesh.h"
#include "tests/verification/fem/bodies/figures.h"

namespace verification::two_layers {

inline constexpr int soft_volume = 7, hard_volume = 8;

inline fem::Material soft(double poisson_ratio) {
  return {1e6, poisson_ratio, 1000};
}
inline fem::Material hard(double jump, double poisson_ratio) {
  return {1e6 * jump, poisson_ratio, 3000};
}

// A tube of two layers under pressure from inside, between radii a, b, c.
inline constexpr double a = 0.05, b = 0.07, c = 0.1, height = 0.02, p_Pa = 1e5;
inline constexpr int n_inner = 6, n_outer = 6;

inline Point in_tube(const Point& q, double turn) {
  const double t = q[0] * (n_inner + n_outer) / n_inner;
  const double r = t <= 1 ? a * std::pow(b / a, t) : b * std::pow(c / b, (t - 1) * n_inner / n_outer);
  return {r * std::cos(turn * q[1]), r * std::sin(turn * q[1]), height * q[2]};
}

/// Hard outside of b.
inline fem::Body tube(bool whole, const fem::Material& inner, const fem::Material& outer) {
  verification::Block block;
  block.cells = {n_inner + n_outer, whole ? 12 : 3, 1};
  block.is_ring = whole;
  block.map = [whole](const Point& q) {
    return in_tube(q, whole ? 2 * verification::pi : verification::pi / 2);
  };
  block.volume = [](const std::array<int, 3>& cell) { return cell[0] < n_inner ? soft_volume : hard_volume; };
  fem::Body body;
  body.mesh = verification::hexahedra_of(block);
  for (const int volume : {soft_volume, hard_volume}) {
    fem::CylinderChart chart;
    chart.volume_id = volume;
    body.cylinders.push_back(chart);
  }
  body.material = outer;
  body.material_of_volume = {{soft_volume, inner}};
  return body;
}

inline verification::LoadCase inside() {
  return {{verification::uniform_pressure(verification::begin_1, {0, 0, height / 2}, height), p_Pa}};
}

/// Lame's solution of each layer in plane strain, sigma_r = C - D / r^2, sigma_theta = C + D / r^2,
/// u = (1 + nu) / E ((1 - 2 nu) C r + D / r); four conditions: pressure, equal sigma_r and u at b, none at c.
struct Lame {
  Eigen::Vector4d k;  // C, D inside; C, D outside
  fem::Material inner, outer;

  Lame(const fem::Material& in, const fem::Material& out) : inner(in), outer(out) {
    const auto u = [](const fem::Material& m, double r) {
      const double f = (1 + m.poisson_ratio) / m.youngs_modulus_Pa;
      return Eigen::RowVector2d(f * (1 - 2 * m.poisson_ratio) * r, f / r);
    };
    Eigen::Matrix4d conditions;
    conditions << 1, -1 / (a * a), 0, 0,                                     //
        1, -1 / (b * b), -1, 1 / (b * b),                                    //
        u(in, b) * in.youngs_modulus_Pa, -u(out, b) * in.youngs_modulus_Pa,  //
        0, 0, 1, -1 / (c * c);
    k = conditions.fullPivLu().solve(Eigen::Vector4d(-p_Pa, 0, 0, 0));
  }
  double radial_Pa(bool is_outer, double r) const {
    return k[is_outer ? 2 : 0] - k[is_outer ? 3 : 1] / (r * r);
  }
  double hoop_Pa(bool is_outer, double r) const {
    return k[is_outer ? 2 : 0] + k[is_outer ? 3 : 1] / (r * r);
  }
  double displacement_m(bool is_outer, double r) const {
    const auto& m = is_outer ? outer : inner;
    return (1 + m.poisson_ratio) / m.youngs_modulus_Pa *
           ((1 - 2 * m.poisson_ratio) * k[is_outer ? 2 : 0] * r + k[is_outer ? 3 : 1] / r);
  }
};

/// Whether the cells of a node are in the outer layer: by the radius of a node at the cells' other side.
inline std::vector<char> outer_nodes(const verification::Solution& s) {
  std::vector<char> outer(s.nodes.n, 0);
  for (std::size_t cell = 0; cell < s.nodes.n_cells(); ++cell) {
    double largest = 0;
    for (const auto node : s.nodes.cell(cell))
      largest = std::max(largest, s.place_m.col(node).head<2>().norm());
    for (const auto node : s.nodes.cell(cell)) outer[node] = largest > b * (1 + 1e-6);
  }
  return outer;
}

}  // namespace verification::two_layers

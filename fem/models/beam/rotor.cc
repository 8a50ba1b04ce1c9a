#include "fem/models/beam/rotor.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "fem/base/common/dense_algebra.h"
#include "fem/models/beam/beam_section.h"

namespace fem {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Of equation (1), without the deflections that rigid bearings hold.
struct RotorMatrices {
  MatrixXd mass, gyroscopic, stiffness;
};

constexpr Index nodes_per_element = 4;
using ElementShape = Eigen::Matrix<double, 2 * nodes_per_element, 1>;  // deflection and tilt of each node

/// Cubic polynomials of the four nodes, evenly spaced, and their derivatives at s in [0, 1].
struct CubicShapes {
  std::array<double, nodes_per_element> value, derivative;
  explicit CubicShapes(double s) {
    const auto node = [](std::size_t i) { return double(i) / 3; };
    for (std::size_t i = 0; i < value.size(); ++i) {
      value[i] = 1;
      derivative[i] = 0;
      for (std::size_t j = 0; j < value.size(); ++j) {
        if (j == i) continue;
        derivative[i] = (derivative[i] * (s - node(j)) + value[i]) / (node(i) - node(j));
        value[i] *= (s - node(j)) / (node(i) - node(j));
      }
    }
  }
};

/// Adds an element of Timoshenko's beam, deflection and tilt cubic: exact where forces act on its ends alone.
/// A section has twice the inertia about the axis that it has about a diameter, which is its gyroscopic
/// moment. Source: the energies of Nelson, A finite rotating shaft element using Timoshenko beam theory, J.
/// Mech. Des. 102 (1980), whose element of two nodes is of second order only where shear matters.
void add_element(RotorMatrices& all, Index first, const BeamSection& section, const Material& material,
                 double length_m) {
  constexpr double at[] = {0.8611363115940526, 0.3399810435848563},
                   weight[] = {0.3478548451374538, 0.6521451548625461};  // Gauss's, exact to degree 7
  const double e_Pa = material.youngs_modulus_Pa, shear_Pa = e_Pa / (2 * (1 + material.poisson_ratio));
  const double inertia_m4 = section.polar_m4 / 2, density = material.density_kg_m3;
  const auto add = [first](MatrixXd& to, double factor, const ElementShape& shape) {
    to.block<2 * nodes_per_element, 2 * nodes_per_element>(first, first) +=
        factor * shape * shape.transpose();
  };
  for (int i = 0; i < 4; ++i) {
    const CubicShapes cubic((1 + (i % 2 == 0 ? at[i / 2] : -at[i / 2])) / 2);
    ElementShape deflection = ElementShape::Zero(), slope = deflection, tilt = deflection,
                 curvature = deflection;
    for (Index k = 0; k < nodes_per_element; ++k) {
      deflection[2 * k] = tilt[2 * k + 1] = cubic.value[std::size_t(k)];
      slope[2 * k] = curvature[2 * k + 1] = cubic.derivative[std::size_t(k)] / length_m;
    }
    const double dz_m = weight[i / 2] * length_m / 2;
    add(all.mass, density * section.area_m2 * dz_m, deflection);
    add(all.mass, density * inertia_m4 * dz_m, tilt);
    add(all.gyroscopic, 2 * density * inertia_m4 * dz_m, tilt);
    add(all.stiffness, e_Pa * inertia_m4 * dz_m, curvature);
    add(all.stiffness, shear_Pa * section.shear_area_m2 * dz_m, slope - tilt);
  }
}

void refuse_at(const std::string& what, double z_m, const std::string& remedy) {
  throw std::invalid_argument("rotor: " + what + " at z = " + std::to_string(z_m) + " m " + remedy);
}

void require_rotor(const Rotor& rotor) {
  if (rotor.segments.empty() || rotor.n_elements < 1 || !(rotor.material.youngs_modulus_Pa > 0) ||
      !(rotor.material.density_kg_m3 > 0))
    throw std::invalid_argument("rotor: needs a segment, an element, a modulus and a density");
  const double begin_m = rotor.segments.front().begin_m, end_m = rotor.segments.back().end_m;
  const double tiny = 1e-9 * (end_m - begin_m);
  double at_m = begin_m;
  for (const auto& s : rotor.segments) {
    if (!(s.end_m > s.begin_m && s.radius_m > s.bore_radius_m && s.bore_radius_m >= 0) ||
        std::abs(s.begin_m - at_m) > tiny)
      refuse_at("a segment", s.begin_m, "needs a length, a wall, and no gap before it");
    at_m = s.end_m;
  }
  const auto is_beside = [&](double z_m) { return !(z_m >= begin_m - tiny && z_m <= end_m + tiny); };
  for (const auto& d : rotor.discs)
    if (is_beside(d.z_m) || !(d.mass_kg > 0 && d.polar_kg_m2 >= 0 && d.diametral_kg_m2 >= 0))
      refuse_at("a disc", d.z_m, "needs a place on the shaft and a mass");
  double least_m = end_m, most_m = begin_m;
  for (const auto& b : rotor.bearings) {
    if (is_beside(b.z_m) || !(b.stiffness_N_m > 0))
      refuse_at("a bearing", b.z_m, "needs a place on the shaft and a stiffness above 0");
    least_m = std::min(least_m, b.z_m);
    most_m = std::max(most_m, b.z_m);
  }
  if (!(most_m - least_m > tiny)) throw std::invalid_argument("rotor: needs bearings at two places");
}

/// Ends of the elements: where a segment, a disc or a bearing is, and evenly between.
std::vector<double> ends_of_elements(const Rotor& rotor) {
  const double begin_m = rotor.segments.front().begin_m, length_m = rotor.segments.back().end_m - begin_m;
  std::vector<double> breaks{begin_m}, ends{begin_m};
  for (const auto& s : rotor.segments) breaks.push_back(s.end_m);
  for (const auto& d : rotor.discs) breaks.push_back(d.z_m);
  for (const auto& b : rotor.bearings) breaks.push_back(b.z_m);
  std::sort(breaks.begin(), breaks.end());
  for (const double z : breaks) {
    const double from = ends.back(), step = z - from;
    if (!(step > 1e-9 * length_m)) continue;
    const int n = int(std::ceil(step / length_m * rotor.n_elements - 1e-9));
    for (int i = 1; i <= n; ++i) ends.push_back(i == n ? z : from + step * i / n);
  }
  return ends;
}

constexpr Index unknowns_per_element = 2 * (nodes_per_element - 1);

/// The deflection at a place where an element ends; the tilt follows it.
Index unknown_at(const std::vector<double>& ends, double z_m) {
  const auto nearest = std::min_element(
      ends.begin(), ends.end(), [&](double a, double b) { return std::abs(a - z_m) < std::abs(b - z_m); });
  return unknowns_per_element * (nearest - ends.begin());
}

RotorMatrices matrices_of(const Rotor& rotor) {
  require_rotor(rotor);
  const auto ends = ends_of_elements(rotor);
  const auto n = unknowns_per_element * Index(ends.size() - 1) + 2;
  RotorMatrices all{MatrixXd::Zero(n, n), MatrixXd::Zero(n, n), MatrixXd::Zero(n, n)};
  auto segment = rotor.segments.begin();
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    while ((ends[i] + ends[i + 1]) / 2 > segment->end_m) ++segment;
    const auto section = beam_section(*segment, rotor.material.poisson_ratio);
    add_element(all, unknowns_per_element * Index(i), section, rotor.material, ends[i + 1] - ends[i]);
  }
  for (const auto& d : rotor.discs) {
    const Index u = unknown_at(ends, d.z_m);
    all.mass(u, u) += d.mass_kg;
    all.mass(u + 1, u + 1) += d.diametral_kg_m2;
    all.gyroscopic(u + 1, u + 1) += d.polar_kg_m2;
  }
  std::vector<bool> is_held(std::size_t(n), false);
  for (const auto& b : rotor.bearings) {
    const Index u = unknown_at(ends, b.z_m);
    if (std::isfinite(b.stiffness_N_m))
      all.stiffness(u, u) += b.stiffness_N_m;
    else
      is_held[std::size_t(u)] = true;
  }
  std::vector<Index> free;
  for (Index u = 0; u < n; ++u)
    if (!is_held[std::size_t(u)]) free.push_back(u);
  for (auto* matrix : {&all.mass, &all.gyroscopic, &all.stiffness}) *matrix = (*matrix)(free, free).eval();
  return all;
}

}  // namespace

// With p = w q, (1) is the symmetric problem (0 K; K W G) (q; p) = w (K 0; 0 M) (q; p).
WhirlFrequencies whirl_frequencies(const Rotor& rotor, double spin_rad_s) {
  const auto of = matrices_of(rotor);
  const Index n = of.mass.rows();
  MatrixXd a = MatrixXd::Zero(2 * n, 2 * n), b = a;
  a.topRightCorner(n, n) = a.bottomLeftCorner(n, n) = b.topLeftCorner(n, n) = of.stiffness;
  a.bottomRightCorner(n, n) = spin_rad_s * of.gyroscopic;
  b.bottomRightCorner(n, n) = of.mass;
  WhirlFrequencies result;
  for (const double w : symmetric_eigenpairs(a, b).value)
    (w > 0 ? result.forward_rad_s : result.backward_rad_s).push_back(std::abs(w));
  std::reverse(result.backward_rad_s.begin(), result.backward_rad_s.end());
  return result;
}

// As (M - G / n) q = 1 / w^2 K q, since K alone is positive definite.
std::vector<double> critical_speeds_rad_s(const Rotor& rotor, double order) {
  if (!(std::abs(order) > 0)) throw std::invalid_argument("rotor: a load of order 0 meets no whirl");
  const auto of = matrices_of(rotor);
  const auto inverse_square = symmetric_eigenpairs(of.mass - of.gyroscopic / order, of.stiffness).value;
  const double round_off = 1e-14 * inverse_square.cwiseAbs().maxCoeff();
  std::vector<double> speeds;
  for (Index i = inverse_square.size() - 1; i >= 0 && inverse_square[i] > round_off; --i)
    speeds.push_back(1 / (std::sqrt(inverse_square[i]) * std::abs(order)));
  return speeds;
}

}  // namespace fem

#include "fem/models/beam/fillet_factors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace fem {
namespace {

/// a, b, c of C1 to C4.
using Coefficients = std::array<std::array<double, 3>, 4>;

constexpr Coefficients tension_flat{
    {{.926, 1.157, -.099}, {.012, -3.036, .961}, {-.302, 3.977, -1.744}, {.365, -2.098, .878}}};
constexpr Coefficients tension_steep{
    {{1.200, .860, -.022}, {-1.805, -.346, -.038}, {2.198, -.486, .165}, {-.593, -.028, -.106}}};
constexpr Coefficients bending_flat{
    {{.947, 1.206, -.131}, {.022, -3.405, .915}, {.869, 1.777, -.555}, {-.810, .422, -.260}}};
constexpr Coefficients bending_steep{
    {{1.232, .832, -.008}, {-3.813, .968, -.260}, {7.423, -4.868, .869}, {-3.839, 3.070, -.600}}};
constexpr Coefficients torsion_all{
    {{.905, .783, -.075}, {-.437, -1.969, .553}, {1.557, 1.073, -.578}, {-1.061, .171, .086}}};

/// A, B, C, z of DIN 743-2.
struct Din {
  double a, b, c, z;
};
constexpr Din din_tension{.62, 3.5, 0, 1}, din_bending{.62, 5.8, .2, 3}, din_torsion{3.4, 19, 1, 2};

double peterson(const Coefficients& k, double t, double x) {
  double sum = 0, power = 1;
  for (const auto& c : k) {
    sum += (c[0] + c[1] * std::sqrt(x) + c[2] * x) * power;
    power *= t;
  }
  return sum;
}

double din_743(const Din& f, double d, double D, double r) {
  const double h = (D - d) / 2, slim = 1 + 2 * r / d;
  return 1 + 1 / std::sqrt(f.a * r / h + 2 * f.b * r / d * slim * slim + f.c * std::pow(r / h, f.z) * d / D);
}

}  // namespace

FilletFactors fillet_factors(double small_diameter_m, double large_diameter_m, double fillet_m) {
  const double d = small_diameter_m, D = large_diameter_m, r = fillet_m;
  if (!(d > 0 && D > d && r > 0))
    throw std::invalid_argument("fillet of " + std::to_string(1e3 * r) + " mm between diameters " +
                                std::to_string(1e3 * d) + " and " + std::to_string(1e3 * D) +
                                " mm: needs a step and a positive radius");
  const double h = (D - d) / 2, x = h / r, t = 2 * h / D;
  FilletFactors k;
  if (x >= 0.1 && x <= 20) {
    k.tension = peterson(x <= 2 ? tension_flat : tension_steep, t, x);
    k.bending = peterson(x <= 2 ? bending_flat : bending_steep, t, x);
  } else {
    k.tension = din_743(din_tension, d, D, r);
    k.bending = din_743(din_bending, d, D, r);
  }
  k.torsion = x >= 0.25 && x <= 4 ? peterson(torsion_all, t, x) : din_743(din_torsion, d, D, r);
  return {std::max(1.0, k.tension), std::max(1.0, k.bending), std::max(1.0, k.torsion)};
}

}  // namespace fem

/// Internal resultants of one unit of every load against sums over small pieces of its traction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "pipelines/loads/channels/statics.h"

namespace {

using pipelines::internal_resultant;
using Component = fem::SurfaceResultant::Component;
using Field = fem::BodyForce::Field;
using Vector = std::array<double, 3>;
using Resultant6 = std::array<double, 6>;

const fem::LoadSurface seat{fem::LoadSurface::Kind::seat, 1, {0.004, -0.003, 0.5}, 0.02, 0.12};

void add(Resultant6& sum, const Vector& f, const Vector& at, double z) {
  const double x = at[0], y = at[1], arm = at[2] - z;
  for (std::size_t c = 0; c < 3; ++c) sum[c] += f[c];
  sum[3] += y * f[2] - arm * f[1];
  sum[4] += arm * f[0] - x * f[2];
  sum[5] += x * f[1] - y * f[0];
}

/// What holds the part below z: minus the sum over the pieces below it. The seat is cut into rings, `load`
/// gives force and couple per length at zeta in [-1, 1] of the half length.
using Density = std::function<std::pair<Vector, Vector>(double zeta)>;
Resultant6 of_rings(const fem::LoadSurface& surface, const Density& load, double z) {
  Resultant6 sum{};
  constexpr int n = 6000;
  const double half = surface.length_m / 2, step = surface.length_m / n;
  for (int i = 0; i < n; ++i) {
    const double zeta = -1 + (2.0 * i + 1) / n, at = surface.centre_m[2] + zeta * half;
    if (at > z) break;
    auto [force, couple] = load(zeta);
    for (double& f : force) f *= step;
    add(sum, force, {surface.centre_m[0], surface.centre_m[1], at}, z);
    for (std::size_t c = 0; c < 3; ++c) sum[3 + c] += couple[c] * step;
  }
  for (double& component : sum) component = -component;
  return sum;
}

/// Planes between the pieces (6000 of them in 0.12 m), so that only the midpoint rule errs: 1/6000^2.
const std::vector<double> planes{0.40, 0.45, 0.47, 0.5, 0.515, 0.55, 0.7};
constexpr double midpoint = 1e-6;

void expect_same(const fem::UnitLoad& load, const meshes::Shaft& shaft,
                 const std::function<Resultant6(double)>& wanted, double tolerance) {
  for (const double z : planes) {
    const auto got = internal_resultant(load, shaft, 7850, z), right = wanted(z);
    for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(got[c], right[c], tolerance) << "z " << z << " row " << c;
  }
}

fem::UnitLoad on(const fem::LoadSurface& surface, Component component) {
  return {"port.load", fem::SurfaceResultant{surface, component}};
}

class Profile : public testing::TestWithParam<std::vector<double>> {};

// Force per length: the profile, less a part linear in z that takes its couple about the seat's middle away.
TEST_P(Profile, ForceAcross) {
  const auto& values = GetParam();
  auto surface = seat;
  surface.axial_profile = values;
  const auto raw = [&](double zeta) {
    if (values.size() == 1) return 1.0;
    const double place = (zeta + 1) / 2 * double(values.size() - 1);
    const auto i = std::min(std::size_t(place), values.size() - 2);
    return values[i] + (values[i + 1] - values[i]) * (place - double(i));
  };
  double whole = 0, first = 0;
  constexpr int n = 60000;
  for (int i = 0; i < n; ++i) {
    const double zeta = -1 + (2.0 * i + 1) / n;
    whole += raw(zeta) * surface.length_m / n;
    first += raw(zeta) * zeta * surface.length_m / n;
  }
  // integral of zeta^2 over the length is length / 3.
  const auto density = [&](double zeta) {
    return raw(zeta) / whole - first / whole * 3 / surface.length_m * zeta;
  };
  const auto along_x = [&](double zeta) { return std::pair{Vector{density(zeta), 0, 0}, Vector{}}; };
  const auto along_y = [&](double zeta) { return std::pair{Vector{0, density(zeta), 0}, Vector{}}; };
  expect_same(
      on(surface, Component::fx), {}, [&](double z) { return of_rings(surface, along_x, z); }, midpoint);
  expect_same(
      on(surface, Component::fy), {}, [&](double z) { return of_rings(surface, along_y, z); }, midpoint);
}

INSTANTIATE_TEST_SUITE_P(shapes, Profile,
                         testing::Values(std::vector<double>{1}, std::vector<double>{0, 1},
                                         std::vector<double>{3, 1, 0}, std::vector<double>{1, 2, 0, 5, 1}));

// fz and torque: traction tapered by 1 - zeta^2, 3/(2 b) of it per length.
TEST(StaticsByIntegration, AxialForceAndTorque) {
  const auto taper = [](double zeta) { return 1.5 * (1 - zeta * zeta) / seat.length_m; };
  const auto axial = [&](double zeta) { return std::pair{Vector{0, 0, taper(zeta)}, Vector{}}; };
  const auto torque = [&](double zeta) { return std::pair{Vector{}, Vector{0, 0, taper(zeta)}}; };
  expect_same(
      on(seat, Component::fz), {}, [&](double z) { return of_rings(seat, axial, z); }, midpoint);
  expect_same(
      on(seat, Component::torque), {}, [&](double z) { return of_rings(seat, torque, z); }, midpoint);
}

// mx, my: pressure proportional to z from the middle: 12 z / b^3 of force per length and N m, along +x for
// +my (z x x = y), along -y for +mx.
TEST(StaticsByIntegration, TiltingMoments) {
  const auto linear = [](double zeta) { return 12 * zeta * seat.length_m / 2 / std::pow(seat.length_m, 3); };
  const auto about_y = [&](double zeta) { return std::pair{Vector{linear(zeta), 0, 0}, Vector{}}; };
  const auto about_x = [&](double zeta) { return std::pair{Vector{0, -linear(zeta), 0}, Vector{}}; };
  // Shears of up to 0.75 / half length per N m.
  expect_same(
      on(seat, Component::my), {}, [&](double z) { return of_rings(seat, about_y, z); }, 20 * midpoint);
  expect_same(
      on(seat, Component::mx), {}, [&](double z) { return of_rings(seat, about_x, z); }, 20 * midpoint);
}

// A face loads its one plane: all of it above, nothing below.
TEST(StaticsByIntegration, Faces) {
  fem::LoadSurface face;
  face.kind = fem::LoadSurface::Kind::face;
  face.centre_m = {0.01, 0.02, 0.5};
  for (int c = 0; c < 6; ++c) {
    const auto load = on(face, Component(c));
    for (const double component : internal_resultant(load, {}, 7850, 0.499)) EXPECT_EQ(component, 0);
    Resultant6 sum{};
    Vector force{};
    if (c < 3)
      force[std::size_t(c)] = 1;
    else
      sum[std::size_t(c)] = 1;
    add(sum, force, face.centre_m, 0.7);
    const auto got = internal_resultant(load, {}, 7850, 0.7);
    for (std::size_t r = 0; r < 6; ++r) EXPECT_NEAR(got[r], -sum[r], 1e-16) << c << r;
  }
}

TEST(StaticsByIntegration, HarmonicsOfPressureCarryNothing) {
  const fem::UnitLoad load{"port.p2c", fem::SeatPressure{seat, 2, 0.4, fem::SeatPressure::Phase::cosine}};
  for (const double z : planes)
    for (const double component : internal_resultant(load, {}, 7850, z)) EXPECT_EQ(component, 0);
}

/// Two segments, one of them eccentric at an angle, both bored about the z axis.
meshes::Shaft bored_and_eccentric() {
  meshes::ShaftSegment first, second;
  first.name = "first";
  first.begin_m = 0.1;
  first.end_m = 0.48;
  first.diameter_m = 0.08;
  first.bore_m = 0.03;
  second.name = "second";
  second.begin_m = 0.48;
  second.end_m = 0.9;
  second.diameter_m = 0.06;
  second.eccentricity_m = 0.005;
  second.eccentricity_angle_rad = 2.3;
  second.bore_m = 0.02;
  return {{first, second}, {0}};
}

/// Sum over small volumes of rho a: rings in z, radius and angle about each circle's own axis.
Resultant6 of_volumes(const meshes::Shaft& shaft, Field field, double z) {
  Resultant6 sum{};
  const auto disc = [&](const meshes::ShaftSegment& s, double radius, double sign, double ex, double ey) {
    constexpr int n_z = 40, n_r = 60, n_t = 8;
    const double end = std::min(s.end_m, z), dz = (end - s.begin_m) / n_z, dr = radius / n_r;
    if (end <= s.begin_m) return;
    for (int i = 0; i < n_z; ++i)
      for (int j = 0; j < n_r; ++j)
        for (int k = 0; k < n_t; ++k) {
          const double r = (j + 0.5) * dr, t = 2 * M_PI * k / n_t;
          const double x = ex + r * std::cos(t), y = ey + r * std::sin(t);
          const double mass = sign * 7850 * r * dr * (2 * M_PI / n_t) * dz;
          Vector a{};
          if (field == Field::rotation)
            a = {-y, x, 0};
          else if (field == Field::spin)
            a = {x, y, 0};
          else
            a[std::size_t(field)] = 1;
          for (double& component : a) component *= mass;
          add(sum, a, {x, y, s.begin_m + (i + 0.5) * dz}, z);
        }
  };
  for (const auto& s : shaft.segments) {
    disc(s, s.diameter_m / 2, 1, s.eccentricity_m * std::cos(s.eccentricity_angle_rad),
         s.eccentricity_m * std::sin(s.eccentricity_angle_rad));
    disc(s, s.bore_m / 2, -1, 0, 0);
  }
  for (double& component : sum) component = -component;
  return sum;
}

// Midpoints in the radius miss r^3 by 1/(2 n^2): 1.4e-4 of the polar inertia, 2e-2 kg m2 of it in all.
TEST(StaticsByIntegration, BodyForcesOfABoredEccentricShaft) {
  const auto shaft = bored_and_eccentric();
  for (const Field field :
       {Field::translation_x, Field::translation_y, Field::translation_z, Field::rotation, Field::spin})
    expect_same(
        {"volume.a", fem::BodyForce{field}}, shaft, [&](double z) { return of_volumes(shaft, field, z); },
        field == Field::rotation ? 3e-6 : 1e-11);
}

/// What one unit of a body force does to the rings of both fillets of `necked`, in thin slices.
Resultant6 of_fillet_rings(Field field, double z) {
  constexpr int n = 20000;
  constexpr double foot_1 = 0.46, foot_2 = 0.54, r = 0.03, fillet = 0.02;
  Resultant6 sum{};
  for (int i = 0; i < n; ++i)
    for (const double side : {-1.0, 1.0}) {
      const double along = fillet * (i + 0.5) / n;
      const double at = side < 0 ? foot_1 - along : foot_2 + along;
      if (at > z) continue;
      const double outer = r + fillet - std::sqrt(fillet * fillet - along * along);
      const double mass = 7850 * M_PI * (outer * outer - r * r) * fillet / n;
      Vector force{};
      if (field <= Field::translation_z) force[std::size_t(field)] = mass;
      if (field == Field::rotation) sum[5] += mass * (outer * outer + r * r) / 2;
      add(sum, force, {0, 0, at}, z);
    }
  for (double& component : sum) component = -component;
  return sum;
}

// A neck of 60 mm between 120 mm, with fillets of 20 mm: their rings have 0.292 of 63.3 kg.
TEST(StaticsByIntegration, BodyForcesOfFillets) {
  const meshes::Shaft sharp{{{"a", 0.1, 0.44, 0.12}, {"neck", 0.44, 0.56, 0.06}, {"b", 0.56, 0.9, 0.12}},
                            {0, 0}};
  auto necked = sharp;
  necked.fillets_m = {0.02, 0.02};
  for (const Field field :
       {Field::translation_x, Field::translation_y, Field::translation_z, Field::rotation, Field::spin}) {
    const fem::UnitLoad load{"volume.a", fem::BodyForce{field}};
    const auto wanted = [&](double z) {
      auto whole = internal_resultant(load, sharp, 7850, z);
      const auto rings = of_fillet_rings(field, z);
      for (std::size_t c = 0; c < 6; ++c) whole[c] += rings[c];
      return whole;
    };
    expect_same(load, necked, wanted, 1e-6);
  }
}

}  // namespace

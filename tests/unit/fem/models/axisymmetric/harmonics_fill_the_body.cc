// The harmonics' result inside the body: nodes, cells, sections, rings, the axis, cut cells.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "fem/base/values/constants.h"
#include "fem/models/axisymmetric/axisymmetric_responses.h"
#include "fem/models/solid/model.h"
#include "tests/unit/fem/examples/meridian_tube.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using Field = fem::BodyForce::Field;
using fem::pi;

using fem_tests::face, fem_tests::left, fem_tests::right, fem_tests::outside, fem_tests::tube;

double radius_of(const fem::Nodes& nodes, std::size_t i) {
  return std::hypot(nodes.xyz_m[3 * i], nodes.xyz_m[3 * i + 1]);
}

/// The stepped shaft of the tests, concentric, and its loads.
struct Stepped {
  meshes::Shaft shaft = fem_tests::small_eccentric_shaft();
  meshes::ShaftMeshControl control;
  fem_tests::ShaftBody solid;
  fem::MeridianBody section;
  std::vector<fem::UnitLoad> loads;

  explicit Stepped(double eccentricity_m = 0) {
    shaft.segments[1].eccentricity_m = eccentricity_m;
    control.cells_per_fillet_quarter = 4;
    control.n_sectors = 12;
    solid = fem_tests::build(shaft, control);
    section = fem_tests::half_section(shaft, control);
    section.n_angles = 24;
    for (const auto* port : {"bearing_1", "seat", "bearing_2"})
      for (const auto c : {Component::fx, Component::fy, Component::torque})
        loads.push_back(fem_tests::resultant(solid, port, c));
    loads.push_back(fem_tests::resultant(solid, "end_1", Component::fz));
    loads.push_back(fem_tests::resultant(solid, "end_2", Component::fz));
    loads.push_back({"spin", fem::BodyForce{Field::spin}});
  }
};

// Every cell's volume by its corners is positive or, at the axis, collapsed; the nodes' volumes add up to the
// ring, and each inner face of the cells is shared by two of them.
TEST(HarmonicsInside, CellsFillTheBody) {
  Stepped shaft;
  shaft.section.n_cuts = 1;
  shaft.section.fine_circles = {{-0.023, 0.0158, 0.0003}};
  const auto r = fem::axisymmetric_responses(shaft.section, {shaft.loads.front()});
  const auto& nodes = r.nodes;
  ASSERT_EQ(nodes.degree, 1);
  ASSERT_GT(nodes.n_cells(), 0u);
  EXPECT_EQ(nodes.cell_volume_id.size(), nodes.n_cells());
  double sum = 0;
  for (const double v : nodes.volume_m3) {
    EXPECT_GT(v, 0);
    sum += v;
  }
  const double exact = fem::axisymmetric_masses(shaft.section).volume_m3;
  EXPECT_NEAR(sum, exact, 1e-12 * exact);
  // The solid's quadratic cells, 12 around, miss of a disc (its own test): 1e-3.
  EXPECT_NEAR(exact, fem::Model(shaft.solid.body).mass_properties().volume_m3, 1e-3 * exact);

  const auto at = [&](std::int32_t i) { return Eigen::Vector3d(&nodes.xyz_m[3 * std::size_t(i)]); };
  double by_corners = 0;
  std::map<std::set<std::int32_t>, int> faces;
  const int sides[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                           {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    // Six tetrahedra around the diagonal 0 - 6.
    double volume = 0;
    const int around[6] = {1, 2, 3, 7, 4, 5};
    for (int k = 0; k < 6; ++k) {
      const Eigen::Vector3d a = at(cell[6]) - at(cell[0]);
      volume += a.cross(at(cell[std::size_t(around[k])]) - at(cell[0]))
                    .dot(at(cell[std::size_t(around[(k + 1) % 6])]) - at(cell[0])) /
                6;
    }
    EXPECT_GT(volume, 0) << c;
    by_corners += volume;
    for (const auto& side : sides) {
      std::set<std::int32_t> corners;
      for (const int i : side) corners.insert(cell[std::size_t(i)]);
      if (corners.size() > 2) ++faces[corners];  // else a line
    }
  }
  // 24 chords of a circle cover 0.989 of it.
  EXPECT_NEAR(by_corners, sum * std::sin(2 * pi / 24) / (2 * pi / 24), 1e-3 * sum);
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto face = nodes.face(f);
    EXPECT_EQ(faces[std::set<std::int32_t>(face.begin(), face.end())], 1);
    faces.erase(std::set<std::int32_t>(face.begin(), face.end()));
  }
  for (const auto& [corners, n] : faces) EXPECT_EQ(n, 2);
}

// Cells at the surface are shown as they are cut, and with them what decays below it: the point next inside
// was 14 times as deep as a face long, now at most 6 times, which the first cells are by themselves.
TEST(HarmonicsInside, CellsAtTheSurfaceAreAsDeepAsLong) {
  Stepped shaft;
  shaft.section.n_cuts = 1;
  shaft.section.fine_circles = {{-0.023, 0.0158, 0.0001}};
  const auto r = fem::axisymmetric_responses(shaft.section, {shaft.loads.front()});
  const auto& nodes = r.nodes;
  const auto half_plane = [&](std::int32_t i) {
    return Eigen::Vector2d(nodes.xyz_m[3 * std::size_t(i) + 2], radius_of(nodes, std::size_t(i)));
  };
  std::map<std::set<std::int32_t>, double> length_m;  // of faces, along the half plane
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto face = nodes.face(f);
    length_m[std::set<std::int32_t>(face.begin(), face.end())] =
        (half_plane(face[0]) - half_plane(face[1])).norm();
  }
  int n_fine = 0;
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    const std::set<std::int32_t> corners(cell.begin(), cell.end());
    for (const auto& [face, own_m] : length_m) {
      if (own_m > 0.00015 || !std::includes(corners.begin(), corners.end(), face.begin(), face.end()))
        continue;
      ++n_fine;
      for (const auto i : corners)
        EXPECT_LE((half_plane(i) - half_plane(*face.begin())).norm(), 8 * own_m) << c;
    }
  }
  EXPECT_GT(n_fine, 0);
}

// A long solid cylinder that turns, plane strain across its middle: on the axis both stresses across are
// rho (3 - 2 nu) / (8 (1 - nu)) b^2; along it they make no force (Timoshenko and Goodier, article 119).
TEST(HarmonicsInside, SpinPeaksOnTheAxis) {
  const double b = 0.02, L = 0.2, nu = fem_tests::steel.poisson_ratio;
  const auto r = fem::axisymmetric_responses(tube(0, b, L, 20, 4), {{"spin", fem::BodyForce{Field::spin}}});
  const double scale = 7850 * b * b / (8 * (1 - nu));
  int on_axis = 0;
  for (std::size_t i = 0; i < r.nodes.n; ++i) {
    if (std::abs(r.nodes.xyz_m[3 * i + 2] - L / 2) > 1e-9 || radius_of(r.nodes, i) > 0) continue;
    ++on_axis;
    const double* s = &r.stress_Pa[6 * i];
    // Cubic cells hold the cubic displacement exactly; the ends, five diameters away, 1e-6.
    EXPECT_NEAR(s[0], (3 - 2 * nu) * scale, 1e-5 * scale);
    EXPECT_NEAR(s[1], s[0], 1e-12 * scale);
    EXPECT_NEAR(s[2], 2 * nu * scale, 1e-5 * scale);
    for (int c = 3; c < 6; ++c) EXPECT_EQ(s[c], 0);
  }
  EXPECT_EQ(on_axis, 1);
}

// Lame's tube of a rubbery material: the difference of both stresses is as good as ever, 1 / r on 8 cubic
// cells; what the dilatation is off by, 1e-3, the bulk modulus multiplies by 1 / (1 - 2 nu) = 50.
TEST(HarmonicsInside, AlmostIncompressibleTube) {
  const double a = 0.02, b = 0.05, L = 0.06;
  auto body = tube(a, b, L, 4, 8);
  body.material.poisson_ratio = 0.49;
  const fem::LoadSurface seat{fem::LoadSurface::Kind::seat, outside, {0, 0, L / 2}, b, L};
  const auto r = fem::axisymmetric_responses(body, {{"p", fem::SeatPressure{seat}}});
  const double p = 1 / (pi * b * L);
  for (std::size_t i = 0; i < r.nodes.n; ++i) {
    const double radius = radius_of(r.nodes, i), c = r.nodes.xyz_m[3 * i] / radius,
                 s = r.nodes.xyz_m[3 * i + 1] / radius;
    const double A = -p * b * b / (b * b - a * a), ratio = a * a / (radius * radius);
    const double radial = A * (1 - ratio), hoop = A * (1 + ratio);
    const double* sigma = &r.stress_Pa[6 * i];
    EXPECT_NEAR(sigma[0] - sigma[1], (radial - hoop) * (c * c - s * s), 5e-3 * p);
    EXPECT_NEAR(sigma[3], (radial - hoop) * c * s, 5e-3 * p);
    EXPECT_NEAR(sigma[0] + sigma[1], radial + hoop, 0.1 * p) << radius;
  }
}

// A bar bent by couples at its ends: sections carry M, turn by their share of M / E I, and rings feel torque.
TEST(HarmonicsInside, SectionsOfABar) {
  const double b = 0.03, L = 0.1;
  const std::vector<fem::SectionPlane> planes{{0.025, b, 0, 0, 0}, {0.05, b, 0, 0, 0}, {0.075, b, 0, 0, 0}};
  std::vector<fem::UnitLoad> loads;
  for (int end = 0; end < 2; ++end)
    for (int c = 0; c < 6; ++c)
      loads.push_back({std::to_string(end) + "." + std::to_string(c),
                       fem::SurfaceResultant{face(end == 0 ? left : right, end * L), Component(c)}});
  auto body = tube(0, b, L, 4, 2);
  body.n_cuts = 1;
  const auto r = fem::axisymmetric_responses(body, loads, planes);
  ASSERT_EQ(r.sections.size(), planes.size() * loads.size());
  const double area = pi * b * b, inertia = area * b * b / 4, E = fem_tests::steel.youngs_modulus_Pa;
  EXPECT_NEAR(r.plane_area_m2[1], area, 1e-12 * area);
  const auto section = [&](int c, std::size_t plane) {
    const auto n = std::to_string(c);
    return fem_tests::section(r, {{"0." + n, -1}, {"1." + n, 1}}, plane);
  };
  for (std::size_t p = 0; p < planes.size(); ++p)
    for (const int c : {2, 3, 4, 5})
      for (int k = 0; k < 6; ++k)
        EXPECT_NEAR(section(c, p).resultant[std::size_t(k)], k == c ? 1 : 0, 1e-7) << c << " " << k;
  EXPECT_NEAR(section(3, 2).rotation_rad[0] - section(3, 0).rotation_rad[0], 0.05 / (E * inertia),
              1e-7 * 0.05 / (E * inertia));
  EXPECT_NEAR(section(4, 2).rotation_rad[1] - section(4, 0).rotation_rad[1], 0.05 / (E * inertia),
              1e-7 * 0.05 / (E * inertia));
  EXPECT_NEAR(section(2, 2).translation_m[2] - section(2, 0).translation_m[2], 0.05 / (E * area),
              1e-7 * 0.05 / (E * area));
  const double torsion = 2 * (1 + fem_tests::steel.poisson_ratio) * 0.05 / (E * 2 * inertia);
  EXPECT_NEAR(section(5, 2).rotation_rad[2] - section(5, 0).rotation_rad[2], torsion, 1e-7 * torsion);
  EXPECT_NEAR(section(5, 1).mean_rim_shear_Pa[1], b / (2 * inertia), 1e-7 * b / inertia);
  // The line of deflection has its slope.
  EXPECT_NEAR((section(4, 2).translation_m[0] - section(4, 0).translation_m[0]) / 0.05,
              (section(4, 2).rotation_rad[1] + section(4, 0).rotation_rad[1]) / 2,
              1e-3 * 0.05 / (E * inertia));
  ASSERT_FALSE(r.rings.empty());
  for (std::size_t i = 0; i < r.rings.size(); ++i) {
    EXPECT_NEAR(r.rings[i].radius_m, b, 1e-12);
    const auto& shear = r.ring_shear_Pa;
    EXPECT_NEAR(shear[i * loads.size() + 11][1] - shear[i * loads.size() + 5][1], b / (2 * inertia),
                1e-7 * b / inertia);
  }
  EXPECT_THROW(fem::axisymmetric_responses(body, loads, {{0.04, b, 0, 0, 0}}), std::invalid_argument);
}

// Section for section the solid's figures under loads that close, its own coarse mesh apart.
TEST(HarmonicsInside, SectionsAreThoseOfTheSolid) {
  const std::vector<fem_tests::LoadCase> cases{
      {{"seat.fx", 1}, {"bearing_1.fx", -0.5}, {"bearing_2.fx", -0.5}},
      {{"seat.fy", 1}, {"bearing_1.fy", -0.5}, {"bearing_2.fy", -0.5}},
      {{"seat.torque", 1}, {"bearing_1.torque", -1}},
      {{"end_2.fz", 1}, {"end_1.fz", -1}}};
  for (const double eccentricity_m : {0.0, 0.002}) {
    const Stepped shaft(eccentricity_m);
    const auto a = fem::Model(shaft.solid.body).unit_responses(shaft.loads, shaft.solid.planes);
    const auto b = fem::axisymmetric_responses(shaft.section, shaft.loads, shaft.solid.planes);
    ASSERT_EQ(a.sections.size(), b.sections.size());
    // Tension bends an eccentric segment, which has no place in a body of revolution.
    for (std::size_t k = 0; k < (eccentricity_m > 0 ? 3 : cases.size()); ++k) {
      double motion = 0, rotation = 0;
      for (std::size_t p = 0; p < a.planes.size(); ++p)
        for (std::size_t c = 0; c < 3; ++c) {
          motion = std::max(motion, std::abs(fem_tests::section(a, cases[k], p).translation_m[c]));
          rotation = std::max(rotation, std::abs(fem_tests::section(a, cases[k], p).rotation_rad[c]));
        }
      for (std::size_t p = 0; p < a.planes.size(); ++p) {
        const auto solid = fem_tests::section(a, cases[k], p), own = fem_tests::section(b, cases[k], p);
        // The solid's recovered stress on 12 sectors is 1 % off beside the seats; an arm is 2 cm. An
        // eccentric segment is stiffer or softer than the concentric one by its offset over its radius, 8 %;
        // twist is about its own axis.
        constexpr double rounding = 1e-16;  // m, rad; a newton moves it by 1e-10
        const double share = eccentricity_m > 0 ? 0.1 : 0.03;
        for (std::size_t c = 0; c < 6; ++c)
          EXPECT_NEAR(own.resultant[c], solid.resultant[c], c < 3 ? 0.02 : 0.02 * (k == 2 ? 1 : 0.02))
              << eccentricity_m << " case " << k << " plane " << p << " " << c;
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(own.translation_m[c], solid.translation_m[c],
                      share * motion + eccentricity_m * rotation + rounding)
              << eccentricity_m << " case " << k << " plane " << p << " " << c;
          EXPECT_NEAR(own.rotation_rad[c], solid.rotation_rad[c], share * rotation + rounding)
              << eccentricity_m << " case " << k << " plane " << p << " " << c;
        }
      }
    }
  }
}

// Fine circles change nothing of what a polynomial field is, hanging nodes and all: bending stays exact.
TEST(HarmonicsInside, CutCellsKeepPolynomials) {
  const double b = 0.03, L = 0.1, inertia = pi / 4 * std::pow(b, 4);
  auto body = tube(0, b, L, 4, 2);
  body.fine_circles = {{0.03, b, 0.001}, {0.07, 0, 0.002}};
  const auto r =
      fem::axisymmetric_responses(body, {{"1", fem::SurfaceResultant{face(left, 0), Component::my}},
                                         {"2", fem::SurfaceResultant{face(right, L), Component::my}}});
  const auto coarse = fem::axisymmetric_responses(
      tube(0, b, L, 4, 2), {{"1", fem::SurfaceResultant{face(left, 0), Component::my}}});
  EXPECT_GT(r.n_dofs, 3 * coarse.n_dofs);
  for (std::size_t i = 0; i < r.nodes.n; ++i) {
    const auto s = fem_tests::stress(r, {{"1", -1}, {"2", 1}}, i);
    for (std::size_t c = 0; c < 6; ++c)
      EXPECT_NEAR(s[c], c == 2 ? -r.nodes.xyz_m[3 * i] / inertia : 0, 1e-7 * b / inertia) << i << " " << c;
  }
}

// Body forces take the resultants of the masses that the loads were made with.
TEST(HarmonicsInside, BodyForcesHaveTheMassesOfTheLoads) {
  Stepped shaft(0.002);
  const auto masses = fem::Model(shaft.solid.body).mass_properties();
  shaft.section.masses_of_loads = masses;
  std::vector<fem::UnitLoad> loads;
  for (int f = 0; f < 5; ++f) loads.push_back({std::to_string(f), fem::BodyForce{Field(f)}});
  const auto r = fem::axisymmetric_responses(shaft.section, loads);
  const auto solid = fem::Model(shaft.solid.body).unit_responses(loads, {});
  for (std::size_t k = 0; k < loads.size(); ++k)
    for (std::size_t c = 0; c < 6; ++c) {
      const double scale = k < 3 ? masses.mass_kg : 0.05 * masses.mass_kg;
      EXPECT_NEAR(r.resultants[k][c], solid.resultants[k][c], 1e-12 * scale) << k << " " << c;
    }
}

}  // namespace

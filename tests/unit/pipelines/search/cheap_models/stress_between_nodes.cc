// Stress between the half planes and between the points of a section: closed forms, and bodies that are
// turned or divided otherwise and have the same stress.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipelines/search/cheap_models/circle_patch.h"
#include "pipelines/superpose/envelope/superposition.h"
#include "tests/unit/pipelines/search/cheap_models/loaded_shaft.h"

namespace {

using namespace pipelines;
using loaded_shaft::LoadedShaft;
using loaded_shaft::scene_of;

/// Components about the axis rr, tt, zz, rt, tz, rz that change around by harmonics up to 23 and along by a
/// parabola.
std::array<double, 6> about_axis(double z_m, double angle_rad) {
  std::array<double, 6> s;
  for (std::size_t c = 0; c < 6; ++c) {
    const double k = double(c);
    s[c] = 1 + k + (2 + k) * z_m - 30 * z_m * z_m + std::cos(angle_rad - k) * (1 + 5 * z_m) +
           0.5 * std::sin((4 * k + 3) * angle_rad + 0.3 * k);
  }
  return s;
}

std::array<double, 6> cartesian(const std::array<double, 6>& s, double angle_rad) {
  const double c = std::cos(angle_rad), n = std::sin(angle_rad);
  return {c * c * s[0] + n * n * s[1] - 2 * c * n * s[3],
          n * n * s[0] + c * c * s[1] + 2 * c * n * s[3],
          s[2],
          c * n * (s[0] - s[1]) + (c * c - n * n) * s[3],
          c * s[4] + n * s[5],
          c * s[5] - n * s[4]};
}

/// Three circles of a cylinder of radius 0.1 m at z = 0, 0.04 and 0.1 m.
fem::UnitResponses three_circles(int n_angles) {
  fem::UnitResponses r;
  r.channels = {"one", "two"};
  for (const double z : {0.0, 0.04, 0.1})
    for (int j = 0; j < n_angles; ++j) {
      const double angle = 2 * M_PI * j / n_angles;
      r.nodes.xyz_m.insert(r.nodes.xyz_m.end(), {0.1 * std::cos(angle), 0.1 * std::sin(angle), z});
      for (const double factor : {1.0, -2.0})
        for (const double component : cartesian(about_axis(z, angle), angle))
          r.stress_Pa.push_back(factor * component);
      for (int k = 0; k < 2; ++k)  // radially by 3 z, around by 2
        r.displacement_m.insert(r.displacement_m.end(),
                                {3 * z * std::cos(angle) - 2 * std::sin(angle),
                                 3 * z * std::sin(angle) + 2 * std::cos(angle), z * z});
      ++r.nodes.n;
    }
  return r;
}

// The field is of the kind that the interpolation is exact for: rounding alone is left.
TEST(CirclePatch, IsExactForHarmonicsAndParabolas) {
  const int n_angles = 48;
  const auto responses = three_circles(n_angles);
  EXPECT_EQ(first_of_circle(responses.nodes, 48 + 47, n_angles), 48u);
  CirclePatch patch(responses, n_angles, {0, 48, 96});
  Eigen::ArrayXd factors(2);
  factors << 3, 1;  // the sum is 1 of the field
  patch.load(factors);
  for (const double angle : {0.0, 0.05, 1.7, 2 * M_PI / 48, -0.4, 4.0})
    for (const double along : {-0.04, -0.013, 0.0, 0.021, 0.06}) {
      SCOPED_TRACE(testing::Message() << angle << " " << along);
      const double z = 0.04 + along;
      const auto expected = cartesian(about_axis(z, angle), angle);
      const auto unit = patch.unit_stress_Pa({along, angle});
      for (std::size_t c = 0; c < 6; ++c) {
        EXPECT_NEAR(unit[c], expected[c], 1e-11);
        EXPECT_NEAR(unit[6 + c], -2 * expected[c], 1e-11);
      }
      EXPECT_NEAR(patch.von_mises_Pa({along, angle}), von_mises_Pa(expected), 1e-11);
      const auto moved = patch.unit_displacement_m({along, angle});
      EXPECT_NEAR(moved[0], 3 * z * std::cos(angle) - 2 * std::sin(angle), 1e-12);
      EXPECT_NEAR(moved[1], 3 * z * std::sin(angle) + 2 * std::cos(angle), 1e-12);
      EXPECT_NEAR(moved[2], z * z, 1e-12);
      const auto at = patch.position_m({along, angle});
      EXPECT_NEAR(at[0], 0.1 * std::cos(angle), 1e-14);
      EXPECT_NEAR(at[1], 0.1 * std::sin(angle), 1e-14);
      EXPECT_NEAR(at[2], z, 1e-14);
    }
}

/// The overhung shaft pulled in the direction of an angle, by so many harmonics of the bearings' pressure.
Scene pulled_at(double angle_rad, const std::string& harmonics) {
  std::string text = loaded_shaft::overhung;
  const auto one = [&](const char* component, double force_N) {
    return "[[machine.constants]]\neffect = \"pull\"\nload = \"left." + std::string(component) +
           "\"\nvalue = \"" + std::to_string(force_N) + " N\"\n";
  };
  const auto begin = text.find("[[machine.constants]]"), end = text.find("[sampling]");
  text.replace(begin, end - begin,
               one("fx", 12e3 * std::cos(angle_rad)) + one("fy", 12e3 * std::sin(angle_rad)));
  text.insert(text.find("[shaft.material]"), "pressure_harmonics = " + harmonics + "\n");
  return scene_of(text);
}

// A load that turns takes the whole field with it, and no half plane knows where it points. Half way between
// two of them the stress of the first harmonic was 0.2 % low. Harmonic 24 is 0 or twice too large at the
// nodes of 48 half planes; the places on the bearings have it.
TEST(NodesAtMaxima, NoPlaceKnowsWhereTheLoadPoints) {
  for (const char* harmonics : {"4", "24"}) {
    const auto at_plane = LoadedShaft(pulled_at(0, harmonics)).stresses(0.02).places,
               turned = LoadedShaft(pulled_at(M_PI / 48, harmonics)).stresses(0.02).places;
    ASSERT_EQ(at_plane.size(), turned.size());
    for (std::size_t i = 0; i < turned.size(); ++i) {
      EXPECT_EQ(turned[i].feature, at_plane[i].feature);
      if (turned[i].feature == inside_the_body) continue;
      EXPECT_NEAR(turned[i].value_Pa, at_plane[i].value_Pa, 1e-5 * at_plane[i].value_Pa + 1)
          << turned[i].feature;
    }
  }
}

/// A shaft of one diameter that its own inertia bends between bearings at its ends, with two names that meet
/// at `division_mm` from the left.
Scene bent_by_inertia(double division_mm) {
  return scene_of(R"(
title = "Plain"
effects = ["shake"]
[machine]
type = "load_table"
speed = "600 rpm"
[[machine.constants]]
effect = "shake"
load = "volume.ay"
value = "500 m/s2"
[sampling]
instants_per_turn = 8
turns = 1
[shaft]
contour = [
  { port = "left",  diameter = "40 mm", length = "30 mm" },
  { name = "one",   diameter = "40 mm", length = ")" +
                  std::to_string(division_mm) + R"( mm" },
  { name = "two",   diameter = "40 mm", length = ")" +
                  std::to_string(400 - division_mm) + R"( mm" },
  { port = "right", diameter = "40 mm", length = "30 mm" },
]
bearings = ["left", "right"]
axial_support = "right"
torque_support = "right"
[shaft.material]
name = "C45"
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
density = "7850 kg/m3"
yield_strength = "305 MPa"
)");
}

// The names change where the section has its points, not the stress at mid-span; the parabola through
// three points leaves 1.2e-4 of it on a section that is known to 0.2 %, less on the next one.
TEST(NodesAtMaxima, NoPlaceKnowsWhereTheSectionHasItsPoints) {
  const auto largest = [](double division_mm) {
    double largest_Pa = 0;
    for (const auto& place : LoadedShaft(bent_by_inertia(division_mm)).stresses(0.001).places)
      if (place.feature == "one" || place.feature == "two") largest_Pa = std::max(largest_Pa, place.value_Pa);
    return largest_Pa;
  };
  const double reference_Pa = largest(50);
  for (const double division_mm : {71.0, 93.0})
    EXPECT_NEAR(largest(division_mm), reference_Pa, 1e-4 * reference_Pa);
}

}  // namespace

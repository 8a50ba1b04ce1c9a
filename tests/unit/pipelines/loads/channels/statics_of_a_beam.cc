/// Internal resultants by statics against the textbook beam.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/loads/channels/statics.h"
#include "tests/unit/pipelines/examples/laboratory.h"

namespace {

using pipelines::internal_resultant;
using Component = fem::SurfaceResultant::Component;

fem::UnitLoad seat_load(double z, double length, Component component, double offset = 0) {
  return {"seat.load",
          fem::SurfaceResultant{{fem::LoadSurface::Kind::seat, 1, {offset, 0, z}, 0.02, length}, component}};
}

meshes::Shaft bar() {
  return {{{"bar", 0, 1, 0.1, 0, false}}, {}};
}

TEST(Statics, ShearAndMomentOfAForce) {
  const auto load = seat_load(0.5, 0.1, Component::fx);
  const auto before = internal_resultant(load, bar(), 1000, 0.4),
             after = internal_resultant(load, bar(), 1000, 0.8);
  for (const double component : before) EXPECT_EQ(component, 0);
  EXPECT_EQ(after[0], -1);
  EXPECT_NEAR(
      after[4], 0.3,
      1e-15);  // force +x at z = 0.5, 0.3 below the plane: moment (z_F - z) F_x = -0.3 on the part below
  const auto half = internal_resultant(load, bar(), 1000, 0.5);
  EXPECT_NEAR(half[0], -0.5, 1e-15);
  EXPECT_NEAR(half[4], 0.5 * 0.025, 1e-15);
}

TEST(Statics, TorqueAndOffset) {
  const auto torque = seat_load(0.5, 0.1, Component::torque);
  EXPECT_NEAR(internal_resultant(torque, bar(), 1000, 0.5)[5], -0.5, 1e-15);
  EXPECT_NEAR(internal_resultant(torque, bar(), 1000, 0.525)[5], -(0.5 + 0.75 * (0.5 - 0.125 / 3)), 1e-15);
  EXPECT_NEAR(internal_resultant(torque, bar(), 1000, 0.9)[5], -1, 1e-15);
  EXPECT_NEAR(internal_resultant(seat_load(0.5, 0.1, Component::fy, 0.004), bar(), 1000, 0.9)[5], -0.004,
              1e-18);
}

TEST(Statics, WeightOfABar) {
  const fem::UnitLoad weight{"volume.ay", fem::BodyForce{fem::BodyForce::Field::translation_y}};
  const double mass = 1000 * M_PI * 0.05 * 0.05;
  const auto r = internal_resultant(weight, bar(), 1000, 0.6);
  EXPECT_NEAR(r[1], -0.6 * mass, 1e-12);
  EXPECT_NEAR(r[3], -0.6 * mass * 0.3,
              1e-12);  // weight below acts 0.3 lower: -(z_F - z) F_y > 0 on the part below
}

}  // namespace

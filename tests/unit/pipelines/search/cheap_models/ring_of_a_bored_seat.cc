// The beam's estimate of what it leaves out of hollow seats.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/search/cheap_models/cheap_responses.h"

namespace {

constexpr double R = 0.04, bore = 0.02, length = 0.05, wall = R - bore, mean = (R + bore) / 2;

fem::BeamShaft shaft(double bore_m) {
  fem::BeamShaft result;
  result.segments = {{-0.1, 0, 0.05, 0, 0, 0}, {0, 0.1, R, bore_m, 0, 0}};
  return result;
}

fem::UnitLoad pressure(int n, double coefficient, fem::SeatPressure::Phase phase) {
  fem::LoadSurface seat;
  seat.boundary_id = 3;
  seat.centre_m = {0, 0, 0.05};
  seat.radius_m = R;
  seat.length_m = length;
  return {"seat.p", fem::SeatPressure{seat, n, coefficient, phase, false}};
}

}  // namespace

// By hand: p_0 R / t and 6 p_2 R r / (3 t^2); the second harmonic's cosine and sine are one wave that turns.
TEST(RingOfASeat, GoesOvalByRoark) {
  using Phase = fem::SeatPressure::Phase;
  pipelines::BodyLoads loads;
  loads.unit_loads = {pressure(0, 0.6, Phase::cosine), pressure(2, 0.4, Phase::cosine),
                      pressure(2, 0.4, Phase::sine)};
  loads.history.values.resize(3, 2);
  loads.history.values << 1000, 0,  //
      300, 500,                     //
      -400, 0;
  const double area = M_PI * R * length, oval = 6 * 0.4 * R * mean / (3 * wall * wall) / area;
  const double first = 1000 * 0.6 / area * R / wall + 500 * oval, second = 500 * oval;
  ASSERT_GT(first, second);
  EXPECT_NEAR(pipelines::ring_stress_Pa(shaft(bore), loads), first, 1e-12 * first);  // rounding
  loads.history.values(0, 0) = 0;
  EXPECT_NEAR(pipelines::ring_stress_Pa(shaft(bore), loads), second, 1e-12 * second);
  EXPECT_EQ(pipelines::ring_stress_Pa(shaft(0), loads), 0);  // solid
}

// By hand, with nu / (1 - nu) = 3 / 7 in the thin disc's formulas; a hollow shaft has twice as much at a
// small bore as a solid one in its middle. Other channels do not count.
TEST(SpinOfAShaft, IsThatOfALongCylinder) {
  pipelines::BodyLoads loads;
  loads.unit_loads = {{"volume.spin", fem::BodyForce{fem::BodyForce::Field::spin}},
                      {"volume.ax", fem::BodyForce{}}};
  loads.history.values.resize(2, 2);
  loads.history.values << 100, 400,  //
      1e9, 1e9;
  fem::Material steel{206e9, 0.3, 7850};
  const double nu = 0.3 / 0.7;
  const double hollow = 7850 * 400 * ((3 + nu) * 0.05 * 0.05 + (1 - nu) * 0.02 * 0.02) / 4;
  auto one = shaft(0.02);
  for (auto& segment : one.segments) segment.radius_m = 0.05;
  EXPECT_NEAR(pipelines::spin_stress_Pa(one, steel, loads), hollow, 1e-12 * hollow);
  for (auto& segment : one.segments) segment.bore_radius_m = 0;
  const double solid = 7850 * 400 * (3 + nu) * 0.05 * 0.05 / 8;
  EXPECT_NEAR(pipelines::spin_stress_Pa(one, steel, loads), solid, 1e-12 * solid);
  loads.history.values.row(0).setZero();
  EXPECT_EQ(pipelines::spin_stress_Pa(one, steel, loads), 0);
}

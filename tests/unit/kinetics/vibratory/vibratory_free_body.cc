// The chamber cut free: its loads balance, are those of the load stage, and are placed where the ports are.
#include "kinetics/free_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "kinetics/values/machine_refused.h"
#include "kinetics/vibratory_mill.h"
#include "tests/unit/kinetics/series/moment_sum.h"
#include "tests/unit/kinetics/vibratory/machines.h"

namespace {

using Eigen::Vector2d;
using kinetics::FreeBody;
using machines::Sum;

// As for the equilibrium of the delivered resultants: a few roundings in each of some ten terms.
constexpr double rounding = 1e-12;

/// At one instant, of those loads whose names hold the word.
Sum sum_of(const FreeBody& body, const std::string& word, const Vector2d& about, Eigen::Index i) {
  Sum sum(about);
  for (const auto& load : body.loads)
    if (load.name.find(word) != std::string::npos)
      sum.add(load.at_m.col(i).matrix(), load.force_N.col(i).matrix(), load.couple_N_m[i]);
  return sum;
}

std::set<std::string> names(const FreeBody& body) {
  std::set<std::string> all;
  for (const auto& load : body.loads) EXPECT_TRUE(all.insert(load.name).second) << load.name;
  return all;
}

const kinetics::FreeBodyLoad& load_of(const FreeBody& body, std::string_view name) {
  const auto load =
      std::find_if(body.loads.begin(), body.loads.end(), [&](const auto& l) { return l.name == name; });
  EXPECT_NE(load, body.loads.end()) << name;
  return *load;
}

}  // namespace

TEST(VibratoryFreeBody, LoadsOfRandomMillsBalance) {
  std::mt19937 generator(21);
  for (int k = 0; k < 300 && !HasFailure(); ++k) {
    SCOPED_TRACE("machine " + std::to_string(k));
    const auto mill = machines::random(generator);
    const auto body = chamber_free_body(mill, machines::effects_without(mill, {}), {3, 12});
    for (Eigen::Index i = 0; i < body.time_s.size(); ++i)
      for (const Vector2d& about : {Vector2d(0, 0), Vector2d(1.7, -0.9)}) {
        EXPECT_LE(sum_of(body, "", about, i).force(), rounding);
        EXPECT_LE(sum_of(body, "", about, i).moment(), rounding);
      }
  }
}

// The charge's weight and inertia, wherever they act, are what the wall carries; springs and bearing are the
// ports' own loads, at the ports' own places.
TEST(VibratoryFreeBody, LoadsAreThoseOfThePorts) {
  std::mt19937 generator(22);
  for (int k = 0; k < 100 && !HasFailure(); ++k) {
    SCOPED_TRACE("machine " + std::to_string(k));
    const auto mill = machines::random(generator);
    const auto effects = machines::effects_without(mill, {});
    const auto body = chamber_free_body(mill, effects, {3, 12});
    const auto loads = compute_loads(mill, effects, {3, 12});
    const auto& wall = loads.resultant("inner_wall").total;
    const auto& charge = load_of(body, "weight of charge");
    const double scale_N = wall.topRows(2).abs().maxCoeff();
    for (Eigen::Index i = 0; i < body.time_s.size(); ++i) {
      Vector2d force = Vector2d::Zero();
      double moment = 0;
      for (const auto& load : body.loads)
        if (load.name.find("charge") != std::string::npos) {
          force += load.force_N.col(i).matrix();
          moment += machines::cross(load.at_m.col(i).matrix() - mill.chamber_centre_m,
                                    load.force_N.col(i).matrix()) +
                    load.couple_N_m[i];
        }
      EXPECT_LE((force - wall.col(i).head<2>().matrix()).norm(), rounding * scale_N);
      EXPECT_NEAR(moment, wall(2, i),
                  rounding * (scale_N * mill.chamber_centre_m.norm() + std::abs(wall(2, i))));
      EXPECT_EQ(charge.at_m(0, i), loads.quantity("charge_at.x").values[i]);
      EXPECT_EQ(charge.at_m(1, i), loads.quantity("charge_at.y").values[i]);
    }
    for (std::size_t s = 0; s < mill.springs.size(); ++s) {
      const auto number = std::to_string(s + 1);
      const auto& spring = load_of(body, "spring " + number);
      const auto& foot = loads.resultant("spring_foot_" + number).total;
      EXPECT_LE((spring.force_N - foot.topRows(2)).abs().maxCoeff(), rounding * foot.abs().maxCoeff());
      EXPECT_LE((spring.at_m.matrix().colwise() - mill.springs[s].position_m).cwiseAbs().maxCoeff(), 0);
    }
    const auto& bore = loads.resultant("housing_bore").total;
    EXPECT_LE((load_of(body, "bearing").force_N - bore.topRows(2)).abs().maxCoeff(),
              rounding * bore.abs().maxCoeff());
  }
}

// Without pitch the forces balance, and the moment that a guide takes is the one that the load stage reports.
TEST(VibratoryFreeBody, MomentOfTheGuideIsTheReportedOne) {
  const auto mill = machines::laboratory();
  const auto effects = machines::effects_without(mill, {"pitch", "charge_follows_pitch", "charge_lag"});
  const auto body = chamber_free_body(mill, effects, {20, 90});
  const auto& reported = compute_loads(mill, effects, {20, 90}).quantity("moment_residual").values;
  EXPECT_GT(machines::largest(reported), 1000);
  EXPECT_LE(machines::largest(body.moment_sum_N_m() - reported), 1e-9);
  EXPECT_LE(machines::largest(body.force_sum_N().row(1).transpose()), 1e-9);
}

// An effect that is off brings no arrow.
TEST(VibratoryFreeBody, HoldsTheLoadsOfItsEffectsAlone) {
  const auto mill = machines::laboratory();
  using Names = std::set<std::string>;
  EXPECT_EQ(names(chamber_free_body(mill, {"structure_inertia"}, {1, 8})),
            (Names{"bearing", "inertia of structure"}));
  EXPECT_EQ(names(chamber_free_body(mill, {"springs"}, {1, 8})), (Names{"bearing", "spring 1", "spring 2"}));
  EXPECT_EQ(names(chamber_free_body(mill, {}, {1, 8})), Names{"bearing"});
}

// The shaft turns clockwise: a quarter of a turn after the start the pivot is below the axis.
TEST(VibratoryFreeBody, PivotTurnsClockwise) {
  const auto mill = machines::laboratory();
  const auto body = chamber_free_body(mill, {}, {1, 4});
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(body.pivot_m(0, i), mill.eccentricity_m * std::cos(body.phi_rad[i]), 1e-15);
    EXPECT_NEAR(body.pivot_m(1, i), -mill.eccentricity_m * std::sin(body.phi_rad[i]), 1e-15);
  }
}

TEST(VibratoryFreeBody, PublishedForcesAreRefused) {
  auto mill = machines::laboratory();
  mill.convention = kinetics::Convention::published;
  try {
    chamber_free_body(mill, {}, {1, 4});
    FAIL();
  } catch (const kinetics::MachineRefused& error) {
    EXPECT_NE(std::string(error.what()).find("consistent"), std::string::npos);
  }
}

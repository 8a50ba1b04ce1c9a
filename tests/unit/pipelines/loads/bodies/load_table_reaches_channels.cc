/// A body under a load table: every component reaches its channel, the supports close what is left.
#include <gtest/gtest.h>

#include "pipelines/base/common/errors.h"
#include "pipelines/loads/bodies/table_body.h"
#include "tests/unit/pipelines/examples/bodies.h"

namespace {

using Eigen::ArrayXd;
using kinetics::HarmonicCourse;
using kinetics::LoadTable;
using kinetics::TableLoad;
using Kind = meshes::Port::Kind;

const kinetics::TimeGrid grid{1, 24};

pipelines::LoadedBody part() {
  fem::MassProperties masses;
  masses.mass_kg = 3;
  masses.first_moment_kg_m = {0.01, -0.02, 0.3};
  masses.second_moments_kg_m2 = {2e-3, 3e-3, 0.05, 1e-4, 2e-4, -3e-4};
  return {"part",
          {bodies::port("disc", Kind::seat, 1, {0.1, 0.14}, 0.02),
           bodies::port("lug", Kind::face, 2, {0.2, 0.2}, 0, {0.05, 0.01}),
           bodies::port("left", Kind::seat, 3, {-0.01, 0.01}, 0.015),
           bodies::port("right", Kind::seat, 4, {0.29, 0.31}, 0.015)},
          {{"", {}, masses}},
          {}};
}

TableLoad load(const std::string& effect, const std::string& port, const std::string& component,
               const std::string& unit, double mean, double amplitude = 0) {
  return {effect, port, component, unit, HarmonicCourse{mean, amplitude, 1, 0.3}};
}

LoadTable every_component() {
  return {53,
          {load("a", "disc", "fx", "N", 100, 20), load("a", "disc", "fy", "N", -50),
           load("b", "disc", "fx", "N", 5), load("a", "disc", "fz", "N", -118),
           load("b", "disc", "torque", "N m", 3, 1), load("b", "disc", "mx", "N m", 0.4),
           load("b", "disc", "my", "N m", -0.7, 0.1), load("a", "lug", "fx", "N", 30),
           load("a", "lug", "fz", "N", 8, 2), load("c", "lug", "mx", "N m", 0.2),
           load("c", "volume", "ax", "m/s2", 4), load("c", "volume", "ay", "m/s2", -9.81),
           load("c", "volume", "az", "rad/s2", 12, 3), load("c", "volume", "spin", "rad2/s2", 2809)}};
}

pipelines::TableBodyOptions supports() {
  pipelines::TableBodyOptions options;
  options.bearings = {"left", "right"};
  options.axial_support = "left";
  options.torque_support = "right";
  return options;
}

pipelines::BodyLoads distributed(const LoadTable& table, const std::vector<std::string>& effects,
                                 const pipelines::LoadedBody& body,
                                 const pipelines::TableBodyOptions& options) {
  return distribute_table_at(compute_loads(table, effects, grid).phi_rad, table, effects, grid, body,
                             options);
}

pipelines::BodyLoads loads(const LoadTable& table, const pipelines::TableBodyOptions& options = supports(),
                           const std::vector<std::string>& effects = {"a", "b", "c"}) {
  return distributed(table, effects, part(), options);
}

ArrayXd values(double mean, double amplitude = 0) {
  const ArrayXd phi = ArrayXd::LinSpaced(24, 0, 2 * M_PI * 23 / 24);
  return mean + amplitude * (phi - 0.3).cos();
}

TEST(LoadTable, EveryComponentReachesItsChannel) {
  const auto result = loads(every_component());
  const auto expect = [&](const char* effect, const char* channel, double mean, double amplitude = 0) {
    EXPECT_LT(bodies::largest(bodies::part(result, effect, channel) - values(mean, amplitude)),
              1e-12 * std::max(1.0, std::abs(mean)))
        << effect << ' ' << channel;
  };
  expect("a", "disc.fx", 100, 20);
  expect("a", "disc.fy", -50);
  expect("b", "disc.fx", 5);
  expect("a", "disc.fz", -118);
  expect("b", "disc.torque", 3, 1);
  expect("b", "disc.mx", 0.4);
  expect("b", "disc.my", -0.7, 0.1);
  expect("a", "lug.fx", 30);
  expect("a", "lug.fz", 8, 2);
  expect("c", "lug.mx", 0.2);
  expect("c", "volume.ax", 4);
  expect("c", "volume.ay", -9.81);
  expect("c", "volume.az", 12, 3);
  expect("c", "volume.spin", 2809);
  expect("a", "disc.torque", 0);
  EXPECT_FALSE(bodies::has(result, "lug.p0c")) << "a face has no pressure round it";
  EXPECT_TRUE(bodies::has(result, "disc.p0c"));
}

TEST(LoadTable, SupportsCloseEveryEffect) {
  for (const auto& effects : {std::vector<std::string>{"a", "b", "c"}, {"a"}, {"b"}, {"c"}}) {
    const auto closure = bodies::closure_of(loads(every_component(), supports(), effects), part().regions);
    EXPECT_LT(closure.worst_force(), bodies::round_off) << effects.size() << effects[0];
    EXPECT_LT(closure.worst_moment(), bodies::round_off) << effects.size() << effects[0];
  }
}

// A bracket that is bolted to a wall by its face: that alone carries forces and moments.
TEST(LoadTable, AClampClosesEveryEffect) {
  pipelines::TableBodyOptions clamp;
  clamp.clamp = "lug";
  for (const auto& effects : {std::vector<std::string>{"a", "b", "c"}, {"a"}, {"b"}, {"c"}}) {
    const auto closure = bodies::closure_of(loads(every_component(), clamp, effects), part().regions);
    EXPECT_LT(closure.worst_force(), bodies::round_off) << effects.size() << effects[0];
    EXPECT_LT(closure.worst_moment(), bodies::round_off) << effects.size() << effects[0];
  }
  // One force at the disc, in the middle of 0.1 to 0.14: the lug lies 0.08 m beside it, and 0.01 m off the
  // axis.
  const auto result = loads({53, {load("a", "disc", "fx", "N", 100)}}, clamp, {"a"});
  const auto expect = [&](const char* channel, double value) {
    EXPECT_LT(bodies::largest(bodies::part(result, "a", channel) - values(value)), 1e-12 * 100) << channel;
  };
  expect("lug.fx", -100);
  expect("lug.my", 100 * 0.08);
  expect("lug.torque", 100 * -0.01);
  EXPECT_FALSE(bodies::has(result, "lug.p0c"));
}

// Two bolts of a base plate: the message had neither place nor remedy.
TEST(LoadTable, BearingsSideBySideAreRefusedWithARemedy) {
  auto body = part();
  body.ports[3] = bodies::port("right", Kind::seat, 4, {-0.01, 0.01}, 0.015, {0.1, 0});
  try {
    (void)distributed(every_component(), {"a"}, body, supports());
    ADD_FAILURE() << "not refused";
  } catch (const pipelines::StageRefused& refused) {
    const std::string text = refused.what();
    EXPECT_NE(text.find("lie at the same place along z"), std::string::npos) << text;
    EXPECT_NE(text.find("as clamp = "), std::string::npos) << text;
  }
}

// What carries forces along the axis beside it, as an eccentric seat, tilts the body, and the bearings hold
// that.
TEST(LoadTable, AnEccentricAxialSupportIsClosed) {
  auto body = part();
  body.ports[0] = bodies::port("disc", Kind::seat, 1, {0.1, 0.14}, 0.02, {0.003, -0.001});
  auto options = supports();
  options.axial_support = "disc";
  for (const auto& effects : {std::vector<std::string>{"a", "b", "c"}, {"a"}}) {
    const auto result = distributed(every_component(), effects, body, options);
    const auto closure = bodies::closure_of(result, body.regions);
    EXPECT_LT(closure.worst_force(), bodies::round_off);
    EXPECT_LT(closure.worst_moment(), bodies::round_off);
  }
}

// Without a support its component stays open, and only that.
TEST(LoadTable, MissingSupportLeavesItsComponent) {
  auto options = supports();
  options.axial_support.clear();
  auto rest = bodies::residual(loads(every_component(), options), part().regions);
  EXPECT_NEAR(rest.row(2).minCoeff(), -118 + 8 - 2, 0.1);
  EXPECT_LT(bodies::largest(rest.topRows<2>()), 1e-10);
  options = supports();
  options.torque_support.clear();
  rest = bodies::residual(loads(every_component(), options), part().regions);
  EXPECT_GT(bodies::largest(rest.row(5)), 1);
  EXPECT_LT(bodies::largest(rest.topRows<5>()), 1e-10);
}

// A load on the bearing's own port: its pressure belongs to what the seat carries altogether, once.
TEST(LoadTable, LoadOnABearingPressesOnce) {
  auto table = every_component();
  table.loads.push_back(load("a", "left", "fx", "N", 700, 50));
  table.loads.push_back(load("b", "left", "fy", "N", 90));
  const auto result = loads(table);
  const ArrayXd size = bodies::magnitude(bodies::force(result, "left"));
  EXPECT_LT(bodies::largest(bodies::course(result, "left.p0c") - size), 1e-11 * bodies::largest(size));
}

// Rounding of what a load and its own reaction leave is no load: it would be solved, and have an amplitude
// with shares.
TEST(LoadTable, LoadsWhereTheyAreCarriedLeaveNothing) {
  const LoadTable table{
      53,
      {load("a", "left", "fx", "N", 2279.82, 713.3), load("b", "right", "fy", "N", 0, 3131.7),
       load("b", "left", "fz", "N", -118.1, 17), load("c", "right", "torque", "N m", 3.7, 1.1)}};
  EXPECT_TRUE(loads(table).unit_loads.empty());
  auto with_spin = table;
  with_spin.loads.push_back(load("c", "volume", "spin", "rad2/s2", 2809));
  auto body = part();
  body.regions.front().masses.first_moment_kg_m = {0, 0, 0.3};
  body.regions.front().masses.second_moments_kg_m2 = {2e-3, 3e-3, 0.05, 0, 0, 0};
  const auto result = distributed(with_spin, {"a", "b", "c"}, body, supports());
  ASSERT_EQ(result.history.channels.size(), 1u);
  EXPECT_EQ(result.history.channels.front().name, "volume.spin");
}

std::string refusal(const LoadTable& table) {
  try {
    loads(table);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(LoadTable, RefusesWhatTheBodyHasNoPlaceFor) {
  const auto with = [](const std::string& port, const std::string& component, const std::string& unit) {
    auto table = every_component();
    table.loads.push_back(load("a", port, component, unit, 1));
    return refusal(table);
  };
  // Forces and moments on the body as a whole have no surface to enter by, and must not vanish silently.
  for (const auto& [component, unit] : std::vector<std::pair<std::string, std::string>>{
           {"fx", "N"}, {"fy", "N"}, {"fz", "N"}, {"torque", "N m"}, {"mx", "N m"}, {"my", "N m"}})
    EXPECT_NE(with("volume", component, unit).find("\"volume\""), std::string::npos) << component;
  EXPECT_NE(with("disc", "ax", "m/s2").find("volume.ax"), std::string::npos);
  EXPECT_NE(with("disk", "fx", "N").find("\"disk\" is missing on the part"), std::string::npos);
}

}  // namespace

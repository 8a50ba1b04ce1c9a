// Loads of a table that nothing carries: the refusal names the body's table, the key and what to write.
// Statics by hand: the torque is that of the belt, the force along the axis the disc's weight.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "pipelines/base/common/errors.h"
#include "pipelines/loads/channels/closure.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/scene/whole/scene.h"
#include "tests/unit/pipelines/examples/results_directory.h"

namespace {

namespace fs = std::filesystem;
using namespace pipelines;

/// Loads the shipped scene with an edit; what the load stage says if it refuses.
std::string refusal_with(const std::string& old_text, const std::string& new_text) {
  const results_test::Directory directory;
  const auto scenes = fs::path(SOURCE_DIR) / "pipelines/scenes";
  fs::copy(scenes / "belt_pull.csv", directory / "belt_pull.csv");
  std::string text = results_test::bytes(scenes / "load_table.toml");
  const auto at = text.find(old_text);
  EXPECT_NE(at, std::string::npos) << old_text;
  text.replace(at, old_text.size(), new_text);
  std::ofstream(directory / "scene.toml") << text;
  const auto scene = read_scene(directory / "scene.toml");
  StageClock silent;
  try {
    load_bodies(scene, {mesh_body(scene.bodies.front(), {})}, silent);
  } catch (const StageRefused& refused) {
    return refused.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& fragment) {
  return text.find(fragment) != std::string::npos;
}

TEST(Supports, AreAskedForByName) {
  EXPECT_EQ(refusal_with("[shaft]", "[shaft]"), "");
  const auto torque = refusal_with("torque_support = \"disc_seat\"\n", "");
  EXPECT_TRUE(says(torque, "scene.toml:46:1: shaft.torque_support: is missing")) << torque;
  EXPECT_TRUE(says(torque, "torque_support = \"pulley_seat\"")) << torque;
  const auto axial = refusal_with("axial_support = \"bearing_1\"\n", "");
  EXPECT_TRUE(says(axial, "shaft.axial_support: is missing: the loads leave up to 118 N along the axis"))
      << axial;
  const auto bearings = refusal_with("bearings = [\"bearing_1\", \"bearing_2\"]\n", "");
  EXPECT_TRUE(says(bearings, "shaft.bearings: is missing")) << bearings;
}

// An end face at the origin: its own place is no arm to judge the moment of its force by. The mesh's
// resultants are those of the port but for round-off.
TEST(Supports, AForceOnTheFaceAtTheOriginCloses) {
  LoadedBody body;
  body.regions.resize(1);
  body.regions.front().masses.mass_kg = 1;
  body.regions.front().masses.second_moments_kg_m2 = {1e-4, 1e-4, 1e-2, 0, 0, 0};
  fem::SurfaceResultant force;
  force.surface.kind = fem::LoadSurface::Kind::face;
  force.component = fem::SurfaceResultant::Component::fx;
  BodyLoads loads;
  loads.unit_loads = {{"end_1.fx", force}};
  loads.history.channels = {{"end_1.fx", "N"}};
  loads.history.values = Eigen::ArrayXXd::Ones(1, 4);
  auto resultant = wanted_resultant(loads.unit_loads.front(), body.regions);
  for (double& component : resultant) component += 1e-14;
  EXPECT_LT(check_closure(loads, {resultant}, body.regions).channel_resultant, 1e-12);
  resultant[5] += 1e-6;  // an arm of a micrometre is no round-off
  EXPECT_GT(check_closure(loads, {resultant}, body.regions).channel_resultant, 1e-6);
}

// Spin on a mesh that is round but for 3e-10 of its first moment: what the support carries of it, 3e-4 N, is
// off by 1e-8, which is round-off of the 1e5 N that spin is made of. Searches on refined meshes were refused
// for that.
TEST(Supports, SpinThatNearlyBalancesItselfCloses) {
  LoadedBody body;
  body.regions.resize(1);
  auto& masses = body.regions.front().masses;
  masses.mass_kg = 1;
  masses.first_moment_kg_m = {3e-10, 0, 0};
  masses.second_moments_kg_m2 = {1e-4, 1e-4, 1e-2, 0, 0, 0};
  fem::SurfaceResultant support;
  support.surface.kind = fem::LoadSurface::Kind::face;
  support.component = fem::SurfaceResultant::Component::fx;
  BodyLoads loads;
  loads.unit_loads = {{"volume.omega2", fem::BodyForce{fem::BodyForce::Field::spin}}, {"end_1.fx", support}};
  loads.history.channels = {{"volume.omega2", "rad2/s2"}, {"end_1.fx", "N"}};
  std::vector<std::array<double, 6>> resultants;
  for (const auto& load : loads.unit_loads) resultants.push_back(wanted_resultant(load, body.regions));
  const auto closure_with = [&](double unbalanced_N) {
    loads.history.values.resize(2, 1);
    loads.history.values << 1e6, -3e-4 + unbalanced_N;
    return check_closure(loads, resultants, body.regions);
  };
  EXPECT_TRUE(closure_with(3e-12).holds());
  EXPECT_TRUE(closure_with(3e-9).holds()) << "a sum over some thousand nodes, 3e-14 of 1e5 N";
  EXPECT_FALSE(closure_with(1e-7).holds()) << "a force that nothing carries";
}

// A shaft with two keyways opposite to each other, of tetrahedra, leaves up to 6e-7 of what its spin is made
// of: it is in balance without bearings, be there small loads that balance each other or none. One keyway is
// not.
TEST(Supports, ABalancedBodyThatSpinsNeedsNone) {
  LoadedBody body;
  body.regions.resize(1);
  auto& masses = body.regions.front().masses;
  masses.mass_kg = 22;
  masses.second_moments_kg_m2 = {0.12, 0.12, 0.02, 0, 0, 0};
  fem::SurfaceResultant pull;
  pull.surface.kind = fem::LoadSurface::Kind::face;
  pull.component = fem::SurfaceResultant::Component::fx;
  BodyLoads loads;
  const fem::BodyForce spin{fem::BodyForce::Field::spin};
  loads.unit_loads = {{"volume.omega2", spin}, {"end_1.fx", pull}, {"end_2.fx", pull}};
  loads.history.channels = {{"volume.omega2", "rad2/s2"}, {"end_1.fx", "N"}, {"end_2.fx", "N"}};
  const auto holds = [&](double share_off_axis, double pull_N, double more_N) {
    const double first = share_off_axis * std::sqrt(22 * 0.24);
    masses.first_moment_kg_m = {first, 0.5 * first, 0};
    masses.second_moments_kg_m2[5] = 0.1 * first;
    std::vector<std::array<double, 6>> resultants;
    for (const auto& load : loads.unit_loads) resultants.push_back(wanted_resultant(load, body.regions));
    loads.history.values.resize(3, 1);
    loads.history.values << 98696, pull_N, -pull_N + more_N;
    return check_closure(loads, resultants, body.regions).holds();
  };
  EXPECT_TRUE(holds(6e-7, 0, 0));
  EXPECT_TRUE(holds(6e-7, 1, 0));
  EXPECT_FALSE(holds(6e-7, 1, 1e-3)) << "a force that nothing carries";
  EXPECT_FALSE(holds(1e-4, 0, 0)) << "one keyway";
}

}  // namespace

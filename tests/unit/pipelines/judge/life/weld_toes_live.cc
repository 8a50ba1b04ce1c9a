/// Lives of weld toes through the code that judges a body, against hand calculation by IIW-1823-07: FAT 90,
/// gamma_M 1.35, a plate of 50 mm. Turns red: thickness factor or gamma_M lost, an amplitude for the range,
/// damage sum 1 for several cycles, 0.5 for one, turns or seconds for hours, one exponent for all types.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/judge/life/body_fatigue.h"
#include "tests/unit/pipelines/examples/row_of_cells.h"

namespace {

using namespace pipelines;

constexpr double seconds_of_an_hour = 3600;
constexpr LoadPeriod twentieth_of_a_second{0.05, 3};  // three turns: no life may be in periods

/// A toe across z on a plate x = 0, 50 mm thick. Stress in MPa at the angles of one period, along z.
template <typename Stress_MPa>
WeldFatigue toe_under(const WeldToeScene& rules, Stress_MPa&& stress_MPa) {
  const examples::Row row(3);
  Judged body;
  body.method = Method::beam;  // without gradients
  body.mesh.features = row.features;
  body.places = row.places();
  body.responses.nodes = row.nodes;
  body.responses.channels = {"c"};
  for (std::size_t i = 0; i < row.nodes.n; ++i)
    for (const double component : {0.0, 0.0, 1e6, 0.0, 0.0, 0.0})
      body.responses.stress_Pa.push_back(component);
  constexpr std::size_t node = 3;  // on the face
  meshes::HotSpot drawn;
  drawn.name = "toe";
  drawn.thickness_m = 0.050;
  drawn.near_m = {0, 0, 0.020};
  body.mesh.hot_spots = {drawn};
  HotSpotStress spot;
  spot.name = "toe";
  spot.parts = {{node, 1}};
  spot.near_node = node;
  body.hot_spots = {spot};
  body.scene.yield_strength_Pa = 355e6;
  auto& fatigue = body.scene.fatigue.emplace();
  fatigue.material.tensile_strength_Pa = 600e6;
  fatigue.material.yield_strength_Pa = 355e6;
  fatigue.roughness_m = 1e-6;
  fatigue.wanted_life_s = seconds_of_an_hour;
  fatigue.toes_by_name = {{"toe", rules}};
  auto& loads = body.loads.history;
  loads.channels = {{"c", "N"}};
  loads.effects = {"e"};
  constexpr Eigen::Index n = 96;
  loads.values.resize(1, n);
  for (Eigen::Index i = 0; i < n; ++i) loads.values(0, i) = stress_MPa(2 * M_PI * double(i) / double(n));
  loads.by_effect = {loads.values};
  body.envelope = envelope(loads, body.responses, 1);
  return judge_fatigue(body, twentieth_of_a_second, 1).welds.at(0);
}

double life_h(const WeldFatigue& toe) {
  return toe.life_s.value_or(0) / seconds_of_an_hour;
}

// What crests between the instants are found to, with the third to fifth power on it.
constexpr double of_crests = 1e-6;

// 54.15016 MPa at 2e6 cycles (90 x 0.5^0.3 / 1.35), a range of 120 MPa: 183,775 periods of 0.05 s.
TEST(WeldToes, OfOneOrderLiveAsByHand) {
  const auto toe = toe_under(WeldToeScene(), [](double angle) { return 60 * std::cos(angle) + 10; });
  EXPECT_EQ(toe.n_counted, 1u);
  EXPECT_NEAR(toe.range_Pa, 120e6, of_crests * 120e6);
  EXPECT_NEAR(toe.angle_rad, 0, 1e-6);
  EXPECT_NEAR(toe.thickness_factor, 0.8122524, 1e-7);
  EXPECT_EQ(toe.thickness_exponent, 0.3);
  EXPECT_NEAR(life_h(toe), 2.552425, of_crests * 3);
  EXPECT_NEAR(toe.damage_per_turn, 1.813816e-06, of_crests * 1.813816e-06);
  EXPECT_NEAR(*toe.life_safety, 1.3666301, of_crests);  // against one hour: the third root of the life in h
}

// cos x + cos 2x turns at 2, -9/8, 0, -9/8 (cos x = -1/4): ranges 3.125 and 1.125, of 20 MPa. The second is
// below the knee, 31.66721 MPa, where the slope is 5; Miner's sum may reach 0.5.
TEST(WeldToes, OfTwoOrdersLiveAsByHand) {
  const auto toe =
      toe_under(WeldToeScene(), [](double angle) { return 20 * (std::cos(angle) + std::cos(2 * angle)); });
  EXPECT_EQ(toe.n_counted, 2u);
  EXPECT_NEAR(toe.range_Pa, 62.5e6, of_crests * 62.5e6);
  EXPECT_NEAR(life_h(toe), 8.82503, of_crests * 10);
  EXPECT_NEAR(toe.damage_per_turn, 2.623011e-07, of_crests * 2.623011e-07);
}

// Butt welds have n = 0.2 and FAT 100: 100 x 0.5^0.2 / 1.35 = 64.48523 MPa. A class of the scene's own has
// 0.3.
TEST(WeldToes, TakeTheExponentOfTheirType) {
  const auto one_order = [](double angle) { return 60 * std::cos(angle); };
  const auto butt = toe_under({"butt", 100e6, 1.35}, one_order);
  EXPECT_EQ(butt.thickness_exponent, 0.2);
  EXPECT_NEAR(life_h(butt), 4.310568, of_crests * 5);
  EXPECT_EQ(toe_under({"", 100e6, 1.35}, one_order).thickness_exponent, 0.3);
}

}  // namespace

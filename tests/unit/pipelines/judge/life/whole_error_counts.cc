/// Lives and "endures" count the whole error that is stated of a stress: numerical, load patches, model.
/// Turns red: the numerical part alone, the leading place's error for another one, a range of blocks or zones
/// without it.
#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include "pipelines/judge/life/duty_fatigue.h"
#include "pipelines/judge/texts/life_text.h"
#include "pipelines/write/parts/fatigue_report.h"
#include "tests/unit/pipelines/examples/row_of_cells.h"

namespace {

using namespace pipelines;

constexpr LoadPeriod one_turn{0.05, 1};
// R_m 600 MPa, polished, j_D 1.5: 0.45 x 600 / 1.5 MPa at 1e6 cycles, slope 5.
constexpr double design_MPa = 180, slope = 5;

/// A row of cells under stress along z, the same everywhere, that goes round once a turn; its peak at the
/// fillet is known to 1 MPa by numbers, 3 MPa by load patches and 3 MPa for resonance, its places to 0.5 MPa
/// by numbers, a toe to 2 MPa by numbers and 3 MPa by load patches.
struct AlternatingRow {
  Judged body;

  explicit AlternatingRow(double amplitude_MPa) {
    const examples::Row row(3);
    body.method = Method::beam;  // without gradients
    body.mesh.features = row.features;
    body.places = row.places();
    body.responses.nodes = row.nodes;
    body.responses.channels = {"c"};
    for (std::size_t i = 0; i < row.nodes.n; ++i)
      for (const double component : {0.0, 0.0, 1e6, 0.0, 0.0, 0.0})
        body.responses.stress_Pa.push_back(component);
    body.scene.yield_strength_Pa = 355e6;
    auto& fatigue = body.scene.fatigue.emplace();
    fatigue.material.tensile_strength_Pa = 600e6;
    fatigue.material.yield_strength_Pa = 355e6;
    fatigue.roughness_m = 1e-6;
    auto& loads = body.loads.history;
    loads.channels = {{"c", "N"}};
    loads.effects = {"e"};
    constexpr Eigen::Index n = 48;
    loads.values.resize(1, n);
    for (Eigen::Index i = 0; i < n; ++i)
      loads.values(0, i) = amplitude_MPa * std::cos(2 * M_PI * double(i) / double(n));
    loads.by_effect = {loads.values};
    body.envelope = envelope(loads, body.responses, 1);
    const double peak_Pa = amplitude_MPa * 1e6;
    body.peak.value_Pa = peak_Pa;
    body.peak.feature = "fillet";
    body.peak.errors.set_numerical({"discretisation", "", 1e6});
    body.peak.errors.set_model({"load_patches", "", 3e6});
    body.peak.errors.set_model({"quasi_static", "", 3e6});
    for (const char* feature : {"left", "fillet", "seat"})
      body.place_stresses.push_back({feature, 0, peak_Pa, 0.5e6, {}});
    Zone zone;
    zone.feature = "left";
    zone.peak_node = 0;
    body.zones.zones = {zone};
  }

  void add_toe() {
    constexpr std::size_t node = 3;  // on the face x = 0
    meshes::HotSpot drawn;
    drawn.name = "toe";
    drawn.thickness_m = 0.010;
    drawn.near_m = {0, 0, 0.020};
    body.mesh.hot_spots = {drawn};
    HotSpotStress spot;
    spot.name = "toe";
    spot.parts = {{node, 1}};
    spot.near_node = node;
    spot.von_mises_Pa = body.peak.value_Pa;
    body.hot_spots = {spot};
    body.hot_spot_errors.set_numerical({"discretisation", "", 2e6});
    body.hot_spot_errors.set_model({"load_patches", "", 3e6});
    body.place_stresses.push_back({"toe", node, body.peak.value_Pa, 2e6, {}});
  }
};

const FatiguePlace& at(const BodyFatigue& fatigue, std::string_view feature) {
  return *std::find_if(fatigue.places.begin(), fatigue.places.end(),
                       [&](const auto& place) { return place.feature == feature; });
}

double life_at_s(double amplitude_MPa) {
  return one_turn.duration_s * 1e6 * std::pow(design_MPa / amplitude_MPa, slope);
}

// Crests between the instants are found to 1e-6, with the fifth power on it.
constexpr double of_crests_between = 1e-5;

}  // namespace

// 179 of 180 MPa with the numerical error: without the load patches the fillet would endure.
TEST(WholeError, APlaceBelowTheLimitWithinItsErrorHasALife) {
  const AlternatingRow row(178);
  const auto fatigue = judge_fatigue(row.body, one_turn, 1);
  const auto& fillet = at(fatigue, "fillet");
  EXPECT_NEAR(fillet.error_share, 7.0 / 178, 1e-9) << "all that is stated of the peak";
  EXPECT_FALSE(fillet.life_s);
  ASSERT_TRUE(fillet.certainty.range && fillet.certainty.range->least_s);
  const double least_s = life_at_s(178 + 7);
  EXPECT_NEAR(*fillet.certainty.range->least_s, least_s, of_crests_between * least_s);
  EXPECT_FALSE(fillet.certainty.range->most_s);
  EXPECT_EQ(life_text(fillet.life_s, fillet.certainty), "endures; 12 h with the stated error");
  // Elsewhere the place's own error, and the share that resonance leaves open of the peak.
  const auto& left = at(fatigue, "left");
  EXPECT_NEAR(left.error_share, 3.5 / 178, 1e-9);
  ASSERT_TRUE(left.certainty.range && left.certainty.range->least_s);
  ASSERT_EQ(fatigue.zones.size(), 1u);
  EXPECT_NEAR(fatigue.zones[0].error_share, left.error_share, 1e-9);
  ASSERT_TRUE(fatigue.zones[0].certainty.range);
  EXPECT_NEAR(*fatigue.zones[0].certainty.range->least_s, *left.certainty.range->least_s,
              of_crests_between * *left.certainty.range->least_s);

  const auto small = judge_fatigue(AlternatingRow(165).body, one_turn, 1);
  EXPECT_EQ(life_text(at(small, "fillet").life_s, at(small, "fillet").certainty), "endures") << "172 of 180";
}

// IIW, FAT 90, gamma_M 1.35, one cycle a period: slope 3.
TEST(WholeError, OfAToeIsThatOfItsStatement) {
  AlternatingRow row(50);
  row.add_toe();
  const auto toe = judge_fatigue(row.body, one_turn, 1).welds.at(0);
  const double e = (2.0 + 3.0) / 50, life_s = one_turn.duration_s * 2e6 * std::pow(90 / 1.35 / 100, 3);
  ASSERT_TRUE(toe.life_s && toe.certainty.range);
  EXPECT_NEAR(*toe.life_s, life_s, of_crests_between * life_s);
  EXPECT_NEAR(*toe.certainty.range->least_s, life_s * std::pow(1 + e, -3), of_crests_between * life_s);
  EXPECT_NEAR(*toe.certainty.range->most_s, life_s * std::pow(1 - e, -3), of_crests_between * life_s);
}

TEST(WholeError, CountsOverBlocksAndStarts) {
  AlternatingRow row(178);
  row.add_toe();
  const auto& loads = row.body.loads.history;
  const auto& maximum = row.body.envelope.von_mises;
  const auto cycles =
      nodal_cycles(loads, row.body.responses, maximum, surface_nodes(row.body.responses.nodes), 1);
  BlockOnBody block;
  block.running = &loads;
  block.von_mises = &maximum;
  block.cycles = &cycles;
  block.period = one_turn;
  block.share = 1;
  const auto own = judge_fatigue(row.body, one_turn, 1);
  for (const double starts_per_s : {0.0, 1e-3}) {
    block.starts_per_s = starts_per_s;
    if (starts_per_s > 0) block.start_von_mises = &maximum;
    for (const auto& place : judge_duty(row.body, {block}, 1)) {
      const double expected =
          place.is_weld ? own.welds.at(0).error_share : at(own, place.feature).error_share;
      EXPECT_NEAR(place.error_share, expected, 1e-9) << place.feature << starts_per_s;
      ASSERT_TRUE(place.certainty.range && place.certainty.range->least_s) << place.feature;
    }
  }
}

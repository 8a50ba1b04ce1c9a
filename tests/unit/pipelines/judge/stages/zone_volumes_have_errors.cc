/// What the volumes of zones may be off by, on a row of cells whose answer can be written down.
#include <gtest/gtest.h>

#include "pipelines/judge/stages/zone_volume_errors.h"
#include "tests/unit/pipelines/examples/row_of_cells.h"

using namespace pipelines;

namespace {

/// Cells 2 x 2 x 2 along z, of which the stress on every layer is given; that of the places is known to a
/// share.
Judged row(const std::vector<double>& layers, double level_Pa, const std::vector<std::string>& features,
           double share) {
  examples::Row row(int(layers.size() / 2));
  for (std::size_t l = 0; l < layers.size(); ++l) row.layer(l, layers[l]);
  Judged analysis;
  analysis.responses.nodes = row.nodes;
  analysis.envelope.von_mises = row.envelope;
  analysis.places = row.places();
  analysis.peak.value_Pa = *std::max_element(layers.begin(), layers.end());
  analysis.zones = find_zones(row.nodes, row.envelope, analysis.places, level_Pa, 220);
  for (const auto& feature : features) analysis.place_stresses.push_back({feature, 0, 100, 100 * share, {}});
  return analysis;
}

}  // namespace

// The seat, from layer 4 on, is known to 20 %: the level of 50 may be passed where it has 60 or 48.
TEST(ZoneVolumeErrors, MoveTheStressUpAndDown) {
  auto analysis = row({100, 90, 80, 70, 60, 50, 40, 30, 20}, 50, {"seat"}, 0.2);
  estimate_volume_errors(analysis);
  ASSERT_EQ(analysis.zones.zones.size(), 1U);
  const auto& zone = analysis.zones.zones[0];
  EXPECT_NEAR(zone.volume_m3, 4 * 5, 1e-12);
  ASSERT_TRUE(zone.volume_error_m3.has_value());
  EXPECT_NEAR(*zone.volume_error_m3, 4 * (5 - (3 + 20. / 22)), 1e-12);
  const auto errors_Pa = envelope_errors_Pa(analysis);
  EXPECT_EQ(errors_Pa[9 * 3], 0);
  EXPECT_DOUBLE_EQ(errors_Pa[9 * 5], 10);
}

// Between two zones the stress is a tenth below the level: one zone, if it is a fifth too low.
TEST(ZoneVolumeErrors, CountWhatMayBeOneZone) {
  auto analysis = row({80, 60, 45, 45, 45, 60, 90, 100, 100}, 50, {"left", "fillet", "seat"}, 0.2);
  estimate_volume_errors(analysis);
  ASSERT_EQ(analysis.zones.zones.size(), 2U);
  for (const auto& zone : analysis.zones.zones) EXPECT_GE(*zone.volume_error_m3, 32 - zone.volume_m3);
}

// Zones that share a cell are one, though its middle is below the level: on finer cells they are two.
TEST(ZoneVolumeErrors, CountWhatMayBeTwoZones) {
  auto analysis = row({100, 90, 80, 20, 80, 80, 80, 80, 80}, 50, {}, 0);
  estimate_volume_errors(analysis);
  ASSERT_EQ(analysis.zones.zones.size(), 1U);
  EXPECT_GE(*analysis.zones.zones[0].volume_error_m3, 4 * 4.5);
}

// 55 may be 44: there may be no zone at all.
TEST(ZoneVolumeErrors, CountAZoneThatMayNotBeThere) {
  auto analysis = row({55, 20, 10, 0, 0}, 50, {"left"}, 0.2);
  estimate_volume_errors(analysis);
  ASSERT_EQ(analysis.zones.zones.size(), 1U);
  EXPECT_GE(*analysis.zones.zones[0].volume_error_m3, analysis.zones.zones[0].volume_m3);
}

TEST(ZoneVolumeErrors, AreNotThoseOfABeam) {
  auto analysis = row({100, 90, 80, 70, 60}, 75, {"left"}, 0.2);
  analysis.method = Method::beam;
  estimate_volume_errors(analysis);
  EXPECT_FALSE(analysis.zones.zones[0].volume_error_m3.has_value());
}

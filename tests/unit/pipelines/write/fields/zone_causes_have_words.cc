/// What brings a zone, in words.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/judge/texts/zone_text.h"

namespace {

using pipelines::largest_shares;

TEST(ZoneText, NamesTheLargestSharesByTheirSize) {
  EXPECT_EQ(largest_shares({{"drive", 0.17}, {"belt", 0.83}}), "belt 83 %, drive 17 %");
  EXPECT_EQ(largest_shares({{"weights", -0.05}, {"charge", 0.64}, {"debalances", 0.41}}),
            "charge 64 %, debalances 41 %, weights -5 %");
  EXPECT_EQ(largest_shares({{"springs", -2}, {"debalances", 3}}), "debalances 300 %, springs -200 %")
      << "one that relieves counts by its size";
  EXPECT_EQ(largest_shares({}), "");
}

TEST(ZoneText, SumsWhatItDoesNotName) {
  EXPECT_EQ(largest_shares({{"a", 0.5}, {"b", 0.3}, {"c", 0.1}, {"d", 0.06}, {"e", 0.04}}),
            "a 50 %, b 30 %, c 10 %, others 10 %");
  EXPECT_EQ(largest_shares({{"a", 0.998}, {"b", 0.004}, {"c", -0.002}}), "a 100 %");
  EXPECT_EQ(largest_shares({{"a", 1}, {"b", 1}, {"c", -1}, {"d", -0.5}, {"e", 0.5}}),
            "a 100 %, b 100 %, c -100 %")
      << "the others cancel";
}

TEST(ZoneText, EffectsOfOneGroupAreOneShare) {
  const auto shares =
      pipelines::group_shares({"gravity_shaft", "belt", "gravity_charge", "mine"}, {0.25, 0.5, 0.125, 0.125});
  ASSERT_EQ(shares.size(), 3u);
  EXPECT_EQ(shares[0].name, "weights");
  EXPECT_EQ(shares[0].share, 0.375);
  EXPECT_EQ(shares[1].name, "belt");
  EXPECT_EQ(shares[1].share, 0.5);
  EXPECT_EQ(shares[2].name, "mine");
}

// 129.3 +- 792.7 left a volume below zero open.
TEST(ZoneText, ShowsVolumesWithTheirErrors) {
  const auto shown = [](double volume_mm3, const std::optional<double>& error_mm3) {
    return pipelines::volume_text(volume_mm3 * 1e-9,
                                  error_mm3 ? std::optional<double>(*error_mm3 * 1e-9) : std::nullopt)
        .text();
  };
  EXPECT_EQ(shown(1619.7, 132.7), "1620 +- 133");
  EXPECT_EQ(shown(76.71, 6.52), "76.7 +- 6.5");
  EXPECT_EQ(shown(0.04123, 0.0034), "0.0412 +- 0.0034") << "a fillet of a small shaft";
  EXPECT_EQ(shown(129.3, 792.7), "129, up to 922");
  EXPECT_EQ(shown(16.25, 16.25), "16, up to 32") << "there may be no zone";
  EXPECT_EQ(shown(0.0412, 3.2), "0.041, up to 3.2");
  EXPECT_EQ(shown(1797.4, 109961.4), "1797, up to 111759");
  EXPECT_EQ(shown(12.34, std::nullopt), "12 +- ?");
  EXPECT_EQ(shown(std::nan(""), std::nullopt), "-") << "of a beam";
  EXPECT_EQ(shown(0, 0), "0.0, up to 0.0");
}

TEST(ZoneText, TellsWhereAZoneSplits) {
  pipelines::Zone zone;
  EXPECT_EQ(pipelines::parts_text(zone), "");
  const auto add = [&](double share) {
    zone.parts.emplace_back();
    zone.parts.back().share_of_peak = share;
  };
  add(0.7);
  add(0.9);
  EXPECT_EQ(pipelines::parts_text(zone), "") << "one piece all the way";
  add(0.9);
  EXPECT_EQ(pipelines::parts_text(zone), "2 parts at 90 % of the peak");
  add(0.7);
  EXPECT_EQ(pipelines::parts_text(zone), "2 parts at 70 % of the peak");
  add(0.9);
  EXPECT_EQ(pipelines::parts_text(zone), "2 parts at 70 % of the peak, 3 at 90 %");
}

}  // namespace

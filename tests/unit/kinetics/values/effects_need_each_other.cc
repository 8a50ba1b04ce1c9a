/// The tables of effects: what needs what, and that the machines refuse by them and nothing else.
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "kinetics/planetary_mill.h"
#include "kinetics/values/effect_info.h"
#include "tests/unit/kinetics/vibratory/machines.h"

using namespace kinetics;

namespace {

using Names = std::vector<std::string>;

/// d needs c, c and b need a.
const std::vector<EffectInfo> chain{{"a", "", ""},
                                    {"b", "", "", {{"a", "b rests on a", ""}}},
                                    {"c", "", "", {{"a", "c rests on a", ""}}},
                                    {"d", "", "", {{"c", "d rests on c", ""}}}};

}  // namespace

TEST(EffectNeeds, AreOpenWhereTheNeededOneIsOff) {
  EXPECT_TRUE(open_needs(chain, {"a", "b", "c", "d"}).empty());
  EXPECT_TRUE(open_needs(chain, {"a"}).empty());
  EXPECT_TRUE(open_needs(chain, {}).empty());
  const auto open = open_needs(chain, {"d", "b"});
  ASSERT_EQ(open.size(), 2u);
  EXPECT_EQ(open[0].effect + open[0].need.effect, "ba");
  EXPECT_EQ(open[1].effect + open[1].need.effect, "dc");
  EXPECT_NO_THROW(require_needs(chain, {"a", "c", "d"}));
  try {
    require_needs(chain, {"a", "d"});
    ADD_FAILURE();
  } catch (const std::invalid_argument& refused) {
    EXPECT_STREQ(refused.what(), "effect d: needs the effect c: d rests on c; add that one, or take d out");
  }
}

TEST(EffectNeeds, DependentsGoTogether) {
  EXPECT_EQ(with_dependents(chain, {"a", "b", "c", "d"}, {"a"}), (Names{"a", "b", "c", "d"}));
  EXPECT_EQ(with_dependents(chain, {"d", "c", "b", "a"}, {"c"}), (Names{"d", "c"}));
  EXPECT_EQ(with_dependents(chain, {"a", "b", "d"}, {"b"}), Names{"b"});
  EXPECT_EQ(with_dependents(chain, {"a", "d"}, {"a"}), Names{"a"}) << "d hangs on c alone, which is off";
}

// Every single effect left out of all: the mill computes exactly what leaves no need open.
TEST(EffectNeeds, TheVibratoryMillRefusesByItsTable) {
  auto mill = machines::laboratory();
  mill.charge_lag.loss_angle_rad = 0.1;
  const auto& table = vibratory_mill_effects(mill.convention);
  Names all;
  for (const auto& info : table) all.push_back(info.name);
  std::set<std::string> refused;
  for (const auto& effect : all) {
    Names left;
    for (const auto& name : all)
      if (name != effect) left.push_back(name);
    if (open_needs(table, left).empty()) {
      EXPECT_NO_THROW(compute_loads(mill, left, {1, 8})) << effect;
    } else {
      EXPECT_THROW(compute_loads(mill, left, {1, 8}), std::invalid_argument) << effect;
      refused.insert(effect);
    }
  }
  EXPECT_EQ(refused, (std::set<std::string>{"springs", "pitch", "charge_translation"}));
}

// A need names an effect of the same table, with a reason and a source.
TEST(EffectNeeds, NameEffectsOfTheirTable) {
  for (const auto convention : {Convention::consistent, Convention::published}) {
    const auto& table = vibratory_mill_effects(convention);
    std::set<std::string> names;
    for (const auto& info : table) names.insert(info.name);
    for (const auto& info : table)
      for (const auto& need : info.needs) {
        EXPECT_EQ(names.count(need.effect), 1u) << info.name;
        EXPECT_FALSE(need.reason.empty() || need.source.empty()) << info.name;
      }
  }
}

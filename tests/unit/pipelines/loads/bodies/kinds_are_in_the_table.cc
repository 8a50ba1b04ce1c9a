/// The table of kinds has every kind at the place of its options, and no scene can mean two of them.
#include <gtest/gtest.h>

#include <set>

#include "pipelines/scene/whole/body_reader.h"

namespace {

using pipelines::BodyOptions;
using pipelines::BodyReader;
using pipelines::BodyScene;

template <typename Options>
const BodyReader& kind_with() {
  BodyScene body;
  body.options = Options{};
  return pipelines::reader_of(body);
}

using Names = std::vector<std::string>;

// Two rows that are swapped would read one body's table as another's.
TEST(BodyKinds, OptionsLeadToTheirKind) {
  ASSERT_EQ(pipelines::body_readers().size(), std::variant_size_v<BodyOptions>);
  const auto is = [](const BodyReader& kind, const std::string& machine_type, const Names& tables) {
    EXPECT_EQ(kind.machine_type(), machine_type);
    EXPECT_EQ(kind.tables(), tables);
  };
  is(kind_with<pipelines::VibratoryShaftOptions>(), "vibratory_mill", {"shaft"});
  is(kind_with<pipelines::ChamberOptions>(), "vibratory_mill", {"chamber"});
  is(kind_with<pipelines::DrumOptions>(), "planetary_mill", {"drum"});
  is(kind_with<pipelines::StubAxleOptions>(), "planetary_mill", {"axle"});
  is(kind_with<pipelines::TrainShaftOptions>(), "drive_train", {"shaft"});
  is(kind_with<pipelines::TableBodyOptions>(), "load_table", {"shaft", "part"});
}

TEST(BodyKinds, TableOfAMachinesSceneMeansOneKind) {
  std::set<std::pair<std::string, std::string>> tables;
  for (const auto* kind : pipelines::body_readers())
    for (const auto& table : kind->tables())
      EXPECT_TRUE(tables.insert({kind->machine_type(), table}).second) << table;
}

TEST(BodyKinds, EffectOfAMachinesBodyIsOneRow) {
  std::set<std::pair<std::string, std::string>> effects;
  for (const auto* kind : pipelines::body_readers())
    for (const auto& effect : kind->own_effects()) {
      EXPECT_TRUE(effects.insert({kind->machine_type(), effect.name}).second) << effect.name;
      EXPECT_FALSE(effect.description.empty()) << effect.name;
      EXPECT_FALSE(effect.source.empty()) << effect.name;
    }
}

// The options that a body carries say what it is: nothing of another kind stays behind.
TEST(BodyKinds, OptionsOfOneBodyAreNotAskedOfAnother) {
  BodyScene body;
  body.options = pipelines::ChamberOptions{pipelines::PitchGuide::body, true};
  EXPECT_TRUE(reader_of(body).has_elastic_feet(body));
  EXPECT_TRUE(reader_of(body).supporting_ports(body).empty());
  body.options = pipelines::StubAxleOptions{};
  EXPECT_FALSE(reader_of(body).has_elastic_feet(body));
  EXPECT_TRUE(reader_of(body).is_clamped(body));
  body.options = pipelines::TableBodyOptions{{"a", "b"}, {}, {}, {}};
  EXPECT_FALSE(reader_of(body).is_clamped(body));
  EXPECT_EQ(reader_of(body).bearing_loads(body).size(), 2U);
  body.options = pipelines::TableBodyOptions{{}, {}, {}, "a"};
  EXPECT_TRUE(reader_of(body).is_clamped(body));
  EXPECT_TRUE(reader_of(body).bearing_loads(body).empty()) << "a clamp is no bearing with a life";
}

}  // namespace

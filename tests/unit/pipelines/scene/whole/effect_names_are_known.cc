/// Names of effects that the code asks for are names in the tables of the machines and bodies that they are
/// of: a row renamed there alone would switch its loads off without a word.
#include <gtest/gtest.h>

#include <algorithm>

#include "pipelines/scene/values/effect_names.h"
#include "pipelines/scene/whole/body_reader.h"

namespace {

namespace effect_name = pipelines::effect_name;

bool is_named(const std::vector<kinetics::EffectInfo>& table, const std::string& name) {
  return std::any_of(table.begin(), table.end(), [&](const auto& info) { return info.name == name; });
}

TEST(EffectNames, OfTheVibratoryMillAreInItsTable) {
  const auto& table = kinetics::vibratory_mill_effects(kinetics::Convention::consistent);
  for (const char* name :
       {effect_name::gravity_structure, effect_name::gravity_exciter, effect_name::structure_inertia,
        effect_name::exciter_inertia, effect_name::charge_lag, effect_name::springs,
        effect_name::spring_damping, effect_name::pitch})
    EXPECT_TRUE(is_named(table, name)) << name;
}

TEST(EffectNames, OfThePlanetaryMillAreInItsTable) {
  using Convention = kinetics::PlanetaryConvention;
  const auto& consistent = kinetics::planetary_mill_effects(Convention::consistent);
  for (const char* name : {effect_name::drum_gravity, effect_name::drum_transport, effect_name::charge_offset,
                           effect_name::belt})
    EXPECT_TRUE(is_named(consistent, name)) << name;
  EXPECT_TRUE(
      is_named(kinetics::planetary_mill_effects(Convention::as_published), effect_name::charge_relative));
}

TEST(EffectNames, OfShaftsAreTheirOwn) {
  int n_shafts = 0;
  for (const auto* kind : pipelines::body_readers()) {
    const bool is_shaft = kind->tables().front() == "shaft" && kind->machine_type() != "load_table";
    if (!is_shaft) continue;
    ++n_shafts;
    EXPECT_TRUE(is_named(kind->own_effects(), effect_name::shaft_inertia)) << kind->machine_type();
  }
  EXPECT_EQ(n_shafts, 2) << "a vibratory mill's and a drive train's";
}

}  // namespace

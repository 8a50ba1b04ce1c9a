#include "tests/cases/program/program.h"

using namespace cases;

namespace {

std::set<std::string> names(const nlohmann::json& list) {
  return {list.begin(), list.end()};
}

bool mentions(const fs::path& csv_file, const std::string& word) {
  std::ifstream in(csv_file);
  std::string header;
  std::getline(in, header);
  return header.find(word) != std::string::npos;
}

}  // namespace

// Without its two effects the debalance feeds nothing: three columns and three unit loads per seat go, and so
// does the role; every other channel stays. Without the shaft's own mass, its body loads go.
TEST(EffectsSwitchedOff, LeaveNoColumnAndNoUnitLoad) {
  const results_test::Directory directory;
  write(directory / "all.toml", shaft_alone(coarse()));
  write(directory / "without.toml",
        shaft_alone(coarse() + Edits{{"\"gravity_charge\", \"gravity_debalance\",", "\"gravity_charge\","},
                                     {"  \"debalance_inertia\",", ""},
                                     {"  \"gravity_shaft\", \"shaft_inertia\",", "  \"gravity_shaft\","}}));
  for (const char* name : {"all", "without"}) {
    const auto run =
        millstress(directory.path, std::string("run ") + name + ".toml --set results.keep=all -o " + name);
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  const auto all = names(summary(directory / "all")["bodies"]["shaft"]["channels"]);
  const auto without = names(summary(directory / "without")["bodies"]["shaft"]["channels"]);
  std::set<std::string> wanted = all;
  for (const char* port : {"debalance_1", "debalance_2"})
    for (const char* component : {".fx", ".fy", ".torque"})
      EXPECT_EQ(wanted.erase(std::string(port) + component), 1u) << port << component;
  EXPECT_EQ(wanted.erase("volume.spin"), 1u);
  EXPECT_EQ(without, wanted);
  EXPECT_EQ(all.size() - without.size(), 7u);

  EXPECT_TRUE(mentions(directory / "all/loads.csv", "debalance"));
  EXPECT_FALSE(mentions(directory / "without/loads.csv", "debalance"));
  EXPECT_FALSE(mentions(directory / "without/loads.csv", "spin"));
  // What was solved and kept is what is fed: 24 of 31 responses of the same nodes.
  const double ratio = double(fs::file_size(directory / "without/shaft/unit_responses.h5")) /
                       double(fs::file_size(directory / "all/shaft/unit_responses.h5"));
  EXPECT_NEAR(ratio, 24.0 / 31.0, 0.03);
  // The weight alone accelerates nothing: closure still holds.
  EXPECT_LT(summary(directory / "without")["closure"]["shaft"]["moment"].get<double>(), 1e-12);
}

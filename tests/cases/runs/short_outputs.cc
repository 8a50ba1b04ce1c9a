// What `check` and `effects` print by default fits on a screen and says first what matters; -v and --json
// keep all.
#include <algorithm>
#include <regex>
#include <sstream>

#include "tests/cases/program/program.h"

using namespace cases;

namespace {

constexpr std::size_t most_lines = 40;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

Outcome of_mill(const results_test::Directory& directory, const std::string& arguments) {
  const auto outcome =
      millstress(directory.path, arguments + " '" + shipped("vibratory_mill.toml").string() + "'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return outcome;
}

}  // namespace

// Red with channels or defaults in it, or without what a run takes in the first line.
TEST(ShortOutputs, CheckSaysFirstThatTheSceneIsValidAndWhatItTakes) {
  const results_test::Directory directory;
  const auto few = lines_of(of_mill(directory, "check").out),
             all = lines_of(of_mill(directory, "check -v").out);
  ASSERT_FALSE(few.empty());
  EXPECT_TRUE(
      std::regex_search(few[0], std::regex("the scene is valid; a run takes about [0-9.]+ s and [0-9.]+ GB")))
      << few[0];
  EXPECT_LE(few.size(), most_lines);
  EXPECT_GT(all.size(), 100u);
  const auto has = [](const std::vector<std::string>& lines, const std::string& words) {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const auto& line) { return line.find(words) != std::string::npos; });
  };
  for (const char* words : {"eccentric_seat", "inner_wall", "spring_foot_2", "charge_coriolis", "off ",
                            "warning: ", "defaults used"}) {
    EXPECT_TRUE(has(few, words)) << words;
    EXPECT_TRUE(has(all, words) || std::string(words) == "off ") << words;
  }
  for (const char* words : {"shaft/volume.ax [m/s2]", "shaft.begin = ", "even mesh", "sum of moments"}) {
    EXPECT_FALSE(has(few, words)) << words;
    EXPECT_TRUE(has(all, words)) << words;
  }
  const auto json = nlohmann::json::parse(of_mill(directory, "check --json").out);
  EXPECT_TRUE(json["valid"].get<bool>());
  EXPECT_GT(json["run"]["seconds"], 0);
  const auto& shaft = json["bodies"]["shaft"];
  EXPECT_TRUE(has(all, std::to_string(shaft["channels"].size()) + " channels"));
  for (const auto& channel : shaft["channels"]) EXPECT_TRUE(has(all, channel.get<std::string>())) << channel;
  EXPECT_TRUE(shaft["ports"].contains("eccentric_seat"));
  EXPECT_FALSE(shaft["effects"]["shaft_inertia"].empty());
  EXPECT_FALSE(json["defaults"].empty());
}

// Red with nanoseconds, round-off in per cent, or the parts before their sums.
TEST(ShortOutputs, EffectsAreGroupsFirstAndWhatCounts) {
  const results_test::Directory directory;
  const auto few = of_mill(directory, "effects").out, all = of_mill(directory, "effects -v").out;
  EXPECT_LE(lines_of(few).size(), most_lines) << few;
  EXPECT_EQ(few.find(" ns "), std::string::npos) << few;
  EXPECT_FALSE(std::regex_search(few, std::regex("[0-9]e[-+][0-9]"))) << few;
  EXPECT_NE(all.find(" ns per instant"), std::string::npos);
  for (const auto* text : {&few, &all}) {
    EXPECT_LT(text->find("inertia of the charge"), text->find("charge_coriolis")) << *text;
    EXPECT_NE(text->find("below a threshold of 1 %"), std::string::npos);
  }
  const auto json = nlohmann::json::parse(of_mill(directory, "effects --json").out);
  EXPECT_EQ(json["effects"]["gravity_charge"]["loads"].size(), 8u) << "JSON keeps the small ones";
  // In sum, as the table has it.
  const double part = json["groups"]["weights"]["loads"]["debalance.torque"]["largest_share"];
  EXPECT_NEAR(part, 1, 1e-9);
  EXPECT_TRUE(std::regex_search(few, std::regex("weights +100 % +100 % +debalance.torque"))) << few;
}

// Names of members in C++ are no keys of a scene.
TEST(ShortOutputs, ARefusedSpringIsToldByItsKeys) {
  const results_test::Directory directory;
  write(directory / "mill.toml", results_test::bytes(shipped("vibratory_mill.toml")));
  const auto outcome = millstress(
      directory.path, "check mill.toml --set 'machine.springs[2].position=[\"100 mm\", \"-180 mm\"]'");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
  EXPECT_NE(outcome.err.find("springs' position"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("_m"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("preload_N"), std::string::npos) << outcome.err;
}

// The beam knows this shaft to 80 %: with a tolerance that is exit code 4, without one it is told beside the
// stress, and by the first warning of the summary.
TEST(ShortOutputs, ABeamThatIsNotKnownWellIsToldSo) {
  const results_test::Directory directory;
  const std::string run =
      "run '" + shipped("shaft.toml").string() + "' --set results.pictures=false --method beam ";
  const auto once = millstress(directory.path, run + "--tolerance none -o once");
  EXPECT_EQ(once.exit_code, 0) << once.err;
  EXPECT_NE(once.out.find("NOT KNOWN WELL: "), std::string::npos) << once.out;
  EXPECT_NE(summary(directory / "once")["warnings"][0].dump().find("NOT KNOWN WELL"), std::string::npos);
  EXPECT_EQ(millstress(directory.path, run + "--tolerance '5 %' -o asked").exit_code, 4);
}

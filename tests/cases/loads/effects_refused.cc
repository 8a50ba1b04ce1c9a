/// Effects that leave a body without equilibrium: exit code 2, and every command says it in the same words.
#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

/// What the commands write to stderr, which has to be the same; each ends with exit code 2.
std::string refusal(const fs::path& directory, const std::string& scene,
                    const std::set<std::string>& commands) {
  write(directory / "scene.toml", scene);
  std::set<std::string> texts;
  for (const auto& command : commands) {
    const auto outcome =
        millstress(directory, command + " scene.toml -q" + (command == "run" ? " -o out" : ""));
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_EQ(outcome.out, "") << command;
    texts.insert(outcome.err);
    EXPECT_FALSE(fs::exists(directory / "out/summary.json")) << command;
  }
  EXPECT_EQ(texts.size(), 1u);
  return texts.empty() ? "" : *texts.begin();
}

const Edits coarse_peeler{{"cells_per_fillet_quarter = 4", "cells_per_fillet_quarter = 2"},
                          {"  \"shaft_inertia\", ", "  "}};

}  // namespace

// Torques that vary need the shaft's inertia: that is known before anything is meshed.
TEST(EffectsRefused, AVaryingTorqueWithoutTheShaftsInertia) {
  const results_test::Directory directory;
  const auto text = refusal(directory.path, edited("root_peeler_shaft.toml", coarse_peeler),
                            {"check", "run", "loads", "effects"});
  EXPECT_EQ(
      text.rfind("scene.toml:7:3: effects[1] = \"motor_torque\": needs the effect \"shaft_inertia\": ", 0),
      0u)
      << text;
  EXPECT_NE(text.find("effects[2] = \"peeling_torque\": needs the effect \"shaft_inertia\": "),
            std::string::npos);
}

// Constant torques need it where they do not balance each other, which the loads on the mesh tell.
TEST(EffectsRefused, ConstantTorquesThatNothingBalances) {
  const results_test::Directory directory;
  // Steady running alone: a start would need the inertia whatever the torques.
  const auto text = refusal(
      directory.path,
      with_edits(
          without("root_peeler_shaft.toml", "[machine.transient]", "[sampling]"),
          coarse_peeler + Edits{{"constant = \"3.744 N m\"", "constant = \"3 N m\""},
                                {"constant = \"-9.984 N m\"", "constant = \"-6 N m\""},
                                {"harmonics = [{ amplitude = \"3.744 N m\", frequency = \"50 Hz\" }]", ""},
                                {"harmonics = [{ amplitude = \"-9.6 N m\", frequency = \"50 Hz\" }]", ""}}),
      {"check", "run", "loads"});
  EXPECT_EQ(text.rfind("scene.toml:6:11: effects = [", 0), 0u) << text;
  EXPECT_NE(
      text.find("the shaft is not in equilibrium: the loads of \"motor_torque\" and \"peeling_torque\" leave "
                "torques about z that nothing balances; add \"shaft_inertia\", or remove"),
      std::string::npos)
      << text;
}

// A torque of a load table that no port takes; the loads alone are no matter of the body.
TEST(EffectsRefused, ATorqueThatNoSupportTakes) {
  const results_test::Directory directory;
  const auto scene =
      with_edits(small_shaft({{"pull", "middle.fy", "100 N"}, {"twist", "middle.torque", "1 N m"}}),
                 {{"torque_support = \"bearing_2\"\n", ""}});
  const auto text = refusal(directory.path, scene, {"check", "run"});
  EXPECT_NE(
      text.find(
          "scene.toml:17:1: shaft.torque_support: is missing: the loads leave a torque of up to 1 N m that "
          "nothing carries; name the port that takes it, as torque_support = \"middle\""),
      std::string::npos)
      << text;
  EXPECT_EQ(millstress(directory.path, "loads scene.toml").exit_code, 0);
}

// What bodies add is listed beside the machine's effects, in text and JSON.
TEST(EffectsOfBodies, AreListedByEffectsAndLoads) {
  const results_test::Directory directory;
  write(directory / "scene.toml",
        edited("root_peeler_shaft.toml", {coarse_peeler.front(), {"turns = 272", "turns = 34"}}));
  for (const std::string command : {"effects", "loads"}) {
    const auto text = millstress(directory.path, command + " scene.toml");
    for (const char* words : {"belt_pull on the shaft", "240 N across, at rest, on pulley_seat",
                              "-118 N along the shaft, on disc_seat", "shaft_inertia on the shaft",
                              "`millstress check scene.toml -v` shows it"})
      EXPECT_NE(text.out.find(words), std::string::npos) << command << ": " << words;
    const auto json = nlohmann::json::parse(millstress(directory.path, command + " scene.toml --json").out);
    EXPECT_EQ(json["body_effects"].size(), 4u) << command;
    EXPECT_EQ(json["body_effects"]["disc_weight"]["loads"]["shaft/disc_seat.fz"]["largest_share"], 1)
        << command;
  }
  const auto check = millstress(directory.path, "check -v scene.toml");
  EXPECT_NE(check.out.find("effects on it, at most"), std::string::npos);
  EXPECT_NE(check.out.find("on  belt_pull"), std::string::npos);
}

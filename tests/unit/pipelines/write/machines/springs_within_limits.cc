// The springs that are proposed: between the neighbouring resonances of the pitch, and within what is asked
// for.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "pipelines/base/common/errors.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/write/machines/spring_report.h"

using namespace pipelines;

namespace {

const Scene& mill() {
  static const Scene scene = [] {
    auto read = read_scene(std::filesystem::path(SOURCE_DIR) / "pipelines/scenes/vibratory_mill.toml",
                           {"sampling.instants_per_turn=24"});
    return read;
  }();
  return scene;
}

nlohmann::json proposed(const SpringLimits& limits) {
  std::ostringstream out;
  print_spring_choice(out, mill(), limits, true);
  return nlohmann::json::parse(out.str());
}

std::string text_of(const SpringLimits& limits) {
  std::ostringstream out;
  print_spring_choice(out, mill(), limits, false);
  return out.str();
}

double given_N_m() {
  double sum = 0;
  for (const auto& spring : mill().vibratory_mill().springs) sum += spring.stiffness_N_m.y();
  return sum;
}

}  // namespace

// Every excitation stays 20 % away from the pitch's natural frequency, which goes with the root of the
// stiffness; what lies beyond is told with the option that looks there. Red if springs are proposed across a
// resonance.
TEST(SpringsWithinLimits, NoResonanceLiesBetween) {
  const auto json = proposed({});
  for (const char* aim : {"rms", "peak"}) {
    const auto& choice = json[aim];
    const double scale = choice["scale"];
    ASSERT_FALSE(choice["resonances"].empty());
    for (const auto& resonance : choice["resonances"]) {
      EXPECT_FALSE(resonance["crossed"].get<bool>()) << aim;
      const double frequency_ratio = std::sqrt(resonance["scale"].get<double>() / scale);
      EXPECT_GE(std::abs(frequency_ratio - 1), 0.2 - 1e-5) << aim;
    }
    EXPECT_LE(choice["reaction_N"], choice["reaction_given_N"]) << aim;
  }
  ASSERT_TRUE(json.contains("beyond")) << json;
  EXPECT_LT(json["beyond"]["rms_reaction_N"], json["rms"]["reaction_N"]);
  const auto text = text_of({});
  for (const char* words : {"goal: the least reaction", "at most: ", "--least", "--most-transmitted",
                            "beyond these limits", "--across-resonances looks there"})
    EXPECT_NE(text.find(words), std::string::npos) << words << text;
  SpringLimits across;
  across.across_resonances = true;
  const auto far = proposed(across);
  EXPECT_NEAR(far["rms"]["scale"].get<double>(), json["beyond"]["scale"].get<double>(),
              1e-6 * far["rms"]["scale"].get<double>());
  EXPECT_FALSE(far.contains("beyond"));
}

TEST(SpringsWithinLimits, WhatIsAskedForIsKept) {
  SpringLimits limits;
  limits.most_N_m = 1.5 * given_N_m();
  limits.least_N_m = 0.8 * given_N_m();
  for (const char* aim : {"rms", "peak"}) {
    const double stiffness_N_m = proposed(limits)[aim]["stiffness_N_m"];
    EXPECT_LE(stiffness_N_m, *limits.most_N_m * (1 + 1e-9)) << aim;
    EXPECT_GE(stiffness_N_m, *limits.least_N_m * (1 - 1e-9)) << aim;
  }
  SpringLimits soft;
  soft.most_transmitted_N = 1.2 * proposed({})["rms"]["transmitted_given_N"].get<double>();
  EXPECT_LE(proposed(soft)["rms"]["transmitted_N"].get<double>(), *soft.most_transmitted_N);
  SpringLimits beyond;
  beyond.least_N_m = 30 * given_N_m();
  try {
    proposed(beyond);
    FAIL() << "accepted";
  } catch (const OptionError& error) {
    EXPECT_NE(std::string(error.what()).find("--across-resonances goes farther"), std::string::npos)
        << error.what();
  }
}

// One guard for each stage: a number that is not finite ends as NotFinite, which names stage and quantity.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/finite.h"
#include "pipelines/judge/verdict/torsion_report.h"
#include "pipelines/loads/channels/finite_loads.h"
#include "pipelines/superpose/envelope/finite_stress.h"

namespace {

using namespace pipelines;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <typename... Inputs>
std::string guard_says(const Inputs&... inputs) {
  try {
    require_finite(inputs...);
  } catch (const NotFinite& error) {
    return error.what();
  }
  return "";
}

bool names(const std::string& text, const std::string& stage, const std::string& quantity) {
  return text.rfind(stage, 0) == 0 && text.find(quantity) != std::string::npos;
}

kinetics::LoadHistory sound_history() {
  kinetics::LoadHistory loads;
  loads.machine = "mill";
  loads.effects = {"gravity"};
  loads.time_s = loads.phi_rad = loads.speed_rad_s = loads.acceleration_rad_s2 =
      Eigen::ArrayXd::LinSpaced(3, 0, 2);
  loads.quantities.push_back({"T", "N m", "", Eigen::ArrayXd::Ones(3)});
  loads.resultants.push_back({"drive", "", Eigen::Array3Xd::Ones(3, 3), {{0, Eigen::Array3Xd::Ones(3, 3)}}});
  return loads;
}

TEST(NothingInfinite, LeavesTheLoadStage) {
  EXPECT_EQ(guard_says(sound_history()), "");
  auto loads = sound_history();
  loads.quantities[0].values[1] = nan;
  EXPECT_TRUE(names(guard_says(loads), "loads of the mill", "\"T\" [N m] is not finite at t = 1 s"))
      << guard_says(loads);
  loads.quantities[0].has_statistics = false;  // it has poles, and says so
  EXPECT_EQ(guard_says(loads), "");
  loads = sound_history();
  loads.resultants[0].total(2, 0) = infinite;
  EXPECT_TRUE(names(guard_says(loads), "loads", "\"drive\"")) << guard_says(loads);
  loads = sound_history();
  loads.resultants[0].contributions[0].load(0, 2) = -infinite;
  EXPECT_TRUE(names(guard_says(loads), "loads", "\"gravity\"")) << guard_says(loads);
  loads = sound_history();
  loads.acceleration_rad_s2[0] = nan;
  EXPECT_TRUE(names(guard_says(loads), "loads", "acceleration")) << guard_says(loads);
}

TEST(NothingInfinite, LeavesTheDistribution) {
  BodyLoads loads;
  loads.history.body = "shaft";
  loads.history.channels = {{"seat.fx", "N"}};
  loads.history.effects = {"belt"};
  loads.history.values = Eigen::ArrayXXd::Ones(1, 4);
  loads.history.by_effect = {loads.history.values};
  EXPECT_EQ(guard_says(loads), "");
  loads.history.by_effect[0](0, 3) = nan;
  EXPECT_TRUE(names(guard_says(loads), "distribution over the shaft", "\"belt\"")) << guard_says(loads);
  loads.history.values(0, 3) = nan;
  EXPECT_TRUE(names(guard_says(loads), "distribution over the shaft", "\"seat.fx\" [N] is not finite"));
}

TEST(NothingInfinite, LeavesTheSolve) {
  fem::UnitResponses responses;
  responses.channels = {"a", "b"};
  responses.displacement_m.assign(2 * 2 * 3, 1.0);
  responses.stress_Pa.assign(2 * 2 * 6, 1.0);
  EXPECT_EQ(guard_says(responses), "");
  responses.stress_Pa[13] = infinite;
  EXPECT_TRUE(names(guard_says(responses), "stress recovery", "at node 1")) << guard_says(responses);
  responses.displacement_m[0] = nan;
  EXPECT_TRUE(names(guard_says(responses), "solve", "displacement")) << guard_says(responses);
}

TEST(NothingInfinite, LeavesTheSuperposition) {
  Envelope envelope;
  for (auto* maximum : {&envelope.von_mises, &envelope.principal}) {
    maximum->value_Pa = {1, 2};
    maximum->stress_Pa.assign(2, Stress{});
  }
  envelope.effect_share = {1, 1};
  EXPECT_EQ(guard_says("shaft", envelope), "");
  auto wrong = envelope;
  wrong.von_mises.value_Pa[1] = infinite;
  EXPECT_TRUE(names(guard_says("shaft", wrong), "superposition on the shaft", "von Mises"));
  wrong = envelope;
  wrong.principal.stress_Pa[0][3] = nan;
  EXPECT_TRUE(names(guard_says("shaft", wrong), "superposition on the shaft", "principal"));
  wrong = envelope;
  wrong.effect_share[0] = float(nan);
  EXPECT_TRUE(names(guard_says("shaft", wrong), "superposition on the shaft", "share"));
}

TEST(NothingInfinite, LeavesTorsion) {
  TorsionReport report;
  report.modes.frequency_rad_s = Eigen::ArrayXd::Ones(2);
  EXPECT_EQ(guard_says(report), "");
  report.modes.frequency_rad_s[1] = nan;
  EXPECT_TRUE(names(guard_says(report), "torsion", "natural frequency")) << guard_says(report);
  report.modes.frequency_rad_s[1] = 1;
  report.torques.push_back({"belt", 0, infinite, 0, 0});
  EXPECT_TRUE(names(guard_says(report), "torsion", "\"belt\"")) << guard_says(report);
}

}  // namespace

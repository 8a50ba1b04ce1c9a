#include <gtest/gtest.h>

#include <sstream>

#include "pipelines/study/accuracy/accuracy.h"
#include "pipelines/study/accuracy/accuracy_report.h"

using namespace pipelines;

namespace {

AccuracyRow row(const std::string& model, double seconds, double value_MPa, double estimate_MPa) {
  AccuracyRow result;
  result.model = model;
  result.seconds = seconds;
  result.value_Pa = 1e6 * value_MPa;
  result.errors.set_numerical({"discretisation", "", 1e6 * estimate_MPa});
  return result;
}

/// True errors against 100 MPa: 10, 2, 4, 0.5.
AccuracyStudy four_runs() {
  AccuracyStudy study;
  study.tolerance = 0.05;
  study.rows = {row("solid", 8, 100.5, 1), row("beam", 0.1, 90, 15), row("slow", 4, 96, 6),
                row("coarse", 2, 98, 3)};
  return study;
}

}  // namespace

TEST(CompareRuns, CheapestFirstFrontierAndChoice) {
  auto study = four_runs();
  compare_runs(study, 100e6);
  ASSERT_EQ(study.rows.size(), 4u);
  const char* order[] = {"beam", "coarse", "slow", "solid"};
  const bool frontier[] = {true, true, false, true};  // "slow" is more expensive than "coarse" and worse
  const double truth[] = {10, 2, 4, 0.5};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(study.rows[i].model, order[i]);
    EXPECT_EQ(study.rows[i].on_frontier, frontier[i]) << order[i];
    EXPECT_NEAR(study.rows[i].true_error_Pa, 1e6 * truth[i], 1e-6);
    EXPECT_FALSE(study.rows[i].is_reference);
  }
  EXPECT_EQ(study.chosen, 1u);  // 3 of 100 MPa is within 5 %, and cheaper than 1
  EXPECT_NE(study.next_factor_of_two.find("costs 6 seconds (8 instead of 2)"), std::string::npos)
      << study.next_factor_of_two;
}

// The reference knows itself to 1 MPa: a run at 0.4 MPa is as close as can be told, and a dearer one at 0.1
// MPa is not told from it.
TEST(CompareRuns, TheFrontierEndsWhereTheReferenceKnowsNoMore) {
  AccuracyStudy study;
  study.tolerance = 0.05;
  study.rows = {row("beam", 0.1, 90, 15), row("close", 2, 100.4, 3), row("closer", 4, 100.1, 3),
                row("overkill", 8, 100, 1)};
  compare_runs(study, 0);
  ASSERT_TRUE(study.rows[3].is_reference);
  EXPECT_TRUE(study.rows[0].on_frontier);
  EXPECT_TRUE(study.rows[1].on_frontier);
  EXPECT_FALSE(study.rows[2].on_frontier);
}

// Without a known value the run with the smallest estimate is it, and its own estimate counts for the others.
TEST(CompareRuns, TheBestRunIsTheReference) {
  auto study = four_runs();
  compare_runs(study, 0);
  EXPECT_EQ(study.reference_Pa, 100.5e6);
  EXPECT_EQ(study.reference_error_Pa, 1e6);
  EXPECT_TRUE(study.rows.back().is_reference);
  EXPECT_FALSE(study.rows.back().on_frontier);
  const auto e = effectivities(study);
  EXPECT_EQ(e.n_runs, 3u);
  EXPECT_EQ(e.n_bounded, 3u);             // 15 of 10.5, 3 of 2.5, 6 of 4.5
  EXPECT_NEAR(e.median, 6 / 4.5, 1e-12);  // of 1.2, 1.33, 1.43
  EXPECT_NEAR(e.smallest, 3 / 2.5, 1e-12);
}

TEST(CompareRuns, NothingWithinTheToleranceIsSaid) {
  auto study = four_runs();
  study.tolerance = 0.005;
  compare_runs(study, 100e6);
  EXPECT_FALSE(study.chosen);
  EXPECT_NE(study.next_factor_of_two.find("no run is known to be within 0.5 %"), std::string::npos);
  AccuracyStudy none;
  EXPECT_THROW(compare_runs(none, 1), std::runtime_error);
}

// A run stops at the first step whose own estimate is within the tolerance, however close it is by luck;
// other models are no steps of it.
TEST(AccuracyReport, TellsWhereTolerancesEnd) {
  AccuracyStudy study;
  study.rows = {row("refined mesh", 3, 99, 6), row("refined mesh", 7, 103, 4), row("even mesh", 1, 100, 0.1),
                row("refined mesh", 20, 99.5, 1.5)};
  compare_runs(study, 100e6);
  EXPECT_EQ(where_tolerances_end(study),
            "    5 %: 103.00 MPa after 7 s, 3.00 % from the reference\n"
            "    2 %: 99.50 MPa after 20 s, 0.50 % from the reference\n"
            "    1 %: not reached\n");
}

// A confident wrong run is no choice, and the reader is told: 79 +- 5 where 106 +- 0.1 is the reference.
TEST(AccuracyReport, WarnsWhereRunsDisagree) {
  AccuracyStudy study;
  study.tolerance = 0.1;
  study.rows = {row("refined mesh", 3, 79, 5), row("even mesh", 7, 104, 4),
                row("axisymmetric", 20, 106, 0.1)};
  compare_runs(study, 0);
  EXPECT_EQ(study.rows[*study.chosen].model, "even mesh") << "the cheapest one is contradicted";
  const auto text = disagreements(study);
  EXPECT_NE(text.find("disagree with the reference, 106.00 +- 0.10 MPa"), std::string::npos) << text;
  EXPECT_NE(text.find("refined mesh (, 0 unknowns): 79.00 +- 5.00 MPa"), std::string::npos) << text;
  EXPECT_EQ(text.find("even mesh"), std::string::npos) << text;
  study.rows.front().errors.set_numerical({"discretisation", "", 28e6});
  compare_runs(study, 0);
  EXPECT_EQ(disagreements(study), "");
}

// By hand: three channels of 30 s of solve and 6 s of superposition, one fed by the pull alone, one by the
// weight alone, one by both.
TEST(EffectPrices, ShareOutSecondsByTheChannelsOfTheirOwn) {
  Judged analysis;
  auto& history = analysis.loads.history;
  history.effects = {"weight", "pull", "idle"};
  history.values = Eigen::ArrayXXd::Ones(3, 2);
  history.by_effect.assign(3, Eigen::ArrayXXd::Zero(3, 2));
  history.by_effect[0].bottomRows(2) = 1;
  history.by_effect[1].topRows(2) = 1;
  analysis.peak.effect_share = {0.25, -0.75, 0};
  const auto prices = price_effects(analysis, 30, 6, {{"pull", 0.5}});
  ASSERT_EQ(prices.size(), 3U);
  EXPECT_EQ(prices[0].effect, "pull");  // the larger share comes first, whatever its sign
  EXPECT_EQ(prices[0].n_channels, 2U);
  EXPECT_EQ(prices[0].n_own, 1U);
  EXPECT_DOUBLE_EQ(prices[0].unit_loads_s, 10);
  EXPECT_DOUBLE_EQ(prices[0].superposition_s, 2);
  EXPECT_EQ(prices[0].evaluation_s, 0.5);
  EXPECT_EQ(prices[1].effect, "weight");
  EXPECT_EQ(prices[1].evaluation_s, 0);
  EXPECT_EQ(prices[2].n_channels, 0U);
  EXPECT_EQ(prices[2].unit_loads_s, 0);

  auto study = four_runs();
  study.body = "shaft";
  std::ostringstream without, with;
  print_accuracy(without, study);
  EXPECT_EQ(without.str().find("effects on the"), std::string::npos);
  study.effects = prices;
  print_accuracy(with, study);
  const auto text = with.str();
  EXPECT_NE(text.find("effects on the shaft"), std::string::npos) << text;
  const auto line = text.substr(text.find("  pull"));
  EXPECT_NE(line.substr(0, line.find('\n')).find("12.5"), std::string::npos) << text;  // 10 + 2 + 0.5 s
  EXPECT_EQ(text.find("in sum"), std::string::npos) << "no two effects belong together";
  study.effects[0].effect = "charge_relative";  // -75 %
  study.effects[1].effect = "charge_coriolis";  // 25 %
  std::ostringstream grouped;
  print_accuracy(grouped, study);
  const auto sums = grouped.str();
  ASSERT_NE(sums.find("inertia of the charge, in sum"), std::string::npos) << sums;
  const auto sum = sums.substr(sums.find("inertia of the charge, in sum"));
  EXPECT_NE(sum.substr(0, sum.find('\n')).find("-50.00%"), std::string::npos) << sums;
}

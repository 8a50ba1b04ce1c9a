// The largest stress between the instants may be at another point than the largest at an instant.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/judge/analysis/crest_elsewhere.h"
#include "pipelines/judge/estimates/error_budget.h"
#include "pipelines/judge/estimates/time_sampling.h"
#include "pipelines/superpose/envelope/superposition.h"

using namespace pipelines;

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr int n_instants = 10;  // resolve order 3, and come no closer to its crests than 18 degrees

/// A constant load, and one of order 3 in every turn.
ChannelHistory constant_and_third_order(int turns = 1) {
  ChannelHistory loads;
  loads.channels = {{"a.fz", "N"}, {"b.fz", "N"}};
  loads.values.resize(2, turns * n_instants);
  for (int i = 0; i < turns * n_instants; ++i)
    loads.values.col(i) << 1, std::cos(3 * 2 * pi * i / n_instants - pi / 10);
  return loads;
}

/// Three nodes, of which the constant load stresses the first with 100 MPa; nothing else stresses any.
Judged constant_at_one_node(int turns = 1) {
  Judged analysis;
  analysis.loads.history = constant_and_third_order(turns);
  auto& responses = analysis.responses;
  responses.channels = {"a.fz", "b.fz"};
  responses.nodes.n = 3;
  responses.stress_Pa.assign(3 * 2 * 6, 0.0);
  responses.stress_Pa[0] = 100e6;
  return analysis;
}

/// The entry of the first node's peak, where the second one has a larger crest between the instants.
double entry_of_peak_Pa(int turns) {
  auto analysis = constant_at_one_node(turns);
  auto& responses = analysis.responses;
  responses.stress_Pa[(1 * 2 + 1) * 6] = 103e6;  // node 1 by the other; 98.0 MPa at the instants
  responses.stress_Pa[(2 * 2 + 1) * 6] = 200e6;  // left out
  analysis.places.excluded = {0, 0, 1};
  analysis.envelope = envelope(analysis.loads.history, responses, 1);
  analysis.peak.node = peak_node(analysis.envelope.von_mises.value_Pa, analysis.places);
  analysis.peak.value_Pa = analysis.envelope.von_mises.value_Pa[analysis.peak.node];
  analysis.peak.errors.set_numerical({"time_sampling", "", 0});
  EXPECT_EQ(analysis.peak.node, 0u);
  add_crest_elsewhere(analysis, 1);
  return analysis.peak.errors.of("time_sampling");
}

// Red where the peak's own point alone is asked: it is constant, and the entry 0. Many instants do not help:
// they are as far apart as those of one turn.
TEST(CrestElsewhere, IsAnErrorOfThePeak) {
  for (const int turns : {1, 300}) EXPECT_NEAR(entry_of_peak_Pa(turns), 3e6, 10) << turns;
}

// Red where the largest toe alone is asked.
TEST(CrestElsewhere, IsAnErrorOfTheLargestToe) {
  auto analysis = constant_at_one_node();
  auto& responses = analysis.responses;
  responses.stress_Pa[(1 * 2 + 1) * 6] = 206e6;  // node 1 by the other: half of it at the second toe
  analysis.places.excluded = {0, 1, 1};
  analysis.envelope = envelope(analysis.loads.history, responses, 1);
  analysis.peak.value_Pa = 100e6;
  analysis.peak.errors.set_numerical({"time_sampling", "", 0});
  analysis.hot_spot_errors.set_numerical({"time_sampling", "", 0});
  HotSpotStress first, second;
  first.parts = {{0, 1.0}};
  first.von_mises_Pa = 100e6;
  second.parts = {{1, 0.5}};
  second.von_mises_Pa = 103e6 * std::cos(pi / 10);
  analysis.hot_spots = {first, second};
  add_crest_elsewhere(analysis, 1);
  EXPECT_NEAR(analysis.hot_spot_errors.of("time_sampling"), 3e6, 1);
  EXPECT_EQ(analysis.peak.errors.of("time_sampling"), 0) << "both are left out there";
}

// Samples of a load table between the instants: of order 0 at these, so that no spectrum knows of them. Red
// where the values at the instants alone are asked.
TEST(CrestElsewhere, SamplesThatTheInstantsPassOverCount) {
  auto analysis = constant_at_one_node();
  auto& loads = analysis.loads.history;
  loads.values.row(1).setZero();
  loads.passed_over.resize(2, 2);
  loads.passed_over << 1, 1.02, 1, 1.5;
  auto& responses = analysis.responses;
  const auto at_first = unit_stress_at(responses, {{{0, 1.0}}, 0});
  EXPECT_NEAR(sampling_error_Pa(at_first, loads), 2e6, 1);
  const std::vector<char> none_left_out(3, 0);
  const auto budget = self_estimate({{{0, 1.0}}, 0}, responses, analysis.loads, {}, 0, none_left_out);
  EXPECT_NEAR(budget.of("time_sampling"), 2e6, 1);

  responses.stress_Pa[(1 * 2 + 1) * 6] = 70e6;  // another node, that is not stressed at any instant: 105 MPa
  analysis.places.excluded = {0, 0, 1};
  analysis.envelope = envelope(loads, responses, 1);
  analysis.peak.node = 0;
  analysis.peak.value_Pa = 100e6;
  analysis.peak.errors = budget;
  add_crest_elsewhere(analysis, 1);
  EXPECT_NEAR(analysis.peak.errors.of("time_sampling"), 5e6, 1);
}

// Order 10 in 24 instants: by themselves they allow for three times the stress. Red where the whole course
// beside them is asked for its largest value only, or not at all.
TEST(CrestElsewhere, TheWholeCourseLeavesLittleUnresolved) {
  const auto course = [](Eigen::Index n) {
    Eigen::ArrayXXd values(1, n);
    for (Eigen::Index i = 0; i < n; ++i) values(0, i) = std::cos(10 * 2 * pi * double(i) / double(n) + 0.3);
    return values;
  };
  const std::vector<std::array<double, 6>> unit{{0, 0, 1e6, 0, 0, 0}};
  ChannelHistory loads;
  loads.values = course(24);
  const double largest_Pa = 1e6 * loads.values.abs().maxCoeff();
  EXPECT_GT(sampling_error_Pa(unit, loads), 1e6);
  loads.passed_over = course(240);
  EXPECT_NEAR(largest_Pa + sampling_error_Pa(unit, loads), 1e6, 1);
  loads.passed_over = course(250);  // not the same instants: no course of theirs
  EXPECT_GT(sampling_error_Pa(unit, loads), 1e6);
}

TEST(CrestElsewhere, DenserInstantsFollowTheFactors) {
  const auto denser = at_denser_instants(constant_and_third_order());
  const auto n = denser.values.cols();
  ASSERT_GE(n, 24 * 3);
  for (Eigen::Index i = 0; i < n; ++i)
    EXPECT_NEAR(denser.values(1, i), std::cos(3 * 2 * pi * double(i) / double(n) - pi / 10), 1e-13);
}

TEST(CrestElsewhere, InstantsThatAreDenseOrOfAnOpenWindowStay) {
  ChannelHistory loads;
  loads.channels = {{"a.fz", "N"}};
  loads.values = Eigen::ArrayXd::LinSpaced(240, 0, 2 * pi * 239 / 240).cos().transpose();
  EXPECT_EQ(at_denser_instants(loads).values.cols(), 240);
  loads.values = Eigen::ArrayXd::LinSpaced(20, 0, 1).transpose();
  EXPECT_EQ(at_denser_instants(loads).values.cols(), 20);
}

}  // namespace

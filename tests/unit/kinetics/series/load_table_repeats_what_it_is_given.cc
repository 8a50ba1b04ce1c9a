#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "kinetics/table/load_table.h"
#include "kinetics/table/periodic_cubic.h"
#include "kinetics/values/machine_refused.h"

using namespace kinetics;

namespace {

constexpr double turn = 2 * M_PI;

TableLoad sampled(int n, double (*value)(double), double span = turn, bool closed = false) {
  SampledCourse samples;
  samples.angle_rad = Eigen::ArrayXd::LinSpaced(closed ? n + 1 : n, 0, closed ? span : span * (n - 1) / n);
  samples.values = samples.angle_rad.unaryExpr(value);
  return {"measured", "pulley_seat", "fx", "N", samples};
}

double wave(double phi) {
  return 3 + 2 * std::cos(phi) - std::sin(3 * phi);
}

LoadHistory loads_of(const TableLoad& load, int per_turn, int turns = 1) {
  return compute_loads({100, {load}}, {load.effect}, {turns, per_turn});
}

std::string message(const LoadTable& table, const std::vector<std::string>& effects,
                    const TimeGrid& grid = {1, 8}) {
  try {
    compute_loads(table, effects, grid);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(LoadTable, GivesSamplesBackWhereTheyStand) {
  for (const bool closed : {false, true}) {
    const auto history = loads_of(sampled(24, wave, turn, closed), 24);
    const auto& fx = history.resultant("pulley_seat").total.row(0);
    for (int i = 0; i < 24; ++i) EXPECT_NEAR(fx[i], wave(turn * i / 24), 1e-14 * 6) << closed;
    EXPECT_TRUE((history.resultant("pulley_seat").total.bottomRows<2>() == 0).all());
    EXPECT_NEAR(history.time_s[6], turn / 4 / 100, 1e-16);
  }
}

// Between samples: at least second order everywhere (extremes are flattened), no value beyond the neighbours.
TEST(LoadTable, InterpolatesToSecondOrderAndNeverBeyondTheNeighbours) {
  for (const int n : {32, 64, 128, 256, 512}) {
    const auto history = loads_of(sampled(n, wave), 1021);
    double miss = 0;
    for (int i = 0; i < 1021; ++i)
      miss = std::max(miss, std::abs(history.resultant("pulley_seat").total(0, i) - wave(turn * i / 1021)));
    // A parabola whose slope is set to zero half a step from its extreme is missed by less than h^2 f''/8.
    const double step = turn / n, most_curvature = 2 + 9;
    EXPECT_LT(miss, step * step * most_curvature / 8) << n;
  }

  // Away from extremes the slopes are second order, the curve third: an eighth of the error from half the
  // step.
  double coarse = 0, fine = 0;
  for (const int n : {64, 128}) {
    const auto history = loads_of(sampled(n, [](double phi) { return std::cos(phi + 0.4); }), 1021);
    double& miss = n == 64 ? coarse : fine;
    for (int i = 0; i < 1021; ++i)
      if (std::abs(std::sin(turn * i / 1021 + 0.4)) > 0.5)
        miss = std::max(
            miss, std::abs(history.resultant("pulley_seat").total(0, i) - std::cos(turn * i / 1021 + 0.4)));
  }
  EXPECT_GT(coarse / fine, 6.5);

  const auto step = loads_of(sampled(16, [](double phi) { return phi < 3 ? 1.0 : -1.0; }), 999);
  EXPECT_LE(step.resultant("pulley_seat").total.row(0).maxCoeff(), 1 + 1e-15);
  EXPECT_GE(step.resultant("pulley_seat").total.row(0).minCoeff(), -1 - 1e-15);
}

TEST(LoadTable, TakesSamplesThatAreNotEquidistantAndBeginAnywhere) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shake(-0.3, 0.3);
  SampledCourse samples{Eigen::ArrayXd(400), Eigen::ArrayXd(400)};
  for (int i = 0; i < 400; ++i) {
    samples.angle_rad[i] = 5 * turn + 1 + turn * (i + shake(random)) / 400;
    samples.values[i] = wave(samples.angle_rad[i]);
  }
  const auto history = loads_of({"measured", "pulley_seat", "torque", "N m", samples}, 60);
  for (int i = 0; i < 60; ++i)
    EXPECT_NEAR(history.resultant("pulley_seat").total(2, i), wave(turn * i / 60), 1e-3);
}

TEST(LoadTable, HarmonicsAndConstantsAreExactAndEffectsAddUp) {
  const LoadTable table{50,
                        {{"weight", "disc", "fy", "N", HarmonicCourse{-30}},
                         {"imbalance", "disc", "fy", "N", HarmonicCourse{0, 12, 1, 0.5}},
                         {"mesh", "disc", "torque", "N m", HarmonicCourse{1, 2, 23.5, 0}},
                         {"mesh", "disc", "fz", "N", HarmonicCourse{7}}}};
  const TimeGrid grid{2, 100};
  const auto all = compute_loads(table, {"weight", "imbalance", "mesh"}, grid);
  const auto& disc = all.resultant("disc");
  ASSERT_EQ(disc.contributions.size(), 3u);
  for (int i = 0; i < 200; ++i) {
    const double phi = turn * i / 100;
    EXPECT_NEAR(disc.total(1, i), -30 + 12 * std::cos(phi - 0.5), 1e-12);
    EXPECT_NEAR(disc.total(2, i), 1 + 2 * std::cos(23.5 * phi), 1e-11);
  }
  EXPECT_EQ(all.quantity("disc.fz").values[17], 7);
  EXPECT_EQ(all.quantity("disc.fz").unit, "N");
  const auto without = compute_loads(table, {"weight", "imbalance"}, grid);
  EXPECT_EQ(without.resultant("disc").contributions.size(), 2u);
  EXPECT_TRUE((without.resultant("disc").total.row(2) == 0).all());
  EXPECT_THROW(without.quantity("disc.fz"), std::out_of_range);
}

// A shock that lasts for five degrees, between two instants: it would be no load at all.
TEST(LoadTable, InstantsThatMissTheLargestSampleAreRefused) {
  const auto shock = sampled(360, [](double phi) { return phi > 1.60 && phi < 1.65 ? 14e3 : 10.0; });
  try {
    loads_of(shock, 24);
    FAIL();
  } catch (const MachineRefused& refused) {
    EXPECT_NE(std::string(refused.what())
                  .find("the closest samples correspond to 360 per turn: set sampling.instants_per_turn"),
              std::string::npos)
        << refused.what();
  }
  EXPECT_NEAR(loads_of(shock, 360).resultant("pulley_seat").total.row(0).maxCoeff(), 14e3, 1e-8);
  EXPECT_NO_THROW(loads_of(sampled(360, [](double phi) { return std::cos(phi - 0.2); }), 8))
      << "smooth: the error of time sampling tells";
}

// Red if sizes alone are compared: a drop from a level that is larger than its bottom was lost in silence,
// and with it the range that a life follows from.
TEST(LoadTable, InstantsThatMissTheSmallestSampleAreRefused) {
  const auto drop = sampled(360, [](double phi) { return phi > 1.60 && phi < 1.65 ? -95.0 : 100.0; });
  try {
    loads_of(drop, 24);
    FAIL();
  } catch (const MachineRefused& refused) {
    EXPECT_NE(std::string(refused.what()).find("is 195 % smaller between the instants"), std::string::npos)
        << refused.what();
  }
  EXPECT_NEAR(loads_of(drop, 360).resultant("pulley_seat").total.row(0).minCoeff(), -95, 1e-8);
}

// A shock of a twelfth of the load, between two instants. Red if what is no more than a tenth is left to the
// values at the instants: they know nothing of it.
TEST(LoadTable, SamplesBetweenTheInstantsAreTold) {
  const auto shock = sampled(360, [](double phi) { return phi > 1.60 && phi < 1.65 ? 109.0 : 100.0; });
  const LoadTable table{100, {shock, {"steady", "pulley_seat", "fy", "N", HarmonicCourse{7, 2, 1}}}};
  const auto angles = samples_passed_over(table, {"measured", "steady"}, {1, 24});
  ASSERT_EQ(angles.size(), 3);  // of 92, 93, 94 degrees
  EXPECT_NEAR(angles[0], 92 * turn / 360, 1e-12);
  EXPECT_NEAR(angles[2], 94 * turn / 360, 1e-12);
  const auto there = loads_at(table, {"measured", "steady"}, {1, 24}, angles);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(there.resultant("pulley_seat").total(0, i), 109, 1e-10);
    EXPECT_NEAR(there.resultant("pulley_seat").total(1, i), 7 + 2 * std::cos(angles[i]), 1e-12);
  }
  EXPECT_EQ(samples_passed_over(table, {"steady"}, {1, 24}).size(), 0) << "of the effects that are on";
  EXPECT_EQ(samples_passed_over(table, {"measured"}, {1, 360}).size(), 0) << "each has an instant";
  EXPECT_EQ(samples_passed_over(table, {"measured"}, {1, 24}, 2).size(), 2);
  const auto warnings = loads_of(shock, 24).warnings;
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings.back().find("is 8.3 % larger between the instants"), std::string::npos)
      << warnings.back();
}

// Three instants in a period at half of the amplitude and at the trough: 200 stood for 400 without a word.
TEST(LoadTable, CrestsOfHarmonicsBetweenTheInstantsAreTold) {
  const TableLoad teeth{"teeth", "roller", "torque", "N m", HarmonicCourse{0, 400, 40, turn / 6}};
  const auto few = loads_of(teeth, 120);
  EXPECT_NEAR(few.resultant("roller").total.row(2).maxCoeff(), 200, 1e-9);
  ASSERT_EQ(few.warnings.size(), 1u);
  EXPECT_NE(
      few.warnings[0].find("teeth/roller.torque is 50 % larger between the instants than at them, which "
                           "are 3 in a period of order 40"),
      std::string::npos)
      << few.warnings[0];
  EXPECT_TRUE(loads_of(teeth, 960).warnings.empty());
}

// Samples that begin elsewhere than at zero, over several turns: the instants around a sample are those of
// its place in the period.
TEST(LoadTable, SamplesOnALineThroughTheInstantsAreNotPassedOver) {
  auto slow = sampled(
      720, [](double phi) { return 10 + std::cos(phi / 2); }, 2 * turn);
  auto& samples = std::get<SampledCourse>(slow.course);
  EXPECT_EQ(samples_passed_over({100, {slow}}, {"measured"}, {2, 90}).size(), 0);
  samples.angle_rad += 7 * turn;
  samples.values = samples.angle_rad.unaryExpr([](double phi) { return 10 + std::cos(phi / 2); });
  EXPECT_EQ(samples_passed_over({100, {slow}}, {"measured"}, {2, 90}).size(), 0);
}

// Samples of less than the period. Red if the gap is bridged without a word: a file of half a turn was taken.
TEST(LoadTable, SamplesThatEndBeforeTheirPeriodAreWarnedOf) {
  auto cut = sampled(360, wave);
  auto& samples = std::get<SampledCourse>(cut.course);
  EXPECT_TRUE(loads_of(cut, 20).warnings.empty())
      << "the last step is that from the last sample to the first";
  samples.angle_rad.conservativeResize(350);
  samples.values.conservativeResize(350);
  const auto warnings = loads_of(cut, 20).warnings;
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(
      warnings.back().find("no sample over 11 degrees where its period closes, and elsewhere one every 1"),
      std::string::npos)
      << warnings.back();
}

// A ramp does not close; a wave sampled eight times per turn is coarse. Both are stated with their size.
// A cosine whose samples from 110 to 240 degrees were lost: its trough of -1000 is -342 then, and the figure
// of interpolation said 17 %. Samples every 90 degrees beside a pulse are no loss.
TEST(LoadTable, SamplesThatLeaveAGapAreWarnedOf) {
  const auto warnings_of = [](const std::vector<double>& degrees) {
    SampledCourse samples;
    samples.angle_rad =
        Eigen::Map<const Eigen::ArrayXd>(degrees.data(), Eigen::Index(degrees.size())) * (M_PI / 180);
    samples.values = 1000 * samples.angle_rad.cos();
    std::string text;
    for (const auto& warning : loads_of({"measured", "pulley_seat", "fx", "N", samples}, 360).warnings)
      text += warning + '\n';
    return text;
  };
  std::vector<double> whole, with_a_gap, with_one_lost;
  for (int degree = 0; degree < 360; degree += 10) {
    whole.push_back(degree);
    if (degree <= 100 || degree >= 250) with_a_gap.push_back(degree);
    if (degree != 110) with_one_lost.push_back(degree);
  }
  EXPECT_NE(warnings_of(with_a_gap)
                .find("no sample over 150 degrees from 100 degrees on, and elsewhere one every "
                      "10 degrees most often"),
            std::string::npos)
      << warnings_of(with_a_gap);
  for (const auto& complete : {whole, with_one_lost, {0, 1, 2, 3, 90, 180, 270, 359}})
    EXPECT_EQ(warnings_of(complete).find("no sample over"), std::string::npos) << warnings_of(complete);
  // The file goes on behind a gap of more than half a turn: it is told, and refused beyond two thirds.
  EXPECT_NE(warnings_of({0, 58, 115, 173, 360}).find("no sample over 187 degrees from 173 degrees on"),
            std::string::npos)
      << warnings_of({0, 58, 115, 173, 360});
  try {
    warnings_of({0, 10, 20, 30, 360});
    ADD_FAILURE() << "accepted";
  } catch (const kinetics::MachineRefused& refused) {
    EXPECT_NE(std::string(refused.what()).find("more than two thirds of a turn"), std::string::npos)
        << refused.what();
  }
}

TEST(LoadTable, StatesWhatMakingItPeriodicChanges) {
  const auto ramp = sampled(20, [](double phi) { return phi; });
  const auto errors = resampling_errors({100, {ramp}}, {1, 20});
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NEAR(errors[0].jump, turn * 18 / 20, 1e-12);  // the whole fall less one usual step
  EXPECT_NEAR(errors[0].largest, turn * 19 / 20, 1e-12);
  ASSERT_FALSE(loads_of(ramp, 20).warnings.empty());
  EXPECT_NE(loads_of(ramp, 20).warnings[0].find("where the period closes"), std::string::npos);

  const auto fine = sampled(720, wave), coarse = sampled(8, wave);
  EXPECT_TRUE(loads_of(fine, 20).warnings.empty());
  EXPECT_LT(resampling_errors({100, {fine}}, {1, 20})[0].between, 1e-3);
  ASSERT_EQ(loads_of(coarse, 20).warnings.size(), 1u);
  // An upper estimate: what interpolation truly adds is less.
  const auto stated = resampling_errors({100, {coarse}}, {1, 20})[0].between;
  const auto history = loads_of(coarse, 500);
  double miss = 0;
  for (int i = 0; i < 500; ++i)
    miss = std::max(miss, std::abs(history.resultant("pulley_seat").total(0, i) - wave(turn * i / 500)));
  EXPECT_LT(miss, stated);
}

TEST(LoadTable, RefusesWhatItCannotUse) {
  auto bad = sampled(10, wave);
  EXPECT_NE(message({100, {}}, {}).find("empty"), std::string::npos);
  EXPECT_NE(message({-1, {bad}}, {"measured"}).find("speed_rad_s = -1"), std::string::npos);
  EXPECT_NE(message({100, {bad}}, {"mesured"}).find("did you mean \"measured\""), std::string::npos);
  EXPECT_NE(message({100, {bad, bad}}, {"measured"}).find("twice"), std::string::npos);
  auto& samples = std::get<SampledCourse>(bad.course);
  std::swap(samples.angle_rad[3], samples.angle_rad[4]);
  EXPECT_NE(message({100, {bad}}, {"measured"}).find("sample 5"), std::string::npos);
  bad = sampled(10, wave);
  std::get<SampledCourse>(bad.course).values[2] = NAN;
  EXPECT_NE(message({100, {bad}}, {"measured"}).find("sample 3"), std::string::npos);
  EXPECT_NE(message({100, {sampled(3, wave)}}, {"measured"}).find("at least four"), std::string::npos);
  EXPECT_NE(message({100, {sampled(10, wave, 2 * turn)}}, {"measured"}).find("exceeds the period"),
            std::string::npos);
  EXPECT_NE(message({100, {sampled(10, wave, 0.4 * turn)}}, {"measured"}).find("half a turn"),
            std::string::npos);
  const TableLoad mesh{"mesh", "disc", "torque", "N m", HarmonicCourse{0, 1, 0.3}};
  EXPECT_NE(message({100, {mesh}}, {"mesh"}).find("disc.torque.order = 0.3"), std::string::npos);
  EXPECT_EQ(message({100, {mesh}}, {"mesh"}, {10, 8}), "");
}

#include "kinetics/series/load_spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

namespace {

using Eigen::ArrayXd;
using kinetics::LoadCycle;
using Counts = std::map<std::pair<double, double>, double>;  // (range, mean) -> count

ArrayXd series(std::initializer_list<double> values) {
  ArrayXd array(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), array.data());
  return array;
}

Counts counts(const std::vector<LoadCycle>& cycles) {
  Counts sums;
  for (const auto& cycle : cycles) sums[{cycle.range, cycle.mean}] += cycle.count;
  return sums;
}

/// Whole numbers in a narrow band tie often; ties are what countings disagree on first.
ArrayXd random_series(std::mt19937& generator, int n, int band) {
  std::uniform_int_distribution<> draw(-band, band);
  return ArrayXd::NullaryExpr(n, [&] { return double(draw(generator)); });
}

std::vector<double> peaks_and_valleys(const ArrayXd& values) {
  std::vector<double> v;
  for (const double x : values)
    if (v.empty() || x != v.back()) v.push_back(x);
  for (std::size_t i = 1; i + 1 < v.size();)
    if ((v[i] - v[i - 1]) * (v[i + 1] - v[i]) > 0)
      v.erase(v.begin() + long(i));
    else
      ++i;
  return v;
}

/// Four-point counting: an inner range no larger than both its neighbours is a cycle, wherever it is found;
/// every range of the residue counts half. Another algorithm with the same outcome.
Counts four_points(const ArrayXd& values) {
  auto v = peaks_and_valleys(values);
  Counts sums;
  for (std::size_t i = 0; i + 3 < v.size();) {
    const double inner = std::abs(v[i + 2] - v[i + 1]);
    if (inner <= std::abs(v[i + 1] - v[i]) && inner <= std::abs(v[i + 3] - v[i + 2])) {
      sums[{inner, (v[i + 1] + v[i + 2]) / 2}] += 1;
      v.erase(v.begin() + long(i) + 1, v.begin() + long(i) + 3);
      i = 0;
    } else {
      ++i;
    }
  }
  for (std::size_t i = 1; i < v.size(); ++i) sums[{std::abs(v[i] - v[i - 1]), (v[i] + v[i - 1]) / 2}] += 0.5;
  return sums;
}

/// Repeating history: round the circle, the smallest range of all is a cycle and goes; until nothing is left.
Counts smallest_first(const ArrayXd& values) {
  std::vector<double> v(values.begin(), values.end());
  bool changed = true;
  while (changed && v.size() > 1) {  // peaks and valleys of the circle
    changed = false;
    for (std::size_t i = 0; i < v.size() && v.size() > 1; ++i) {
      const double before = v[(i + v.size() - 1) % v.size()], after = v[(i + 1) % v.size()];
      if (v[i] == after || (v[i] - before) * (after - v[i]) > 0) {
        v.erase(v.begin() + long(i));
        changed = true;
        break;
      }
    }
  }
  Counts sums;
  while (v.size() > 1) {
    std::size_t best = 0;
    const auto range = [&](std::size_t i) { return std::abs(v[(i + 1) % v.size()] - v[i]); };
    for (std::size_t i = 0; i < v.size(); ++i)
      if (range(i) < range(best)) best = i;
    sums[{range(best), (v[best] + v[(best + 1) % v.size()]) / 2}] += 1;
    const std::size_t next = (best + 1) % v.size();
    v.erase(v.begin() + long(std::max(best, next)));
    v.erase(v.begin() + long(std::min(best, next)));
  }
  return sums;
}

// Equal cycles but for rounding: each is closed by neighbours. The order in which they are found tells by
// what distance they are; without `alike` some pair points far apart.
TEST(RainflowEnds, OfEqualCyclesAreNeighbours) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> rounding(-1e-12, 1e-12);
  ArrayXd values(400);
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = (i % 2 == 0 ? 1 : -1) + rounding(random);
  const auto ends = kinetics::rainflow_repeating_ends(values, 1e-9);
  ASSERT_EQ(ends.size(), 200u);
  for (const auto& [from, to] : ends) EXPECT_TRUE(to - from == 1 || to - from == 399) << from << " " << to;
}

// The same ranges and means as rainflow_repeating; what is not larger than `alike` is none.
TEST(RainflowEnds, AreThoseOfTheCycles) {
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 100; ++trial) {
    const ArrayXd values = ArrayXd::NullaryExpr(3 + trial, [&] { return normal(random); });
    std::vector<std::pair<double, double>> by_ends, by_cycles;
    for (const auto& [from, to] : kinetics::rainflow_repeating_ends(values, 0))
      by_ends.emplace_back(std::abs(values[from] - values[to]), values[from] / 2 + values[to] / 2);
    for (const auto& cycle : kinetics::rainflow_repeating(values))
      by_cycles.emplace_back(cycle.range, cycle.mean);
    std::sort(by_ends.begin(), by_ends.end());
    std::sort(by_cycles.begin(), by_cycles.end());
    ASSERT_EQ(by_ends.size(), by_cycles.size());
    for (std::size_t i = 0; i < by_ends.size(); ++i) {
      EXPECT_DOUBLE_EQ(by_ends[i].first, by_cycles[i].first);
      EXPECT_NEAR(by_ends[i].second, by_cycles[i].second, 1e-15 * 8) << "the sum in either order";
    }
    EXPECT_TRUE(kinetics::rainflow_repeating_ends(values, 20).empty());
  }
  EXPECT_THROW(kinetics::rainflow_repeating_ends(ArrayXd::Zero(3), -1), std::invalid_argument);
}

}  // namespace

TEST(LoadSpectrum, AgreesWithAnotherAlgorithm) {
  std::mt19937 generator(7);
  for (const int band : {2, 5, 1000})
    for (int n = 1; n < 200; ++n) {
      const ArrayXd values = random_series(generator, n, band);
      EXPECT_EQ(counts(kinetics::rainflow(values)), four_points(values)) << "n " << n << ", band " << band;
      EXPECT_EQ(counts(kinetics::rainflow_repeating(values)), smallest_first(values))
          << "n " << n << ", band " << band;
    }
}

TEST(LoadSpectrum, RepeatingHistoryHasNoDirectionAndNoBeginning) {
  std::mt19937 generator(8);
  for (int n = 2; n < 100; ++n) {
    const ArrayXd values = random_series(generator, n, 6);
    const Counts expected = counts(kinetics::rainflow_repeating(values));
    EXPECT_EQ(counts(kinetics::rainflow_repeating(values.reverse())), expected);
    ArrayXd shifted(n + 1);  // cut elsewhere, and closed by its own first value
    shifted << values.tail(n - n / 3), values.head(n / 3), values[n / 3];
    EXPECT_EQ(counts(kinetics::rainflow_repeating(shifted)), expected);
    Counts mirrored;
    for (const auto& [key, count] : counts(kinetics::rainflow_repeating(-values)))
      mirrored[{key.first, -key.second + 0.0}] += count;
    EXPECT_EQ(mirrored, expected);
    Counts scaled;  // by a power of two, which rounds nothing
    for (const auto& [key, count] : counts(kinetics::rainflow_repeating(4 * values + 8)))
      scaled[{key.first / 4, (key.second - 8) / 4}] += count;
    EXPECT_EQ(scaled, expected);
  }
}

// Every excursion is closed: twice the sum of the full cycles is the way up and down round the period.
TEST(LoadSpectrum, RepeatingHistoryCountsTheWholeWay) {
  std::mt19937 generator(9);
  const ArrayXd values = random_series(generator, 500, 50);
  double way = std::abs(values[0] - values[499]), counted = 0;
  for (Eigen::Index i = 1; i < 500; ++i) way += std::abs(values[i] - values[i - 1]);
  for (const auto& cycle : kinetics::rainflow_repeating(values)) {
    EXPECT_EQ(cycle.count, 1);
    counted += 2 * cycle.range;
  }
  EXPECT_EQ(counted, way);
}

TEST(LoadSpectrum, ConstantSeriesHasNoCycles) {
  const ArrayXd constant = ArrayXd::Constant(50, 3.5);
  EXPECT_TRUE(kinetics::rainflow(constant).empty());
  EXPECT_TRUE(kinetics::rainflow_repeating(constant).empty());
}

TEST(LoadSpectrum, MergesEqualCyclesByFallingRange) {
  const auto merged = kinetics::spectrum({{2, 0, 0.5}, {4, 1, 1}, {2, 0, 0.5}, {2, -1, 1}});
  ASSERT_EQ(merged.size(), 3u);
  EXPECT_EQ(merged[0].range, 4);
  EXPECT_EQ(merged[1].mean, -1);
  EXPECT_EQ(merged[2].count, 1);
}

TEST(LoadSpectrum, WrongInputIsRefused) {
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(kinetics::rainflow(ArrayXd()), std::invalid_argument);
  EXPECT_THROW(kinetics::rainflow_repeating(ArrayXd()), std::invalid_argument);
  for (const double bad : {not_a_number, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(kinetics::rainflow(series({1, 2, bad})), std::invalid_argument);
    EXPECT_THROW(kinetics::rainflow_repeating(series({1, bad, 2})), std::invalid_argument);
  }
  try {
    kinetics::rainflow(series({1, not_a_number}));
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("load series[1] = nan"), std::string::npos) << error.what();
  }
}

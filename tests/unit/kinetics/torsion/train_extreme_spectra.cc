// Every frequency is accurate relative to itself, against bisection in long double; sizes that trains may
// have.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "tests/unit/kinetics/torsion/trains.h"

namespace {

double worst_deviation(const kinetics::DriveTrain& train) {
  const auto wanted = trains::counted_frequencies(train);
  const auto modes = natural_modes(train);
  EXPECT_TRUE(modes.reduced_shape.isFinite().all());
  double worst = 0;
  for (std::size_t k = 1; k < wanted.size(); ++k)
    worst = std::max(worst, std::abs(double(modes.frequency_rad_s[k] / wanted[k] - 1)));
  return worst;
}

double seconds_of(const kinetics::DriveTrain& train, kinetics::Shapes shapes) {
  const auto start = std::chrono::steady_clock::now();
  natural_modes(train, shapes);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double power_of_ten(std::mt19937& generator, double low, double high) {
  return std::pow(10, std::uniform_real_distribution<double>(low, high)(generator));
}

/// Inertias from 1e-12 to 1e3 side by side, stiffnesses over eight decades; a chain or any tree.
kinetics::DriveTrain extreme(std::mt19937& generator, int n, bool tree) {
  std::vector<double> J{1e-12, 1e3}, C;
  for (int i = 2; i < n; ++i) J.push_back(power_of_ten(generator, -12, 3));
  std::shuffle(J.begin(), J.end(), generator);
  for (int i = 1; i < n; ++i) C.push_back(power_of_ten(generator, 0, 8));
  auto train = trains::chain(J, C);
  if (tree)
    for (int i = 1; i < n; ++i)
      train.elements[i - 1].first =
          "J" + std::to_string(std::uniform_int_distribution<int>(0, i - 1)(generator));
  return train;
}

}  // namespace

// Goes red when the matrix is squared or Jacobi meets an unsorted one: then low frequencies lose all digits.
TEST(TrainExtremeSpectra, ChainsAndTreesKeepRelativeAccuracy) {
  std::mt19937 generator(41);
  double chain = 0, tree = 0;
  for (int draw = 0; draw < 60; ++draw) {
    chain = std::max(chain, worst_deviation(extreme(generator, 4 + draw, false)));
    tree = std::max(tree, worst_deviation(extreme(generator, 4 + draw, true)));
  }
  RecordProperty("worst_chain", std::to_string(chain * 1e15));
  RecordProperty("worst_tree", std::to_string(tree * 1e15));
  std::cout << "worst relative deviation: chains " << chain << ", trees " << tree << '\n';
  EXPECT_LT(chain, 1e-13);
  EXPECT_LT(tree, 5e-13);
}

TEST(TrainExtremeSpectra, LargeTrainsTakeAboutASecond) {
  std::mt19937 generator(42);
  trains::RandomTrain kind;
  const auto chain = extreme(generator, 1000, false);
  const auto uniform = trains::chain(std::vector<double>(1000, 0.1), std::vector<double>(999, 1e4));
  auto tree = extreme(generator, 200, true);
  const double values_s = seconds_of(chain, kinetics::Shapes::none),
               uniform_s = seconds_of(uniform, kinetics::Shapes::none);
  const double tree_s = seconds_of(tree, kinetics::Shapes::all);
  std::cout << "1000-mass chain, values: " << values_s << " s (uniform " << uniform_s
            << " s); 200-mass tree, shapes: " << tree_s << " s\n";
  EXPECT_LT(values_s, 10);
  EXPECT_LT(uniform_s, 10);
  EXPECT_LT(tree_s, 10);
}

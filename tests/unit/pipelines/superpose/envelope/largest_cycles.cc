/// The largest stress cycle of a point and of many nodes: brute force over all pairs of instants, closed
/// forms, and what must not depend on axes.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "pipelines/superpose/envelope/nodal_cycles.h"
#include "pipelines/superpose/kernels/linear_extremes_kernel.h"
#include "pipelines/superpose/kernels/walked_factors.h"

namespace {

using Eigen::ArrayXXd;
using Eigen::Index;
using pipelines::Stress;

Stress stress_at_instant(const ArrayXXd& history, Index i) {
  return {history(0, i), history(1, i), history(2, i), history(3, i), history(4, i), history(5, i)};
}

double half_difference(const ArrayXXd& history, Index i, Index j) {
  Stress half{};
  for (Index c = 0; c < 6; ++c) half[std::size_t(c)] = (history(c, i) - history(c, j)) / 2;
  return pipelines::von_mises_Pa(half);
}

double by_all_pairs(const ArrayXXd& history) {
  double most = 0;
  for (Index i = 0; i < history.cols(); ++i)
    for (Index j = 0; j < i; ++j) most = std::max(most, half_difference(history, i, j));
  return most;
}

/// A few harmonics in each component, with a mean.
ArrayXXd random_course(std::mt19937& random, Index n) {
  std::normal_distribution<double> normal;
  ArrayXXd history(6, n);
  for (Index c = 0; c < 6; ++c) {
    const double mean = normal(random);
    history.row(c) = mean;
    for (int order = 1; order < 5; ++order) {
      const double size = normal(random), phase = normal(random);
      for (Index i = 0; i < n; ++i)
        history(c, i) += size * std::cos(2 * M_PI * order * double(i) / double(n) + phase);
    }
  }
  return 1e6 * history;
}

/// The stress seen along a cycle: 3/2 s(t) : r / sigma_v(r) with r the cycle's deviatoric range, so that the
/// values at both ends differ by twice the amplitude.
Eigen::ArrayXd along_Pa(const ArrayXXd& stress_Pa, const pipelines::StressCycle& cycle) {
  Eigen::ArrayXd along = Eigen::ArrayXd::Zero(stress_Pa.cols());
  if (!(cycle.amplitude_Pa > 0)) return along;
  const auto& r = cycle.half_range_Pa;
  const double mean = (r[0] + r[1] + r[2]) / 3;
  for (Index c = 0; c < 6; ++c)
    along += 1.5 / cycle.amplitude_Pa * (c < 3 ? r[std::size_t(c)] - mean : 2 * r[std::size_t(c)]) *
             stress_Pa.row(c).transpose();
  return along;
}

TEST(LargestCycle, IsThatOfAllPairs) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const auto history = random_course(random, 1 + trial);
    const auto cycle = pipelines::largest_cycle(history);
    EXPECT_NEAR(cycle.amplitude_Pa, by_all_pairs(history), 1e-11 * cycle.amplitude_Pa) << trial;
    EXPECT_LE(cycle.from, cycle.to);
    EXPECT_NEAR(half_difference(history, cycle.from, cycle.to), cycle.amplitude_Pa,
                1e-12 * cycle.amplitude_Pa);
    // The range along the cycle is its own; no other instant leaves it by more than rounding.
    const auto along = along_Pa(history, cycle);
    EXPECT_NEAR(along[cycle.to] - along[cycle.from], 2 * cycle.amplitude_Pa, 1e-11 * cycle.amplitude_Pa);
    EXPECT_LE(along.maxCoeff() - along.minCoeff(), 2 * cycle.amplitude_Pa * (1 + 1e-11));
  }
}

// With slack no pair differs by more than that share beyond the one that is found; odd numbers of instants on
// a circle, where no two are opposite and all pairs look alike, are the case that it is for.
TEST(LargestCycle, WithSlackIsThatOfAllPairsUpToIt) {
  std::mt19937 random(5);
  constexpr double slack = 1e-3;
  for (int trial = 0; trial < 100; ++trial) {
    auto history = random_course(random, 50 + trial);
    if (trial % 2 == 0) {
      const Index n = 51 + trial;
      history = ArrayXXd::Zero(6, n);
      for (Index i = 0; i < n; ++i) {
        history(2, i) = 1e6 * std::cos(2 * M_PI * double(i) / double(n));
        history(4, i) = 1e6 / std::sqrt(3.0) * std::sin(2 * M_PI * double(i) / double(n));
      }
    }
    const double most = by_all_pairs(history);
    const double found = pipelines::largest_cycle(history, slack).amplitude_Pa;
    EXPECT_LE(found, most * (1 + 1e-12)) << trial;
    EXPECT_GE(found * (1 + slack), most * (1 - 1e-12)) << trial;
  }
}

// Many instants, of which all may belong to the largest pair: random courses, random directions, and a curve
// that is 2 MPa wide in every direction, h = 1 + cos(3 a) / 10 about its middle, so that no centre tells
// where the pairs are.
TEST(LargestCycle, WithSlackIsThatOfAllPairsOfManyInstants) {
  std::mt19937 random(7);
  constexpr double slack = 1e-6;
  for (int trial = 0; trial < 60; ++trial) {
    const Index n = 241 + 40 * (trial % 10);
    auto history = random_course(random, n);
    if (trial % 3 == 1) {  // directions at random, all of one size
      history = ArrayXXd::NullaryExpr(6, n, [&] { return std::normal_distribution<double>()(random); });
      for (Index i = 0; i < n; ++i)
        history.col(i) *= 1e6 / pipelines::von_mises_Pa(stress_at_instant(history, i));
    }
    if (trial % 3 == 0)
      for (Index i = 0; i < n; ++i) {
        const double a = 2 * M_PI * double(i) / double(n), h = 1 + std::cos(3 * a) / 10,
                     slope = -0.3 * std::sin(3 * a);
        history.col(i) << 0, 0, h * std::cos(a) - slope * std::sin(a), 0,
            (h * std::sin(a) + slope * std::cos(a)) / std::sqrt(3.0), 0;
        history.col(i) *= 1e6;
      }
    const double most = by_all_pairs(history);
    const double found = pipelines::largest_cycle(history, slack).amplitude_Pa;
    EXPECT_LE(found, most * (1 + 1e-12)) << trial;
    EXPECT_GE(found * (1 + slack), most * (1 - 1e-12)) << trial;
    if (trial % 3 == 0) {
      EXPECT_NEAR(most, 1e6, 25) << "half of the width, up to (pi / n)^2 / 8";
    }
  }
}

// sigma = S cos t: amplitude S, mean 0. tau = T cos t: sqrt(3) T, whatever its sign does to a principal
// stress.
TEST(LargestCycle, OfReversedTensionAndTorsionIsTheirVonMisesStress) {
  for (const Index row : {0, 3}) {
    ArrayXXd history = ArrayXXd::Zero(6, 48);
    for (Index i = 0; i < 48; ++i) history(row, i) = 80e6 * std::cos(2 * M_PI * double(i) / 48);
    const auto cycle = pipelines::largest_cycle(history);
    EXPECT_NEAR(cycle.amplitude_Pa, (row == 0 ? 1 : std::sqrt(3.0)) * 80e6, 1);
    EXPECT_NEAR(cycle.signed_mean_Pa, 0, 1);
    EXPECT_EQ(cycle.to - cycle.from, 24);
  }
}

// Bending S cos t with torsion T sin t: distances in an ellipse of half axes S and sqrt(3) T.
TEST(LargestCycle, OfBendingAndTorsionAQuarterApartIsTheLargerHalfAxis) {
  ArrayXXd history = ArrayXXd::Zero(6, 360);
  for (Index i = 0; i < 360; ++i) {
    history(2, i) = 100e6 * std::cos(M_PI * double(i) / 180) + 30e6;
    history(4, i) = 70e6 * std::sin(M_PI * double(i) / 180);
  }
  const auto cycle = pipelines::largest_cycle(history);
  EXPECT_NEAR(cycle.amplitude_Pa, std::sqrt(3.0) * 70e6, 1);
  EXPECT_NEAR(cycle.signed_mean_Pa, 30e6, 1);
}

TEST(LargestCycle, MeansHaveTheSignOfTheirPressure) {
  EXPECT_DOUBLE_EQ(pipelines::signed_von_mises_Pa({-50e6, 0, 0, 0, 0, 0}), -50e6);
  EXPECT_DOUBLE_EQ(pipelines::signed_von_mises_Pa({50e6, 0, 0, 0, 0, 0}), 50e6);
  // Torsion beside a pressure of a tenth: no reward for the whole of it.
  const Stress pressed{-3.4e6, 0, 0, 20e6, 0, 0};
  EXPECT_NEAR(pipelines::signed_von_mises_Pa(pressed), pipelines::von_mises_Pa(pressed) - 6.8e6, 1);
  EXPECT_DOUBLE_EQ(pipelines::signed_von_mises_Pa({-50e6, -50e6, 0, 0, 0, 0}), -50e6);
  for (const double tau : {-20e6, 20e6})  // pure shear, with rounding in its normal stresses
    EXPECT_NEAR(pipelines::signed_von_mises_Pa({-1e-3, 1e-3, -1e-3, tau, 0, 0}), std::sqrt(3.0) * 20e6, 1);
}

TEST(LargestCycle, DoesNotDependOnAxes) {
  std::mt19937 random(11);
  const auto history = random_course(random, 90);
  const Eigen::Matrix3d q = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.2).normalized().toRotationMatrix();
  ArrayXXd turned(6, history.cols());
  for (Index i = 0; i < history.cols(); ++i) {
    const auto s = stress_at_instant(history, i);
    Eigen::Matrix3d tensor;
    tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    const Eigen::Matrix3d t = q * tensor * q.transpose();
    turned.col(i) << t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(0, 2);
  }
  const auto cycle = pipelines::largest_cycle(history), other = pipelines::largest_cycle(turned);
  EXPECT_NEAR(cycle.amplitude_Pa, other.amplitude_Pa, 1e-12 * cycle.amplitude_Pa);
  EXPECT_NEAR(cycle.signed_mean_Pa, other.signed_mean_Pa, 1e-11 * cycle.amplitude_Pa);
}

struct Nodal {
  pipelines::ChannelHistory loads;
  fem::UnitResponses responses;
  std::vector<std::size_t> nodes;
};

/// @param n_harmonics  one: all channels are in phase or opposite, so stress is proportional
Nodal nodal_problem(std::size_t n_nodes, Index n_channels, Index n_instants, bool proportional) {
  Nodal p;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (Index k = 0; k < n_channels; ++k) {
    p.loads.channels.push_back({"port.c" + std::to_string(k), "N"});
    p.responses.channels.push_back(p.loads.channels.back().name);
  }
  p.responses.nodes.n = n_nodes;
  for (std::size_t i = 0; i < n_nodes * std::size_t(n_channels) * 6; ++i)
    p.responses.stress_Pa.push_back(1e6 * normal(random));
  p.loads.effects = {"all"};
  p.loads.values.resize(n_channels, n_instants);
  for (Index k = 0; k < n_channels; ++k) {
    const double size = normal(random), phase = proportional ? 0 : normal(random);
    for (Index i = 0; i < n_instants; ++i)
      p.loads.values(k, i) = size * std::cos(2 * M_PI * double(i) / double(n_instants) + phase);
  }
  p.loads.by_effect = {p.loads.values};
  for (std::size_t i = 0; i < n_nodes; i += 2) p.nodes.push_back(i);
  return p;
}

pipelines::NodalCycles walked(const Nodal& p, int n_threads) {
  const auto envelope = pipelines::envelope(p.loads, p.responses, 1);
  return pipelines::nodal_cycles(p.loads, p.responses, envelope.von_mises, p.nodes, n_threads);
}

// In one harmonic the path is an ellipse; of a proportional one the walks find the ends themselves.
TEST(NodalCycles, AreExactOfProportionalStressAndNeverTooLarge) {
  for (const bool proportional : {true, false}) {
    const auto p = nodal_problem(301, 7, 101, proportional);
    const auto found = walked(p, 1);
    ASSERT_EQ(found.cycles.size(), p.nodes.size());
    for (std::size_t i = 0; i < p.nodes.size(); ++i) {
      const auto history = pipelines::stress_history_Pa(p.responses, p.loads, p.nodes[i]);
      const double exact = by_all_pairs(history);
      EXPECT_LE(found.cycles[i].amplitude_Pa, exact * (1 + 1e-11));
      // Two walks start at the largest stress of the ellipse about zero: its larger axis.
      EXPECT_GE(found.cycles[i].amplitude_Pa, exact * (proportional ? 1 - 1e-11 : 0.995));
      EXPECT_NEAR(half_difference(history, found.cycles[i].from, found.cycles[i].to),
                  found.cycles[i].amplitude_Pa, 1e-11 * exact);
    }
  }
}

TEST(NodalCycles, AreTheSameOnAnyNumberOfThreads) {
  const auto p = nodal_problem(500, 9, 77, false);
  const auto one = walked(p, 1), three = walked(p, 3);
  for (std::size_t i = 0; i < p.nodes.size(); ++i) {
    EXPECT_EQ(one.cycles[i].amplitude_Pa, three.cycles[i].amplitude_Pa);
    EXPECT_EQ(one.cycles[i].from, three.cycles[i].from);
  }
}

TEST(NodalCycles, OfStressThatDoesNotChangeAreZero) {
  auto p = nodal_problem(10, 3, 40, false);
  p.loads.values.colwise() = p.loads.values.col(5).eval();
  p.loads.by_effect = {p.loads.values};
  for (const auto& cycle : walked(p, 1).cycles) EXPECT_EQ(cycle.amplitude_Pa, 0);
  p.responses.channels[1] = "another";
  EXPECT_THROW(walked(p, 1), std::invalid_argument);
}

/// All variants of the linear walk that this machine can run.
std::vector<pipelines::kernel::LinearWalk*> linear_walks_of_this_machine() {
  namespace kernel = pipelines::kernel;
  std::vector<kernel::LinearWalk*> walks{&kernel::generic::linear_walk};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    walks.push_back(&kernel::avx2::linear_walk);
#endif
  if (&kernel::linear_walk_for_this_machine() != walks.back())
    walks.push_back(&kernel::linear_walk_for_this_machine());
  return walks;
}

/// Against a matrix product.
/// @param values  of independent channels
void expect_extremes_of_all_instants(const Eigen::MatrixXd& values, bool is_smooth) {
  namespace kernel = pipelines::kernel;
  std::mt19937 random(13);
  std::normal_distribution<double> normal;
  constexpr auto n_forms = Index(kernel::forms_at_once);
  const Eigen::MatrixXd weights =
      Eigen::MatrixXd::NullaryExpr(n_forms, values.rows(), [&] { return normal(random); });
  const pipelines::WalkedFactors factors(values.array());
  const std::size_t n_channels = factors.n_channels();
  ASSERT_EQ(n_channels, std::size_t(values.rows()));
  EXPECT_EQ(factors.for_kernel().knots.n_spans > 0, is_smooth);
  std::vector<double> room(kernel::room_of_linear_walk(factors.for_kernel())),
      walked(n_channels * kernel::forms_at_once), one(n_channels);
  for (Index form = 0; form < n_forms; ++form) {  // the walk has the channels in an order of its own
    const Eigen::VectorXd of_form = weights.row(form);
    factors.gather(of_form.data(), 1, one.data());
    for (std::size_t k = 0; k < n_channels; ++k)
      walked[k * kernel::forms_at_once + std::size_t(form)] = one[k];
  }
  const Eigen::MatrixXd all = weights * values;
  const double rounding = 1e-13 * values.cwiseAbs().maxCoeff();  // sums of seven terms at most
  for (auto* walk : linear_walks_of_this_machine()) {
    std::array<kernel::LinearExtremes, kernel::forms_at_once> found, of_smallest;
    walk(walked.data(), factors.for_kernel(), kernel::Wanted::both, room.data(), found.data());
    walk(walked.data(), factors.for_kernel(), kernel::Wanted::smallest, room.data(), of_smallest.data());
    for (Index form = 0; form < n_forms; ++form) {
      Index largest = 0, smallest = 0;
      const auto& of_form = found[std::size_t(form)];
      EXPECT_NEAR(of_form.largest, all.row(form).maxCoeff(&largest), rounding);
      EXPECT_NEAR(of_form.smallest, all.row(form).minCoeff(&smallest), rounding);
      EXPECT_EQ(of_form.largest_instant, largest);
      EXPECT_EQ(of_form.smallest_instant, smallest);
      EXPECT_EQ(of_smallest[std::size_t(form)].smallest, of_form.smallest);
      EXPECT_EQ(of_smallest[std::size_t(form)].smallest_instant, smallest);
    }
  }
}

TEST(LinearExtremes, AreThoseOfAllInstants) {
  std::mt19937 random(17);
  std::normal_distribution<double> normal;
  expect_extremes_of_all_instants(
      Eigen::MatrixXd::NullaryExpr(7, 5 * pipelines::kernel::block + 1, [&] { return normal(random); }),
      false);
}

// A parabola within one span, between knots at 0 and u, whose crest at three quarters is as high above u as
// the bound lets it be, E (1 - u / (4 E))^2; elsewhere a peak at a knot a little lower, and a valley.
TEST(LinearExtremes, OfACrestAsHighAsItsBound) {
  for (const double u : {2.0, -2.0}) {
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(1, 720);
    for (Index i = 0; i <= 160; ++i) {
      values(0, 400 + i) = 2.2 * (1 - std::abs(double(i) / 80 - 1));  // straight between the knots
      if (i <= 80) values(0, 600 + i) = std::abs(double(i) / 40 - 1) - 1;
      if (i <= 8) {
        const double t = double(u > 0 ? i : 8 - i) / 8;
        values(0, 200 + i) = 4 * t * (1 - t) + std::abs(u) * t;
      } else {
        (u > 0 ? values(0, 200 + i) : values(0, 208 - i)) = 2 - 2 * double(i - 8) / 152;
      }
    }
    expect_extremes_of_all_instants(values, true);
    expect_extremes_of_all_instants(-values, true);
  }
}

// Harmonics, the last span of one to eight instants; with a blow at a knot, within a span and at the end.
TEST(LinearExtremes, OfSmoothFactorsAreThoseOfAllInstants) {
  std::mt19937 random(19);
  std::uniform_real_distribution<double> phase(0, 2 * M_PI);
  for (Index n_instants = 713; n_instants <= 720; ++n_instants)
    for (const Index blow : {Index(-1), Index(0), Index(64), Index(67), n_instants - 2, n_instants - 1}) {
      SCOPED_TRACE(testing::Message() << n_instants << ", " << blow);
      Eigen::MatrixXd values(7, n_instants);
      for (Index k = 0; k < 7; ++k) {
        const double begin = phase(random);
        for (Index i = 0; i < n_instants; ++i)
          values(k, i) = std::cos(2 * M_PI * double(1 + k / 2) * double(i) / double(n_instants) + begin) +
                         (k == 6 && i == blow ? 20 : 0);
      }
      expect_extremes_of_all_instants(values, true);
    }
}

}  // namespace

/// Stress between the instants of a cycle against closed forms and dense scans. Turns red: pairs of instants
/// alone, an interpolation that forgets an order, cycles at instants, jumps drawn as polynomials.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "pipelines/superpose/between_instants/amplitude_bound.h"
#include "pipelines/superpose/between_instants/stress_course.h"

namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;
using pipelines::FactorCourse;
using pipelines::StressCourse;

ArrayXXd harmonics(Index n, const std::vector<double>& orders, const std::vector<double>& phases) {
  ArrayXXd values(Index(orders.size()), n);
  for (Index k = 0; k < values.rows(); ++k)
    for (Index i = 0; i < n; ++i)
      values(k, i) =
          std::cos(orders[std::size_t(k)] * 2 * M_PI * double(i) / double(n) - phases[std::size_t(k)]);
  return values;
}

FactorCourse course_of(const ArrayXXd& values) {
  return {values, ArrayXd::Ones(values.rows()), 48};
}

// A bar under a moment fixed in space, seen by the bar: sigma_zz = S cos(angle of the node - turn). At every
// node of the section the amplitude is S and the mean zero, wherever the instants lie. Places have
// polynomials of eight points with 1e-9 of error at 48 a period; ends by parabolas are better than that.
TEST(StressBetweenInstants, OfRotatingBendingHasThePeakAsAmplitudeForAnyNumberOfInstants) {
  constexpr double size_Pa = 80e6;
  for (const Index n : {7, 9, 24, 121, 720}) {
    const auto factors = course_of(harmonics(n, {1, 1}, {0, M_PI / 2}));
    ASSERT_TRUE(factors.is_resolved());
    for (int node = 0; node < 37; ++node) {
      const double angle = 2 * M_PI * node / 37;
      pipelines::UnitStresses unit = pipelines::UnitStresses::Zero(6, 2);
      unit(2, 0) = size_Pa * std::cos(angle);
      unit(2, 1) = size_Pa * std::sin(angle);
      const auto found = StressCourse(unit, factors).largest();
      EXPECT_NEAR(found.cycle.amplitude_Pa, size_Pa, 1e-9 * size_Pa) << n << ", node " << node;
      EXPECT_NEAR(found.cycle.signed_mean_Pa, 0, 1e-9 * size_Pa) << n << ", node " << node;
      // Its ends are where the node passes the pulled side and the pressed one: half a turn apart.
      EXPECT_NEAR(found.to - found.from, double(n) / 2, 1e-4 * double(n));
    }
  }
}

// Torsion T cos(37 t) at 120 instants, 3.2 in a period: 37 cycles of amplitude sqrt(3) T. A turning point is
// off by 1e-6 of it at most (stress_course.h).
TEST(StressBetweenInstants, AllCyclesOfAHighOrderAreWhole) {
  constexpr double tau_Pa = 40e6;
  const double amplitude_Pa = std::sqrt(3.0) * tau_Pa;
  for (const Index n : {120, 121, 1200}) {
    const auto factors = course_of(harmonics(n, {37}, {0.4}));
    pipelines::UnitStresses unit = pipelines::UnitStresses::Zero(6, 1);
    unit(3, 0) = tau_Pa;
    const StressCourse course(unit, factors);
    EXPECT_NEAR(course.largest().cycle.amplitude_Pa, amplitude_Pa, 1e-9 * amplitude_Pa);
    const auto cycles = course.cycles_along(pipelines::direction_of({0, 0, 0, 1, 0, 0}));
    ASSERT_EQ(cycles.size(), 37u) << n;
    for (const auto& cycle : cycles) {
      EXPECT_NEAR(cycle.range_Pa / 2, amplitude_Pa, 1e-6 * amplitude_Pa);
      EXPECT_LT(std::abs(cycle.to_instant - cycle.from_instant), double(n)) << "within the period";
    }
  }
}

// Six orders in all components: never above the true diameter, which a scan of 1500 places knows to
// (pi 6 / 1500)^2 = 1.6e-4; never more below it than the second of two pairs may be, 0.4 %.
TEST(StressBetweenInstants, LargestCyclesOfRandomCourses) {
  std::mt19937 random(29);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 40; ++trial) {
    constexpr Index n_dense = 1500;
    std::vector<double> orders, phases;
    for (int order = 1; order <= 6; ++order)
      for (int part = 0; part < 2; ++part) {
        orders.push_back(order);
        phases.push_back(3 * normal(random));
      }
    const pipelines::UnitStresses unit =
        pipelines::UnitStresses::NullaryExpr(6, Index(orders.size()), [&] { return 1e6 * normal(random); });
    const auto found = StressCourse(unit, course_of(harmonics(19 + trial, orders, phases))).largest();
    const StressCourse dense(unit, {harmonics(n_dense, orders, phases), ArrayXd::Ones(12), 1});
    const auto& x = dense.coordinates();
    double most = 0;
    for (Index i = 0; i < n_dense; ++i)
      most = std::max(most, (x.rightCols(n_dense - i).colwise() - x.col(i)).colwise().norm().maxCoeff() / 2);
    EXPECT_GE(found.cycle.amplitude_Pa, most * (1 - 0.004)) << trial;
    EXPECT_LE(found.cycle.amplitude_Pa, most * (1 + 2e-4)) << trial;
  }
}

// Bending S and torsion T, each with an order of its own: along one direction their half axes add up, across
// each other they add up by squares. Both are reached, so the bound is exact; the mean is that of the static
// part.
TEST(AmplitudeBound, OfTwoOrdersIsExactAlongOneDirectionAndAcross) {
  constexpr double size_Pa = 80e6, other_Pa = 30e6, static_Pa = 11e6;
  const auto factors = course_of(harmonics(240, {0, 1, 7}, {0, 0.4, 1}));
  const pipelines::AmplitudeBound bound(factors, ArrayXd::Constant(3, size_Pa));
  pipelines::UnitStresses unit = pipelines::UnitStresses::Zero(6, 3);
  unit(2, 0) = static_Pa;
  unit(2, 1) = size_Pa;
  unit(4, 2) = other_Pa / std::sqrt(3.0);
  EXPECT_NEAR(bound.about_mean(unit).radius_Pa, std::hypot(size_Pa, other_Pa), 1e-9 * size_Pa);
  EXPECT_NEAR(bound.about_mean(unit).mean_Pa, static_Pa, 1e-9 * size_Pa);
  unit(4, 2) = 0;
  unit(2, 2) = other_Pa;
  EXPECT_NEAR(bound.about_mean(unit).radius_Pa, size_Pa + other_Pa, 1e-9 * size_Pa);
}

// Thirty orders, of which 24 are lines of the bound: no stress at any place is farther from the mean, of
// random tensors and of a single channel. And the stress from few rows is that from all channels.
TEST(AmplitudeBound, HoldsForRandomCourses) {
  std::mt19937 random(53);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<double> orders, phases;
    for (int order = 0; order <= 30; ++order) {
      orders.push_back(order);
      phases.push_back(3 * normal(random));
    }
    const auto factors = course_of(harmonics(121 + trial, orders, phases));
    pipelines::UnitStresses unit = pipelines::UnitStresses::NullaryExpr(
        6, Index(orders.size()), [&] { return 1e6 * std::exp(2 * normal(random)) * normal(random); });
    if (trial % 4 == 0) unit.rightCols(30 - 2 * trial).setZero();
    const ArrayXd size = unit.colwise().norm().transpose().array();
    const pipelines::AmplitudeBound bound(factors, size);
    const auto ball = bound.about_mean(unit);
    const StressCourse course(unit, factors);
    const auto x = course.coordinates();
    const double most = (x.colwise() - x.rowwise().mean()).colwise().norm().maxCoeff();
    EXPECT_GE(ball.radius_Pa, most * (1 - 1e-12)) << trial;
    EXPECT_NEAR(ball.mean_Pa, x.rowwise().mean().norm(), 1e-9 * size.maxCoeff()) << trial;
    const auto from_rows = bound.stress_of(unit, factors);
    EXPECT_LE((from_rows.stress_Pa() - course.stress_Pa()).abs().maxCoeff(), 1e-9 * size.maxCoeff()) << trial;
  }
}

// Windows that do not close, of orders that never meet: no two places differ by more than the knots say, and
// none is farther from the mean. With 32 knots a turn orders of 1, 1, 2.2 and 4.7 leave straight lines by
// (pi h / 32)^2 / 2: 0.5, 0.5, 2.3 and 10.6 % of their parts, all at once by 14 % at most. Red without that.
TEST(AmplitudeBound, AtKnotsHoldsForWindowsThatDoNotClose) {
  std::mt19937 random(54);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 24; ++trial) {
    ArrayXXd values(5, 128 * 9 + trial);
    for (Index i = 0; i < values.cols(); ++i) {
      const double angle = 2 * M_PI * double(i) / 128;
      values.col(i) << 1, std::cos(angle), std::sin(angle), std::cos(2.2 * angle - trial),
          std::sin(4.7 * angle + trial);
    }
    const pipelines::UnitStresses unit =
        pipelines::UnitStresses::NullaryExpr(6, values.rows(), [&] { return 1e6 * normal(random); });
    const auto factors = course_of(values);
    ASSERT_FALSE(factors.is_polynomial());
    const StressCourse course(unit, factors);
    const pipelines::AmplitudeBound bound(factors, ArrayXd::Ones(values.rows()));
    const auto x = course.coordinates();
    const double amplitude_Pa = course.largest().cycle.amplitude_Pa;
    const double radius_Pa = (x.colwise() - x.rowwise().mean()).colwise().norm().maxCoeff();
    for (std::size_t level = 0; level < pipelines::AmplitudeBound::n_levels; ++level) {
      const auto most = bound.at_knots(unit, level);
      EXPECT_GE(most.amplitude_Pa, amplitude_Pa) << trial << ", level " << level;
      EXPECT_GE(most.ball.radius_Pa, radius_Pa) << trial << ", level " << level;
      EXPECT_NEAR(most.ball.mean_Pa, x.rowwise().mean().norm(), 1e-9 * radius_Pa);
    }
    EXPECT_LE(bound.at_knots(unit, 1).amplitude_Pa, 1.14 * amplitude_Pa) << trial;
  }
}

TEST(FactorCourse, GoesThroughTheInstantsAndBetweenThem) {
  const std::vector<double> orders{0, 1, 5, 9}, phases{0, 0.3, -1, 2};
  for (const Index n : {29, 30}) {
    const auto values = harmonics(n, orders, phases);
    const auto course = course_of(values);
    ASSERT_GT(course.per_step(), 1);
    for (Index i = 0; i < course.fine().cols(); ++i) {
      const double instant = double(i) / double(course.per_step());
      const Eigen::VectorXd by_weights = values.matrix() * course.weights_at(instant);
      for (Index k = 0; k < 4; ++k) {
        const double exact =
            std::cos(orders[std::size_t(k)] * 2 * M_PI * instant / double(n) - phases[std::size_t(k)]);
        EXPECT_NEAR(course.fine()(k, i), exact, 1e-13);
        EXPECT_NEAR(by_weights[k], exact, 1e-12);
      }
    }
    // A sum over places is one over instants: red if the line at n / 2 counts twice.
    const Eigen::MatrixXd by_place = Eigen::MatrixXd::Random(2, course.fine().cols());
    const Eigen::MatrixXd over_places = by_place * course.fine().matrix().transpose(),
                          over_instants = course.by_instant(by_place) * values.matrix().transpose();
    EXPECT_LT((over_places - over_instants).cwiseAbs().maxCoeff(), 1e-11) << "rounding of 300 terms";
    const ArrayXd most = values.rowwise().maxCoeff() + course.missed_by_instants();
    EXPECT_GE(most.minCoeff(), 1 - 1e-12) << "crests are 1";
    EXPECT_LT(course.missed_by_places().maxCoeff(), 0.01);
  }
}

// A step, a kink at few instants, and a window whose ends do not meet stay as they are; channels that stress
// nothing have no say.
TEST(FactorCourse, OfJumpsIsThatOfTheInstants) {
  constexpr Index n = 60;
  ArrayXXd step = ArrayXXd::Zero(1, n), kink(1, n), ramp(1, n);
  for (Index i = 0; i < n; ++i) {
    step(0, i) = i < 20 ? 1 : -1;
    kink(0, i) = std::abs(double(i) - 29.5) / 30;
    ramp(0, i) = double(i) / n;
  }
  for (const auto& values : {step, kink, ramp}) {
    const auto course = course_of(values);
    EXPECT_FALSE(course.is_polynomial());
    EXPECT_EQ(course.fine().cols(), n);
    EXPECT_EQ(course.missed_by_instants().maxCoeff(), 0);
    EXPECT_EQ(course.weights_at(3.2)[3], 1);
  }
  ArrayXXd both(2, n);
  both << harmonics(n, {2}, {0}), step;
  EXPECT_FALSE(course_of(both).is_polynomial());
  ArrayXd size(2);
  size << 1, 0;
  EXPECT_TRUE(FactorCourse(both, size, 48).is_resolved());
}

}  // namespace

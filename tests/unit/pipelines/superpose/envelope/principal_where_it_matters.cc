/// The walk computes the largest principal stress in few blocks of instants, and superposes few instants at
/// all where the factors are smooth. Stresses of which a bound could leave out the wrong ones, against a loop
/// over all instants.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "pipelines/superpose/envelope/superposition.h"
#include "pipelines/superpose/kernels/walked_factors.h"

namespace {

using Eigen::Index;
using pipelines::Stress;

struct Walked {
  pipelines::ChannelHistory loads;
  fem::UnitResponses responses;
};

Walked walked_problem(std::size_t n_nodes, Eigen::ArrayXXd values,
                      const std::function<Stress()>& unit_stress) {
  Walked p;
  for (Index k = 0; k < values.rows(); ++k) {
    p.loads.channels.push_back({"port.c" + std::to_string(k), "N"});
    p.responses.channels.push_back(p.loads.channels.back().name);
  }
  p.responses.nodes.n = n_nodes;
  for (std::size_t i = 0; i < n_nodes * std::size_t(values.rows()); ++i) {
    const Stress unit = unit_stress();
    p.responses.stress_Pa.insert(p.responses.stress_Pa.end(), unit.begin(), unit.end());
  }
  p.loads.effects = {"all"};
  p.loads.by_effect = {values};
  p.loads.values = std::move(values);
  return p;
}

/// The value is that of a loop over all instants, and so is the instant: no earlier one has as much.
void expect_maximum_of_all_instants(const Walked& p, const pipelines::NodalMaximum& found,
                                    double (*measure)(const Stress&)) {
  for (std::size_t node = 0; node < p.responses.nodes.n; ++node) {
    double largest = -1e300, size = 0;
    std::vector<double> at;
    for (Index i = 0; i < p.loads.values.cols(); ++i) {
      const auto stress = pipelines::stress_at(p.responses, p.loads, node, i);
      at.push_back(measure(stress));
      largest = std::max(largest, at.back());
      for (const double component : stress) size = std::max(size, std::abs(component));
    }
    // The walk orders its sums otherwise: round-off of up to forty terms.
    EXPECT_NEAR(found.value_Pa[node], largest, 2e-13 * size) << node;
    for (std::int32_t i = 0; i < found.instant[node]; ++i) EXPECT_LT(at[std::size_t(i)], largest) << node;
  }
}

/// The same stresses, with channels that change their sign at random and bring none: of such factors all
/// instants are walked.
Walked with_idle_noise(const Walked& p) {
  std::mt19937 random(41);
  const Index n_channels = p.loads.values.rows();
  Walked noisy;
  noisy.responses.nodes.n = p.responses.nodes.n;
  noisy.loads.effects = p.loads.effects;
  noisy.loads.values.resize(2 * n_channels, p.loads.values.cols());
  noisy.loads.values << p.loads.values, Eigen::ArrayXXd::NullaryExpr(n_channels, p.loads.values.cols(), [&] {
    return random() % 2 == 0 ? 1.0 : -1.0;
  });
  noisy.loads.by_effect = {noisy.loads.values};
  for (Index k = 0; k < 2 * n_channels; ++k) {
    noisy.loads.channels.push_back({"port.c" + std::to_string(k), "N"});
    noisy.responses.channels.push_back(noisy.loads.channels.back().name);
  }
  const auto width = std::size_t(6 * n_channels);
  for (std::size_t node = 0; node < p.responses.nodes.n; ++node) {
    const auto begin = p.responses.stress_Pa.begin() + std::ptrdiff_t(node * width);
    noisy.responses.stress_Pa.insert(noisy.responses.stress_Pa.end(), begin, begin + std::ptrdiff_t(width));
    noisy.responses.stress_Pa.insert(noisy.responses.stress_Pa.end(), width, 0.0);
  }
  return noisy;
}

void expect_principal(const Walked& p) {
  const auto found = pipelines::envelope(p.loads, p.responses, 1);
  expect_maximum_of_all_instants(p, found.principal, pipelines::largest_principal_Pa);
}

/// Whether the walk leaves out instants or only the principal stress.
void expect_principal_of_all_instants(const Walked& p) {
  expect_principal(p);
  const auto noisy = with_idle_noise(p);
  EXPECT_EQ(pipelines::WalkedFactors(noisy.loads.values).for_kernel().knots.n_spans, 0u);
  expect_principal(noisy);
}

/// Both maxima, of factors that are smooth enough to leave out instants.
void expect_maxima_of_smooth_factors(const Walked& p) {
  EXPECT_GT(pipelines::WalkedFactors(p.loads.values).for_kernel().knots.n_spans, 0u);
  const auto found = pipelines::envelope(p.loads, p.responses, 1);
  expect_maximum_of_all_instants(p, found.principal, pipelines::largest_principal_Pa);
  expect_maximum_of_all_instants(p, found.von_mises, pipelines::von_mises_Pa);
}

/// Harmonics of the cycle with random phases, two channels of each order.
Eigen::ArrayXXd harmonics(Index n_channels, Index n_instants, std::mt19937& random) {
  std::uniform_real_distribution<double> phase(0, 2 * M_PI);
  Eigen::ArrayXXd values(n_channels, n_instants);
  for (Index k = 0; k < n_channels; ++k) {
    const double begin = phase(random);
    for (Index i = 0; i < n_instants; ++i)
      values(k, i) = std::cos(2 * M_PI * double(1 + k / 2) * double(i) / double(n_instants) + begin);
  }
  return values;
}

std::function<Stress()> random_stress(std::mt19937& random, double pressure, double deviator) {
  return [=, &random] {
    std::normal_distribution<double> normal;
    const double mean = pressure * normal(random);
    Stress s;
    for (std::size_t c = 0; c < 6; ++c) s[c] = deviator * normal(random) + (c < 3 ? mean : 0);
    return s;
  };
}

}  // namespace

// From stress without a mean to pressure beside which von Mises stress is nothing; from one channel to forty;
// blocks that are full and not.
TEST(PrincipalWhereItMatters, OfAnyShareOfPressure) {
  std::mt19937 random(17);
  for (const double pressure : {0.0, 1.0, 10.0, 1e4})
    for (const Index n_channels : {1, 2, 12, 40})
      for (const Index n_instants : {720, 101}) {
        SCOPED_TRACE(testing::Message() << pressure << ", " << n_channels << " channels, " << n_instants);
        expect_principal_of_all_instants(
            walked_problem(5, harmonics(n_channels, n_instants, random), random_stress(random, pressure, 1)));
      }
}

// Pressure from all sides that varies, and shear that is largest where the pressure is too: the largest
// principal stress, negative, is far from the largest von Mises stress.
TEST(PrincipalWhereItMatters, OfPressureThatHidesTheLargestShear) {
  const Index n_instants = 240;
  Eigen::ArrayXXd values(2, n_instants);
  for (Index i = 0; i < n_instants; ++i) {
    const double swing = std::cos(2 * M_PI * double(i) / double(n_instants));
    values.col(i) << 3 + 2 * swing, 0.1 + swing * swing * (swing > 0 ? 1 : 0);
  }
  bool is_pressure = false;
  const auto p = walked_problem(3, values, [&] {
    is_pressure = !is_pressure;
    return is_pressure ? Stress{-1, -1, -1, 0, 0, 0} : Stress{0, 0, 0, 1, 0, 0};
  });
  expect_principal_of_all_instants(p);
  const auto envelope = pipelines::envelope(p.loads, p.responses, 1);
  EXPECT_EQ(envelope.von_mises.instant[0], 0);
  EXPECT_EQ(envelope.principal.instant[0], n_instants / 2);
  EXPECT_NEAR(envelope.principal.value_Pa[0], -1 + 0.1, 1e-14);  // least pressure, least shear
}

// A blow of pressure or tension at one instant within a block, beside shear that changes slowly: the mean
// stress of the block's other instants says nothing about it.
TEST(PrincipalWhereItMatters, OfABlowAtOneInstant) {
  std::mt19937 random(23);
  for (const Index blow : {0, 23, 24, 50, 99})
    for (const double size : {-30.0, 30.0}) {
      auto values = harmonics(6, 100, random);
      values.row(5).setZero();
      values(5, blow) = size;
      std::size_t entry = 0;
      const auto p = walked_problem(8, values, [&, draw = random_stress(random, 1, 1)] {
        return entry++ % 6 < 5 ? draw() : Stress{1, 1, 1, 0, 0, 0};
      });
      expect_principal_of_all_instants(p);
      if (size > 0) {
        for (const auto instant : pipelines::envelope(p.loads, p.responses, 1).principal.instant)
          EXPECT_EQ(instant, blow);
      }
    }
}

// Two equal largest principal stresses, where the cubic touches zero: compression along one axis, first more
// of it, then less beside tension h from all sides. The largest principal stress is 0, then h.
TEST(PrincipalWhereItMatters, OfTwoEqualPrincipalStresses) {
  for (const double h : {0.5, 1.5, 5.0}) {
    Eigen::ArrayXXd values(2, 100);
    for (Index i = 0; i < 100; ++i) values.col(i) << (i < 48 ? -3 : -2), (i < 48 ? 0 : h);
    std::size_t entry = 0;
    const auto p = walked_problem(
        1, values, [&] { return entry++ % 2 == 0 ? Stress{1, 0, 0, 0, 0, 0} : Stress{1, 1, 1, 0, 0, 0}; });
    const auto envelope = pipelines::envelope(p.loads, p.responses, 1);
    EXPECT_EQ(envelope.von_mises.instant[0], 0);
    EXPECT_EQ(envelope.principal.instant[0], 48) << h;      // the first of a block
    EXPECT_NEAR(envelope.principal.value_Pa[0], h, 1e-14);  // rounding of numbers up to 7
  }
}

// Channels that change from instant to instant: their bounds over a block are wide.
TEST(PrincipalWhereItMatters, OfRoughFactors) {
  std::mt19937 random(29);
  std::normal_distribution<double> normal;
  for (const Index n_channels : {3, 12, 31})
    expect_principal_of_all_instants(
        walked_problem(10, Eigen::ArrayXXd::NullaryExpr(n_channels, 300, [&] { return normal(random); }),
                       random_stress(random, 1, 1)));
}

// Of equal instants in different blocks the first counts, though the walk begins where von Mises stress is
// largest; without stress all are equal.
TEST(PrincipalWhereItMatters, OfEqualInstantsTheFirst) {
  Eigen::ArrayXXd values = Eigen::ArrayXXd::Zero(2, 150);
  for (const Index i : {40, 90, 101}) values(0, i) = 1;  // tension
  values(1, 100) = -2;                                   // compression: the largest von Mises stress
  std::size_t entry = 0;
  const auto p =
      walked_problem(2, values, [&] { return entry++ / 2 == 0 ? Stress{1, 0, 0, 0, 0, 0} : Stress{}; });
  const auto envelope = pipelines::envelope(p.loads, p.responses, 1);
  EXPECT_EQ(envelope.von_mises.instant[0], 100);
  EXPECT_EQ(envelope.principal.instant[0], 40);
  EXPECT_EQ(envelope.principal.instant[1], 0);
  EXPECT_EQ(envelope.von_mises.instant[1], 0);
  EXPECT_EQ(envelope.principal.value_Pa[1], 0);
}

// Orders up to the third and up to the fifteenth; the last span has eight instants, one, or two.
TEST(InstantsThatMatter, OfSmoothFactors) {
  std::mt19937 random(31);
  for (const double pressure : {0.0, 3.0, 1e3})
    for (const Index n_channels : {1, 6, 12, 31})
      for (const Index n_instants : {720, 721, 722}) {
        SCOPED_TRACE(testing::Message() << pressure << ", " << n_channels << " channels, " << n_instants);
        expect_maxima_of_smooth_factors(
            walked_problem(6, harmonics(n_channels, n_instants, random), random_stress(random, pressure, 1)));
      }
}

// A blow at one instant of factors that are smooth everywhere else: at a knot, anywhere in a span, beside
// knots that share their deviations with others, at the ends. Tension is the maximum, which pressure is not.
TEST(InstantsThatMatter, OfABlowWithinASpan) {
  std::mt19937 random(37);
  const Index n_instants = 720;
  for (const Index blow : {0, 1, 8, 12, 23, 63, 64, 65, 67, 71, 300, 711, 712, 713, 718, 719})
    for (const double size : {-30.0, 30.0}) {
      SCOPED_TRACE(testing::Message() << size << " at " << blow);
      auto values = harmonics(7, n_instants, random);
      values.row(6).setZero();
      values(6, blow) = size;
      std::size_t entry = 0;
      const auto p = walked_problem(3, values, [&, draw = random_stress(random, 1, 1)] {
        return entry++ % 7 < 6 ? draw() : Stress{1, 0.2, 0, 0, 0, 0};
      });
      expect_maxima_of_smooth_factors(p);
      const auto found = pipelines::envelope(p.loads, p.responses, 1);
      for (std::size_t node = 0; node < 3; ++node) {
        EXPECT_EQ(found.von_mises.instant[node], blow);
        if (size > 0) {
          EXPECT_EQ(found.principal.instant[node], blow);
        }
      }
    }
}

// Crests between two knots, higher than at all knots of another channel's higher plateau: of von Mises stress
// by shear, of principal stress by tension beside pressure. Before knot 64 too, where another word of knots
// begins.
TEST(InstantsThatMatter, OfACrestBetweenKnots) {
  const Index n_instants = 720;
  for (const Index crest : {4, 100, 203, 510, 511, 513, 716}) {
    Eigen::ArrayXXd values(2, n_instants);
    for (Index i = 0; i < n_instants; ++i) {
      const double distance = double(i - crest) / 8;
      values.col(i) << std::exp(-distance * distance), 0.9 * std::min(1.0, std::abs(double(i - crest)) / 80);
    }
    for (const Stress& unit : {Stress{0, 0, 0, 1, 0, 0}, Stress{1, -1, -1, 0, 0, 0}}) {
      const auto p = walked_problem(1, values, [&] { return unit; });
      expect_maxima_of_smooth_factors(p);
      EXPECT_EQ(pipelines::envelope(p.loads, p.responses, 1).von_mises.instant[0], crest);
    }
  }
}

// Straight lines between the knots but in one span, whose crest is below another place's knots without the
// deviation, and far from the line's other end: only the knot after the span can tell of it, the first one of
// those that share their deviations.
TEST(InstantsThatMatter, OfACrestThatTheNextKnotTells) {
  const Index n_instants = 720, other = 320;
  for (const Index knot : {64, 192, 512}) {
    Eigen::ArrayXXd values = Eigen::ArrayXXd::Zero(2, n_instants);
    for (Index i = 0; i < n_instants; ++i) {
      const double before = std::max(0.0, 1 - double(knot - i) / 8), after = 1 - double(i - knot) / 160;
      const double elsewhere = 1.05 - std::abs(double(i - other)) / 64;
      values(0, i) = std::max({i < knot ? before : after, elsewhere, 0.0});
    }
    values(1, knot - 1) = 0.2;  // 0.875 without it
    const auto p = walked_problem(1, values, [] { return Stress{1, 0, 0, 0, 0, 0}; });
    expect_maxima_of_smooth_factors(p);
    EXPECT_EQ(pipelines::envelope(p.loads, p.responses, 1).principal.instant[0], knot - 1);
  }
}

// Of equal instants the first counts, whether it is a knot or not and wherever the walk begins.
TEST(InstantsThatMatter, OfEqualInstantsTheFirstOfSmoothFactors) {
  const Index n_instants = 960;
  for (const Index period : {240, 60})
    for (const Index first : {0, 3, 8, 17}) {
      Eigen::ArrayXXd values(1, n_instants);
      for (Index i = 0; i < n_instants; ++i)  // the same bits in each period
        values(0, i) = std::cos(2 * M_PI * double((i - first + period) % period) / double(period));
      const auto p = walked_problem(1, values, [] { return Stress{3, 1, 0, 0.5, 0, 0}; });
      expect_maxima_of_smooth_factors(p);
      const auto found = pipelines::envelope(p.loads, p.responses, 1);
      EXPECT_EQ(found.principal.instant[0], first);
    }
}

// Tension along two axes, turned at random: the Lode angle's cosine is known to the root of the rounding,
// which is less than what two instants beside each other differ by. At a knot, beside one, between two, and
// last.
TEST(InstantsThatMatter, OfTwoEqualPrincipalStresses) {
  std::mt19937 random(43);
  std::normal_distribution<double> normal;
  const auto turned_tension = [&] {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    const Eigen::Matrix3d m =
        turn.toRotationMatrix() * Eigen::Vector3d(1, 1, 0).asDiagonal() * turn.toRotationMatrix().transpose();
    return Stress{m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(0, 2)};
  };
  for (const Index crest : {0, 96, 97, 100, 719}) {
    Eigen::ArrayXXd values(1, 720);
    for (Index i = 0; i < 720; ++i) values(0, i) = 1 + 0.5 * std::cos(M_PI * double(i - crest) / 720);
    const auto p = walked_problem(100, values, turned_tension);
    for (const auto instant : pipelines::envelope(p.loads, p.responses, 1).principal.instant)
      EXPECT_EQ(instant, crest);
  }
}

// A history that changes at its last instant alone is not steady.
TEST(InstantsThatMatter, OfALastInstantUnlikeAllOthers) {
  Eigen::ArrayXXd values = Eigen::ArrayXXd::Ones(1, 200);
  values(0, 199) = 2;
  const auto p = walked_problem(1, values, [] { return Stress{3, 1, 0, 0.5, 0, 0}; });
  const auto found = pipelines::envelope(p.loads, p.responses, 1);
  EXPECT_EQ(found.von_mises.instant[0], 199);
  EXPECT_EQ(found.principal.instant[0], 199);
}

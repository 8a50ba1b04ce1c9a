// The crest of von Mises between the instants. Reference: the factors' own formulas, on 4096 instants and
// then by golden sections around the largest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "pipelines/judge/estimates/time_sampling.h"
#include "pipelines/superpose/between_instants/cycle_extremes.h"
#include "pipelines/superpose/between_instants/factor_spectrum.h"
#include "pipelines/superpose/envelope/superposition.h"

using namespace pipelines;

namespace {

using UnitStress = std::vector<std::array<double, 6>>;
using Factors = std::function<Eigen::ArrayXd(double)>;  // of the angle, one turn is 2 pi

struct Loading {
  UnitStress unit;
  Factors factors;

  double von_mises_at(double angle_rad) const {
    const Eigen::ArrayXd a = factors(angle_rad);
    Stress sum{};
    for (std::size_t k = 0; k < unit.size(); ++k)
      for (std::size_t c = 0; c < 6; ++c) sum[c] += a[Eigen::Index(k)] * unit[k][c];
    return von_mises_Pa(sum);
  }
};

Eigen::ArrayXXd at_instants(const Factors& factors, int n) {
  Eigen::ArrayXXd values(factors(0).size(), n);
  for (int i = 0; i < n; ++i) values.col(i) = factors(2 * M_PI * i / n);
  return values;
}

double largest_of(const Loading& loading, int n) {
  double largest = 0;
  for (int i = 0; i < n; ++i) largest = std::max(largest, loading.von_mises_at(2 * M_PI * i / n));
  return largest;
}

/// Of all crests among the instants that come close to the largest.
double exact_largest(const Loading& loading, int n_instants = 4096) {
  const double step = 2 * M_PI / n_instants, golden = (std::sqrt(5.0) - 1) / 2;
  const double sampled = largest_of(loading, n_instants);
  double largest = sampled;
  for (int i = 0; i < n_instants; ++i) {
    if (loading.von_mises_at(i * step) < 0.999 * sampled) continue;
    double left = (i - 1) * step, right = (i + 1) * step;
    while (right - left > 1e-9) {
      const double a = right - golden * (right - left), b = left + golden * (right - left);
      (loading.von_mises_at(a) < loading.von_mises_at(b) ? left : right) =
          loading.von_mises_at(a) < loading.von_mises_at(b) ? a : b;
    }
    largest = std::max(largest, loading.von_mises_at((left + right) / 2));
  }
  return largest;
}

using Random = std::mt19937;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

UnitStress random_unit(Random& random, int n_channels) {
  UnitStress unit;
  for (int k = 0; k < n_channels; ++k) {
    unit.emplace_back();
    for (double& component : unit.back()) component = between(random, -1, 1);
  }
  return unit;
}

/// Harmonics up to `highest` of random sizes and phases, times size^order.
Factors random_harmonics(Random& random, int n_channels, int highest, double size = 1) {
  Eigen::ArrayXXd amplitude(n_channels, highest + 1), phase_rad(n_channels, highest + 1);
  for (int k = 0; k < n_channels; ++k)
    for (int h = 0; h <= highest; ++h) {
      amplitude(k, h) = between(random, -1, 1) * std::pow(size, h);
      phase_rad(k, h) = between(random, 0, 2 * M_PI);
    }
  return [=](double angle_rad) {
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(n_channels);
    for (int h = 0; h <= highest; ++h) sum += amplitude.col(h) * (h * angle_rad - phase_rad.col(h)).cos();
    return sum;
  };
}

TimeSampling of_instants(const Loading& loading, int n) {
  return time_sampling(loading.unit, at_instants(loading.factors, n));
}

}  // namespace

// Trigonometric polynomials whose harmonics the instants resolve: the crest to 1e-12, which is the rounding
// of lines left out; nothing is left unresolved. A crest taken from the largest instant's own neighbours
// alone would miss those of other instants.
TEST(ExtremesBetweenInstants, AreExactWhereHarmonicsAreResolved) {
  Random random(22);
  double worst = 0;
  int of_other_instants = 0;
  for (int seed = 0; seed < 300; ++seed) {
    const int highest = 1 + seed % 7, n = 3 * highest + 1 + int(random() % 20), n_channels = 1 + seed % 5;
    const Loading loading{random_unit(random, n_channels), random_harmonics(random, n_channels, highest)};
    const auto found = of_instants(loading, n);
    const double exact = exact_largest(loading), sampled = largest_of(loading, n);
    EXPECT_EQ(found.unresolved_Pa, 0) << seed;
    worst = std::max(worst, std::abs(sampled + found.excess_Pa - exact) / exact);
    EXPECT_NEAR(loading.von_mises_at(2 * M_PI * found.instant / n), exact, 1e-10 * exact) << seed;
    int largest = 0;
    for (int i = 0; i < n; ++i)
      if (loading.von_mises_at(2 * M_PI * i / n) == sampled) largest = i;
    of_other_instants += std::abs(std::remainder(found.instant - largest, n)) > 1 ? 1 : 0;
  }
  EXPECT_LT(worst, 1e-12);
  EXPECT_GT(of_other_instants, 10);
  RecordProperty("largest error", std::to_string(worst));
}

// Few instants for the highest harmonic, up to all that they can have: the polynomial is the same, but the
// instants cannot tell that there is nothing above, and say so.
TEST(ExtremesBetweenInstants, AreExactUpToHalfTheInstants) {
  Random random(7);
  for (int seed = 0; seed < 100; ++seed) {
    const int highest = 1 + seed % 7, n = 2 * highest + 1;
    const Loading loading{random_unit(random, 3), random_harmonics(random, 3, highest)};
    const auto extreme = extreme_of_polynomial(factor_spectrum(
        deviatoric_coordinates(Eigen::Map<const Eigen::Matrix<double, 6, 3>>(loading.unit.front().data()))
                .matrix() *
            at_instants(loading.factors, n).matrix(),
        0));
    const double exact = exact_largest(loading);
    EXPECT_NEAR(extreme.value, exact, 1e-12 * exact) << seed;
    EXPECT_GT(extreme.unresolved, 0) << seed;
  }
}

// Kinks, spectra that fall slowly or fast, shocks, on few and many instants: the true largest value is within
// what is stated. Kinks and shocks stand anywhere; sums of both sides' kinks peak at a kink or beside it.
TEST(ExtremesBetweenInstants, AreBoundedWhereHarmonicsAreNotResolved) {
  Random random(4);
  int unresolved = 0;
  double median_share = 0;
  std::vector<double> shares;
  for (int seed = 0; seed < 400; ++seed) {
    const int n = 16 + int(random() % 200), kind = seed % 4;
    const double where_rad = between(random, 0, 2 * M_PI), size = between(random, -2, 2);
    const double decay = kind == 3 ? 0.9 : 0.5, width = between(random, 2, 10) * 2 * M_PI / n;
    const auto smooth = random_harmonics(random, 3, 12, decay);
    const Loading loading{random_unit(random, 3), [=](double angle_rad) {
                            Eigen::ArrayXd a = smooth(angle_rad);
                            const double away = std::remainder(angle_rad - where_rad, 2 * M_PI);
                            if (kind == 0) a[0] += size * std::abs(std::sin(away));
                            if (kind == 1) a[1] += size * std::max(0.0, std::cos(3 * away));
                            if (kind == 2) a[2] += size * std::exp(-away * away / (width * width));
                            return a;
                          }};
    const auto found = of_instants(loading, n);
    const double exact = exact_largest(loading, 2048), sampled = largest_of(loading, n);
    EXPECT_LE(exact, (sampled + found.error_Pa()) * (1 + 1e-9))
        << "seed " << seed << ", kind " << kind << ", n " << n << ": " << sampled << " + " << found.excess_Pa
        << " + " << found.unresolved_Pa;
    if (found.unresolved_Pa == 0) continue;
    ++unresolved;
    shares.push_back(found.error_Pa() / exact);
  }
  EXPECT_GT(unresolved, 200);
  std::nth_element(shares.begin(), shares.begin() + long(shares.size() / 2), shares.end());
  median_share = shares[shares.size() / 2];
  EXPECT_LT(median_share, 0.05);  // a bound of any size would hold
}

// A kink that is the crest, in the middle between two instants: there polynomials miss it by 1.57 times what
// instants at twice the distance show.
TEST(ExtremesBetweenInstants, KinkInTheMiddleIsWithinTheBound) {
  for (const int n : {16, 60, 360}) {
    Eigen::ArrayXXd values(1, n);
    for (int i = 0; i < n; ++i) values(0, i) = 2 - std::abs(std::sin(M_PI * (2 * i + 1) / n));
    const auto extreme = extreme_of_pieces(values);
    EXPECT_GE(extreme.value + extreme.unresolved, 2) << n;
    EXPECT_LE(extreme.value + extreme.unresolved, 2 + M_PI / n) << n;
  }
}

// A load that turns round in four instants: bending at 45 degrees between them has the same size at all.
TEST(ExtremesBetweenInstants, LoadThatTurnsInFourInstants) {
  const double angle_rad = M_PI / 4;
  const Loading loading{{{0, 0, std::cos(angle_rad), 0, 0, 0}, {0, 0, std::sin(angle_rad), 0, 0, 0}},
                        [](double x) { return Eigen::Array2d(std::cos(x), std::sin(x)).eval(); }};
  const auto found = of_instants(loading, 4);
  EXPECT_NEAR(found.excess_Pa, 1 - std::sqrt(0.5), 1e-14);
  EXPECT_EQ(found.unresolved_Pa, 0);
}

// Steady factors, a stress that turns without changing its size, and instants that meet the crests: nothing
// is missed, exactly; and of loads of no size, or one and two instants, nothing is said.
TEST(ExtremesBetweenInstants, NothingIsMissedOfWhatIsSteadyOrMet) {
  const auto unit = random_unit(*std::make_unique<Random>(1), 3);
  for (const int n : {1, 2, 3, 7, 16, 45, 120, 4097, 2 * 4099}) {
    const Loading steady{unit, [](double) { return Eigen::Array3d(1e6, -3.7, 0.1).eval(); }};
    EXPECT_EQ(of_instants(steady, n).error_Pa(), 0) << n;
    const Loading none{unit, [](double) { return Eigen::Array3d(0, 0, 0).eval(); }};
    EXPECT_EQ(of_instants(none, n).error_Pa(), 0) << n;
  }
  const double half = 1 / std::sqrt(3.0);  // bending and torsion of one von Mises stress, a quarter apart
  for (const int n : {4, 16, 45, 120}) {
    const Loading turning{{{0, 0, 1, 0, 0, 0}, {0, 0, 0, half, 0, 0}},
                          [](double x) { return Eigen::Array2d(std::cos(x), std::sin(x)).eval(); }};
    EXPECT_EQ(of_instants(turning, n).error_Pa(), 0) << n;
  }
  const Loading equal_crests{{{1, 0, 0, 0, 0, 0}},
                             [](double x) { return Eigen::ArrayXd::Constant(1, std::cos(2 * x)).eval(); }};
  EXPECT_EQ(of_instants(equal_crests, 16).error_Pa(), 0);
  const Loading moved{{{1, 0, 0, 0, 0, 0}},
                      [](double x) { return Eigen::ArrayXd::Constant(1, std::cos(2 * x - 0.1)).eval(); }};
  EXPECT_NEAR(of_instants(moved, 16).excess_Pa, 1 - std::cos(0.1), 1e-14);
}

// A run-up whose stress grows to its end: taken as a cycle, the fall from the last instant to the first would
// swing above the last value.
TEST(ExtremesBetweenInstants, WindowsAreNoCycles) {
  const Loading growing{{{1, 0, 0, 0, 0, 0}, {0, 0, 0, 1, 0, 0}},
                        [](double x) { return Eigen::Array2d(x * x, 0.2 * std::sin(5 * x)).eval(); }};
  const auto values = at_instants(growing.factors, 120);
  EXPECT_FALSE(is_closed(values));
  const auto found = time_sampling(growing.unit, values);
  EXPECT_LT(found.error_Pa(), 1e-4 * largest_of(growing, 120));  // four instants at the end
  // The same with a crest within.
  const Loading falling{{{1, 0, 0, 0, 0, 0}}, [](double x) {
                          return Eigen::ArrayXd::Constant(1, 2 + x / 10 + std::cos(x - 3)).eval();
                        }};
  const double exact = exact_largest(falling), sampled = largest_of(falling, 50);
  const auto crest = of_instants(falling, 50);
  EXPECT_LE(exact, sampled + crest.error_Pa());
  EXPECT_NEAR(exact, sampled + crest.excess_Pa, 1e-6);
  EXPECT_LT(crest.unresolved_Pa, 1e-4);
  EXPECT_TRUE(is_closed(at_instants(random_harmonics(*std::make_unique<Random>(3), 3, 5), 40)));
}

// Stresses of any size have the same share between the instants.
TEST(ExtremesBetweenInstants, OfAnySize) {
  Random random(9);
  const Loading loading{random_unit(random, 3), random_harmonics(random, 3, 4)};
  const double share = of_instants(loading, 16).excess_Pa;
  for (const double size : {1e-150, 1e150}) {
    const auto values = at_instants(loading.factors, 16);
    EXPECT_NEAR(time_sampling(loading.unit, values * size).excess_Pa / size, share, 1e-13);
  }
}

// The instants asked for miss no more of any crest than wanted, and a quarter of them would miss more.
TEST(InstantsNeeded, KeepTheShare) {
  ChannelHistory loads;
  loads.channels = {{"seat.fx", "N"}, {"seat.fy", "N"}, {"seat.mz", "N m"}};
  for (const int order : {1, 3, 8}) {
    loads.values.resize(3, 120);
    for (int i = 0; i < 120; ++i)
      loads.values.col(i) << 5e3, 1e3 * std::cos(2 * M_PI * i / 120),
          2 * std::cos(2 * M_PI * order * i / 120);
    for (const double share : {0.1, 0.01, 0.001}) {
      const auto needed = instants_needed(loads, share);
      // 1 - cos(pi order / n) = share
      const double least = M_PI * order / std::acos(1 - share);
      EXPECT_EQ(needed.channel, "seat.mz");
      EXPECT_EQ(needed.highest, order);
      EXPECT_TRUE(needed.is_resolved);
      EXPECT_GE(needed.n_instants, least - 1);
      EXPECT_LE(needed.n_instants, std::max(1.02 * least + 1, 3.0 * order + 1)) << order << ' ' << share;
    }
  }
  loads.values.setConstant(4);
  EXPECT_EQ(instants_needed(loads, 0.01).n_instants, 1);
  EXPECT_EQ(instants_needed(loads, 0.01).channel, "");
}

// Of a factor with kinks every instant more is worth something: 1 % of it takes hundreds.
TEST(InstantsNeeded, KinksTakeMore) {
  ChannelHistory loads;
  loads.channels = {{"seat.fx", "N"}};
  double before = 0;
  for (const int n : {90, 180, 360}) {
    loads.values.resize(1, n);
    for (int i = 0; i < n; ++i) loads.values(0, i) = std::abs(std::sin(2 * M_PI * i / n));
    const auto needed = instants_needed(loads, 0.01);
    EXPECT_FALSE(needed.is_resolved);
    EXPECT_GT(needed.n_instants, 200);
    if (before > 0) {
      EXPECT_NEAR(needed.n_instants, before, 0.15 * before);  // whatever it is reckoned from
    }
    before = needed.n_instants;
  }
}

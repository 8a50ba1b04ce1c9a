// Machines at the edge of what the formulas can say: pulleys of one size, a drum nearly empty or nearly full,
// a carrier that hardly turns, pulleys that just touch.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/unit/kinetics/planetary/planetary_machines.h"

namespace {

using kinetics::LoadHistory;
using kinetics::PlanetaryConvention;
using kinetics::PlanetaryMill;
using kinetics::PlanetaryRatios;
using machines::effects_without;

const kinetics::TimeGrid a_turn{1, 36};

LoadHistory all_effects(const PlanetaryMill& mill) {
  return compute_loads(mill, effects_without(mill, {}), a_turn);
}

void expect_finite(const LoadHistory& loads) {
  for (const auto& quantity : loads.quantities) EXPECT_TRUE(quantity.values.allFinite()) << quantity.name;
  for (const auto& resultant : loads.resultants) EXPECT_TRUE(resultant.total.allFinite()) << resultant.role;
  if (loads.convention == "consistent") {
    EXPECT_LE(loads.quantity("closure_force").values.maxCoeff(), 1e-12);
    EXPECT_LE(loads.quantity("closure_moment").values.maxCoeff(), 1e-12);
  }
}

PlanetaryMill with_c(double c, PlanetaryConvention convention = PlanetaryConvention::consistent) {
  auto mill = machines::printed_planetary();
  mill.convention = convention;
  std::get<PlanetaryRatios>(mill.geometry).c = c;
  return mill;
}

}  // namespace

// The paper's "zone of indeterminacy" (E11): R_A runs through c = 1 without a jump, and the drum does not
// spin there.
TEST(PlanetaryHardCases, PulleysOfOneSizeAreNoSpecialCase) {
  for (const auto convention : {PlanetaryConvention::as_published, PlanetaryConvention::as_plotted,
                                PlanetaryConvention::consistent}) {
    const auto at_one = all_effects(with_c(1, convention));
    expect_finite(at_one);
    EXPECT_EQ(at_one.quantity("drum_speed").values.abs().maxCoeff(), 0);
    EXPECT_EQ(at_one.quantity("drum_relative_speed").values[0], -30);
    const double R = at_one.quantity("R_A").values.maxCoeff();
    for (const double step : {-1e-3, -1e-6, -1e-9, -1e-12, 1e-12, 1e-9, 1e-6, 1e-3}) {
      const auto beside = all_effects(with_c(1 + step, convention));
      expect_finite(beside);
      const double jump =
          (beside.quantity("R_A").values - at_one.quantity("R_A").values).abs().maxCoeff() / R;
      EXPECT_LE(jump, 0.05 * std::abs(step) + 1e-15) << step;
      EXPECT_NEAR(beside.quantity("drum_speed").values[0] / (30 * step), 1, 2e-3 + 1e-4);
    }
  }
}

// abs in (5) leaves a kink of the slope at c = 1; the signed sine does not.
TEST(PlanetaryHardCases, SignedBeltAngleHasNoKink) {
  const auto Y = [](double c, PlanetaryConvention convention) {
    return compute_loads(with_c(c, convention), {"charge_transport", "belt"}, a_turn)
        .quantity("Y_A")
        .values[0];
  };
  const auto slopes = [&](PlanetaryConvention convention) {
    const double h = 1e-5, middle = Y(1, convention);
    return std::pair{(middle - Y(1 - h, convention)) / h, (Y(1 + h, convention) - middle) / h};
  };
  const auto smooth = slopes(PlanetaryConvention::consistent);
  EXPECT_NEAR(smooth.second / smooth.first, 1, 1e-4);
  const auto kinked = slopes(PlanetaryConvention::as_plotted);
  EXPECT_NEAR(kinked.second / kinked.first, -1, 1e-4);
}

// First moments vanish like the void's share, so full and empty drums have no belt load left; no NaN on the
// way, and q_C follows its limit (2/3) (r gamma)^3 = 2 pi r^3 f.
TEST(PlanetaryHardCases, FromEmptyToFull) {
  auto mill = machines::printed_planetary();
  mill.charge.half_angle_rad.reset();
  for (const double share : {0.0, 1e-300, 1e-200, 1e-100, 1e-16, 1e-15, 1e-8, 0.5}) {
    SCOPED_TRACE(share);
    mill.charge.filling = share, mill.charge.void_fraction.reset();
    const auto nearly_empty = all_effects(mill);
    expect_finite(nearly_empty);
    mill.charge.filling.reset(), mill.charge.void_fraction = share;
    const auto nearly_full = all_effects(mill);
    expect_finite(nearly_full);
    // By the segment alone, charge and void turn the drum equally.
    EXPECT_TRUE((nearly_empty.quantity("M_A").values == nearly_full.quantity("M_A").values).all());
    if (share > 0 && share < 1e-99) {
      // sin(gamma)^3 = 12 pi f / 8 for small f
      const double q = 4600 * 2.0 / 3 * 1e-3 * 1.5 * machines::pi * share;
      const double expected = q * (900 * 0.9 * std::cos(mill.charge.segment_angle_rad) -
                                   9.81 * std::sin(mill.charge.segment_angle_rad));
      EXPECT_NEAR(nearly_empty.quantity("M_A").values[0] / expected, 1, 2e-15);
    }
  }
  for (const double filling : {1 - 1e-15, 1 - 1e-10, 1.0}) {
    mill.charge.void_fraction.reset(), mill.charge.filling = filling;
    expect_finite(all_effects(mill));
  }
  mill.charge.filling.reset();
  for (const double gamma : {0.0, 1e-200, machines::pi, std::nextafter(machines::pi, 0)}) {
    mill.charge.half_angle_rad = gamma;
    expect_finite(all_effects(mill));
  }
}

// A carrier that hardly turns: weights alone, turning backwards in its frame; the belt swaps its strands.
TEST(PlanetaryHardCases, CarrierThatHardlyTurns) {
  auto mill = machines::printed_planetary();
  mill.speed_rad_s = 1e-9;
  const auto loads = all_effects(mill);
  expect_finite(loads);
  const auto without_belt = compute_loads(mill, effects_without(mill, {"belt"}), a_turn);
  const double weight_N = 9.81 * (79.47 + planetary_charge_body(mill).mass_kg);
  EXPECT_LE((without_belt.quantity("R_A").values / weight_N - 1).abs().maxCoeff(), 1e-13);
  EXPECT_GE(loads.quantity("T1").values.minCoeff(), 0);
  EXPECT_GE(loads.quantity("T2").values.minCoeff(), 0);
  EXPECT_FALSE(hodograph(mill, effects_without(mill, {})));
}

// Strands diverge as 1/r_A, the rest stays: Y_A does not know r_A at all at a given c.
TEST(PlanetaryHardCases, SmallDrumPulley) {
  auto mill = machines::printed_planetary();
  const auto Y = [&](double r_A) {
    mill.geometry = kinetics::PlanetaryLengths{0.9, 2 * r_A, r_A};
    const auto loads = all_effects(mill);
    expect_finite(loads);
    EXPECT_NEAR(loads.quantity("T1").values[0] * r_A / (2 * loads.quantity("M_A").values[0]), 1, 1e-14);
    return Eigen::ArrayXd(loads.quantity("Y_A").values);
  };
  const Eigen::ArrayXd reference = Y(0.1);
  for (const double r_A : {1e-3, 1e-9, 1e-30, 1e-100})
    EXPECT_LE((Y(r_A) / reference - 1).abs().maxCoeff(), 1e-14) << r_A;
}

// Pulleys that just touch in their plane, k = c / (1 + 2c), are allowed whatever the rounding; the touch from
// within, c = k, is the last belt there is.
TEST(PlanetaryHardCases, PulleysThatJustTouch) {
  for (const double c : {0.1, 0.3, 0.37, 0.5, 0.7, 1.0}) {
    auto mill = with_c(c);
    std::get<PlanetaryRatios>(mill.geometry).k = c / (1 + 2 * c);
    std::get<PlanetaryRatios>(mill.geometry).b = 0.5;
    expect_finite(all_effects(mill));
    mill.convention = PlanetaryConvention::as_plotted;
    std::get<PlanetaryRatios>(mill.geometry).k = c < 1 ? c : 0.9;
    EXPECT_LE(planetary_geometry(mill).belt_cosine, c < 1 ? 0.0 : 1.0) << c;
    expect_finite(all_effects(mill));
  }
  // 0.4 - 0.3 is 0.1 and a rounding.
  auto mill = machines::printed_planetary();
  mill.convention = PlanetaryConvention::as_plotted;
  mill.geometry = kinetics::PlanetaryLengths{0.1, 0.4, 0.3};
  EXPECT_EQ(planetary_geometry(mill).belt_sine, 1);
  expect_finite(all_effects(mill));
}

// Both descriptions of one machine give one result.
TEST(PlanetaryHardCases, RatiosAndLengthsAgree) {
  auto mill = machines::printed_planetary();
  const auto by_ratios = all_effects(mill);
  mill.geometry = kinetics::PlanetaryLengths{0.9, 0.2, 0.1};
  const auto by_lengths = all_effects(mill);
  for (const auto& quantity : by_ratios.quantities)
    if (quantity.unit != "1") {
      EXPECT_LE((quantity.values - by_lengths.quantity(quantity.name).values).abs().maxCoeff(),
                1e-14 * quantity.values.abs().maxCoeff())
          << quantity.name;
    }
}

// Turning the start turns the history: the carrier's angle is all that weights depend on.
TEST(PlanetaryHardCases, InitialAnglesShiftTheHistory) {
  auto mill = machines::printed_planetary();
  const auto start = all_effects(mill);
  mill.initial_angle_rad = 9 * 2 * machines::pi / 36;
  mill.initial_drum_angle_rad = 0.3;
  const auto later = all_effects(mill);
  for (Eigen::Index i = 0; i < 27; ++i)
    EXPECT_NEAR(later.quantity("R_A").values[i] / start.quantity("R_A").values[i + 9], 1, 1e-14);
  EXPECT_EQ(later.quantity("psi").values[0], 0.3);
  EXPECT_EQ(later.time_s[0], 0);
}

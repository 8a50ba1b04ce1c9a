#include "kinetics/spring_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinetics/vibratory_effects/affine_optimum.h"
#include "tests/unit/kinetics/vibratory/machines.h"

namespace {

using Eigen::Array2Xd;
using kinetics::Convention;
using kinetics::SpringAim;
using kinetics::SpringChoice;
using kinetics::VibratoryMill;
using machines::effects_without;
using Names = std::vector<std::string>;

const kinetics::TimeGrid grid{20, 12};
const auto both = {SpringAim::rms, SpringAim::peak};

Names held(const VibratoryMill& mill) {
  return effects_without(mill, {"pitch", "charge_follows_pitch", "charge_lag"});
}

VibratoryMill scaled(VibratoryMill mill, double scale) {
  for (auto& spring : mill.springs) spring.stiffness_N_m *= scale;
  return mill;
}

/// From the load stage itself; default preloads do not depend on the common scale.
double reaction_N(const VibratoryMill& mill, const Names& effects, SpringAim aim) {
  const auto loads = compute_loads(mill, effects, grid);
  const auto& R_E = loads.quantity("R_E").values;
  return aim == SpringAim::rms ? std::sqrt(R_E.square().mean()) : R_E.maxCoeff();
}

bool warned(const SpringChoice& choice, const std::string& words) {
  for (const auto& warning : choice.warnings)
    if (warning.find(words) != std::string::npos) return true;
  return false;
}

std::string refusal(const VibratoryMill& mill, const Names& effects,
                    const kinetics::SpringSearch& search = {}) {
  try {
    choose_springs(mill, effects, grid, SpringAim::rms, search);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

/// Equal in both directions, so that G turns with the drive.
VibratoryMill round_springs() {
  auto mill = machines::laboratory();
  for (auto& spring : mill.springs) spring.stiffness_N_m = {20000, 20000};
  return mill;
}

}  // namespace

// Springs that are alike in both directions can carry all that turns with the drive: k* = omega^2 (M + m3 KE
// / ecc). Nothing is then left but the debalance's own term if masses are missing from the sum.
TEST(SpringChoice, RoundSpringsCarryWhatTurnsWithTheDrive) {
  const auto mill = round_springs();
  const double w2 = 151.844 * 151.844;
  const Names effects{"structure_inertia", "exciter_inertia", "charge_translation", "debalance_inertia",
                      "springs"};
  for (const auto aim : both) {
    const auto choice = choose_springs(mill, effects, grid, aim);
    EXPECT_NEAR(choice.stiffness_N_m / (w2 * (30 + 6 + 20 + 4 * 0.01 / 0.004)), 1, 1e-11);
    EXPECT_NEAR(choice.scale * 40000, choice.stiffness_N_m, 1e-6);
    EXPECT_LE(choice.reaction_N, 1e-9 * choice.reaction_given_N);
  }
  // Without debalance the bounce frequency sqrt(k* / M) is that of the drive itself.
  EXPECT_TRUE(warned(choose_springs(mill, held(mill), grid, SpringAim::rms), "the chamber bounces at"));
  auto light = mill;
  light.debalance_offset_m = -0.004 * 50 / 4;  // counterweights: k* = 6 kg omega^2, sqrt(6/56) of the speed
  EXPECT_FALSE(warned(choose_springs(light, effects, grid, SpringAim::rms), "the chamber bounces at"));
}

// Lateral stiffness a = kx / ky: least squares share k* by (1 + a) / (1 + a^2).
TEST(SpringChoice, LateralStiffnessEntersInProportion) {
  const auto mill = machines::laboratory();
  const double a = 14000 / 27500.0, w2 = 151.844 * 151.844;
  const auto choice = choose_springs(mill, {"structure_inertia", "springs"}, grid, SpringAim::rms);
  EXPECT_NEAR(choice.stiffness_N_m / (30 * w2 * (1 + a) / (1 + a * a)), 1, 1e-12);
}

// The paper's formulas: vertical springs only, so that X_E stays. Least squares: k* = m omega^2; for the peak
// every k up to 2 m omega^2 is as good, as |X_E| at phi = 0 is the largest anyhow: the smallest is none.
TEST(SpringChoice, Published) {
  auto mill = machines::laboratory();
  mill.convention = Convention::published;
  const Names effects{"charge_translation", "springs"};
  const double w2 = 151.844 * 151.844;
  EXPECT_NEAR(choose_springs(mill, effects, grid, SpringAim::rms).stiffness_N_m / (20 * w2), 1, 1e-12);
  const auto peak = choose_springs(mill, effects, grid, SpringAim::peak);
  EXPECT_EQ(peak.stiffness_N_m, 0);
  EXPECT_NEAR(peak.reaction_N / (20 * w2 * 0.004), 1, 1e-12);
  EXPECT_TRUE(warned(peak, "k* = 0"));
}

TEST(SpringChoice, NoStiffnessScannedByBruteForceIsBetter) {
  std::mt19937 generator(17);
  for (int i = 0; i < 12; ++i) {
    auto mill = i == 0 ? machines::laboratory() : machines::random(generator);
    if (i % 3 == 2) {
      mill.convention = Convention::published;
      mill.springs = {mill.springs[0], mill.springs[mill.springs.size() > 1 ? 1 : 0]};
    }
    for (const auto aim : both) {
      const auto choice = choose_springs(mill, held(mill), grid, aim);
      EXPECT_NEAR(choice.reaction_N / reaction_N(scaled(mill, std::max(choice.scale, 1e-9)), held(mill), aim),
                  1, 1e-6);
      const double reach = std::max(choice.scale, 1.0);
      for (int j = 1; j <= 30; ++j)
        EXPECT_GE(reaction_N(scaled(mill, 2 * reach * j / 30), held(mill), aim),
                  choice.reaction_N * (1 - 1e-12))
            << "machine " << i;
    }
  }
}

TEST(SpringChoice, ReactionIsAffineWithThePitchHeld) {
  const auto mill = machines::laboratory();
  const auto vector_at = [&](double scale) -> Array2Xd {
    return compute_loads(scaled(mill, scale), held(mill), grid)
        .resultant("frame_bearings")
        .total.topRows<2>();
  };
  const Array2Xd one = vector_at(1), two = vector_at(2), seven = vector_at(7);
  EXPECT_LE((seven - (6 * two - 5 * one)).abs().maxCoeff(), 1e-12 * seven.abs().maxCoeff());
}

TEST(SpringChoice, SmallestOfEquallyGoodOnes) {
  Array2Xd R0(2, 2), G(2, 2);
  R0 << 8, 0, 0, 5;  // |8 - k| and a constant 5: all of [3, 13] is optimal
  G << -1, 0, 0, 0;
  EXPECT_NEAR(kinetics::vibratory::peak_optimum(R0, G), 3, 1e-12);
  G(1, 1) = -1e-17;  // round-off of sin(pi) must not open the interval
  EXPECT_NEAR(kinetics::vibratory::peak_optimum(R0, G), 3, 1e-12);
  R0(1, 1) = 1, G(1, 1) = 0;  // the vertex lies below the constant: |8 - k| = 1
  EXPECT_NEAR(kinetics::vibratory::peak_optimum(R0, G), 7, 1e-12);
  G << 1, 0, 0, 0;
  EXPECT_EQ(kinetics::vibratory::peak_optimum(R0, G), 0) << "clipped";
  EXPECT_EQ(kinetics::vibratory::rms_optimum(R0, G), 0) << "clipped";
  R0 << 8, -2, 0, 0;
  G << -1, 1, 0, 0;  // |8 - k| and |k - 2| meet at 5
  EXPECT_NEAR(kinetics::vibratory::peak_optimum(R0, G), 5, 1e-12);
}

// With pitch on the objective has resonances; what is found must not be above a scan ten times as fine.
TEST(SpringChoice, FreePitchAgainstAFineScan) {
  const auto mill = machines::laboratory();
  const Names effects = effects_without(mill, {"charge_lag", "charge_follows_pitch"});
  for (const auto aim : both) {
    const auto choice = choose_springs(mill, effects, {20, 12}, aim, {0.01, 100, 80});
    const auto value = [&](double scale) {
      const auto loads = compute_loads(scaled(mill, scale), effects, {20, 12});
      const auto& R_E = loads.quantity("R_E").values;
      return aim == SpringAim::rms ? std::sqrt(R_E.square().mean()) : R_E.maxCoeff();
    };
    EXPECT_NEAR(value(choice.scale) / choice.reaction_N, 1, 1e-12);
    EXPECT_NEAR(value(1) / choice.reaction_given_N, 1, 1e-12);
    double least = value(choice.scale);
    for (int i = 0; i <= 800; ++i) least = std::min(least, value(std::pow(10, -2 + i / 200.0)));
    EXPECT_GE(least, choice.reaction_N * (1 - 1e-9));
  }
}

TEST(SpringChoice, ResonancesAreNamed) {
  const auto mill = machines::laboratory();
  const Names effects = effects_without(mill, {"charge_lag", "charge_follows_pitch"});
  const auto choice = choose_springs(mill, effects, {20, 24}, SpringAim::rms);
  // k_theta = 7001.2 N m, I_E = 2.85: the drive meets the pitch at I w^2 / k_theta of the given springs.
  bool found = false;
  for (const auto& resonance : choice.resonances) {
    EXPECT_EQ(resonance.between_given_and_chosen,
              (resonance.scale > 1) == (resonance.scale < choice.scale) && resonance.scale != 1);
    if (resonance.p == 1 && resonance.q == 0) {
      found = true;
      EXPECT_NEAR(resonance.scale, 2.85 * 151.844 * 151.844 / 7001.2, 1e-9);
      EXPECT_NEAR(resonance.frequency_rad_s, 151.844, 1e-9);
      EXPECT_NEAR(resonance.stiffness_N_m, 55000 * resonance.scale, 1e-6);
    }
  }
  EXPECT_TRUE(found);
  // Undamped, and met exactly by the scan's middle (scale 1): passed over, not divided by.
  auto tuned = scaled(mill, 2.85 * 151.844 * 151.844 / 7001.2);
  for (auto& spring : tuned.springs) spring.damping_N_s_m.setZero();
  const auto beside = choose_springs(tuned, effects, {20, 24}, SpringAim::rms, {0.1, 10, 201});
  EXPECT_TRUE(std::isfinite(beside.reaction_N));
  EXPECT_FALSE(std::isfinite(beside.reaction_given_N));
}

// A charge that stands still in space brings several harmonics of one frequency, which were told one by one.
TEST(SpringChoice, AResonanceIsToldOnce) {
  auto mill = machines::laboratory();
  mill.charge_relative_speed_rad_s = -mill.speed_rad_s;
  const auto choice =
      choose_springs(mill, effects_without(mill, {"charge_lag"}), {1, 24}, SpringAim::rms, {0.01, 100, 80});
  ASSERT_FALSE(choice.resonances.empty());
  for (std::size_t i = 1; i < choice.resonances.size(); ++i)
    EXPECT_GT(choice.resonances[i].frequency_rad_s, 1.001 * choice.resonances[i - 1].frequency_rad_s);
}

// The force on the ground is the sum of what the load stage has at the springs' feet, less its mean; what
// exceeds the limit is not proposed. Red if the limit is not kept, or if springs within it are passed over.
TEST(SpringChoice, KeepsTheLimitOfTheForceOnTheGround) {
  const auto mill = machines::laboratory();
  const Names effects = effects_without(mill, {"charge_lag", "charge_follows_pitch"});
  const kinetics::TimeGrid turns{20, 24};
  const auto on_ground = [&](double scale) {
    const auto loads = compute_loads(scaled(mill, scale), effects, turns);
    Array2Xd sum = Array2Xd::Zero(2, loads.n_instants());
    for (const auto& resultant : loads.resultants)
      if (resultant.role.rfind("spring_foot_", 0) == 0) sum += resultant.total.topRows<2>();
    sum.colwise() -= sum.rowwise().mean().eval();
    return std::sqrt(sum.square().colwise().sum().maxCoeff());
  };
  kinetics::SpringSearch search{0.1, 9, 200};
  const auto free = choose_springs(mill, effects, turns, SpringAim::rms, search);
  EXPECT_NEAR(free.transmitted_N / on_ground(free.scale), 1, 1e-9);
  EXPECT_NEAR(free.transmitted_given_N / on_ground(1), 1, 1e-9);
  search.most_transmitted_N = 0.5 * (free.transmitted_N + free.transmitted_given_N);
  ASSERT_GT(free.transmitted_N, search.most_transmitted_N) << "stiffer springs press harder";
  const auto limited = choose_springs(mill, effects, turns, SpringAim::rms, search);
  EXPECT_LE(limited.transmitted_N, search.most_transmitted_N);
  EXPECT_GT(limited.transmitted_N, 0.999 * search.most_transmitted_N) << "the limit decides";
  EXPECT_GT(limited.reaction_N, free.reaction_N);
  EXPECT_LT(limited.reaction_N, limited.reaction_given_N);
  search.most_transmitted_N = 1e-3;
  EXPECT_NE(refusal(mill, effects, search).find("no springs of the search keep it"), std::string::npos);
}

// With the pitch held the optimum is in closed form, and bounds hold where they are asked to.
TEST(SpringChoice, BoundsHoldWithThePitchHeldWhereTheyAreAskedTo) {
  const auto mill = round_springs();
  const auto open = choose_springs(mill, held(mill), grid, SpringAim::rms, {0.5, 2, 100});
  ASSERT_GT(open.scale, 2);
  kinetics::SpringSearch search{0.5, 2, 100};
  search.bounds_held_pitch = true;
  const auto bounded = choose_springs(mill, held(mill), grid, SpringAim::rms, search);
  EXPECT_NEAR(bounded.scale, 2, 1e-6);
  EXPECT_TRUE(bounded.resonances.empty());
}

TEST(SpringChoice, WrongInputIsRefused) {
  auto mill = machines::laboratory();
  EXPECT_NE(refusal(mill, {"structure_inertia"}).find("the effect is off"), std::string::npos);
  EXPECT_NE(refusal(mill, {"springs"}, {0, 1, 10}).find("least_scale = 0"), std::string::npos);
  EXPECT_NE(refusal(mill, {"springs"}, {2, 1, 10}).find("most_scale = 1"), std::string::npos);
  EXPECT_NE(refusal(mill, {"springs"}, {1, 2, 2}).find("n_scan = 2"), std::string::npos);
  for (auto& spring : mill.springs) spring.stiffness_N_m.y() = 0;
  EXPECT_NE(refusal(mill, {"springs"}).find("vertical stiffness = 0"), std::string::npos);
  mill = machines::laboratory();
  mill.eccentricity_m = 0;
  EXPECT_NE(refusal(mill, {"springs"}).find("eccentricity = 0"), std::string::npos);
}

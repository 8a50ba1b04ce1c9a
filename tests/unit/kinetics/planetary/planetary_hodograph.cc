// The closed form of the axle's load against the history, which knows nothing of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/kinetics/planetary/planetary_machines.h"

namespace {

using Eigen::ArrayXd;
using kinetics::LoadHistory;
using kinetics::PlanetaryConvention;
using kinetics::PlanetaryHodograph;
using kinetics::PlanetaryMill;

ArrayXd at(const PlanetaryHodograph::Component& h, const ArrayXd& phi) {
  return h.mean_N + h.cosine_N * phi.cos() + h.sine_N * phi.sin();
}

void expect_ellipse(const PlanetaryMill& mill, const std::vector<std::string>& effects) {
  const auto h = hodograph(mill, effects);
  const auto loads = compute_loads(mill, effects, {1, 360});
  if (!h) {
    const auto& dT = loads.quantity("belt_difference").values;
    EXPECT_TRUE(dT.minCoeff() < 0 && dT.maxCoeff() > 0);
    return;
  }
  const ArrayXd& R = loads.quantity("R_A").values;
  double scale = 0;  // of the largest force that enters: they cancel
  for (const auto& part : loads.resultant("axle").contributions)
    scale = std::max(scale, part.load.abs().maxCoeff());
  EXPECT_LE((at(h->X_A, loads.phi_rad) - loads.quantity("X_A").values).abs().maxCoeff(), 2e-14 * scale);
  EXPECT_LE((at(h->Y_A, loads.phi_rad) - loads.quantity("Y_A").values).abs().maxCoeff(), 2e-14 * scale);
  // The history samples the curve: below its maximum by up to the curvature over half a step.
  const double step = machines::pi / 360, swing = h->X_A.amplitude_N() + h->Y_A.amplitude_N();
  EXPECT_GE(h->R_max_N, R.maxCoeff() - 2e-14 * scale);
  EXPECT_LE(h->R_max_N, R.maxCoeff() + 4 * swing * step * step + 2e-14 * scale);
  EXPECT_LE(h->R_min_N, R.minCoeff() + 2e-14 * scale);
  const auto R_at = [&](double phi) {
    const ArrayXd one = ArrayXd::Constant(1, phi);
    return std::hypot(at(h->X_A, one)[0], at(h->Y_A, one)[0]);
  };
  EXPECT_NEAR(R_at(h->phi_of_R_max_rad), h->R_max_N, 1e-14 * scale);
  EXPECT_NEAR(R_at(h->phi_of_R_min_rad), h->R_min_N, 1e-14 * scale);
  for (const double angle : {h->phi_of_R_max_rad, h->phi_of_R_min_rad}) {
    EXPECT_GE(angle, 0);
    EXPECT_LE(angle, 2 * machines::pi);
  }
}

}  // namespace

TEST(PlanetaryHodograph, RandomMachinesAllConventions) {
  std::mt19937 generator(5);
  for (int k = 0; k < 100 && !HasFailure(); ++k) {
    SCOPED_TRACE("machine " + std::to_string(k));
    auto mill = machines::random_planetary(generator);
    for (const auto convention : {PlanetaryConvention::consistent, PlanetaryConvention::as_plotted,
                                  PlanetaryConvention::as_published}) {
      mill.convention = convention;
      expect_ellipse(mill, machines::effects_without(mill, {}));
      expect_ellipse(mill, machines::effects_without(mill, {"charge_gravity"}));
      expect_ellipse(mill, machines::effects_without(mill, {"belt", "drum_transport"}));
      expect_ellipse(mill, {"drum_transport", "charge_transport", "charge_gravity", "belt"});
    }
  }
}

// R at first order is good to the second: (swing / mean)^2.
TEST(PlanetaryHodograph, FirstOrderOfR) {
  const auto mill = machines::printed_planetary();
  const auto h = hodograph(mill, machines::effects_without(mill, {}));
  ASSERT_TRUE(h);
  const double second = std::pow(h->X_A.amplitude_N() + h->Y_A.amplitude_N(), 2) / h->R_mean_N;
  EXPECT_NEAR(h->R_max_N, h->R_mean_N + h->R_amplitude_N, second);
  EXPECT_NEAR(h->R_min_N, h->R_mean_N - h->R_amplitude_N, second);
  EXPECT_NEAR(h->phi_of_R_max_rad * 180 / machines::pi, 310, 1.5);  // E16: not the paper's 330
}

// A circle about the origin, R constant, and nothing at all: no NaN, no endless search.
TEST(PlanetaryHodograph, DegenerateEllipses) {
  const auto mill = machines::printed_planetary();
  const auto weight = hodograph(mill, {"drum_gravity"});
  ASSERT_TRUE(weight);
  EXPECT_NEAR(weight->R_max_N / (79.47 * 9.81), 1, 1e-15);
  EXPECT_NEAR(weight->R_min_N / (79.47 * 9.81), 1, 1e-15);
  EXPECT_EQ(weight->R_amplitude_N, 0);
  const auto nothing = hodograph(mill, {});
  ASSERT_TRUE(nothing);
  EXPECT_EQ(nothing->R_max_N, 0);
  const auto inertia = hodograph(mill, {"drum_transport"});
  EXPECT_EQ(inertia->R_max_N, inertia->R_min_N);
}

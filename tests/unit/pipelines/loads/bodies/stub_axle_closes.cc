/// The two stubs that carry the drum of the planetary mill: what they receive adds up to the axle's load, the
/// clamp closes, and the load hardly changes.
#include <gtest/gtest.h>

#include "pipelines/loads/bodies/drum.h"
#include "pipelines/loads/bodies/stub_axle.h"
#include "tests/unit/pipelines/examples/plain_body.h"

namespace {

using Eigen::Array2Xd;
using Eigen::ArrayXd;

struct Stub {
  pipelines::Scene scene = plain::scene("stub_axle");
  pipelines::LoadedBody body = plain::loaded(*scene.body("axle"));
  kinetics::PlanetaryMill mill = std::get<kinetics::PlanetaryMill>(scene.machine);
  kinetics::LoadHistory history = kinetics::compute_loads(mill, scene.kinetics_effects(), {1, 360});

  const pipelines::StubAxleOptions& options() const {
    return std::get<pipelines::StubAxleOptions>(scene.body("axle")->options);
  }
  pipelines::BodyLoads loads(bool pulley_side) const {
    auto side = options();
    side.pulley_side = pulley_side;
    return distribute_stub_axle(history, mill, body, side, scene.effects);
  }
};

TEST(StubAxle, BothSidesAddUpToTheAxlesLoad) {
  const Stub stub;
  const auto sum =
      (bodies::force(stub.loads(true), "bearing") + bodies::force(stub.loads(false), "bearing")).eval();
  const ArrayXd X = stub.history.quantity("X_A").values, Y = stub.history.quantity("Y_A").values;
  const double size = bodies::largest(X);
  EXPECT_LT(bodies::largest(sum.row(0).transpose() - X), 1e-12 * size);
  EXPECT_LT(bodies::largest(sum.row(1).transpose() + Y), 1e-12 * size);
}

// A drum with trunnions on the same bearings feels the opposite. The drum here is symmetrical about its
// middle but for the pulley, which is what the stub's share assumes.
TEST(StubAxle, IsTheCounterpartOfTheDrumsTrunnions) {
  const Stub stub;
  using Kind = meshes::Port::Kind;
  const auto& axle = stub.options();
  pipelines::LoadedBody drum{"drum",
                             {bodies::port("inner_wall", Kind::bore, 1, {-0.5, 0.5}, 0.1),
                              bodies::port("trunnion_1", Kind::seat, 2, {-0.58, -0.54}, 0.04),
                              bodies::port("trunnion_2", Kind::seat, 3, {0.54, 0.58}, 0.04),
                              bodies::port("pulley_seat", Kind::seat, 4, {0.58, 0.678}, 0.035)},
                             {{"", {}, {}}},
                             {}};
  drum.regions[0].masses.mass_kg = stub.mill.drum_mass_kg - axle.pulley_mass_kg;
  const pipelines::AttachedMass pulley{"pulley", "pulley_seat", axle.pulley_mass_kg, {0, 0}, 0.1};
  const auto on_drum = distribute_drum(stub.history, stub.mill, drum, {stub.scene.effects, {pulley}});
  EXPECT_LT(bodies::closure_of(on_drum, drum.regions).worst_moment(), 1e-12);
  const ArrayXd back = -stub.history.quantity("psi").values;
  for (const bool pulley_side : {false, true}) {
    const Array2Xd wanted =
        -pipelines::turned(bodies::force(on_drum, pulley_side ? "trunnion_2" : "trunnion_1"), back);
    const Array2Xd got = bodies::force(stub.loads(pulley_side), "bearing");
    EXPECT_LT(bodies::largest(got - wanted), 1e-11 * bodies::largest(wanted)) << pulley_side;
  }
}

TEST(StubAxle, ClampCloses) {
  const Stub stub;
  for (const bool pulley_side : {false, true}) {
    const auto loads = stub.loads(pulley_side);
    const auto closure = bodies::closure_of(loads, stub.body.regions);
    EXPECT_LT(closure.worst_force(), 1e-12);
    EXPECT_LT(closure.worst_moment(), 1e-12);
    EXPECT_GT(bodies::largest(bodies::course(loads, "clamp.mx")), 100);
    EXPECT_GT(bodies::largest(bodies::course(loads, "clamp.my")), 100);
    EXPECT_FALSE(bodies::has(loads, "clamp.torque")) << "bearings have no friction";
  }
}

double swing(const Array2Xd& force) {
  const ArrayXd size = bodies::magnitude(force);
  return (size.maxCoeff() - size.minCoeff()) / (size.maxCoeff() + size.minCoeff());
}

// coupling.md section 5: constant to 1.6 %, a case of yield. That is the load of both stubs and of the plain
// one, which carries more; belt and centrifugal forces nearly cancel on the other, so that weights show more.
TEST(StubAxle, LoadHardlyChanges) {
  const Stub stub;
  const Array2Xd plain = bodies::force(stub.loads(false), "bearing"),
                 pulley = bodies::force(stub.loads(true), "bearing");
  EXPECT_NEAR(swing(plain + pulley), 0.016, 0.001);
  EXPECT_LT(swing(plain), 0.016);
  EXPECT_LT(swing(pulley), 0.045);
  EXPECT_GT(bodies::magnitude(plain).minCoeff(), 2 * bodies::magnitude(pulley).maxCoeff());
}

// The stub stands still in the carrier's axes and turns with Omega, not with the drum.
TEST(StubAxle, TurnsWithTheCarrier) {
  const Stub stub;
  const auto loads = stub.loads(true);
  const double omega2 = 30 * 30, l_OA = kinetics::planetary_geometry(stub.mill).carrier_m;
  const auto part = [&](const char* effect, const char* channel) {
    return bodies::part(loads, effect, channel);
  };
  EXPECT_LT(bodies::largest(part("axle_transport", "volume.spin") - omega2), 1e-9);
  EXPECT_LT(bodies::largest(part("axle_transport", "volume.ax") - omega2 * l_OA), 1e-9);
  EXPECT_LT(bodies::largest(part("axle_gravity", "volume.ax") + 9.81 * stub.history.phi_rad.sin()), 1e-12);
  EXPECT_LT(bodies::largest(part("axle_gravity", "volume.ay") + 9.81 * stub.history.phi_rad.cos()), 1e-12);
  const auto massless =
      distribute_stub_axle(stub.history, stub.mill, stub.body, stub.options(), {"drum_transport"});
  EXPECT_FALSE(bodies::has(massless, "volume.ax"));
  EXPECT_FALSE(bodies::has(massless, "volume.spin"));
}

}  // namespace

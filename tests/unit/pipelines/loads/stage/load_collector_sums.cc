/// The collector's sums against points with masses, its reactions against the formulas of coupling.md
/// section 1.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "tests/unit/pipelines/examples/bodies.h"

namespace {

using Eigen::Array2Xd;
using Eigen::ArrayXd;
using Eigen::Vector3d;
using pipelines::AccelerationField;
using pipelines::LoadCollector;
using pipelines::LoadedBody;
using pipelines::Wrench;
using Kind = meshes::Port::Kind;

constexpr Eigen::Index n = 6;

struct PointMass {
  double mass_kg;
  Vector3d place_m;
};

const std::vector<PointMass> points{
    {1.5, {0.1, 0.2, -0.3}}, {0.7, {-0.4, 0.05, 0.2}}, {2.1, {0.3, -0.1, 0.6}}, {0.4, {0.02, 0.5, 0.1}}};

fem::MassProperties masses_of(const std::vector<PointMass>& all) {
  fem::MassProperties m;
  for (const auto& [mass, p] : all) {
    m.mass_kg += mass;
    const std::array<double, 6> products{p[0] * p[0], p[1] * p[1], p[2] * p[2],
                                         p[0] * p[1], p[1] * p[2], p[0] * p[2]};
    for (std::size_t c = 0; c < 3; ++c) m.first_moment_kg_m[c] += mass * p[Eigen::Index(c)];
    for (std::size_t c = 0; c < 6; ++c) m.second_moments_kg_m2[c] += mass * products[c];
  }
  return m;
}

LoadedBody body() {
  return {"body",
          {bodies::port("seat", Kind::seat, 1, {0.05, 0.15}, 0.03, {0.004, -0.002}),
           bodies::port("bore", Kind::bore, 2, {-0.3, -0.1}, 0.02, {-0.1, 0.2}),
           bodies::port("pad", Kind::face, 3, {-0.1, 0.3}, 0, {0.4, 0.3}),
           bodies::port("first", Kind::seat, 4, {-0.52, -0.48}, 0.03),
           bodies::port("second", Kind::seat, 5, {0.68, 0.72}, 0.03)},
          {{"", {}, masses_of(points)}},
          {}};
}

ArrayXd random_course(std::mt19937& random, double size) {
  ArrayXd values(n);
  for (double& v : values) v = std::uniform_real_distribution<>(-size, size)(random);
  return values;
}

AccelerationField random_field(std::mt19937& random) {
  AccelerationField field{Eigen::Array3Xd::Zero(3, n), random_course(random, 5), random_course(random, 9)};
  for (Eigen::Index d = 0; d < 3; ++d) field.translation_m_s2.row(d) = random_course(random, 10).transpose();
  return field;
}

/// Sum of m a and r x m a over points, a = translation + angular z x r + spin (x, y, 0).
Wrench of_points(const std::vector<PointMass>& all, const AccelerationField& field) {
  Wrench sum = Wrench::Zero(6, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (const auto& [mass, p] : all) {
      Vector3d a = field.translation_m_s2.col(i).matrix();
      a += field.angular_rad_s2[i] * Vector3d::UnitZ().cross(p);
      a += field.spin_rad2_s2[i] * Vector3d(p[0], p[1], 0);
      const Vector3d f = mass * a, moment = p.cross(f);
      sum.col(i).head<3>() += f.array();
      sum.col(i).tail<3>() += moment.array();
    }
  return sum;
}

double relative(const Wrench& a, const Wrench& b) {
  return bodies::largest(a - b) / bodies::largest(b);
}

TEST(LoadCollector, AddsForcesAndMomentsAboutTheOrigin) {
  std::mt19937 random(1);
  LoadCollector collector(body(), {"a", "b"}, n, 100);
  Wrench wanted = Wrench::Zero(6, n);
  for (const std::size_t effect : {0, 1, 0})
    for (const auto& port : body().ports) {
      const ArrayXd fx = random_course(random, 100), fy = random_course(random, 100),
                    fz = random_course(random, 100), mx = random_course(random, 10),
                    my = random_course(random, 10), mz = random_course(random, 10);
      Array2Xd f(2, n), tilt(2, n);
      f << fx.transpose(), fy.transpose();
      tilt << mx.transpose(), my.transpose();
      collector.force(port.name, effect, f);
      collector.axial_force(port.name, effect, fz);
      collector.torque(port.name, effect, mz);
      collector.tilt(port.name, effect, tilt);
      const Vector3d p(port.axis_x_m, port.axis_y_m, (port.begin_m + port.end_m) / 2);
      for (Eigen::Index i = 0; i < n; ++i) {
        const Vector3d force(fx[i], fy[i], fz[i]), moment = p.cross(force) + Vector3d(mx[i], my[i], mz[i]);
        wanted.col(i).head<3>() += force.array();
        wanted.col(i).tail<3>() += moment.array();
      }
    }
  EXPECT_LT(relative(collector.sum(), wanted), bodies::round_off);
  EXPECT_LT(relative(collector.sum(0) + collector.sum(1), wanted), bodies::round_off);
  EXPECT_EQ(bodies::largest(collector.sum(2)), 0);
  // What leaves as channels is what was entered.
  EXPECT_LT(relative(bodies::residual(collector.finish(), body().regions), wanted), bodies::round_off);
}

TEST(LoadCollector, AcceleratesARegionAsItsPoints) {
  std::mt19937 random(2);
  const auto field = random_field(random);
  LoadCollector collector(body(), {"inertia"}, n, 100);
  collector.accelerate(body().region(), 0, field);
  const auto wanted = of_points(points, field);
  EXPECT_LT(relative(collector.sum(0), wanted), bodies::round_off);
  EXPECT_LT(relative(bodies::residual(collector.finish(), body().regions), wanted), bodies::round_off);
}

// An attached mass lies in its port's middle plane; it loads the port by r x m a about the port's own point.
TEST(LoadCollector, AttachedMassLoadsItsPortAsItsPoints) {
  std::mt19937 random(3);
  for (const char* port : {"seat", "bore", "pad"}) {
    const auto field = random_field(random);
    const auto loaded = body();
    const auto& at = *std::find_if(loaded.ports.begin(), loaded.ports.end(),
                                   [&](const auto& p) { return p.name == port; });
    auto flat = points;
    for (auto& point : flat) point.place_m[2] = (at.begin_m + at.end_m) / 2;
    const auto m = masses_of(flat);
    LoadCollector collector(loaded, {"inertia"}, n, 100);
    collector.accelerate({"rings",
                          port,
                          m.mass_kg,
                          {m.first_moment_kg_m[0], m.first_moment_kg_m[1]},
                          m.second_moments_kg_m2[0] + m.second_moments_kg_m2[1]},
                         0, field);
    EXPECT_LT(relative(collector.sum(0), of_points(flat, field)), bodies::round_off) << port;
    const auto loads = collector.finish();
    for (const auto& channel : loads.history.channels)
      EXPECT_EQ(channel.name.rfind(std::string(port) + ".", 0), 0u) << channel.name;
    EXPECT_FALSE(bodies::has(loads, std::string(port) + ".p0c")) << "it clings, it does not press";
  }
}

// coupling.md section 1, term by term:
//   R_Bx = -sum(F_xj (z_j - z_A) + my_j - x_j F_zj) / (z_B - z_A)        R_Ax = -sum F_xj - R_Bx
//   R_By = -sum(F_yj (z_j - z_A) - mx_j - y_j F_zj) / (z_B - z_A)        R_Ay = -sum F_yj - R_By
TEST(LoadCollector, ReactsByAxialStatics) {
  std::mt19937 random(4);
  const auto loaded = body();
  LoadCollector collector(loaded, {"a", "b"}, n, 100);
  const double z_A = -0.5, z_B = 0.7;
  for (const std::size_t effect : {0, 1}) {
    const std::string name = effect == 0 ? "a" : "b";
    ArrayXd x_sum = ArrayXd::Zero(n), y_sum = x_sum, fx_sum = x_sum, fy_sum = x_sum;
    for (std::size_t p = 0; p < 3; ++p) {
      const auto& port = loaded.ports[p];
      const double z = (port.begin_m + port.end_m) / 2;
      const ArrayXd fx = random_course(random, 100), fy = random_course(random, 100),
                    fz = random_course(random, 100), mx = random_course(random, 10),
                    my = random_course(random, 10);
      Array2Xd f(2, n), tilt(2, n);
      f << fx.transpose(), fy.transpose();
      tilt << mx.transpose(), my.transpose();
      collector.force(port.name, effect, f);
      collector.axial_force(port.name, effect, fz);
      collector.tilt(port.name, effect, tilt);
      x_sum += fx * (z - z_A) + my - port.axis_x_m * fz;
      y_sum += fy * (z - z_A) - mx - port.axis_y_m * fz;
      fx_sum += fx;
      fy_sum += fy;
    }
    LoadCollector copy = collector;  // so that each effect is looked at before the next one reacts
    copy.react("first", "second");
    const auto loads = copy.finish();
    const ArrayXd R_Bx = -x_sum / (z_B - z_A), R_By = -y_sum / (z_B - z_A);
    const double size = bodies::largest(R_Bx) + bodies::largest(R_By);
    EXPECT_LT(bodies::largest(bodies::part(loads, name, "second.fx") - R_Bx), bodies::round_off * size);
    EXPECT_LT(bodies::largest(bodies::part(loads, name, "second.fy") - R_By), bodies::round_off * size);
    EXPECT_LT(bodies::largest(bodies::part(loads, name, "first.fx") + fx_sum + R_Bx),
              bodies::round_off * size);
    EXPECT_LT(bodies::largest(bodies::part(loads, name, "first.fy") + fy_sum + R_By),
              bodies::round_off * size);
  }
}

// With the axial force and the torque taken too, nothing is left in any of the six equations.
// A pressure that rises in straight lines from nothing acts at two thirds of its seat: of a load and of a
// bearing. By hand: the load at 0.05 + 0.1 * 2/3, the first bearing at -0.48 - 0.04 * 2/3, the second at 0.7.
TEST(LoadCollector, LopsidedPressureActsWhereItIs) {
  auto loaded = body();
  loaded.pressures["seat"].axial_profile = {0, 1};
  loaded.pressures["first"].axial_profile = {1, 0.5, 0};
  loaded.pressures["second"].axial_profile = {0, 1, 0};
  LoadCollector collector(loaded, {"a"}, n, 100);
  Array2Xd f = Array2Xd::Zero(2, n);
  f.row(0).setConstant(90);
  f.row(1).setConstant(-30);
  collector.force("seat", 0, f);
  collector.react("first", "second");
  const double z = 0.05 + 0.1 * 2 / 3, z_A = -0.48 - 0.04 * 2 / 3, on_second = -(z - z_A) / (0.7 - z_A);
  const auto loads = collector.finish();
  const auto largest_apart = [&](const char* channel, double wanted) {
    return bodies::largest(bodies::part(loads, "a", channel) - wanted);
  };
  EXPECT_LT(largest_apart("second.fx", 90 * on_second), 1e-12);
  EXPECT_LT(largest_apart("second.fy", -30 * on_second), 1e-12);
  EXPECT_LT(largest_apart("first.fx", -90 * (1 + on_second)), 1e-12);
  // About the middle of the seat, a sixth of its length from there.
  EXPECT_LT(largest_apart("seat.my", 90 * 0.1 / 6), 1e-12);
  EXPECT_LT(largest_apart("seat.mx", 30 * 0.1 / 6), 1e-12);
  EXPECT_FALSE(bodies::has(loads, "second.my"));
  EXPECT_LT(bodies::residual(loads, loaded.regions).middleRows<2>(3).abs().maxCoeff(), 1e-12 * 90);
}

TEST(LoadCollector, SupportsCloseAllSix) {
  std::mt19937 random(5);
  LoadCollector collector(body(), {"inertia"}, n, 100);
  collector.accelerate(body().region(), 0, random_field(random));
  collector.react("first", "second");
  collector.react_axial("first");
  collector.react_torque("second");
  const auto closure = bodies::closure_of(collector.finish(), body().regions);
  EXPECT_LT(closure.worst_force(), bodies::round_off);
  EXPECT_LT(closure.worst_moment(), bodies::round_off);
}

// A clamp off the axis, under axial forces too, closes by force and moments about its own point.
TEST(LoadCollector, ClampClosesAllSix) {
  std::mt19937 random(6);
  LoadCollector collector(body(), {"inertia"}, n, 100);
  collector.accelerate(body().region(), 0, random_field(random));
  collector.axial_force("bore", collector.effect("push"), random_course(random, 100));
  collector.react_force("pad");
  collector.react_tilt("pad");
  collector.react_torque("pad");
  const auto rest = bodies::residual(collector.finish(), body().regions);
  const auto closed = rest.topRows<2>().abs().maxCoeff() + rest.row(5).abs().maxCoeff();
  EXPECT_LT(closed, 1e-11);
  EXPECT_GT(rest.row(2).abs().maxCoeff(), 1) << "nobody was asked to take the axial force";
  collector.react_axial("pad");
  const auto closure = bodies::closure_of(collector.finish(), body().regions);
  EXPECT_LT(closure.worst_force(), bodies::round_off);
  EXPECT_LT(closure.worst_moment(), bodies::round_off);
}

// A reaction that the load stage gives is taken as it is: whether the body closes stays a question.
TEST(LoadCollector, GivenReactionIsNotCorrected) {
  LoadCollector collector(body(), {"a"}, n, 100);
  collector.force("seat", 0, Array2Xd::Constant(2, n, 100));
  collector.react("first", "second", {{0, Array2Xd::Constant(2, n, -90)}});
  const auto loads = collector.finish();
  EXPECT_NEAR(bodies::residual(loads, body().regions)(0, 2), 10, 1e-12);
  EXPECT_GT(bodies::closure_of(loads, body().regions).worst_force(), 0.05);
}

TEST(LoadCollector, RefusesWhatItCannotPlace) {
  LoadCollector collector(body(), {"a"}, n, 100);
  EXPECT_THROW(collector.torque("sea", 0, ArrayXd::Ones(n)), std::invalid_argument);
  EXPECT_THROW(collector.react("first", "first"), std::invalid_argument);
  EXPECT_THROW(body().region("exciter"), std::out_of_range);
}

// Faces across an axis along x have their middles at one z, but for what their meshes make of it: a moment of
// 1 N m asked for forces of 1e5 N there.
TEST(LoadCollector, RefusesBearingsThatAreHardlyApart) {
  const auto react = [](double apart_m) {
    auto loaded = body();
    loaded.ports[4].begin_m = loaded.ports[3].begin_m + apart_m;
    loaded.ports[4].end_m = loaded.ports[3].end_m + apart_m;
    LoadCollector collector(loaded, {"a"}, n, 100);
    collector.tilt("pad", 0, Array2Xd::Ones(2, n));
    collector.react("first", "second");
  };
  EXPECT_THROW(react(1e-5), std::invalid_argument);
  EXPECT_NO_THROW(react(0.01));
}

}  // namespace

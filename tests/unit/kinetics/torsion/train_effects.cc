// Loads of a train: what each effect brings, and what is left when it is off.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

#include "kinetics/train_crests.h"
#include "kinetics/values/constants.h"
#include "tests/unit/kinetics/torsion/trains.h"

namespace {

using kinetics::pi;

double largest(const Eigen::ArrayXXd& values) {
  return values.abs().maxCoeff();
}

/// MOK-150 with every kind of excitation and damping.
kinetics::DriveTrain full() {
  auto train = trains::mok150("working");
  train.modal_damping_ratio = 0.01;
  train.elements[1].damping_N_m_s = 0.5;
  train.elements[1].loss_factor = 0.05;
  train.inertias[3].damping_N_m_s = 0.02;
  kinetics::TrainExcitation roots;
  roots.name = "roots", roots.inertia = "disc";
  roots.constant_Nm = -2;
  roots.table.torque_Nm = {0, -1, -4, -1, 0.5, 0};
  roots.table.order = 1;
  roots.table.order_of = "working";
  train.excitations.push_back(roots);
  return train;
}

std::vector<std::string> all_effects(const kinetics::DriveTrain& train) {
  std::vector<std::string> names;
  for (const auto& info : drive_train_effects(train)) names.push_back(info.name);
  return names;
}

}  // namespace

TEST(TrainEffects, AreTheExcitationsAndTheDampingThatThereIs) {
  const std::vector<std::string> wanted{"torque_on_rotor", "torque_on_disc",  "roots",
                                        "inertia_damping", "element_damping", "structural_damping",
                                        "modal_damping"};
  EXPECT_EQ(all_effects(full()), wanted);
  EXPECT_EQ(all_effects(trains::mok150("motor")).size(), 2u);
}

TEST(TrainEffects, ContributionsAddUpAndEveryInertiaIsInBalance) {
  const auto train = full();
  const auto history = compute_loads(train, all_effects(train), {8, 60});
  EXPECT_LT(largest(history.quantity("closure").values), 1e-12);
  for (const auto& resultant : history.resultants) {
    Eigen::Array3Xd sum = Eigen::Array3Xd::Zero(3, history.n_instants());
    for (const auto& part : resultant.contributions) sum += part.load;
    EXPECT_LT(largest(sum - resultant.total), 1e-13 * largest(resultant.total)) << resultant.role;
    EXPECT_EQ(largest(resultant.total.topRows(2)), 0);
  }
  // T_34 - T_45 - D_4 phi_4' = J_4 phi_4''
  const auto on = [&](const char* role) -> Eigen::ArrayXd {
    return history.resultant(role).total.row(2).transpose();
  };
  const Eigen::ArrayXd sum = on("upper_half_on_working_shaft") + on("lower_half_on_working_shaft") +
                             on("damping_on_working_shaft") -
                             7.05e-5 * history.quantity("working_shaft.acceleration").values;
  EXPECT_LT(largest(sum), 1e-12 * largest(on("upper_half_on_working_shaft")));
  EXPECT_LT(largest(on("upper_half_on_working_shaft") - history.quantity("upper_half.torque").values), 1e-12);
  EXPECT_LT(largest(history.quantity("upper_half.torque").values * 0.375 -
                    history.quantity("upper_half.reduced_torque").values),
            1e-12);
  EXPECT_LT(largest(on("belt_on_driven_pulley") * 0.375 + on("belt_on_driving_pulley")), 1e-12);
}

// One excitation alone brings what it contributes among all; damping that is off is not there.
TEST(TrainEffects, AreIndependent) {
  const auto train = full();
  const auto names = all_effects(train);
  const auto all = compute_loads(train, names, {8, 60});
  auto without = names;
  without.erase(without.begin(), without.begin() + 2);
  const auto alone = compute_loads(train, without, {8, 60});
  const auto& contribution = all.resultant("belt_on_driven_pulley").contributions.at(2);
  EXPECT_EQ(all.effects[contribution.effect], "roots");
  EXPECT_LT(largest(contribution.load - alone.resultant("belt_on_driven_pulley").total), 1e-12);
  auto undamped = train;
  undamped.modal_damping_ratio = 0;
  const auto off = compute_loads(train, {names.begin(), names.end() - 1}, {8, 60});
  const auto gone = compute_loads(undamped, all_effects(undamped), {8, 60});
  EXPECT_EQ(largest(off.quantity("belt.torque").values - gone.quantity("belt.torque").values), 0);
  EXPECT_GT(largest(off.quantity("belt.torque").values - all.quantity("belt.torque").values), 1e-3);
  EXPECT_TRUE(compute_loads(train, {}, {1, 12}).resultant("belt_on_driven_pulley").contributions.empty());
}

// Both ways of solving, modal coordinates and dynamic stiffnesses: a loss factor in every element is, mode by
// mode, a damping ratio of loss w_k / (2 w); for one frequency and one elastic mode they agree exactly.
TEST(TrainEffects, ModalDampingIsWhatItsNameSays) {
  auto train = trains::chain({1, 3}, {400});
  const double w = 31, w_k = natural_modes(train).frequency_rad_s[1];
  train.excitations = {trains::harmonic("J0", 2, w)};
  auto modal = train, structural = train;
  modal.modal_damping_ratio = 0.04;
  structural.elements[0].loss_factor = 2 * 0.04 * w / w_k;
  const auto a = forced_response(modal).harmonics[0], b = forced_response(structural).harmonics[0];
  EXPECT_LT((a.angle_rad - b.angle_rad).abs().maxCoeff(), 1e-14 * b.angle_rad.abs().maxCoeff());
  EXPECT_LT(std::abs(a.torque_Nm[0] - b.torque_Nm[0]), 1e-14 * std::abs(b.torque_Nm[0]));
  // A ratio that rounds away leaves the undamped response, of all modes.
  auto mok = trains::mok150("working");
  const auto without = forced_response(mok).harmonics[0];
  mok.modal_damping_ratio = 1e-18;
  const auto with = forced_response(mok).harmonics[0];
  EXPECT_LT((with.torque_Nm - without.torque_Nm).abs().maxCoeff(),
            1e-10 * without.torque_Nm.abs().maxCoeff());
}

// The torque of an element is what its neighbours' inertias need, modal damping included, by the matrices of
// all masses, D = J Phi 2 zeta w_k Phi^T J: and where that differs from stiffness times twist, it is said.
TEST(TrainEffects, ModalDampingIsPartOfTheTorqueAndIsTold) {
  auto train = trains::chain({1, 3, 0.2}, {400, 900});
  const double w = 120, zeta = 0.1;
  train.excitations = {trains::harmonic("J0", 2, w)};
  train.modal_damping_ratio = zeta;
  const auto modes = natural_modes(train);
  const Eigen::Vector3d J(1, 3, 0.2);
  Eigen::Matrix3d K;
  K << 400, -400, 0, -400, 1300, -900, 0, -900, 900;
  Eigen::Matrix3d D = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d shape = modes.reduced_shape.col(k).matrix(), moving = J.asDiagonal() * shape;
    D += 2 * zeta * modes.frequency_rad_s[k] / shape.dot(moving) * moving * moving.transpose();
  }
  const std::complex<double> i(0, 1);
  Eigen::Matrix3cd Z = K.cast<std::complex<double>>() + i * w * D.cast<std::complex<double>>();
  Z.diagonal() -= w * w * J.cast<std::complex<double>>();
  const Eigen::Vector3cd q = Z.fullPivLu().solve(Eigen::Vector3cd(2, 0, 0));
  const auto response = forced_response(train);
  const auto& torque = response.harmonics[0].torque_Nm;
  EXPECT_LT(std::abs(torque[0] - (2.0 + w * w * J[0] * q[0])), 1e-13);
  EXPECT_LT(std::abs(torque[1] + w * w * J[2] * q[2]), 1e-13);
  const double by_twist = std::abs(900.0 * (q[1] - q[2]));
  ASSERT_GT(std::abs(by_twist / std::abs(torque[1]) - 1), 0.05);
  ASSERT_EQ(response.warnings.size(), 1);
  EXPECT_NE(response.warnings[0].find("modal damping changes the torque in "), std::string::npos);
  const auto history = compute_loads(train, all_effects(train), {8, 60});
  EXPECT_NE(std::find(history.warnings.begin(), history.warnings.end(), response.warnings[0]),
            history.warnings.end());
  train.modal_damping_ratio = 0.001;
  EXPECT_TRUE(forced_response(train).warnings.empty());
  auto single = trains::chain({1, 3}, {400});
  single.excitations = {trains::harmonic("J0", 2, w)};
  single.modal_damping_ratio = zeta;
  EXPECT_TRUE(forced_response(single).warnings.empty()) << "the damping can sit in one element only";
}

TEST(TrainEffects, TablesPassThroughTheirEntries) {
  for (const int n : {1, 2, 5, 8}) {
    auto train = trains::chain({1, 2}, {1e6});
    kinetics::TrainExcitation x;
    x.name = "table", x.inertia = "J0";
    for (int j = 0; j < n; ++j) x.table.torque_Nm.push_back(3 + std::sin(j * j));
    x.table.order = 1;
    train.excitations = {x};
    const auto history = compute_loads(train, {"table"}, {1, 40});
    const auto row = history.resultant("excitation_on_J0").total.row(2);
    for (int j = 0; j < n; ++j) EXPECT_NEAR(row[j * 40 / n], x.table.torque_Nm[j], 1e-13) << n << ' ' << j;
  }
}

// A rigid gear is the limit of a stiff one.
TEST(TrainEffects, RigidGearIsTheLimitOfStiffGears) {
  auto train = trains::mok150("working");
  auto& gear = train.elements[1];
  gear.kind = kinetics::ElementKind::gear;
  gear.ratio = -0.375;
  gear.stiffness_N_m_rad = 1e13;
  const auto stiff = compute_loads(train, {"torque_on_rotor", "torque_on_disc"}, {1, 30});
  gear.stiffness_N_m_rad.reset();
  gear.rigid = true;
  const auto rigid = compute_loads(train, {"torque_on_rotor", "torque_on_disc"}, {1, 30});
  for (const char* name : {"motor_shaft.torque", "belt.torque", "belt.reduced_torque", "lower_half.torque"}) {
    const auto& wanted = stiff.quantity(name).values;
    EXPECT_LT(largest(rigid.quantity(name).values - wanted), 1e-7 * largest(wanted)) << name;
  }
  EXPECT_LT(largest(rigid.quantity("closure").values), 1e-12);
  EXPECT_EQ(natural_modes(train).frequency_rad_s.size(), 4);
}

// Held end inside a rigid pair, and a rigid pair beyond it: the reaction belongs to the held inertia alone.
TEST(TrainEffects, HeldEndTakesTheTorque) {
  auto train = trains::chain({1, 2, 3}, {1, 500});
  train.elements[0].stiffness_N_m_rad.reset();
  train.elements[0].rigid = true;
  train.inertias[1].held = true;
  train.excitations = {trains::harmonic("J2", 4, 5)};
  train.excitations[0].constant_Nm = 7;
  const auto response = forced_response(train);
  EXPECT_EQ(response.rigid_acceleration_rad_s2, 0);
  EXPECT_NEAR(response.mean_torque_Nm[1], -7, 1e-14);
  EXPECT_EQ(response.mean_torque_Nm[0], 0) << "nothing acts on J0";
  EXPECT_NEAR(response.mean_angle_rad[2], 7.0 / 500, 1e-16);
  EXPECT_NEAR(response.harmonics[0].angle_rad[2].real(), 4 / (500 - 3 * 25.0), 1e-16);
}

TEST(TrainEffects, WindowsAndSamplingsThatMisleadAreSaid) {
  auto train = trains::mok150("working");
  const auto says = [&](const kinetics::TimeGrid& grid, const std::string& part) {
    for (const auto& warning : compute_loads(train, {"torque_on_rotor"}, grid).warnings)
      if (warning.find(part) != std::string::npos) return true;
    return false;
  };
  EXPECT_TRUE(says({1, 30}, "the vibration repeats after 0.02 s"));
  EXPECT_FALSE(says({34, 30}, "repeats"));  // 34 turns at 1360 rpm are 75 mains periods
  EXPECT_TRUE(says({34, 6}, "instants per period"));
}

// Order 4 with six instants in its period, none nearer to a crest than 30 degrees. Red where only fewer than
// four are told of: torques were 13 % too small without a word.
TEST(TrainEffects, CrestsBetweenTheInstantsAreTold) {
  auto train = trains::chain({0.05, 0.005, 1e-3}, {6749.4, 500});
  train.reference_speed_rad_s = 100;
  train.excitations = {trains::harmonic("J1", 10, 400, M_PI / 2)};
  const auto warnings_with = [&](int instants) {
    return compute_loads(train, {train.excitations[0].name}, {1, instants}).warnings;
  };
  const auto of_few = warnings_with(24);
  ASSERT_EQ(of_few.size(), 1u);
  EXPECT_NE(of_few[0].find("has 6 instants per period"), std::string::npos) << of_few[0];
  EXPECT_NE(of_few[0].find("by 13.4 % ("), std::string::npos) << of_few[0];
  EXPECT_TRUE(warnings_with(16).empty()) << "four in the period, on its crests";
  EXPECT_TRUE(warnings_with(120).empty());
}

// 50 Hz at 25 turns a second, by thirty, seven, five and three instants in a period: red where figures are
// those of the instants, which lack half of the range by three, or the largest of 24 and more in a period,
// which lack 0.9 %. Torques on inertias have the ratio of their side.
TEST(TrainEffects, FiguresOverTheCourseHaveTheCrests) {
  auto train = trains::mok150("working");
  train.reference_speed_rad_s = 50 * M_PI;
  std::vector<std::string> effects;
  for (const auto& info : drive_train_effects(train)) effects.push_back(info.name);
  const auto right = compute_loads(train, effects, {1, 2400});
  const auto course_of = [&](const std::string& name) -> Eigen::ArrayXd {
    const auto role = name.substr(0, name.rfind('.'));
    if (!right.has_resultant(role)) return right.quantity(name).values;
    return right.resultant(role).total.row(2).transpose();
  };
  for (const int instants : {60, 14, 10, 6}) {
    const auto figures = figures_over_the_course(train, effects, {1, instants});
    EXPECT_EQ(std::count_if(figures.begin(), figures.end(),
                            [](const auto& of) { return of.quantity.find("_on_") != std::string::npos; }),
              long(2 * train.elements.size()));
    for (const auto& of : figures) {
      const Eigen::ArrayXd values = course_of(of.quantity);
      const double size = 1e-12 + values.abs().maxCoeff();
      // A parabola through three of 24 instants in a period misses 1.1e-4 of its crest.
      EXPECT_NEAR(of.largest, values.maxCoeff(), 2e-4 * size) << instants << ' ' << of.quantity;
      EXPECT_NEAR(of.least, values.minCoeff(), 2e-4 * size) << instants << ' ' << of.quantity;
      EXPECT_NEAR(of.mean, values.mean(), 1e-9 * size) << instants << ' ' << of.quantity;
      EXPECT_NEAR(of.rms, std::sqrt(values.square().mean()), 1e-9 * size) << instants << ' ' << of.quantity;
    }
  }
}

// The instants at hand are the course where they are dense; red where their ends are no crests, or where
// instants of another number are taken for the course.
TEST(TrainEffects, FiguresOverTheCourseTakeInstantsThatAreThere) {
  auto train = trains::mok150("working");
  train.reference_speed_rad_s = 50 * M_PI;
  std::vector<std::string> effects;
  for (const auto& info : drive_train_effects(train)) effects.push_back(info.name);
  for (const int instants : {14, 60, 240}) {
    const kinetics::TimeGrid grid{1, instants};
    const auto evaluated = figures_over_the_course(train, effects, grid);
    for (const auto& at_hand :
         {compute_loads(train, effects, grid), compute_loads(train, effects, {1, 33})}) {
      const auto taken = figures_over_the_course(train, effects, grid, &at_hand);
      ASSERT_EQ(taken.size(), evaluated.size());
      for (std::size_t q = 0; q < taken.size(); ++q) {
        EXPECT_EQ(taken[q].quantity, evaluated[q].quantity);
        const double near = 1e-12 + 1e-11 * std::max(evaluated[q].largest, -evaluated[q].least);
        EXPECT_NEAR(taken[q].largest, evaluated[q].largest, near) << instants << ' ' << taken[q].quantity;
        EXPECT_NEAR(taken[q].least, evaluated[q].least, near) << instants << ' ' << taken[q].quantity;
        EXPECT_NEAR(taken[q].mean, evaluated[q].mean, near) << instants << ' ' << taken[q].quantity;
        EXPECT_NEAR(taken[q].rms, evaluated[q].rms, near) << instants << ' ' << taken[q].quantity;
      }
    }
  }
}

// A fast line that brings 0.2 % of the torques and half of an acceleration. Red where the lines that count
// for torques decide how many instants there are: 802 rad/s2 stood where 883 is right.
TEST(TrainEffects, FiguresOverTheCourseHaveFastAccelerations) {
  auto train = trains::chain({0.05, 0.2, 0.05}, {500, 500});
  train.reference_speed_rad_s = 20;
  train.excitations = {trains::harmonic("J0", 10, 60, 0.3), trains::harmonic("J2", 10, 4000, 1.1)};
  train.excitations[1].name = "fast";
  const std::vector<std::string> effects{train.excitations[0].name, "fast"};
  const auto right = compute_loads(train, effects, {1, 96000});
  for (const auto& of : figures_over_the_course(train, effects, {1, 7})) {
    if (of.quantity.find("acceleration") == std::string::npos) continue;
    const auto& values = right.quantity(of.quantity).values;
    const double size = values.abs().maxCoeff();
    EXPECT_NEAR(of.largest, values.maxCoeff(), 2e-4 * size) << of.quantity;
    EXPECT_NEAR(of.least, values.minCoeff(), 2e-4 * size) << of.quantity;
  }
}

// Two to three instants in a period tell the line, but not that there is nothing above: the whole course
// does, where it is not too long.
TEST(TrainEffects, TheWholeCourseIsKnownWhereInstantsAreFew) {
  auto train = trains::chain({0.05, 0.005, 1e-3}, {6749.4, 500});
  train.reference_speed_rad_s = 100;
  train.excitations = {trains::harmonic("J1", 10, 1000, 0.3)};
  const std::vector<std::string> effects{train.excitations[0].name};
  for (const int instants : {21, 24, 27, 30}) {
    const auto at = compute_loads(train, effects, {2, instants});
    const auto between = loads_between_instants(train, effects, {2, instants});
    ASSERT_TRUE(between) << instants;
    const auto times = between->n_instants() / at.n_instants();
    ASSERT_EQ(between->n_instants(), times * at.n_instants());
    EXPECT_GE(times * instants, 240);
    for (Eigen::Index i = 0; i < at.n_instants(); ++i)
      EXPECT_NEAR(between->quantity("C0.torque").values[times * i], at.quantity("C0.torque").values[i],
                  1e-12);
  }
}

// Order 24 with 24 instants: at each of them the same value, which no spectrum tells from a constant. Red
// where the instants alone are asked: a shaft had 38.5 +- 0.3 MPa where 100.9 is right.
TEST(TrainEffects, HarmonicsThatTheInstantsCannotTellAreFoundBetweenThem) {
  auto train = trains::chain({0.05, 0.005, 1e-3}, {6749.4, 500});
  train.reference_speed_rad_s = 100;
  train.excitations = {trains::harmonic("J1", 10, 2400, M_PI / 2), trains::harmonic("J0", 1, 100)};
  train.excitations[1].name = "slow";
  const std::vector<std::string> effects{train.excitations[0].name, "slow"};
  const auto largest = [](const kinetics::LoadHistory& loads) {
    return loads.quantity("C0.torque").values.abs().maxCoeff();
  };
  const double right = largest(compute_loads(train, effects, {1, 2400}));
  for (const int instants : {24, 48, 36}) {
    const kinetics::TimeGrid grid{1, instants};
    const auto between = loads_between_instants(train, effects, grid);
    ASSERT_TRUE(between) << instants;
    EXPECT_NEAR(largest(*between), right, 0.01 * right) << instants;
    EXPECT_LT(largest(compute_loads(train, effects, grid)), right);
    // They are loads like any others.
    const auto at = between->phi_rad;
    EXPECT_TRUE((at.tail(at.size() - 1) > at.head(at.size() - 1)).all());
    EXPECT_LT(between->quantity("closure").values.abs().maxCoeff(), 1e-12);
    const auto few = loads_between_instants(train, effects, grid, 5);
    ASSERT_EQ(few->n_instants(), 5);
    EXPECT_NEAR(largest(*few), right, 0.01 * right);
  }
  EXPECT_FALSE(loads_between_instants(train, effects, {1, 73}, 5)) << "three in a period: they tell the line";
  EXPECT_FALSE(loads_between_instants(train, effects, {1, 96})) << "four in a period";
  EXPECT_FALSE(loads_between_instants(train, {"slow"}, {1, 24}));
}

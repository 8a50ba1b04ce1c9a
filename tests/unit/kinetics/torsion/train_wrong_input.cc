// Each mistake must be refused with the parameter, its value and a way out.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/unit/kinetics/torsion/trains.h"

namespace {

using kinetics::DriveTrain;

const double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::string refusal(const std::function<void()>& run) {
  try {
    run();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

void expect_message(const std::string& message, const std::vector<std::string>& parts) {
  for (const auto& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "wanted: " << part << "\n   got: " << message;
}

struct Mistake {
  std::function<void(DriveTrain&)> make;
  std::vector<std::string> message_has;
};

}  // namespace

TEST(TrainWrongInput, Parameters) {
  const std::vector<Mistake> mistakes = {
      {[](auto& t) { t.inertias.clear(); }, {"inertias: none"}},
      {[](auto& t) { t.inertias[4].inertia_kg_m2 = 0; },
       {"disc.inertia = 0", "must be positive", "write 1e-12"}},
      {[](auto& t) { t.inertias[4].inertia_kg_m2 = -1; }, {"disc.inertia = -1", "must not be negative"}},
      {[](auto& t) { t.inertias[4].inertia_kg_m2 = not_a_number; }, {"disc.inertia = nan"}},
      {[](auto& t) { t.inertias[0].damping_N_m_s = -1; }, {"rotor.damping = -1"}},
      {[](auto& t) { t.inertias[1].name = "rotor"; }, {"rotor is taken"}},
      {[](auto& t) { t.inertias[0].held = t.inertias[4].held = true; }, {"disc.held", "rotor is held too"}},
      {[](auto& t) { t.elements[0].stiffness_N_m_rad = -5; }, {"motor_shaft.stiffness = -5"}},
      {[](auto& t) { t.elements[0].stiffness_N_m_rad.reset(); }, {"motor_shaft.shear_modulus = 0"}},
      {[](auto& t) { t.elements[0].ratio = 2; }, {"motor_shaft.ratio = 2", "one speed"}},
      {[](auto& t) { t.elements[0].bore_m = 0.019; }, {"motor_shaft.bore = 0.019", "smaller"}},
      {[](auto& t) { t.elements[0].stress_concentration = 0.9; }, {"stress_concentration = 0.9"}},
      {[](auto& t) { t.elements[0].loss_factor = -0.1; }, {"loss_factor = -0.1"}},
      {[](auto& t) { t.elements[0].second = "drivng_pulley"; },
       {"drivng_pulley", "did you mean driving_pulley?"}},
      {[](auto& t) { t.elements[0].second = "rotor"; }, {"with itself"}},
      {[](auto& t) { t.elements[1].ratio = 0; }, {"belt.ratio = 0"}},
      {[](auto& t) { t.elements[1].stiffness_on = "shaft"; },
       {"belt.stiffness_on", "\"motor\" or \"working\""}},
      {[](auto& t) { t.elements[1].stiffness_N_m_rad.reset(); }, {"belt.stiffness: missing"}},
      {[](auto& t) { t.elements[1].rigid = true; }, {"belt.rigid"}},
      {[](auto& t) { t.elements[1].diameter_m = 0.1; }, {"belt.diameter = 0.1"}},
      {[](auto& t) { t.inertias[4].shaft = "motor"; }, {"ratio of disc", "0.375", "same shaft line"}},
      {[](auto& t) { t.reference_shaft = "axle"; }, {"reference_shaft = \"axle\""}},
      {[](auto& t) { t.reference_speed_rad_s = 0; }, {"reference_speed = 0"}},
      {[](auto& t) { t.modal_damping_ratio = -1; }, {"modal_damping_ratio = -1"}},
      {[](auto& t) { t.elements.pop_back(); }, {"inertia disc", "two trains"}},
      {[](auto& t) {
         t.elements.push_back(t.elements[3]);
         t.elements[4].name = "again";
       },
       {"element again", "cycle"}},
      {[](auto& t) { t.excitations[0].name = "modal_damping"; }, {"modal_damping is taken"}},
      {[](auto& t) { t.excitations[0].inertia = "motor"; }, {"no inertia of that name"}},
      {[](auto& t) { t.excitations[0].constant_Nm = not_a_number; }, {"torque_on_rotor.constant = nan"}},
      {[](auto& t) { t.excitations[0].harmonics[0].order = 2; }, {"harmonic_1", "both given"}},
      {[](auto& t) { t.excitations[0].harmonics[0].frequency_rad_s = 0; }, {"harmonic_1.frequency = 0"}},
      {[](auto& t) {
         t.excitations[0].table.torque_Nm = {1, 2};
       },
       {"table", "both missing"}},
      {[](auto& t) {
         t.excitations[0].harmonics[0] = {1, std::nullopt, 1.0, "workng", 0};
       },
       {"order_of = \"workng\"", "did you mean working?"}},
  };
  for (const auto& mistake : mistakes) {
    auto train = trains::mok150("motor");
    mistake.make(train);
    expect_message(refusal([&] { forced_response(train); }), mistake.message_has);
  }
  EXPECT_EQ(refusal([] { forced_response(trains::mok150("motor")); }), "accepted");
}

TEST(TrainWrongInput, EffectsGridAndRanges) {
  const auto train = trains::mok150("motor");
  const auto loads = [&](const std::vector<std::string>& effects, kinetics::TimeGrid grid) {
    return refusal([&] { compute_loads(train, effects, grid); });
  };
  expect_message(loads({"torque_on_roter"}, {1, 12}), {"torque_on_roter", "did you mean torque_on_rotor?"});
  expect_message(loads({"modal_damping"}, {1, 12}), {"modal_damping", "none of that name"});
  expect_message(loads({"torque_on_disc", "torque_on_disc"}, {1, 12}), {"named twice"});
  expect_message(loads({}, {0, 12}), {"turns = 0"});
  expect_message(loads({}, {1, 3}), {"instants_per_turn = 3"});
  expect_message(refusal([&] { campbell_table(train, 10, 10, 5); }), {"fastest = 10", "slowest"});
  expect_message(refusal([&] { campbell_table(train, 0, 10, 1); }), {"n_speeds = 1"});
  expect_message(refusal([&] { campbell_table(train, 0, 10, 5, {-1}); }), {"orders = -1"});
}

TEST(TrainWrongInput, TransientRuns) {
  const auto run = [](const std::function<void(DriveTrain&, kinetics::TransientRun&)>& make) {
    auto train = trains::mok150("motor");
    kinetics::TransientRun wrong;
    wrong.time_step_s = 1e-4;
    wrong.n_steps = 3;
    make(train, wrong);
    return refusal([&] { transient(train, wrong); });
  };
  EXPECT_EQ(run([](auto&, auto&) {}), "accepted");
  expect_message(run([](auto&, auto& r) { r.time_step_s = 0; }), {"time_step_s = 0"});
  expect_message(run([](auto&, auto& r) { r.n_steps = 0; }), {"n_steps = 0"});
  expect_message(run([](auto&, auto& r) { r.store_every = 0; }), {"store_every = 0"});
  expect_message(run([](auto&, auto& r) { r.angle_rad = Eigen::Array2d(1, 2); }),
                 {"entries of angle = 2", "5"});
  expect_message(run([](auto& t, auto& r) {
                   t.inertias[0].held = true;
                   r.speed_rad_s = Eigen::ArrayXd::Ones(5);
                 }),
                 {"speed of rotor = 1", "held"});
  expect_message(run([](auto& t, auto&) { t.elements[1].loss_factor = 0.1; }),
                 {"loss_frequency = 0", "belt"});
  expect_message(run([](auto&, auto& r) {
                   r.loads = {{"disc", [](double) { return not_a_number; }}};
                 }),
                 {"torque at time_s = 0"});
  expect_message(refusal([] { kinetics::torque_table({0, 0}, {1, 2}); }), {"time_s = 0", "exceed"});
  expect_message(refusal([] { kinetics::torque_table({0}, {1, 2}); }), {"entries of time_s = 1"});
}

TEST(TrainWrongInput, PublishedTables) {
  auto train = trains::mok150("motor");
  train.excitations[1].harmonics[0].frequency_rad_s = 300;
  expect_message(refusal([&] { published_table_4(train); }), {"torque_on_disc", "one frequency"});
  train.excitations.clear();
  expect_message(refusal([&] { published_table_7(train); }), {"one harmonic at least"});
  train = trains::mok150("motor");
  train.elements[3].first = "driven_pulley";
  expect_message(refusal([&] { published_table_4(train); }), {"lower_half", "chain"});
}

// Each mistake must be refused with the parameter, its value and a way out.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/unit/kinetics/vibratory/machines.h"

namespace {

using kinetics::Convention;
using kinetics::VibratoryMill;

struct Mistake {
  std::function<void(VibratoryMill&)> make;
  std::vector<std::string> effects;
  std::vector<std::string> message_has;
};

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double infinite = std::numeric_limits<double>::infinity();

void unchanged(VibratoryMill&) {}
void published(VibratoryMill& mill) {
  mill.convention = Convention::published;
}

std::string refusal(const VibratoryMill& mill, const std::vector<std::string>& effects,
                    kinetics::TimeGrid grid = {1, 12}) {
  try {
    compute_loads(mill, effects, grid);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

void expect_refused(const Mistake& mistake) {
  auto mill = machines::laboratory();
  mistake.make(mill);
  const auto message = refusal(mill, mistake.effects);
  for (const auto& part : mistake.message_has)
    EXPECT_NE(message.find(part), std::string::npos) << "wanted: " << part << "\n   got: " << message;
}

}  // namespace

TEST(VibratoryWrongInput, Parameters) {
  const std::vector<Mistake> mistakes = {
      {[](auto& m) { m.eccentricity_m = -0.004; }, {}, {"eccentricity = -0.004", "must not be negative"}},
      {[](auto& m) { m.eccentricity_m = not_a_number; }, {}, {"eccentricity = nan", "finite"}},
      {[](auto& m) { m.speed_rad_s = 0; }, {}, {"speed = 0", "must be positive"}},
      {[](auto& m) { m.speed_rad_s = infinite; }, {}, {"speed = inf", "finite"}},
      {[](auto& m) { m.charge_relative_speed_rad_s = not_a_number; }, {}, {"charge_relative_speed = nan"}},
      {[](auto& m) { m.initial_angle_rad = infinite; }, {}, {"initial_angle = inf"}},
      {[](auto& m) { m.charge_initial_angle_rad = not_a_number; }, {}, {"charge_initial_angle = nan"}},
      {[](auto& m) { m.charge_offset_m = -1; }, {}, {"charge_offset = -1"}},
      {[](auto& m) { m.gravity_m_s2 = -9.81; }, {}, {"gravity = -9.81"}},
      {[](auto& m) { m.debalance_offset_m = not_a_number; }, {}, {"debalance_offset = nan"}},
      {[](auto& m) { m.chamber_centre_m.y() = not_a_number; }, {}, {"chamber_centre.y = nan"}},
      {[](auto& m) { m.structure_centre_m.x() = infinite; }, {}, {"structure_centre.x = inf"}},
      {[](auto& m) { m.structure_mass_kg = -1; }, {}, {"structure_mass = -1"}},
      {[](auto& m) { m.structure_mass_kg = 0; },
       {"structure_inertia"},
       {"structure_mass = 0", "structure_inertia"}},
      {[](auto& m) { m.exciter_mass_kg = 0; }, {"gravity_exciter"}, {"exciter_mass = 0"}},
      {[](auto& m) { m.charge_mass_kg = 0; }, {"charge_coriolis"}, {"charge_mass = 0", "charge_coriolis"}},
      {[](auto& m) { m.debalance_mass_kg = 0; }, {"debalance_inertia"}, {"debalance_mass = 0"}},
      {[](auto& m) { m.springs[1].stiffness_N_m.x() = -1; }, {}, {"spring_2.stiffness.x = -1"}},
      {[](auto& m) { m.springs[0].damping_N_s_m.y() = -2; }, {}, {"spring_1.damping.y = -2"}},
      {[](auto& m) { m.springs[0].position_m.x() = not_a_number; }, {}, {"spring_1.position.x = nan"}},
      {[](auto& m) { m.springs[0].preload_N = Eigen::Vector2d(not_a_number, 0); },
       {},
       {"spring_1.preload.x = nan"}},
      {[](auto& m) { m.springs.clear(); }, {"springs"}, {"springs: none given"}},
      {[](auto& m) { m.springs.clear(); }, {"spring_damping"}, {"spring_damping is on"}},
      {[](auto& m) { m.pitch_inertia_kg_m2 = 2.0; }, {"springs", "pitch"}, {"pitch_inertia = 2", "2.04"}},
      {[](auto& m) { m.pitch_inertia_kg_m2 = not_a_number; }, {}, {"pitch_inertia = nan"}},
  };
  for (const auto& mistake : mistakes) expect_refused(mistake);
}

TEST(VibratoryWrongInput, Effects) {
  const std::vector<Mistake> mistakes = {
      {unchanged, {"gravity_chrage"}, {"gravity_chrage: unknown", "did you mean gravity_charge?"}},
      {unchanged, {"springs", "springs"}, {"named twice"}},
      {unchanged, {"gravity_shaft"}, {"effect gravity_shaft", "mesh"}},
      {unchanged, {"shaft_inertia"}, {"effect shaft_inertia", "mesh"}},
      {unchanged, {"pitch_guide"}, {"effect pitch_guide", "moment_residual"}},
      {unchanged, {"springs", "charge_follows_pitch"}, {"charge_follows_pitch", "needs the effect pitch"}},
      {unchanged, {"charge_lag"}, {"charge_lag", "needs the effect charge_translation"}},
      {unchanged, {"structure_inertia", "pitch"}, {"effect pitch", "needs the effect springs"}},
      {published, {"structure_inertia"}, {"structure_inertia", "not part of the convention \"published\""}},
      {published, {"pitch"}, {"pitch", "consistent"}},
  };
  for (const auto& mistake : mistakes) expect_refused(mistake);
}

TEST(VibratoryWrongInput, ChargeLag) {
  const std::vector<std::string> on{"charge_translation", "charge_lag"};
  const std::vector<Mistake> mistakes = {
      {unchanged, on, {"both missing"}},
      {[](auto& m) {
         m.charge_lag = {0.1, 100.0};
       },
       on,
       {"both given"}},
      {[](auto& m) { m.charge_lag.loss_angle_rad = 1.6; }, on, {"loss_angle = 1.6", "pi/2"}},
      {[](auto& m) { m.charge_lag.loss_angle_rad = not_a_number; }, on, {"loss_angle = nan"}},
      {[](auto& m) { m.charge_lag.grinding_power_W = -5; }, on, {"grinding_power = -5"}},
      // m ecc^2 omega^3 = 1120.3 W
      {[](auto& m) { m.charge_lag.grinding_power_W = 1121; }, on, {"grinding_power = 1121", "1120.3"}},
      {[](auto& m) {
         m.eccentricity_m = 0;
         m.charge_lag.grinding_power_W = 1;
       },
       on,
       {"grinding_power = 1", "0 W"}},
  };
  for (const auto& mistake : mistakes) expect_refused(mistake);
  auto mill = machines::laboratory();
  mill.charge_lag.grinding_power_W = 1120;
  EXPECT_EQ(refusal(mill, on), "accepted");
}

TEST(VibratoryWrongInput, PublishedNeedsTwoSprings) {
  expect_refused({[](auto& m) {
                    published(m);
                    m.springs.pop_back();
                  },
                  {"springs"},
                  {"number of springs = 1", "exactly two"}});
  expect_refused({[](auto& m) {
                    published(m);
                    m.springs[0].position_m.x() = -0.46;
                  },
                  {"springs"},
                  {"QE + HE"}});
}

TEST(VibratoryWrongInput, Grid) {
  EXPECT_NE(refusal(machines::laboratory(), {}, {0, 12}).find("turns = 0"), std::string::npos);
  EXPECT_NE(refusal(machines::laboratory(), {}, {1, 3}).find("instants_per_turn = 3"), std::string::npos);
}

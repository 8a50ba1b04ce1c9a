// The laboratory mill against outputs of an independent program (tests/data/vibratory_mill_laboratory*.json):
// every number of every series except residuals, which are round-off, and nulls, where a quantity is
// undefined.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "kinetics/vibratory_effects/springs.h"
#include "kinetics/vibratory_mill.h"

namespace {

using Eigen::ArrayXd;
using Eigen::Vector2d;
using kinetics::Convention;
using kinetics::LoadHistory;
using Json = nlohmann::json;

// The outputs are printed with 12 significant digits, so a value deviates by 5e-12 of itself at most; what
// remains is our own round-off, which near a difference of large numbers is some 1e-14 of the maximum.
constexpr double tolerance = 1e-11;

Json read(const std::string& name) {
  std::ifstream file(std::string(SOURCE_DIR) + "/tests/data/" + name + ".json");
  EXPECT_TRUE(file) << name;
  return Json::parse(file);
}

Vector2d vector_of(const Json& pair) {
  return {pair[0].get<double>(), pair[1].get<double>()};
}

kinetics::VibratoryMill mill_of(const Json& in, Convention convention) {
  kinetics::VibratoryMill mill;
  mill.convention = convention;
  mill.gravity_m_s2 = in["g"];
  mill.eccentricity_m = in["ecc"];
  mill.speed_rad_s = in["omega_e"];
  mill.initial_angle_rad = in["phi0"];
  mill.charge_relative_speed_rad_s = in["omega_r"];
  mill.charge_initial_angle_rad = in["delta0"];
  mill.charge_offset_m = in["r"];
  mill.charge_mass_kg = in["m"];
  mill.structure_mass_kg = in["m1"];
  mill.exciter_mass_kg = in["m2"];
  mill.debalance_mass_kg = in["m3"];
  mill.debalance_offset_m = in["KE"];
  mill.chamber_centre_m = vector_of(in["c"]);
  mill.structure_centre_m = vector_of(in["l"]);
  mill.pitch_inertia_kg_m2 = in["I_E"];
  for (const Json& s : in["springs"])
    mill.springs.push_back(
        {vector_of(s["p"]), Vector2d(s["kx"], s["ky"]), Vector2d(s["cx"], s["cy"]), vector_of(s["preload"])});
  return mill;
}

struct Case {
  Json input, output;
  LoadHistory loads;
};

Case run(const std::string& file, Convention convention, const std::vector<std::string>& without) {
  const Json reference = read(file);
  const Json& in = reference["input"];
  std::vector<std::string> effects;
  for (const auto& info : kinetics::vibratory_mill_effects(convention))
    if (std::find(without.begin(), without.end(), info.name) == without.end()) effects.push_back(info.name);
  const kinetics::TimeGrid grid{in["turns"], in["samples_per_turn"]};
  return {in, reference["output"], kinetics::compute_loads(mill_of(in, convention), effects, grid)};
}

/// @param scale  what a deviation is judged by; zero: the reference's own maximum
void expect_series(const Json& reference, const ArrayXd& ours, const std::string& name, double scale = 0) {
  ASSERT_EQ(Eigen::Index(reference.size()), ours.size()) << name;
  if (scale == 0)
    for (const Json& value : reference)
      if (!value.is_null()) scale = std::max(scale, std::abs(value.get<double>()));
  double worst = 0;
  for (std::size_t i = 0; i < reference.size(); ++i)
    if (!reference[i].is_null())
      worst = std::max(worst, std::abs(reference[i].get<double>() - ours[Eigen::Index(i)]));
  EXPECT_LE(worst, tolerance * scale) << name;
  ::testing::Test::RecordProperty(name, std::to_string(scale > 0 ? worst / scale * 1e12 : 0) + "e-12");
}

void expect_contributions(const Json& reference, const LoadHistory& loads) {
  const auto& parts = loads.resultant("frame_bearings").contributions;
  EXPECT_EQ(reference.size(), parts.size());
  for (const auto& part : parts) {
    const std::string& effect = loads.effects[part.effect];
    const bool renamed = loads.convention == "published" && effect == "springs";
    const Json& expected = reference.at(renamed ? "spring_force" : effect);
    double scale = 1e-300;  // a force's smaller component is judged by the force
    for (const char* axis : {"fx", "fy"})
      for (const Json& value : expected[axis]) scale = std::max(scale, std::abs(value.get<double>()));
    // The reference lists the forces on the machine; the bearings' reaction to a force is its opposite.
    expect_series(expected["fx"], -part.load.row(0).transpose(), effect + ".fx", scale);
    expect_series(expected["fy"], -part.load.row(1).transpose(), effect + ".fy", scale);
  }
}

/// The reference lets the force of charge_follows_pitch do work at the charge's centre o; it acts at c, and
/// only with its work at c is the energy balanced over the period (the reference leaves 1.5 mW of 24 W). What
/// lies between the two: -F . (theta' z x r e(chi)), F = -m theta'' z x c.
ArrayXd follow_at_charge_W(const Json& in, const LoadHistory& loads) {
  if (std::find(loads.effects.begin(), loads.effects.end(), "charge_follows_pitch") == loads.effects.end())
    return ArrayXd::Zero(loads.n_instants());
  const ArrayXd &chi = loads.quantity("chi").values, &rate = loads.quantity("theta_dot").values,
                &acceleration = loads.quantity("theta_ddot").values;
  const Vector2d c = vector_of(in["c"]);
  const double m = in["m"], r = in["r"];
  const ArrayXd fx = m * acceleration * c.y(), fy = -m * acceleration * c.x();
  return -(fx * rate * r * chi.sin() + fy * rate * r * chi.cos());
}

void expect_consistent(const Case& c) {
  const LoadHistory& loads = c.loads;
  const Json& in = c.input;
  const Json& reference = c.output["consistent"];
  expect_series(c.output["t"], loads.time_s, "t");
  expect_series(c.output["phi"], loads.phi_rad, "phi");
  expect_series(c.output["chi"], loads.quantity("chi").values, "chi");
  for (const char* name : {"X_E", "Y_E", "R_E", "theta", "theta_dot", "theta_ddot", "T"})
    expect_series(reference[name], loads.quantity(name).values, name);
  expect_series(reference["B"]["fx"], loads.quantity("B_x").values, "B_x");
  expect_series(reference["B"]["fy"], loads.quantity("B_y").values, "B_y");
  for (std::size_t i = 0; i < reference["spring_forces"].size(); ++i) {
    const std::string name = "spring_" + std::to_string(i + 1);
    expect_series(reference["spring_forces"][i]["fx"], loads.quantity(name + ".fx").values, name + ".fx");
    expect_series(reference["spring_forces"][i]["fy"], loads.quantity(name + ".fy").values, name + ".fy");
  }
  expect_series(reference["charge_on_wall"]["fx"], loads.quantity("charge_on_wall.fx").values,
                "charge_on_wall.fx");
  expect_series(reference["charge_on_wall"]["fy"], loads.quantity("charge_on_wall.fy").values,
                "charge_on_wall.fy");
  expect_series(reference["charge_at"]["fx"], loads.quantity("charge_at.x").values, "charge_at.x");
  expect_series(reference["charge_at"]["fy"], loads.quantity("charge_at.y").values, "charge_at.y");
  expect_series(reference["power_drive"], loads.quantity("drive_power").values, "drive_power");
  expect_series(reference["power_charge"],
                loads.quantity("charge_power").values + follow_at_charge_W(in, loads), "charge_power");
  expect_series(reference["power_damping"], loads.quantity("damping_power").values, "damping_power");
  expect_series(reference["couple"], loads.quantity("couple").values, "couple");
  expect_contributions(reference["contributions"], loads);
}

}  // namespace

TEST(VibratoryReferenceOutputs, PitchStiffnessAndDamping) {
  const Json reference = read("vibratory_mill_laboratory");
  const auto mill = mill_of(reference["input"], Convention::consistent);
  const Json& output = reference["output"]["consistent"];
  EXPECT_NEAR(kinetics::vibratory::pitch_stiffness_Nm(mill.springs), output["k_theta"], tolerance * 7001.2);
  EXPECT_NEAR(kinetics::vibratory::pitch_damping_Nm_s(mill.springs), output["c_theta"], tolerance * 15.24);
}

TEST(VibratoryReferenceOutputs, Consistent) {
  expect_consistent(
      run("vibratory_mill_laboratory", Convention::consistent, {"charge_follows_pitch", "charge_lag"}));
}

TEST(VibratoryReferenceOutputs, ConsistentWithChargeThatFollowsPitch) {
  expect_consistent(run("vibratory_mill_laboratory_follow", Convention::consistent, {"charge_lag"}));
}

TEST(VibratoryReferenceOutputs, Published) {
  const Case c = run("vibratory_mill_laboratory", Convention::published, {});
  const Json& reference = c.output["published"];
  for (const char* name :
       {"X_E", "Y_E", "R_E", "spring_force", "spring_force_from_moments", "K_star", "a_n", "a_xi", "a_O"})
    expect_series(reference[name], c.loads.quantity(name).values, name);
  // K* beside its poles is some hundred times larger than in between: judge it there by itself as well.
  const ArrayXd& ours = c.loads.quantity("K_star").values;
  for (std::size_t i = 0; i < reference["K_star"].size(); ++i)
    if (!reference["K_star"][i].is_null()) {
      EXPECT_NEAR(reference["K_star"][i].get<double>() / ours[Eigen::Index(i)], 1, tolerance) << i;
    }
  expect_contributions(reference["contributions"], c.loads);
}

// The published form has lengths of its own; the machine's description must give the same ones.
TEST(VibratoryReferenceOutputs, PublishedLengthsAreThoseOfTheMachine) {
  const Json in = read("vibratory_mill_laboratory")["input"];
  const auto mill = mill_of(in, Convention::published);
  EXPECT_EQ(in["JE"].get<double>(), mill.chamber_centre_m.x());
  EXPECT_EQ(in["LE"].get<double>(), mill.structure_centre_m.x());
  EXPECT_EQ(in["QE"].get<double>(), mill.springs[0].position_m.x());
  EXPECT_EQ(in["HE"].get<double>(), mill.springs[1].position_m.x());
  EXPECT_EQ(in["k"].get<double>(), mill.springs[0].stiffness_N_m.y() + mill.springs[1].stiffness_N_m.y());
}

// The reference gives its preload as numbers; ours defaults to the static balance of the weights.
TEST(VibratoryReferenceOutputs, DefaultPreloadIsThatOfTheReference) {
  const Json in = read("vibratory_mill_laboratory")["input"];
  auto mill = mill_of(in, Convention::consistent);
  mill.eccentricity_m = 0;  // the springs then carry nothing but their preload
  for (auto& spring : mill.springs) spring.preload_N.reset();
  const auto loads = kinetics::compute_loads(
      mill, {"gravity_structure", "gravity_exciter", "gravity_charge", "springs"}, {1, 4});
  for (std::size_t i = 0; i < mill.springs.size(); ++i) {
    const auto& force = loads.resultant("spring_foot_" + std::to_string(i + 1)).total;
    const Vector2d printed = vector_of(in["springs"][i]["preload"]);
    EXPECT_EQ(force(0, 0), printed.x());
    EXPECT_NEAR(force(1, 0), printed.y(), 0.005) << "printed to 0.01 N";
    EXPECT_NEAR(force(1, 0), printed.y(), 1e-9) << "in fact these numbers are exact";
  }
}

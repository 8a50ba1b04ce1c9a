// Both parameter sets under all conventions against outputs of an independent program
// (tests/data/planetary_mill_*.json): every number but residuals, which are round-off.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinetics/planetary/hodograph.h"
#include "tests/verification/kinetics/planetary_sets.h"

namespace {

using Eigen::ArrayXd;
using kinetics::LoadHistory;
using kinetics::PlanetaryMill;
using planetary_sets::Json;

// The references print all digits; what is left is the round-off of two ways to write the same sums, 1e-15
// of a quantity's maximum, and that of sin(phi) where a quantity is a difference of larger ones.
constexpr double tolerance = 1e-13;

const double degree = std::acos(-1.0) / 180;

double scale_of(const Json& series) {
  double scale = 0;
  for (const Json& value : series) scale = std::max(scale, std::abs(value.get<double>()));
  return scale;
}

/// @param scale  what a deviation is judged by; zero: the reference's own maximum
void expect_series(const Json& reference, const ArrayXd& ours, const std::string& name, double scale = 0) {
  ASSERT_GT(reference.size(), 0u) << name;
  ASSERT_LE(Eigen::Index(reference.size()), ours.size() + 1) << name;
  if (scale == 0) scale = scale_of(reference);
  double worst = 0;
  for (std::size_t i = 0; i < reference.size(); ++i)  // the references repeat phi = 0 as 360 degrees
    worst = std::max(worst, std::abs(reference[i].get<double>() - ours[Eigen::Index(i) % ours.size()]));
  EXPECT_LE(worst, tolerance * scale) << name;
  ::testing::Test::RecordProperty(name, std::to_string(scale > 0 ? worst / scale * 1e15 : 0) + "e-15");
}

void expect_value(const Json& reference, double ours, const std::string& name, double scale = 0) {
  const double expected = reference.get<double>();
  EXPECT_NEAR(ours, expected, tolerance * (scale > 0 ? scale : std::abs(expected))) << name;
}

void expect_contributions(const Json& reference, const LoadHistory& loads) {
  const auto& parts = loads.resultant("axle").contributions;
  EXPECT_EQ(reference.size(), parts.size());
  for (const auto& part : parts) {
    const std::string& effect = loads.effects[part.effect];
    const Json& expected = reference.at(effect == "charge_offset" ? "charge_relative" : effect);
    const double scale = std::max(scale_of(expected["X"]), scale_of(expected["Y"]));
    expect_series(expected["X"], part.load.row(0).transpose(), effect + ".X", scale);
    expect_series(expected["Y"], -part.load.row(1).transpose(), effect + ".Y", scale);
  }
}

void expect_machine(const Json& reference, const PlanetaryMill& mill) {
  const auto g = kinetics::planetary_geometry(mill);
  const Json& geometry = reference["geometry"];
  expect_value(geometry["r_A"], g.drum_pulley_m, "r_A");
  expect_value(geometry["r_O"], g.central_pulley_m, "r_O");
  expect_value(geometry["l_OA"], g.carrier_m, "l_OA");
  expect_value(geometry["sin_beta"], g.belt_sine, "sin_beta");
  expect_value(geometry["omega_A"], g.drum_speed_ratio * mill.speed_rad_s, "omega_A");
  expect_value(geometry["omega_rel"], g.relative_speed_ratio * mill.speed_rad_s, "omega_rel");
  expect_value(geometry["c"], -1 / g.relative_speed_ratio, "c");
  // The instantaneous centre, which the machine itself never forms: l_AD = v_A / omega, (1).
  expect_value(geometry["l_AD"], g.carrier_m / std::abs(g.drum_speed_ratio), "l_AD");
  EXPECT_EQ(geometry["feasible_belt"].get<bool>(), std::abs(g.belt_sine) <= 1);
  EXPECT_EQ(geometry["feasible_pulleys"].get<bool>(), g.carrier_m >= g.drum_pulley_m + g.central_pulley_m);
  EXPECT_EQ(geometry["feasible_drums"].get<bool>(), g.carrier_m > mill.drum_radius_m);
  expect_value(reference["wrap_drum_pulley_deg"], g.wrap_rad / degree, "wrap");

  const auto c = kinetics::planetary_charge_body(mill);
  const Json& charge = reference["charge"];
  expect_value(charge["gamma_deg"], c.half_angle_rad / degree, "gamma");
  expect_value(charge["fill"], c.filling, "fill");
  expect_value(charge["m_C"], c.mass_kg, "m_C");
  expect_value(charge["l_AC"], c.centroid_m, "l_AC");
  expect_value(charge["q_C"], c.first_moment_kg_m, "q_C");
}

/// The paper's inertia forces from those on the axle.
void expect_inertia(const Json& phi, const LoadHistory& loads) {
  const auto& parts = loads.resultant("axle").contributions;
  expect_value(phi["Phi_A"], parts[0].load(0, 0), "Phi_A");
  expect_value(phi["Phi_Ce"], parts[1].load(0, 0), "Phi_Ce");
  expect_value(phi["Phi_Cr"], std::hypot(parts[2].load(0, 0), parts[2].load(1, 0)), "Phi_Cr");
}

void expect_harmonics(const Json& reference, const PlanetaryMill& mill) {
  std::vector<std::string> names;
  for (const auto& info : kinetics::planetary_mill_effects(mill.convention)) names.push_back(info.name);
  const auto h = kinetics::planetary::ellipse(kinetics::planetary::make_machine(mill), names);
  ASSERT_TRUE(h);
  const double scale = h->R_mean_N;
  const auto component = [&](const Json& expected, const auto& ours, const std::string& name) {
    expect_value(expected["mean"], ours.mean_N, name + ".mean", scale);
    expect_value(expected["c"], ours.cosine_N, name + ".c", scale);
    expect_value(expected["s"], ours.sine_N, name + ".s", scale);
  };
  component(reference["X"], h->X_A, "X");
  component(reference["Y"], h->Y_A, "Y");
  expect_value(reference["R"]["mean0"], h->R_mean_N, "R.mean0");
  expect_value(reference["R"]["amplitude1"], h->R_amplitude_N, "R.amplitude1", scale);
  const double phase_deg = std::fmod(h->R_phase_rad / degree + 360, 360);
  EXPECT_NEAR(phase_deg, reference["R"]["phi_max_deg"].get<double>(), 1e-9);
}

}  // namespace

TEST(PlanetaryReferenceOutputs, Figure3) {
  const Json reference = planetary_sets::read("planetary_mill_figure3")["figure_3"];
  ASSERT_EQ(reference.size(), 6u);
  for (const auto& [key, expected] : reference.items()) {
    SCOPED_TRACE(key);
    const auto convention = planetary_sets::convention_named(expected["convention"]);
    const PlanetaryMill mill = planetary_sets::mill_of(key.substr(0, 1), convention);
    const LoadHistory loads = planetary_sets::loads_of(mill, 36);
    EXPECT_EQ(loads.convention, expected["convention"]);
    expect_machine(expected, mill);
    expect_inertia(expected["Phi"], loads);
    expect_harmonics(expected["harmonics"], mill);
    ArrayXd degrees(37);
    degrees << loads.phi_rad / degree, 360;
    expect_series(expected["phi_deg"], degrees, "phi");
    const double scale_N = scale_of(expected["R_A"]);
    expect_series(expected["X_A"], loads.quantity("X_A").values, "X_A");
    expect_series(expected["Y_A"], loads.quantity("Y_A").values, "Y_A", scale_N);
    for (const char* name : {"R_A", "T1", "T2", "M_A"})
      expect_series(expected[name], loads.quantity(name).values, name);
    expect_contributions(expected["contributions"], loads);
    EXPECT_EQ(expected["belt_ok"].get<bool>(), loads.quantity("T2").values.minCoeff() > 0);
  }
}

TEST(PlanetaryReferenceOutputs, Sweeps) {
  const Json reference = planetary_sets::read("planetary_mill_sweeps");
  ASSERT_EQ(reference.size(), 6u);
  for (const auto& [key, figures] : reference.items()) {
    SCOPED_TRACE(key);
    const auto convention = planetary_sets::convention_named(key.substr(key.find('/') + 1));
    const PlanetaryMill mill = planetary_sets::mill_of(key.substr(0, 1), convention);
    expect_series(figures["fig3"]["R"], planetary_sets::loads_of(mill, 360).quantity("R_A").values, "fig3");
    for (const std::string figure : {"fig4", "fig5", "fig6", "fig7", "fig8"}) {
      const Json& x = figures[figure]["x"];
      ArrayXd R_N(Eigen::Index(x.size())), filling(Eigen::Index(x.size()));
      for (std::size_t i = 0; i < x.size(); ++i) {
        const auto at_x = planetary_sets::at_abscissa(mill, figure, x[i]);
        R_N[Eigen::Index(i)] = planetary_sets::R_A_N(at_x, 330);
        filling[Eigen::Index(i)] = kinetics::planetary_charge_body(at_x).filling;
      }
      expect_series(figures[figure]["R"], R_N, figure);
      if (figure == "fig5") expect_series(figures[figure]["fill"], filling, "fill");
    }
  }
}

// The specification's table, printed to 1e-9 N. Its first R_A has a wrong digit (...708651): the root of its
// own X_A and Y_A, and the reference file, say ...708751.
TEST(PlanetaryReferenceOutputs, PrintedTable) {
  struct Row {
    const char *set, *convention;
    double phi_deg, X_A, Y_A, R_A, T2;
  };
  const Row rows[] = {
      {"B", "consistent", 0, 78096.011161054, 5011.019543647, 78256.611708751, 15736.387414346},
      {"B", "consistent", 90, 76497.019963389, 3526.701358303, 76578.271629423, 15773.468000116},
      {"B", "consistent", 330, 78459.909498071, 4825.780348982, 78608.177401732, 15863.950884696},
      {"B", "as_published", 330, 77704.675034519, 1272.312003503, 77715.090555531, 16117.264224614},
      {"A", "as_plotted", 0, 67780.983602238, 44964.246927660, 81339.075725376, 30045.401385083},
      {"A", "consistent", 0, 67780.983602238, 44964.246927660, 81339.075725376, 30045.401385083},
      {"A", "as_plotted", 330, 68359.512559989, 44856.037305552, 81762.381571212, 30738.690255478},
  };
  for (const Row& row : rows) {
    SCOPED_TRACE(std::string(row.set) + " " + row.convention + " " + std::to_string(row.phi_deg));
    auto mill = planetary_sets::mill_of(row.set, planetary_sets::convention_named(row.convention));
    mill.initial_angle_rad = row.phi_deg * degree;
    const auto loads = planetary_sets::loads_of(mill, 4);
    const double print = 0.6e-9, round_off = 1e-14 * row.R_A;
    EXPECT_NEAR(loads.quantity("X_A").values[0], row.X_A, print + round_off);
    EXPECT_NEAR(loads.quantity("Y_A").values[0], row.Y_A, print + round_off);
    EXPECT_NEAR(loads.quantity("R_A").values[0], row.R_A, print + round_off);
    EXPECT_NEAR(loads.quantity("T2").values[0], row.T2, print + round_off);
  }
}

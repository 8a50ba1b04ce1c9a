// Which resonance margins a table shows, and that no number is told twice with two values.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "pipelines/judge/verdict/torsion_report.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/write/fields/train_fields.h"

using namespace pipelines;

namespace {

/// Two inertias of 1 kg m2 on 200 N m/rad: 20 rad/s; thirty weak orders of a slow shaft, one near the
/// resonance, and one strong line far from it.
Scene scene_of_many_orders() {
  kinetics::DriveTrain train;
  train.reference_shaft = "s";
  train.reference_speed_rad_s = 1;
  for (const char* name : {"left", "right"}) {
    kinetics::TrainInertia inertia;
    inertia.name = name, inertia.inertia_kg_m2 = 1, inertia.shaft = "s";
    train.inertias.push_back(inertia);
  }
  kinetics::TrainElement element;
  element.name = "joint", element.first = "left", element.second = "right";
  element.stiffness_N_m_rad = 200, element.loss_factor = 0.035;
  train.elements = {element};
  kinetics::TrainExcitation weak;
  weak.name = "weak", weak.inertia = "left";
  for (int order = 1; order <= 30; ++order)
    if (order != 20) weak.harmonics.push_back({1e-3, std::nullopt, double(order), "s", 0});
  kinetics::TrainExcitation strong;
  strong.name = "strong", strong.inertia = "left";
  strong.harmonics.push_back({50, 3.5, std::nullopt, "", 0});
  train.excitations = {weak, strong};
  Scene scene;
  scene.title = "two inertias";
  scene.machine = train;
  scene.effects = {"weak", "strong", "structural_damping"};
  scene.sampling = {2, 200};
  scene.torsion.fastest_rad_s = 2;
  return scene;
}

std::string printed(const Scene& scene, const TorsionReport& report, bool all) {
  std::ostringstream out;
  print_torsion(out, scene, report, all);
  return out.str();
}

int rows_with(const std::string& text, const std::string& word) {
  std::istringstream lines(
      text.substr(text.find("amplification"), text.find("crossings") - text.find("amplification")));
  int n = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.find(word) != std::string::npos) ++n;
  return n;
}

}  // namespace

// Orders 17 to 24 without 20 lie within 20 % of 20 rad/s (16 is 20 % below, to rounding); the strong line is
// felt far from it. Red if all 30 rows are there, or if the strong one is not.
TEST(TorsionMargins, TheTableShowsThoseThatMatter) {
  const auto scene = scene_of_many_orders();
  const auto report = report_torsion(scene, scene.machine);
  ASSERT_EQ(report.margins.size(), 30u);
  const auto few = printed(scene, report, false), all = printed(scene, report, true);
  EXPECT_EQ(rows_with(all, "weak, order"), 29) << all;
  EXPECT_GE(rows_with(few, "weak, order"), 7) << few;
  EXPECT_LE(rows_with(few, "weak, order"), 9) << few;
  EXPECT_EQ(rows_with(few, "strong"), 1) << few;
  EXPECT_NE(few.find("more, farther than 20 % from a natural frequency and below 5 % of every torque"),
            std::string::npos)
      << few;
  EXPECT_EQ(all.find("more, farther than"), std::string::npos) << all;
}

// The torque of one frequency alone is all of the torque; the amplification of table, JSON and warning is one
// number.
TEST(TorsionMargins, HaveTheShareOfTheTorqueAndOneAmplification) {
  auto scene = scene_of_many_orders();
  auto& train = std::get<kinetics::DriveTrain>(scene.machine);
  train.excitations[0].harmonics = {{1, 20.2, std::nullopt, "", 0}};
  train.excitations.pop_back();
  scene.effects = {"weak", "structural_damping"};
  const auto report = report_torsion(scene, scene.machine);
  ASSERT_EQ(report.margins.size(), 1u);
  EXPECT_NEAR(report.margins[0].torque_share, 1, 1e-6);
  const double expected = 1 / std::hypot(1.01 * 1.01 - 1, 0.035 * 1.01);
  EXPECT_NEAR(margins_json(report)[0]["amplification"].get<double>(), expected, 1e-9);
  const auto text = printed(scene, report, false);
  EXPECT_EQ(rows_with(text, "24.6"), 1) << text;
  ASSERT_FALSE(report.forced.warnings.empty());
  EXPECT_NE(report.forced.warnings[0].find("amplified up to 24.59 times"), std::string::npos)
      << report.forced.warnings[0];
}

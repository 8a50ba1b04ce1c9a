#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "pipelines/judge/analysis/crest_elsewhere.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/study/accuracy/cost_forecast.h"

using namespace pipelines;

// As of a chamber whose cells are a third of the scene's.
TEST(CostForecast, ColumnsOfLargeNumbersStayApart) {
  ModelForecast large;
  large.model = "even mesh, cells 1/3";
  large.n_dofs = 12'345'678'901;
  large.solve_s = large.superpose_s = large.gigabytes = 123'456;
  std::ostringstream out;
  print_models(out, {large});
  std::istringstream lines(out.str());
  std::string title, line;
  ASSERT_TRUE(std::getline(lines, title) && std::getline(lines, line));
  EXPECT_NE(line.find(" 12345678901 "), std::string::npos) << line;
  EXPECT_NE(line.find(" 1.2e+05      1.2e+05   1.2e+05  factorisation"), std::string::npos) << line;
  for (const char* column : {" solve s ", " superpose s ", " GB "})
    EXPECT_NE(title.find(column), std::string::npos) << title;
  EXPECT_EQ(title.find("GB") + 2, line.find("  factorisation"));
}

// Natural frequencies took up to 54 s and submodels 13 to 21, and no forecast named them.
TEST(CostForecast, NamesFrequenciesAndSubmodels) {
  auto scene = read_scene(std::string(SOURCE_DIR) + "/pipelines/scenes/load_table.toml");
  auto& body = scene.bodies.front();
  auto meshed = mesh_body(body, {});
  EXPECT_EQ(forecast_beside(body, meshed), "");
  body.natural_frequencies = 3;
  const auto text = forecast_beside(body, meshed);
  const std::string begin = "natural frequencies take about ";
  const auto at = text.find(begin);
  ASSERT_NE(at, std::string::npos) << text;
  EXPECT_GT(std::stod(text.substr(at + begin.size())), 1);
  meshed.mesh.hot_spots.resize(7);
  EXPECT_NE(forecast_beside(body, meshed).find("for each weld toe that may lead, of 7"), std::string::npos);
}

// A chamber's superposition took 1.7 s where 0.31 were forecast: its instants alone counted, not those
// between them at which all nodes are superposed once more.
TEST(CostForecast, SuperpositionCountsInstantsBetween) {
  ChannelHistory history;
  history.channels.resize(1);
  const auto n_with = [&](int n, double order) {
    history.values = (Eigen::ArrayXd::LinSpaced(n, 0, n - 1) * (2 * M_PI * order / n)).cos().transpose();
    return n_superposed(history);
  };
  EXPECT_EQ(n_with(240, 10), 240);        // 24 in a period
  EXPECT_EQ(n_with(240, 20), 240 + 480);  // twice as many
  history.passed_over = Eigen::ArrayXXd::Zero(1, 5);
  EXPECT_EQ(n_with(240, 20), 240 + 480 + 5);
}

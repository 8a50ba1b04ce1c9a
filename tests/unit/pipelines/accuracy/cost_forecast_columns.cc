#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "pipelines/accuracy/cost_forecast.h"

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

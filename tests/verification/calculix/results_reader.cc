/// The reader of .frd files, on files written by hand in the format of CalculiX 2.20.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/pipelines/examples/results_directory.h"
#include "tests/verification/calculix/calculix_results.h"

namespace {

const char* const displacements =
    " -4  DISP        4    1\n -5  D1          1    2    1    0\n -5  D2          1    2    2    0\n"
    " -5  D3          1    2    3    0\n -5  ALL         1    2    0    0    1ALL\n"
    " -1         1-1.00000E-05 2.00000E+00-3.00000E+00\n"
    " -1         3 4.00000E-05-5.00000E+00-6.00000E+00\n -3\n";
const char* const stresses =
    " -4  STRESS      6    1\n -5  SXX         1    4    1    1\n"
    " -1         1 1.00000E+00-2.00000E+00 3.00000E+00-4.00000E+00-5.00000E+00-6.00000E+00\n"
    " -1         3 7.00000E+00 0.00000E+00 0.00000E+00 0.00000E+00 0.00000E+00 8.00000E+00\n -3\n";

pipelines::CalculixResults read(const std::string& text, std::size_t n_nodes = 3) {
  const results_test::Directory directory;
  std::ofstream(directory / "x.frd") << "    1C\n" << text << " 9999\n";
  return pipelines::read_calculix_results(directory / "x.frd", n_nodes);
}

std::string refusal(const std::string& text, std::size_t n_nodes = 3) {
  try {
    read(text, n_nodes);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "read without an error";
}

}  // namespace

// Numbers that touch, a node without results, two steps.
TEST(CalculixResults, AreReadByColumns) {
  const std::string step = std::string(displacements) + stresses;
  const auto results = read(step + step);
  ASSERT_EQ(results.n_steps, 2u);
  const std::vector<double> u = {-1e-5, 2, -3, 0, 0, 0, 4e-5, -5, -6};
  const std::vector<double> s = {1, -2, 3, -4, -5, -6, 0, 0, 0, 0, 0, 0, 7, 0, 0, 0, 0, 8};
  ASSERT_EQ(results.displacement_m.size(), 18u);
  ASSERT_EQ(results.stress_Pa.size(), 36u);
  for (std::size_t i = 0; i < 18; ++i) EXPECT_EQ(results.displacement_m[i], u[i % 9]) << i;
  for (std::size_t i = 0; i < 36; ++i) EXPECT_EQ(results.stress_Pa[i], s[i % 18]) << i;
}

TEST(CalculixResults, RefusesWhatIsNotWhole) {
  const std::string u = displacements, s = stresses;
  EXPECT_NE(refusal("").find("0 steps"), std::string::npos) << refusal("");
  EXPECT_NE(refusal(u + s + u).find("2 steps with displacements, 1 with stresses"), std::string::npos);
  EXPECT_NE(refusal(u + s, 2).find("x.frd:8: node 3"), std::string::npos) << refusal(u + s, 2);
  EXPECT_NE(refusal(u + s.substr(0, s.size() - 4)).find("no row"), std::string::npos);
  EXPECT_NE(refusal(u.substr(0, u.size() - 20)).find("no row"), std::string::npos);
  EXPECT_THROW(pipelines::read_calculix_results("/nowhere.frd", 3), std::runtime_error);
}

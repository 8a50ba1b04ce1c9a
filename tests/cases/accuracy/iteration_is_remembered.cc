#include "tests/cases/program/program.h"

using namespace cases;

// Cells six times as long as wide in a nearly incompressible material: conjugate gradients stall. The next
// run has other loads and so has to solve anew, but not to find that out again.
TEST(Runs, DoNotRepeatAnIterationThatGaveUp) {
  const results_test::Directory directory;
  const auto scene = with_edits(results_test::bytes(fs::path(SOURCE_DIR) / "tests/benchmarks/shaft.toml"),
                                {{"poisson_ratio = 0.3", "poisson_ratio = 0.4999"},
                                 {"sectors = 16", "sectors = 8"},
                                 {"largest_cell = \"12 mm\"", "largest_cell = \"60 mm\""},
                                 {"growth = 0.5", "growth = 1.0"},
                                 {"[sampling]", "[results]\npictures = false\n\n[sampling]"},
                                 {"\n[shaft]\n", "\n[shaft]\nsolver = \"iterative\"\n"}});
  const auto solve = [&](const std::string& text) {
    write(directory / "shaft.toml", text);
    EXPECT_EQ(millstress(directory.path, "run shaft.toml --tolerance none -o out").exit_code, 0);
    return summary(directory / "out")["bodies"]["shaft"]["solver"];
  };
  const auto first = solve(scene);
  EXPECT_TRUE(first["gave_up"].get<bool>());
  EXPECT_NE(first["reason"].get<std::string>().find("the iteration stalled"), std::string::npos);
  EXPECT_GT(first["bytes"].get<double>(), 1e6);
  EXPECT_GT(first["predicted_bytes"].get<double>(), 1e6);
  const auto other_loads = with_edits(
      scene, {{"[sampling]",
               "[[machine.constants]]\neffect = \"drive\"\nload = \"gear_seat.torque\"\nvalue = \"1 N m\"\n\n"
               "[sampling]"}});
  const auto second = solve(other_loads);
  EXPECT_EQ(second["used"], "direct");
  EXPECT_NE(second["reason"].get<std::string>().find("given up on this mesh and material before"),
            std::string::npos)
      << second["reason"];
}

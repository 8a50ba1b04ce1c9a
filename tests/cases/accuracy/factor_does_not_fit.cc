#include "tests/cases/program/program.h"

using namespace cases;

// A long shaft of 99 k unknowns, cells stretched up to 1 : 26: its factor of 1.05 GB does not fit into 0.95
// GB, where the iteration finds the same stress.
TEST(Runs, IterateWhereTheFactorDoesNotFit) {
  const results_test::Directory directory;
  write(
      directory / "long.toml",
      with_edits(results_test::bytes(fs::path(SOURCE_DIR) / "tests/benchmarks/accuracy/torsion_fillet.toml"),
                 {{"length = \"80 mm\"", "length = \"400 mm\""}}));
  const auto shaft = [&](const std::string& limit, const std::string& files) {
    const auto run = millstress(directory.path, "run long.toml -o " + files, limit);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return summary(directory / files)["bodies"]["shaft"];
  };
  const auto factorised = shaft("true", "direct"), iterated = shaft("ulimit -d 950000", "iterated");
  EXPECT_EQ(factorised["solver"]["used"], "direct");
  EXPECT_EQ(iterated["solver"]["used"], "iterative");
  const auto reason = iterated["solver"]["reason"].get<std::string>();
  EXPECT_NE(reason.find("the factor does not fit into memory"), std::string::npos) << reason;
  const double expected = factorised["peak_von_mises"]["value"];
  // The iteration ends at a residual of 1e-10; ten times that, as between the solvers themselves.
  EXPECT_NEAR(iterated["peak_von_mises"]["value"].get<double>(), expected, 1e-9 * expected);
}

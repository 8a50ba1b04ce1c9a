/// Load tables through the load stage: resampling, harmonics, files as loggers write them.
#include <cmath>

#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

// What resampling adds is stated whether or not it is worth a warning.
TEST(LoadTables, LoadTableStatesItsResampling) {
  const results_test::Directory directory;
  const auto json = json_of(directory.path, "loads '" + shipped("load_table.toml").string() + "' --json");
  ASSERT_EQ(json["resampling"].size(), 3u);
  const auto& fx = json["resampling"]["belt/pulley_seat.fx"];
  EXPECT_NEAR(fx["largest"].get<double>(), 240.34, 0.05);
  EXPECT_EQ(fx["jump"].get<double>(), 0);
  EXPECT_GT(fx["between_samples"].get<double>(), 0);
  EXPECT_LT(fx["between_samples"].get<double>(), 0.01 * fx["largest"].get<double>());
}

// Red if the reader tries a table at fewer instants than the scene has: harmonics between would be refused.
TEST(LoadTables, ATableMayHaveHarmonicsUpToHalfTheInstants) {
  const results_test::Directory directory;
  const auto with_order = [&](int order) {
    write(directory / "scene.toml", small_shaft({{"pull", "middle.fy", "100 N", order}}));
    return millstress(directory.path, "loads scene.toml --json");
  };
  for (const int order : {4, 11}) {
    const auto outcome = with_order(order);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  const auto refused = with_order(12);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("has 24 instants per turn"), std::string::npos) << refused.err;
}

// A file as a logger writes it, titles named by the scene. At 960 rpm its 0.0625 s are one turn, and 25
// instants of it stand where the samples stand: 0, 4, 8 and 12. Values are those that the file has there. Red
// where columns are mistaken, commas or units are misread, or the resampling moves a sample.
TEST(LoadTables, ReadsALoggersFile) {
  const results_test::Directory directory;
  fs::copy_file(fs::path(SOURCE_DIR) / "tests/data/measured.csv", directory / "measured.csv");
  write(
      directory / "mill.toml",
      "effects = [\"belt\"]\n[machine]\ntype = \"load_table\"\nspeed = \"960 rpm\"\n[[machine.files]]\n"
      "effect = \"belt\"\nfile = \"measured.csv\"\ncolumns = { time = \"Zeit\", \"pulley.fx\" = \"Kraft X\", "
      "\"pulley.fy\" = \"Kraft Y\", \"roller.torque\" = \"Moment\" }\n[sampling]\ninstants_per_turn = 25\n");
  const auto run = millstress(directory.path, "loads mill.toml --csv loads.csv");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto loads = csv(directory / "loads.csv");
  struct Sample {
    std::size_t instant;
    double time_s, fx_N, fy_N, torque_Nm;
  };
  for (const auto& at : {Sample{0, 0, 0, 1000, 60}, Sample{4, 0.01, 700, 700, 62.5},
                         Sample{8, 0.02, 1000, 0, 58}, Sample{12, 0.03, 0, -1000, 60}}) {
    EXPECT_NEAR(loads.at("time")[at.instant], at.time_s, 1e-15);
    EXPECT_NEAR(loads.at("pulley.fx")[at.instant], at.fx_N, 1e-9);
    EXPECT_NEAR(loads.at("pulley.fy")[at.instant], at.fy_N, 1e-9);
    EXPECT_NEAR(loads.at("roller.torque")[at.instant], at.torque_Nm, 1e-9);
  }
  // Between two samples no value leaves them.
  for (const std::size_t instant : {5, 6, 7}) {
    EXPECT_GT(loads.at("pulley.fx")[instant], 700);
    EXPECT_LT(loads.at("pulley.fx")[instant], 1000);
  }
  const auto check = millstress(directory.path, "check mill.toml");
  EXPECT_NE((check.out + check.err)
                .find("measured.csv: ';' with decimal comma, units in row 2, 4 columns, 5 rows over "
                      "0.0625 s, uneven (steps of 0.01 to 0.0325 s); resampled to 25 instants"),
            std::string::npos)
      << check.out << check.err;
}

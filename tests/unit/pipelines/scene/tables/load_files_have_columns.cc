// Entries of [[machine.files]]: which title is which load, units, several turns.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/files/toml_tree.h"
#include "pipelines/scene/machines/load_table_reader.h"
#include "tests/unit/pipelines/examples/results_directory.h"

namespace {

using results_test::Directory;

constexpr double speed_rad_s = 32 * M_PI;  // 960 rpm: a turn takes 0.0625 s

struct Read {
  kinetics::LoadTable loads;
  std::string errors, warnings, text;
};

/// @param entry  keys of [[machine.files]] beside effect and file
Read read_loads(const std::string& log, const std::string& entry, int window_turns = 0) {
  const Directory directory;
  std::ofstream(directory / "log.csv", std::ios::binary) << log;
  const auto tree = pipelines::parse_toml(
      "type = \"load_table\"\nspeed = \"960 rpm\"\n[[files]]\neffect = "
      "\"belt\"\nfile = \"log.csv\"\n" +
      entry);
  pipelines::SceneFindings findings;
  findings.file = "scene.toml";
  pipelines::SceneTable machine(tree, "machine", findings);
  machine.know("type");
  Read read;
  read.loads = pipelines::read_load_table(machine, directory.path, window_turns, findings);
  for (const auto& error : findings.errors) read.errors += error.text() + "\n";
  for (const auto& warning : findings.warnings) read.warnings += warning + "\n";
  for (const auto& samples : pipelines::samples_read(read.loads, {1, 120}))
    read.text += samples.text() + "\n";
  return read;
}

const kinetics::SampledCourse& course(const Read& read, std::size_t i) {
  return std::get<kinetics::SampledCourse>(read.loads.loads.at(i).course);
}

bool tells_of(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

std::string measured() {
  std::ifstream in(std::string(SOURCE_DIR) + "/tests/data/measured.csv", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

const std::string header_map =
    "columns = { time = \"Zeit\", \"pulley.fx\" = \"Kraft X\", \"roller.torque\" = \"Moment\" }\n";

/// fx = first + turn x rise + cos(phi), eight samples in a turn.
std::string turns_of(double n_turns, double rise) {
  std::string text = "Zeit;Kraft X\ns;kN\n";
  for (int i = 0; i / 8.0 < n_turns - 1e-9; ++i) {
    char row[80];
    std::snprintf(row, sizeof row, "%.9f;%.9f\n", 0.0625 * i / 8, rise * (i / 8) + std::cos(M_PI * i / 4));
    text += row;
  }
  return text;
}

const std::string fx = "columns = { time = \"Zeit\", \"pulley.fx\" = \"Kraft X\" }\n";

}  // namespace

TEST(LoadFiles, HaveColumnsThatTheSceneNames) {
  const auto read = read_loads(measured(), header_map);
  ASSERT_EQ(read.errors, "");
  ASSERT_EQ(read.loads.loads.size(), 2u);
  EXPECT_EQ(read.loads.loads[0].port + "." + read.loads.loads[0].component, "pulley.fx");
  EXPECT_EQ(read.loads.loads[1].port + "." + read.loads.loads[1].component, "roller.torque");
  ASSERT_EQ(course(read, 0).angle_rad.size(), 5);
  EXPECT_NEAR(course(read, 0).angle_rad[1], 0.01 * speed_rad_s, 1e-12);
  EXPECT_NEAR(course(read, 0).angle_rad[4], 2 * M_PI, 1e-12);
  EXPECT_EQ(course(read, 0).values[2], 1000);
  EXPECT_EQ(course(read, 1).values[1], 62.5);
  EXPECT_EQ(read.text,
            "belt: 5 rows over the drive's angle from 0 to 360 deg; log.csv: ';' with decimal comma, units "
            "in row 2, "
            "3 of 4 columns (not used: Kraft Y), 5 rows over 0.0625 s, uneven (steps of 0.01 to 0.0325 s); "
            "resampled to 120 instants\n");
  // The same without quotes round "pulley.fx", with units, and by number.
  for (const std::string other : {"columns.time = \"Zeit\"\ncolumns.pulley.fx = \"Kraft X\"\n",
                                  "columns = { time = \"#1\", \"pulley.fx\" = \"#2\" }\n"})
    EXPECT_EQ(course(read_loads(measured(), other), 0).values[2], 1000) << other;
}

TEST(LoadFiles, UnitsAreConverted) {
  const auto value = [](const std::string& log, const std::string& columns) {
    const auto read = read_loads(log, columns);
    EXPECT_EQ(read.errors, "");
    return read.loads.loads.empty() ? NAN : course(read, 0).values[1];
  };
  const std::string rows = "\n0;0\n10;2,5\n20;3\n40;1\n62,5;0\n";
  for (const std::string titles :
       {"Zeit [ms];Kraft X [kN]", "Zeit (ms);Kraft X (kN)", "Zeit / ms;Kraft X / kN", "Zeit_ms;Kraft X_kN",
        "Zeit;Kraft X\nms;kN", "Zeit;Kraft X\n[ms];[kN]"}) {
    EXPECT_EQ(value(titles + rows, fx), 2500) << titles;
    EXPECT_NEAR(course(read_loads(titles + rows, fx), 0).angle_rad[1], 0.01 * speed_rad_s, 1e-12) << titles;
  }
  EXPECT_EQ(
      value("Zeit [ms];Kraft X" + rows, "columns = { time = \"Zeit\", \"pulley.fx\" = \"Kraft X [kN]\" }\n"),
      2500);
  EXPECT_EQ(value("time_ms;pulley.fx_kN" + rows, ""), 2500);
  EXPECT_EQ(value("time (ms);pulley.fx / kN" + rows, ""), 2500);
  EXPECT_EQ(value("angle;pulley.fx [N]\nGrad;\n0;0\n90;7\n180;0\n270;0\n", ""), 7);
  // Without a unit a bare number is SI, as in a scene; it is told.
  const auto bare = read_loads("Zeit [ms];Kraft X" + rows, fx);
  EXPECT_EQ(course(bare, 0).values[1], 2.5);
  EXPECT_TRUE(tells_of(bare.warnings, "log.csv:1:11: Kraft X has no unit and is taken in N"))
      << bare.warnings;
}

TEST(LoadFiles, AreRefusedWithTheirTitles) {
  const auto errors = [](const std::string& log, const std::string& entry) {
    return read_loads(log, entry).errors;
  };
  const auto missing = errors(measured(), "columns = { time = \"Zeit\", \"pulley.fx\" = \"Kraft Z\" }\n");
  EXPECT_TRUE(tells_of(
      missing,
      "scene.toml:6:42: machine.files[1].columns.pulley.fx = \"Kraft Z\": is no title in log.csv; did "
      "you mean \"Kraft X\"? Its titles, in line 1, are: Zeit, Kraft X, Kraft Y, Moment"))
      << missing;
  EXPECT_TRUE(tells_of(errors(measured(), "columns = { \"pulley.fx\" = \"Kraft X\" }\n"),
                       "has neither time nor angle"));
  EXPECT_TRUE(
      tells_of(errors(measured(), "columns = { time = \"Zeit\" }\n"), "has no load; add one such as"));
  EXPECT_TRUE(tells_of(errors(measured(), "columns = { time = \"Zeit\", \"pulley.fu\" = \"Kraft X\" }\n"),
                       "the key pulley.fu is no load"));
  EXPECT_TRUE(tells_of(errors(measured(), ""), "the first column must be \"time [s]\" or \"angle [deg]\""));
  EXPECT_TRUE(tells_of(
      errors("Zeit;F [Nm]\ns;\n0;1\n1;1\n2;2\n3;1\n", "columns = { time = \"Zeit\", \"p.fx\" = \"F\" }\n"),
      "log.csv:1:6: F = Nm: \"Nm\" is no unit of this quantity (SI unit N)"));
  EXPECT_TRUE(tells_of(
      errors("Zeit;F\ns;Nx\n0;1\n1;1\n2;2\n3;1\n", "columns = { time = \"Zeit\", \"p.fx\" = \"F\" }\n"),
      "log.csv:2:6: F = Nx: has an unknown unit \"Nx\""));
  EXPECT_TRUE(tells_of(
      errors("Zeit;F;F\n0;1;2\n1;1;2\n2;2;2\n3;1;2\n", "columns = { time = \"Zeit\", \"p.fx\" = \"F\" }\n"),
      "is the title of 2 columns of log.csv; write the number of the one that is meant, such as \"#2\""));
  EXPECT_TRUE(
      tells_of(errors(measured(), "delimiter = \"|\"\n"), "is none of \";\", \",\", \"tab\", \"blanks\""));
}

// Other columns may hold what they like.
TEST(LoadFiles, ReadTheColumnsThatAreUsed) {
  const auto read = read_loads(
      "Datum;Zeit;Status;Kraft X\n;s;;N\n01.02.2026;0;ok;1\n01.02.2026;0,02;;2\n;0,04;--;3\n;0,05;x;1,5\n",
      fx);
  ASSERT_EQ(read.errors, "");
  EXPECT_EQ(course(read, 0).values[3], 1.5);
  EXPECT_TRUE(tells_of(read.text, "2 of 4 columns (not used: Datum, Status)")) << read.text;
}

TEST(LoadFiles, OfSeveralTurnsAskForAChoice) {
  const auto asked = read_loads(turns_of(3, 0.3), fx);
  EXPECT_TRUE(tells_of(asked.errors,
                       "machine.files[1].file = \"log.csv\": has samples over 2.875 turns of the drive, of "
                       "0.0625 s each, and the window has 1"))
      << asked.errors;
  EXPECT_TRUE(tells_of(asked.errors, "turns = \"average\""));
  // A window of three turns takes them without a word, as ever.
  EXPECT_EQ(read_loads(turns_of(3, 0.3), fx, 3).errors, "");
  const auto as_they_are = read_loads(turns_of(3, 0.3), fx + "turns = \"as they are\"\n");
  EXPECT_EQ(as_they_are.errors, "");
  EXPECT_EQ(as_they_are.loads.turns, 3);
  EXPECT_EQ(course(as_they_are, 0).values.size(), 24);
  EXPECT_TRUE(
      tells_of(read_loads(turns_of(2.4, 0), fx + "turns = \"as they are\"\n").errors, "no whole number"));
}

TEST(LoadFiles, AreAveragedOverTheirTurns) {
  // 0, 0.3 and 0.6 above the cosine: 0.3 in the mean. A fourth turn that is not whole is left out.
  for (const double n_turns : {3.0, 3.4}) {
    const auto read = read_loads(turns_of(n_turns, 0.3), fx + "turns = \"average\"\n");
    ASSERT_EQ(read.errors, "");
    ASSERT_EQ(course(read, 0).values.size(), 8);
    for (int i = 0; i < 8; ++i) {
      EXPECT_NEAR(course(read, 0).angle_rad[i], M_PI * i / 4, 1e-6);
      EXPECT_NEAR(course(read, 0).values[i], 1000 * (0.3 + std::cos(M_PI * i / 4)), 1e-3);  // nine digits
    }
    EXPECT_TRUE(tells_of(read.text, "mean of 3 turns")) << read.text;
    EXPECT_TRUE(tells_of(read.warnings, "the mean of 3 turns is")) << read.warnings;  // 1.3 kN of 1.6
  }
  const auto window = read_loads(turns_of(3, 0.3), fx + "turns = \"average\"\n", 2);
  ASSERT_EQ(course(window, 0).values.size(), 16);
  EXPECT_NEAR(course(window, 0).angle_rad[9], 2.25 * M_PI, 1e-6);
  EXPECT_EQ(course(window, 0).values[9], course(window, 0).values[1]);
  EXPECT_TRUE(
      tells_of(read_loads(turns_of(0.5, 0), fx + "turns = \"average\"\n").errors, "not one whole turn"));
}

TEST(LoadFiles, ThatCoverTooLittleAreRefused) {
  const auto read = read_loads(turns_of(0.5, 0), fx);
  EXPECT_TRUE(
      tells_of(read.errors,
               "has samples over 0.375 turns of the drive, of 0.0625 s each, and the window has 1: check "
               "machine.speed"))
      << read.errors;
}

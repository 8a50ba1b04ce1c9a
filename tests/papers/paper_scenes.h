/// What the program says of a shipped scene.
#pragma once

#include "tests/cases/program/program.h"

namespace papers {

using Columns = std::map<std::string, std::vector<double>>;

/// The loads of a scene in pipelines/scenes, with further options; in SI.
inline Columns loads_of(const std::string& scene, const std::string& options = "") {
  const results_test::Directory directory;
  const auto run = cases::millstress(
      directory.path, "loads '" + cases::shipped(scene).string() + "' --csv loads.csv " + options);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return cases::csv_in_si(directory / "loads.csv");
}

}  // namespace papers

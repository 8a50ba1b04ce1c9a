/// The exported cards, read by CalculiX: what it applies is what the load stage computed.
#include <algorithm>
#include <cmath>

#include "tests/cases/program/program.h"
#include "tests/unit/pipelines/examples/tools.h"

using namespace cases;

namespace {

/// A unit cube from node `first` on, clamped below; its upper face is a rigid body with a reference node for
/// forces and a rotation node for moments.
std::string cube(int first, double x, int reference) {
  std::ostringstream text;
  const double corners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  text << "*NODE, NSET=NALL\n";
  for (int i = 0; i < 8; ++i)
    text << first + i << ", " << x + corners[i][0] << ", " << corners[i][1] << ", " << corners[i][2] << "\n";
  for (int i = 0; i < 2; ++i) text << reference + i << ", " << x + 0.5 << ", 0.5, 1\n";
  text << "*ELEMENT, TYPE=C3D8, ELSET=EALL\n" << first;
  for (int i = 0; i < 8; ++i) text << ", " << first + i;
  text << "\n*NSET, NSET=TOP" << first << "\n";
  for (int i = 4; i < 8; ++i) text << first + i << (i < 7 ? ", " : "\n");
  text << "*NSET, NSET=CLAMPED\n";
  for (int i = 0; i < 4; ++i) text << first + i << (i < 3 ? ", " : "\n");
  text << "*RIGID BODY, NSET=TOP" << first << ", REF NODE=" << reference << ", ROT NODE=" << reference + 1
       << "\n";
  return text.str();
}

/// A static step (geometrically nonlinear, or CalculiX would jump to its end) follows the loads over one
/// period; CalculiX prints the reaction of all that is clamped. One cube per port: CalculiX takes no two
/// amplitudes on one node.
std::string model(double period_s, double step_s) {
  std::ostringstream text;
  text.precision(15);
  text << cube(1, 0, 100) << cube(11, 3, 200);
  text << "*NSET, NSET=N_PULLEY_SEAT\n100\n*NSET, NSET=N_PULLEY_SEAT_ROT\n101\n"
          "*NSET, NSET=N_DISC_SEAT\n200\n"
          "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1E11, 0.3\n*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL\n"
          "*BOUNDARY\nCLAMPED, 1, 3\n*INCLUDE, INPUT=cards_amplitudes.inp\n"
          "*STEP, NLGEOM, INC=10000\n*STATIC, DIRECT\n"
       << step_s << ", " << period_s
       << "\n*INCLUDE, INPUT=cards_loads.inp\n*NODE PRINT, NSET=CLAMPED\nRF\n*END STEP\n";
  return text.str();
}

struct Reactions {
  double time_s = 0, fx = 0, fy = 0, fz = 0;
  double torque = 0;  ///< of the pulley's cube about its axis
};

/// Reactions per increment from CalculiX's .dat file, whose rows are node, fx, fy, fz.
std::vector<Reactions> reactions(const fs::path& dat) {
  std::ifstream in(dat);
  std::vector<Reactions> rows;
  for (std::string line; std::getline(in, line);) {
    const auto at = line.find("and time");
    if (at != std::string::npos) rows.push_back({std::strtod(line.c_str() + at + 8, nullptr)});
    std::istringstream numbers(line);
    int node;
    double fx, fy, fz;
    if (rows.empty() || !(numbers >> node >> fx >> fy >> fz)) continue;
    Reactions& sum = rows.back();
    sum.fx += fx;
    sum.fy += fy;
    sum.fz += fz;
    if (node > 4) continue;
    const double x = node == 2 || node == 3 ? 0.5 : -0.5, y = node > 2 ? 0.5 : -0.5;
    sum.torque += x * fy - y * fx;
  }
  return rows;
}

}  // namespace

TEST(CalculixCards, AreAppliedAsComputed) {
  SKIP_WITHOUT("ccx");
  const results_test::Directory directory;
  std::string scene =
      edited("load_table.toml",
             {{"instants_per_turn = 360", "instants_per_turn = 24"},
              {"file = \"belt_pull.csv\"", "file = \"" + shipped("belt_pull.csv").string() + "\""}});
  write(directory / "table.toml", scene);
  const auto run = millstress(directory.path, "loads table.toml --csv loads.csv --calculix cards");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto loads = csv(directory / "loads.csv");
  const double step_s = loads.at("time")[1];
  write(directory / "cube.inp", model(24 * step_s, step_s));
  const std::string ccx = "cd '" + directory.path.string() + "' && ccx -i cube > ccx.log 2>&1";
  ASSERT_EQ(std::system(ccx.c_str()), 0) << results_test::bytes(directory / "ccx.log");

  const auto found = reactions(directory / "cube.dat");
  ASSERT_EQ(found.size(), 24u) << results_test::bytes(directory / "cube.dat");
  double largest = 0;
  for (std::size_t i = 0; i < 24; ++i) {
    const std::size_t instant = (i + 1) % 24;  // increments end at the instants; the last closes the period
    EXPECT_NEAR(found[i].time_s, double(i + 1) * step_s, 1e-6 * step_s * 24);
    const double fx = loads.at("pulley_seat.fx")[instant] + loads.at("disc_seat.fx")[instant];
    const double fy = loads.at("pulley_seat.fy")[instant] + loads.at("disc_seat.fy")[instant];
    // CalculiX prints seven digits; the forces of single nodes reach 2 kN.
    EXPECT_NEAR(found[i].fx, -fx, 1e-2) << i;
    EXPECT_NEAR(found[i].fy, -fy, 1e-2) << i;
    EXPECT_NEAR(found[i].fz, 118, 1e-2) << i;
    EXPECT_NEAR(found[i].torque, -loads.at("pulley_seat.torque")[instant], 1e-2) << i;
    largest = std::max(largest, std::abs(fx));
  }
  EXPECT_GT(largest, 900);
}

// CalculiX itself solves such a model in tests/verification/calculix.
TEST(CalculixModel, HasAStepForEveryChannel) {
  const results_test::Directory directory;
  write(directory / "shaft.toml",
        with_edits(results_test::bytes(fs::path(SOURCE_DIR) / "tests/benchmarks/shaft.toml"),
                   {{"sectors = 16", "sectors = 8"}, {"\"12 mm\"", "\"24 mm\""}}));
  const auto run = millstress(directory.path, "calculix shaft.toml -o out");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto check = millstress(directory.path, "check -v shaft.toml");
  const std::string model = results_test::bytes(directory / "out/shaft.inp");
  EXPECT_NE(model.find("TYPE=C3D20,"), std::string::npos);
  int n_steps = 0;
  std::istringstream lines(check.out.substr(check.out.find(" channels\n")));
  for (std::string line; std::getline(lines, line);) {
    const auto name = line.find("shaft/");
    if (name == std::string::npos) continue;
    const auto channel = line.substr(name + 6, line.find(" [") - name - 6);
    EXPECT_NE(model.find("** " + channel + " = 1\n*STEP\n"), std::string::npos) << channel;
    ++n_steps;
  }
  EXPECT_EQ(n_steps, 12);
}

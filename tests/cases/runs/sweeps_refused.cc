/// Sweeps, and points of them, that cannot be computed: what is told, and what is kept.
#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"
#include "tests/cases/program/swept_points.h"

using namespace cases;

TEST(Sweeps, OneRefusedPointIsToldAndKept) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  const auto points =
      points_of(directory.path, "mill.toml --loads --vary 'machine.charge.mass = 20 kg, -1 kg, 15 kg'");
  ASSERT_EQ(points.size(), 3u);
  EXPECT_TRUE(points[0].contains("figures"));
  EXPECT_NE(points[1]["refused"].get<std::string>().find("machine.charge.mass"), std::string::npos);
  EXPECT_TRUE(points[2].contains("figures"));
}

// Red if a point of a load stage alone skips what the scene's reader finds by computing loads: which key it
// is, and loads that are no force.
TEST(Sweeps, RefuseAPointAsLoadsDoes) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  for (const char* setting : {"machine.springs[2]=removed", "bearings[1].load=no_such"}) {
    const std::string key(setting, std::string(setting).find('=')), value = setting + key.size() + 1;
    const auto points =
        points_of(directory.path, "mill.toml --loads --vary '" + key + " = kept, " + value + "'");
    const auto alone = as_a_user(directory.path, "loads mill.toml --set '" + std::string(setting) + "'");
    ASSERT_EQ(points.size(), 2u);
    EXPECT_TRUE(points[0].contains("figures"));
    EXPECT_EQ(alone.exit_code, 2) << setting;
    const std::string refused = points[1].value("refused", "");
    EXPECT_FALSE(refused.empty()) << setting;
    EXPECT_NE(alone.err.find(refused), std::string::npos) << refused << "\n" << alone.err;
    EXPECT_FALSE(points[1].contains("figures"));
  }
}

// The chamber of the first point cannot be meshed; the shaft, whose mesh the second point shares, is not to
// blame.
TEST(Sweeps, OneRefusedMeshIsNoFaultOfOthers) {
  const results_test::Directory directory;
  write(directory / "open.toml",
        without("vibratory_mill.toml", "[machine.structure]           # the chamber and what is fixed to it",
                "[machine.debalance]           # the counterweights on the shaft, both together"));
  const auto points =
      points_of(directory.path, "open.toml --loads --vary 'chamber.mesh.min_scaled_jacobian = 0.9, 0.3'");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_NE(points[0].value("refused", "").find("Jacobian"), std::string::npos) << points[0];
  EXPECT_GT(figure(points[1], "loads.R_E.max"), 1000);
  const auto none = as_a_user(
      directory.path, "sweep open.toml --loads -o none --vary 'chamber.mesh.min_scaled_jacobian = 0.9'");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("no point could be computed"), std::string::npos) << none.err;
}

// A body that only some points have ended the program, or left the others without a figure and without a
// word.
TEST(Sweeps, PointsWithOtherBodiesAreRefused) {
  const results_test::Directory directory;
  write(directory / "bar.toml",
        "method = \"axisymmetric\"\n" +
            small_shaft(fixed_in_space("pull", "middle", "100 N"), "mm", "600 rpm", ""));
  for (const auto* order : {"kept, removed", "removed, kept"}) {
    const auto points =
        points_of(directory.path, std::string("bar.toml --fresh --vary 'shaft = ") + order + "'");
    ASSERT_EQ(points.size(), 2u);
    EXPECT_FALSE(points[0].contains("refused")) << points[0];
    EXPECT_NE(points[1].value("refused", "").find("sweep points of other bodies apart"), std::string::npos)
        << points[1];
  }
}

TEST(Sweeps, ThatCannotBeMadeAreRefusedAtOnce) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  for (const auto& [arguments, said] :
       {std::pair<std::string, std::string>{"", "nothing is varied"},
        {"--vary 'machine.drive.sped = 1, 2'", "unknown key; did you mean \"speed\"?"},
        {"--vary 'machine.drive.speed = 1..2 rpm'", "how many values"},
        {"--vary 'machine.drive.speed = 1, 2 rpm' --design best", "is no design"},
        {"--vary 'shaft.fatigue.roughness = 6, 25 um'", "judges no fatigue"},
        {"--vary 'duty[1].share = 10, 20 %'", "no operating blocks"},
        {"--vary 'tolerance = 1, 5 %'", "all have one tolerance"},
        {"--vary 'time_limit = 1, 5 s'", "one time limit"},
        {"--vary 'title = a, b'", "no figure of a sweep depends"},
        {"--vary 'results.snapshots = 1, 2'", "no figure of a sweep depends"},
        {"--loads --vary 'method = beam, solid'", "no figure of loads depends"},
        {"--vary 'zones.level = \"50 % of peak\", \"30 % of peak\"'", "add --zones"},
        {"--vary 'machine.drive.speed = 1200, 1300 rpm' --loads --figure nothing", "has no such figure"},
        {"--vary 'effects.gravty_charge = off, off'", "effects does not have it"}}) {
    const auto outcome = as_a_user(directory.path, "sweep mill.toml " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  }
}

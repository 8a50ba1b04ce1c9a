#include <algorithm>

#include "tests/cases/program/program.h"

using namespace cases;

// A line, a VTU and, where the machine can draw, a picture for each body; nothing is solved.
TEST(PortPictures, OfEveryBodyOfAScene) {
  const results_test::Directory directory;
  write(directory / "mill.toml", edited("vibratory_mill.toml", coarse()));
  const auto run = millstress(directory.path, "ports mill.toml");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 2) << run.out;
  EXPECT_EQ(run.out.rfind("shaft: 8 ports, results/mill/shaft/ports.vtu", 0), 0u) << run.out;
  EXPECT_NE(run.out.find("\nchamber: 5 ports, results/mill/chamber/ports.vtu"), std::string::npos) << run.out;
  const bool draws = run.err.find("no picture") == std::string::npos;
  for (const char* body : {"shaft", "chamber"}) {
    EXPECT_TRUE(fs::exists(directory / "results/mill" / body / "ports.vtu"));
    EXPECT_EQ(fs::exists(directory / "results/mill" / body / "ports.png"), draws);
  }
  EXPECT_EQ(contents(directory / "results").size(), draws ? 5u : 3u);  // with the manifest
}

// The surface needs no EGL; that it is missing is said.
TEST(PortPictures, WithoutEglLeaveTheSurface) {
  const results_test::Directory directory;
  ASSERT_EQ(setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere", 1), 0);
  const auto run = millstress(directory.path, "ports '" + shipped("stub_axle.toml").string() + "' -o out");
  unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("no picture"), std::string::npos) << run.err;
  EXPECT_TRUE(fs::exists(directory / "out/axle/ports.vtu"));
  EXPECT_FALSE(fs::exists(directory / "out/axle/ports.png"));
}

// A key, a shape that the mesher refuses, a scene without a body: exit code 2, no file.
TEST(PortPictures, OfAWrongSceneLeaveNothing) {
  const results_test::Directory directory;
  const std::vector<std::string> wrong{
      edited("vibratory_mill.toml", coarse() + Edits{{"mass = \"20 kg\"", "mass = \"-20 kg\""}}),
      edited("vibratory_mill.toml", coarse() + Edits{{"wall = \"12 mm\"", "wall = \"60 mm\""}}),
      results_test::bytes(shipped("drive_train.toml"))};
  for (const auto& text : wrong) {
    write(directory / "mill.toml", text);
    const auto run = millstress(directory.path, "ports mill.toml -o out");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_NE(run.err, "");
    EXPECT_FALSE(fs::exists(directory / "out"));
  }
}

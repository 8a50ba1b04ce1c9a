// STEP files and meshes that are damaged by chance: whatever gmsh and OpenCASCADE make of them, the program
// ends by itself, soon, and says which file it is about. 60 of each run draw the same damage;
// MILLSTRESS_MUTANTS takes more.
#include <sys/resource.h>

#include <algorithm>

#include "tests/cases/program.h"
#include "tests/unit/meshes/examples/damaged_samples.h"

using namespace cases;

namespace {

const std::string scene_of_part = R"(effects = ["pull"]
tolerance = "none"
[machine]
type = "load_table"
speed = "600 rpm"
[[machine.constants]]
effect = "pull"
load = "hole.fx"
value = "1 kN"
[sampling]
instants_per_turn = 8
turns = 1
[part]
file = "GEOMETRY"
bearings = ["left", "right"]
axial_support = "left"
torque_support = "left"
length_unit = "1 mm"
[[part.ports]]
port = "left"
box = { low = ["-1 m", "-1 m", "-1 um"], high = ["1 m", "1 m", "1 um"] }
[[part.ports]]
port = "right"
box = { low = ["-1 m", "-1 m", "19.999 mm"], high = ["1 m", "1 m", "20.001 mm"] }
[[part.ports]]
port = "hole"
cylinder = { diameter = "10 mm", axis = ["15 mm", "15 mm"], begin = "-1 mm", end = "21 mm", side = "inside" }
[part.mesh]
size = "12 mm"
cells_per_circle = 6
min_scaled_jacobian = 0.01
[part.material]
name = "steel"
youngs_modulus = "206 GPa"
poisson_ratio = 0.3
density = "7850 kg/m3"
yield_strength = "305 MPa"
)";

/// Seconds of a core that ended children have taken.
double children_s() {
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  return double(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * double(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

class MutatedImports : public testing::Test {
protected:
  void SetUp() override { damaged::write_samples(directory_.path); }

  Outcome check(const std::string& geometry) {
    write(directory_ / "part.toml", with_edits(scene_of_part, {{"GEOMETRY", geometry}}));
    return millstress(directory_.path, "check part.toml");
  }

  results_test::Directory directory_;
};

TEST_F(MutatedImports, SoundFilesAreAccepted) {
  for (const char* name : {"sound.step", "sound_2.msh"}) {
    const auto outcome = check(name);
    EXPECT_EQ(outcome.exit_code, 0) << name << ": " << outcome.err;
  }
}

TEST_F(MutatedImports, EndByThemselvesAndNameTheFile) {
  const int n_mutants = damaged::n_mutants(12);
  damaged::Mutator mutator(20);
  std::map<std::string, int> count;
  double slowest_s = 0;
  for (int i = 0; i < n_mutants; ++i) {
    const std::string& sample = damaged::samples[std::size_t(i) % damaged::samples.size()];
    const bool is_step = fs::path(sample).extension() == ".step";
    const std::string name = "mutant" + fs::path(sample).extension().string();
    std::string what;
    const std::string text = mutator.damage(results_test::bytes(directory_ / sample), is_step, what);
    write(directory_ / name, text);
    const double before_s = children_s();
    const auto outcome = check(name);
    const double took_s = children_s() - before_s;
    slowest_s = std::max(slowest_s, took_s);
    const std::string mutant = std::to_string(i) + " of " + sample + ", " + what;
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 2 || outcome.exit_code == 3)
        << mutant << ": " << outcome.exit_code << ": " << outcome.err;
    if (outcome.exit_code != 0) {
      EXPECT_NE(outcome.err.find(name), std::string::npos) << mutant << ": " << outcome.err;
      EXPECT_EQ(outcome.err.find("internal error"), std::string::npos) << mutant << ": " << outcome.err;
    }
    EXPECT_LT(took_s, 10) << mutant;
    if (testing::Test::HasFailure()) {
      const auto kept = fs::temp_directory_path() / ("failed_" + std::to_string(i) + "_" + name);
      write(kept, text);
      FAIL() << "kept as " << kept;
    }
    const bool crashed = outcome.err.find("gmsh crashed") != std::string::npos;
    const bool hung = outcome.err.find("did not come to an end") != std::string::npos;
    ++count[crashed ? "crashed apart" : hung ? "hung apart" : "exit " + std::to_string(outcome.exit_code)];
  }
  std::cout << "mutants: " << damaged::told(count) << "slowest " << slowest_s << " s of a core\n";
  EXPECT_GT(count["exit 2"], n_mutants / 3) << "the damage is none";
}

}  // namespace

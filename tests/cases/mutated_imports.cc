// STEP files and meshes that are damaged by chance: whatever gmsh and OpenCASCADE make of them, the program
// ends by itself, soon, and says which file it is about. 60 of each run draw the same damage;
// MILLSTRESS_MUTANTS takes more.
#include <gmsh.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <random>
#include <regex>

#include "tests/cases/program.h"

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

/// A block with a hole, in millimetres, as CAD and as meshes of two versions.
void write_samples(const fs::path& directory) {
  namespace occ = gmsh::model::occ;
  gmsh::initialize();
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::vectorpair parts;
  std::vector<gmsh::vectorpair> map;
  occ::cut({{3, occ::addBox(0, 0, 0, 30, 30, 20)}}, {{3, occ::addCylinder(15, 15, -1, 0, 0, 22, 5)}}, parts,
           map);
  occ::synchronize();
  gmsh::write((directory / "sound.step").string());
  gmsh::option::setNumber("Mesh.MeshSizeMax", 12);
  gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 6);
  gmsh::model::mesh::generate(3);
  for (const double version : {4.1, 2.2}) {
    gmsh::option::setNumber("Mesh.MshFileVersion", version);
    gmsh::write((directory / (version > 4 ? "sound.msh" : "sound_2.msh")).string());
  }
  gmsh::finalize();
}

class Mutator {
public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  /// One damage, of a kind that editors, disks, mail and exporters do; its name stands in `what`.
  std::string damage(std::string text, bool is_step, std::string& what) {
    auto lines = lines_of(text);
    const std::size_t a = below(lines.size()), b = below(lines.size());
    switch (below(is_step ? 10 : 8)) {
      case 0:
        what = "line missing";
        lines.erase(lines.begin() + long(a));
        break;
      case 1:
        what = "lines swapped";
        std::swap(lines[a], lines[b]);
        break;
      case 2:
        what = "line twice";
        lines.insert(lines.begin() + long(b), lines[a]);
        break;
      case 3:
        what = "cut off";
        return text.substr(0, below(text.size()));
      case 4:
        what = "byte flipped";
        text[below(text.size())] ^= char(1 << below(8));
        return text;
      case 5:
      case 6:
      case 7: {
        what = "number changed";
        static const std::array<const char*, 9> odd = {
            "-1", "0", "2147483648", "-2147483649", "1e308", "1e-300", "nan", "9", "99999999999999999999"};
        return change_number(text, R"([-+]?[0-9][0-9.eE+-]*)", odd[below(odd.size())]);
      }
      default:
        what = "reference changed";
        return change_number(text, "#[0-9]+(?=[,)])", "#" + std::to_string(1 + below(lines.size())));
    }
    std::string joined;
    for (const auto& line : lines) joined += line + "\n";
    return joined;
  }

private:
  std::size_t below(std::size_t n) { return std::size_t(random_() % std::max<std::size_t>(1, n)); }

  static std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }

  std::string change_number(const std::string& text, const std::string& pattern, const std::string& to) {
    const std::regex number(pattern);
    const std::vector<std::smatch> found(std::sregex_iterator(text.begin(), text.end(), number), {});
    const auto& chosen = found[below(found.size())];
    return std::string(text.begin(), chosen[0].first) + to + std::string(chosen[0].second, text.end());
  }

  std::mt19937 random_;
};

/// Seconds of a core that ended children have taken.
double children_s() {
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  return double(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * double(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

int n_mutants() {
  const char* const wanted = std::getenv("MILLSTRESS_MUTANTS");
  return wanted == nullptr ? 60 : std::atoi(wanted);
}

class MutatedImports : public testing::Test {
protected:
  void SetUp() override { write_samples(directory_.path); }

  Outcome check(const std::string& geometry) {
    write(directory_ / "part.toml", with_edits(scene_of_part, {{"GEOMETRY", geometry}}));
    return millstress(directory_.path, "check part.toml");
  }

  results_test::Directory directory_;
};

TEST_F(MutatedImports, SoundFilesAreAccepted) {
  for (const char* name : {"sound.step", "sound.msh", "sound_2.msh"}) {
    const auto outcome = check(name);
    EXPECT_EQ(outcome.exit_code, 0) << name << ": " << outcome.err;
  }
}

TEST_F(MutatedImports, EndByThemselvesAndNameTheFile) {
  const std::array<std::string, 3> samples = {"sound.step", "sound.msh", "sound_2.msh"};
  Mutator mutator(20);
  std::map<std::string, int> count;
  double slowest_s = 0;
  for (int i = 0; i < n_mutants(); ++i) {
    const std::string& sample = samples[std::array{0, 1, 0, 2}[std::size_t(i % 4)]];
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
  std::ostringstream told;
  for (const auto& [outcome, n] : count) told << outcome << ' ' << n << "; ";
  std::cout << "mutants: " << told.str() << "slowest " << slowest_s << " s of a core\n";
  EXPECT_GT(count["exit 2"], n_mutants() / 3) << "the damage is none";
}

}  // namespace

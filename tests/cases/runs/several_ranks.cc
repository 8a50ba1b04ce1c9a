// The program under mpirun: the results of one rank, the envelope in pieces, one message where something is
// wrong.
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <set>

#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

/// The small shaft made short: rounding changes the slender one by 1e-9 whatever the order of sums. Every
/// node has its largest stress at the same instant, when the harmonic adds to the constant.
std::string small_scene() {
  auto text = small_shaft({{"pull", "middle.fx", "100 N", 0},
                           {"shake", "middle.fx", "50 N", 1},
                           {"twist", "middle.torque", "1 N m", 0}},
                          "mm", "600 rpm", "");
  for (const char* length : {"20", "28"})  // of the left, of the right
    text.replace(text.find("\"188 mm\""), 8, "\"" + std::string(length) + " mm\"");
  return text;
}

/// Runs `millstress ARGUMENTS` on two ranks in `directory`.
Outcome on_two_ranks(const fs::path& directory, const std::string& arguments) {
  const Start start{directory, on_its_own_mesh(directory, arguments), "true", two_ranks()};
  return outcome_of(start, std::system(shell_command(start).c_str()));
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

std::set<std::string> files_below(const fs::path& directory) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (entry.is_regular_file()) names.insert(entry.path().lexically_relative(directory).generic_string());
  return names;
}

template <typename Reader>
vtkSmartPointer<vtkUnstructuredGrid> read(const fs::path& file) {
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// Headline numbers of the shaft. Places and moments are left out: equal stresses at several nodes are told
/// apart by rounding.
void expect_same(const nlohmann::json& one, const nlohmann::json& two) {
  const auto &a = one["bodies"]["shaft"], &b = two["bodies"]["shaft"];
  EXPECT_EQ(a["dofs"], b["dofs"]);
  const std::vector<std::string> names{"/peak_von_mises/value", "/peak_principal/value", "/zone_level/value",
                                       "/torsion/max_shear_stress/value"};
  for (const auto& name : names) {
    const double x = a.at(nlohmann::json::json_pointer(name)), y = b.at(nlohmann::json::json_pointer(name));
    EXPECT_GT(x, 0) << name;
    EXPECT_NEAR(x, y, 1e-10 * x) << name;  // rounding times the condition of a body seven diameters long
  }
}

/// What a field may differ by, as a share of its largest value: single precision, or one step of what is
/// rounded: shares to 1/1024, tensors and displacements to 2^-12 of the largest value.
double step_of(const std::string& field) {
  if (field == "effect share") return 2.0 / 1024;
  return field.rfind("von Mises", 0) == 0 ? 1.2e-7 : 1.0 / 4096;
}

}  // namespace

TEST(SeveralRanks, GiveTheResultsOfOne) {
  const results_test::Directory directory;
  write(directory / "scene.toml", small_scene());
  const std::string run =
      "run scene.toml --threads 1 --set results.snapshots=2 --set results.keep=all --set "
      "results.pictures=true -o ";
  const auto one = millstress(directory.path, run + "one");
  ASSERT_EQ(one.exit_code, 0) << one.err;
  const auto two = on_two_ranks(directory.path, run + "two");
  ASSERT_EQ(two.exit_code, 0) << two.err;
  EXPECT_EQ(count(two.out, "Small shaft"), count(one.out, "Small shaft")) << "told once:\n" << two.out;
  EXPECT_EQ(results_test::bytes(directory / "one/loads.csv"),
            results_test::bytes(directory / "two/loads.csv"));
  expect_same(summary(directory / "one"), summary(directory / "two"));
  const auto ranks = summary(directory / "two")["bodies"]["shaft"]["solver"]["ranks"];
  EXPECT_EQ(ranks.size(), 2u);
  EXPECT_FALSE(summary(directory / "one")["bodies"]["shaft"]["solver"].contains("ranks"));

  const auto shaft = directory / "two/shaft";
  auto expected = files_below(directory / "one");
  ASSERT_EQ(expected.erase("shaft/envelope.vtu"), 1u);
  expected.insert({"shaft/envelope.pvtu", "shaft/envelope_0.vtu", "shaft/envelope_1.vtu"});
  EXPECT_EQ(files_below(directory / "two"), expected);
  EXPECT_EQ(expected.count("shaft/envelope.png"), 1u);
  const auto whole = read<vtkXMLUnstructuredGridReader>(directory / "one/shaft/envelope.vtu");
  const auto pieces = read<vtkXMLPUnstructuredGridReader>(shaft / "envelope.pvtu");
  EXPECT_EQ(pieces->GetNumberOfCells(), whole->GetNumberOfCells());
  EXPECT_GT(pieces->GetNumberOfPoints(), whole->GetNumberOfPoints()) << "nodes between pieces are in both";
  std::map<std::array<double, 3>, vtkIdType> node_at;
  for (vtkIdType i = 0; i < whole->GetNumberOfPoints(); ++i) {
    std::array<double, 3> x{};
    whole->GetPoint(i, x.data());
    node_at[x] = i;
  }
  ASSERT_EQ(pieces->GetPointData()->GetNumberOfArrays(), whole->GetPointData()->GetNumberOfArrays());
  for (const char* name : {"von Mises stress, maximum [Pa]", "stress at maximum [Pa]", "effect share"}) {
    auto* a = whole->GetPointData()->GetArray(name);
    auto* b = pieces->GetPointData()->GetArray(name);
    ASSERT_TRUE(a != nullptr && b != nullptr) << name;
    ASSERT_EQ(a->GetNumberOfComponents(), b->GetNumberOfComponents());
    double largest = 0, difference = 0;
    for (vtkIdType i = 0; i < pieces->GetNumberOfPoints(); ++i) {
      std::array<double, 3> x{};
      pieces->GetPoint(i, x.data());
      ASSERT_TRUE(node_at.count(x)) << "a node of a piece that the body does not have";
      for (int c = 0; c < a->GetNumberOfComponents(); ++c) {
        largest = std::max(largest, std::abs(a->GetComponent(node_at[x], c)));
        difference = std::max(difference, std::abs(a->GetComponent(node_at[x], c) - b->GetComponent(i, c)));
      }
    }
    EXPECT_GT(largest, 0) << name;
    EXPECT_LE(difference, step_of(name) * largest) << name;
  }

  // Each rank knows the surface that it has at an instant.
  for (const char* name : {"von Mises stress [Pa]", "displacement [m]"}) {
    const auto of_one = read<vtkXMLUnstructuredGridReader>(directory / "one/shaft/cycle_001.vtu"),
               of_two = read<vtkXMLUnstructuredGridReader>(shaft / "cycle_001.vtu");
    auto *a = of_one->GetPointData()->GetArray(name), *b = of_two->GetPointData()->GetArray(name);
    ASSERT_TRUE(a != nullptr && b != nullptr) << name;
    ASSERT_EQ(a->GetNumberOfTuples(), b->GetNumberOfTuples());
    double largest = 0, difference = 0;
    for (vtkIdType i = 0; i < a->GetNumberOfTuples(); ++i)
      for (int c = 0; c < a->GetNumberOfComponents(); ++c) {
        largest = std::max(largest, std::abs(a->GetComponent(i, c)));
        difference = std::max(difference, std::abs(a->GetComponent(i, c) - b->GetComponent(i, c)));
      }
    EXPECT_GT(largest, 0) << name;
    EXPECT_LE(difference, step_of(name) * largest) << name;
  }

  // One rank into the same directory leaves its own files alone.
  ASSERT_EQ(millstress(directory.path, run + "two").exit_code, 0);
  EXPECT_TRUE(fs::exists(shaft / "envelope.vtu"));
  for (const char* gone : {"envelope.pvtu", "envelope_0.vtu", "envelope_1.vtu"})
    EXPECT_FALSE(fs::exists(shaft / gone)) << gone;
}

// Goals' errors, submodels, places, zones, lives, cycles and frequencies are found where the rows are; the
// search takes the same steps.
TEST(SeveralRanks, SearchAsOneDoes) {
  const results_test::Directory directory;
  auto text = small_scene();
  text += "[shaft.fatigue]\ntensile_strength = \"580 MPa\"\nroughness = \"3.2 um\"\n";
  write(directory / "scene.toml", text);
  const std::string run = "run scene.toml --method solid --tolerance \"4 %\" --threads 1 -o ";
  const auto one = millstress(directory.path, run + "one");
  ASSERT_EQ(one.exit_code, 0) << one.err;
  const auto two = on_two_ranks(directory.path, run + "two");
  ASSERT_EQ(two.exit_code, 0) << two.err;
  const auto expect_alike = [&](const char* of_one, const char* of_two) {
    expect_same(summary(directory / of_one), summary(directory / of_two));
    const nlohmann::json a = summary(directory / of_one)["bodies"]["shaft"],
                         b = summary(directory / of_two)["bodies"]["shaft"];
    const auto alike = [&](const std::string& pointer, double tolerance) {
      const nlohmann::json::json_pointer at(pointer);
      const double x = a.at(at), y = b.at(at);
      EXPECT_GT(x, 0) << pointer;
      EXPECT_NEAR(x, y, tolerance * x) << pointer;
    };
    EXPECT_EQ(a["search"]["steps"].size(), b["search"]["steps"].size());
    // Errors are small differences of stresses.
    alike("/peak_von_mises/error/total", 1e-6);
    alike("/zones/0/volume_m3", 1e-8);
    alike("/fatigue/places/0/utilisation", 1e-8);
  };
  expect_alike("one", "two");

  // Other loads on the responses that both have kept.
  write(directory / "scene.toml", with_edits(text, {{"100 N", "120 N"}}));
  ASSERT_EQ(millstress(directory.path, run + "one").exit_code, 0);
  const auto again = on_two_ranks(directory.path, run + "two");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  expect_alike("one", "two");
  const auto unchanged = on_two_ranks(directory.path, run + "two");
  EXPECT_EQ(unchanged.exit_code, 0);
  EXPECT_EQ(count(unchanged.err, "unchanged since the last run"), 1u) << unchanged.err;
}

// The other one would wait for ever.
TEST(SeveralRanks, EndWhereOneOfThemFails) {
  const results_test::Directory directory;
  write(directory / "scene.toml", small_scene());
  const std::string limited =
      " sh -c 'test \"$OMPI_COMM_WORLD_RANK\" = 0 || ulimit -v 900000; exec \"$0\" \"$@\"'";
  const Start start{directory.path, "run scene.toml --tolerance none --threads 1 -o out", "true",
                    two_ranks() + limited};
  const auto before = std::chrono::steady_clock::now();
  const auto failed = outcome_of(start, std::system(shell_command(start).c_str()));
  EXPECT_EQ(failed.exit_code, 3) << failed.err;
  EXPECT_EQ(count(failed.err, "rank 1: "), 1u) << failed.err;
  EXPECT_FALSE(fs::exists(directory / "out/summary.json"));
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(60))
      << "at once but for patience";
}

TEST(SeveralRanks, EndTogetherWithOneMessage) {
  const results_test::Directory directory;
  write(directory / "scene.toml",
        with_edits(small_scene(), {{"\"pull\", \"shake\", \"twist\"", "\"pull\", \"shook\""}}));
  const auto wrong = on_two_ranks(directory.path, "run scene.toml -o out");
  EXPECT_EQ(wrong.exit_code, 2) << wrong.err;
  EXPECT_EQ(count(wrong.err, "scene.toml:"), 1u) << wrong.err;
  EXPECT_EQ(wrong.out, "");
  EXPECT_FALSE(fs::exists(directory / "out"));
  const auto misspelt = on_two_ranks(directory.path, "runn scene.toml");
  EXPECT_EQ(misspelt.exit_code, 2) << misspelt.err;
}

// Three designs at two speeds each, one of which no mesher takes: rank 1 has the second design.
TEST(SeveralRanks, DealOutTheDesignsOfASweep) {
  const results_test::Directory directory;
  write(directory / "scene.toml", small_scene());
  const std::string command =
      "sweep scene.toml --threads 1 --tolerance none --vary \"shaft.contour[3].diameter = 12 mm, 14 mm, 0 "
      "mm\" "
      "--vary \"machine.speed = 600 rpm, 700 rpm\" -o ";
  const auto one = millstress(directory.path, command + "one");
  ASSERT_EQ(one.exit_code, 0) << one.err;
  const auto two = on_two_ranks(directory.path, command + "two");
  ASSERT_EQ(two.exit_code, 0) << two.err;
  EXPECT_NE(two.err.find("points by rank: 4 2"), std::string::npos) << two.err;
  EXPECT_EQ(count(two.out, "refused"), count(one.out, "refused"));
  EXPECT_EQ(results_test::bytes(directory / "one/sweep.csv"),
            results_test::bytes(directory / "two/sweep.csv"));

  // Goes on where rank 1 has lost its rows.
  const auto journal = results_test::bytes(directory / "two/journal");
  std::string kept;
  std::istringstream lines(journal);
  for (std::string line; std::getline(lines, line);)
    if (line.find("14 mm") == std::string::npos) kept += line + '\n';
  ASSERT_LT(kept.size(), journal.size());
  write(directory / "two/journal", kept);
  const auto again = on_two_ranks(directory.path, command + "two");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.err.find("2 known from the sweep before"), std::string::npos) << again.err;
  EXPECT_EQ(results_test::bytes(directory / "one/sweep.csv"),
            results_test::bytes(directory / "two/sweep.csv"));
}

TEST(SeveralRanks, EndASweepThatOneOfThemCannotGoOnWith) {
  const results_test::Directory directory;
  write(directory / "scene.toml", small_scene());
  fs::create_directory(directory / "other");
  write(directory / "other/scene.toml", "no scene");
  const std::string sweep =
      "sweep scene.toml --threads 1 --tolerance none --vary \"shaft.contour[3].diameter = 12 mm, 14 mm\" -o "
      "out";
  const std::string elsewhere = " sh -c 'test \"$OMPI_COMM_WORLD_RANK\" = 0 || cd other; exec \"$0\" \"$@\"'";
  const Start start{directory.path, sweep, "true", two_ranks() + elsewhere};
  const auto failed = outcome_of(start, std::system(shell_command(start).c_str()));
  EXPECT_EQ(failed.exit_code, 2) << failed.err;  // as on one rank
  EXPECT_EQ(count(failed.err, "rank 1: "), 1u) << failed.err;
  EXPECT_EQ(failed.out, "");
}

// The program under mpirun: the results of one rank, the envelope in pieces, one message where something is
// wrong.
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <array>
#include <cmath>

#include "tests/cases/program.h"
#include "tests/cases/small_shaft.h"

using namespace cases;

namespace {

std::string small_scene() {
  return small_shaft({{"pull", "middle.fx", "100 N", 0}, {"shake", "middle.fy", "50 N", 1}}, "mm", "600 rpm",
                     "");
}

/// Runs `millstress ARGUMENTS` on two ranks in `directory`.
Outcome on_two_ranks(const fs::path& directory, const std::string& arguments) {
  const auto out = directory / "stdout.txt", err = directory / "stderr.txt";
  const std::string command =
      "cd '" + directory.string() +
      "' && OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
      "OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_btl_vader_single_copy_mechanism=none '" MPIEXEC
      "' -n 2 '" MILLSTRESS "' " +
      arguments + " > '" + out.string() + "' 2> '" + err.string() + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, results_test::bytes(out), results_test::bytes(err)};
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

template <typename Reader>
vtkSmartPointer<vtkUnstructuredGrid> read(const fs::path& file) {
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// Every number of both that is not a count of work, relative to the larger one.
void expect_same(const nlohmann::json& one, const nlohmann::json& two, const std::string& name) {
  if (one.is_object()) {
    for (const auto& [key, value] : one.items())
      if (key != "timing" && key != "solver" && key != "closure" && key != "error") {
        ASSERT_TRUE(two.contains(key)) << name << '.' << key;
        expect_same(value, two[key], name + '.' + key);
      }
  } else if (one.is_array()) {
    ASSERT_EQ(one.size(), two.size()) << name;
    for (std::size_t i = 0; i < one.size(); ++i) expect_same(one[i], two[i], name);
  } else if (one.is_number()) {
    const double a = one, b = two;
    // 1e-10 of a number; below 1e-9 of their unit (N m, MPa ...) numbers here are rounding of larger ones
    EXPECT_NEAR(a, b, 1e-10 * std::max(std::abs(a), std::abs(b)) + 1e-9) << name;
  } else {
    EXPECT_EQ(one, two) << name;
  }
}

}  // namespace

TEST(SeveralRanks, GiveTheResultsOfOne) {
  const results_test::Directory directory;
  write(directory / "scene.toml", small_scene());
  const auto one = millstress(directory.path, "run scene.toml -o one --threads 1");
  ASSERT_EQ(one.exit_code, 0) << one.err;
  const auto two = on_two_ranks(directory.path, "run scene.toml -o two --threads 1");
  ASSERT_EQ(two.exit_code, 0) << two.err;
  EXPECT_EQ(count(two.out, "Small shaft"), count(one.out, "Small shaft")) << "told once:\n" << two.out;
  expect_same(summary(directory / "one"), summary(directory / "two"), "summary");
  const auto ranks = summary(directory / "two")["bodies"]["shaft"]["solver"]["ranks"];
  EXPECT_EQ(ranks.size(), 2u);
  EXPECT_FALSE(summary(directory / "one")["bodies"]["shaft"]["solver"].contains("ranks"));

  const auto shaft = directory / "two/shaft";
  EXPECT_FALSE(fs::exists(shaft / "envelope.vtu"));
  ASSERT_TRUE(fs::exists(shaft / "envelope_0.vtu") && fs::exists(shaft / "envelope_1.vtu"));
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
    EXPECT_LE(difference, 1.2e-7 * largest) << name << ": fields are kept in single precision";
  }

  // One rank into the same directory leaves its own files alone.
  ASSERT_EQ(millstress(directory.path, "run scene.toml -o two --threads 1").exit_code, 0);
  EXPECT_TRUE(fs::exists(shaft / "envelope.vtu"));
  for (const char* gone : {"envelope.pvtu", "envelope_0.vtu", "envelope_1.vtu"})
    EXPECT_FALSE(fs::exists(shaft / gone)) << gone;
}

TEST(SeveralRanks, EndTogetherWithOneMessage) {
  const results_test::Directory directory;
  write(directory / "scene.toml",
        with_edits(small_scene(), {{"\"pull\", \"shake\"", "\"pull\", \"shook\""}}));
  const auto wrong = on_two_ranks(directory.path, "run scene.toml -o out");
  EXPECT_EQ(wrong.exit_code, 2) << wrong.err;
  EXPECT_EQ(count(wrong.err, "scene.toml:"), 1u) << wrong.err;
  EXPECT_EQ(wrong.out, "");
  EXPECT_FALSE(fs::exists(directory / "out"));
  const auto misspelt = on_two_ranks(directory.path, "runn scene.toml");
  EXPECT_EQ(misspelt.exit_code, 2) << misspelt.err;
}

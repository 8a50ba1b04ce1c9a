#include <hdf5.h>

#include <algorithm>
#include <regex>

#include "tests/cases/program/program.h"
#include "tests/cases/program/stepped_shaft.h"

using namespace cases;

namespace {

std::vector<std::string> first_column(const fs::path& csv_file) {
  std::vector<std::string> result;
  std::istringstream lines(results_test::bytes(csv_file));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) result.push_back(line.substr(0, line.find(',')));
  return result;
}

/// Columns of numbers of a study. The CSV has text with commas: numbers are read from its twin.
class Study {
public:
  Study(const fs::path& file, std::size_t n, const std::string& body = "shaft")
      : id_(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)), n_(n), body_(body) {}
  ~Study() { H5Fclose(id_); }
  Study(const Study&) = delete;
  Study& operator=(const Study&) = delete;
  double attribute(const std::string& name) const {
    double value = 0;
    const hid_t attribute =
        H5Aopen_by_name(id_, ("/" + body_).c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(attribute, 0) << name;
    H5Aread(attribute, H5T_NATIVE_DOUBLE, &value);
    H5Aclose(attribute);
    return value;
  }
  std::vector<double> column(const std::string& name) const {
    std::vector<double> values(n_);
    const hid_t set = H5Dopen2(id_, ("/" + body_ + "/" + name).c_str(), H5P_DEFAULT);
    EXPECT_GE(set, 0) << name;
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(set);
    return values;
  }

private:
  hid_t id_;
  std::size_t n_;
  std::string body_;
};

}  // namespace

// All models are there, more expensive runs come later, and estimates bound the errors against the
// best run, whose own estimate counts too (one run of nineteen may stick out). A model whose model error were
// forgotten would.
TEST(Accuracy, EveryModelBoundsItsError) {
  const results_test::Directory directory;
  write(directory / "small.toml", stepped_shaft());
  const auto outcome =
      millstress(directory.path, "accuracy small.toml -o out --tolerance '20 %' --time-limit '200 s'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("the next factor of two in accuracy costs"), std::string::npos) << outcome.out;
  const auto files = directory / "out/accuracy";
  // What the effect costs: it feeds all channels.
  EXPECT_NE(outcome.out.find("effects on the shaft"), std::string::npos) << outcome.out;
  const auto models = first_column(files / "shaft.csv");
  for (const std::string model :
       {"beam", "axisymmetric", "Q1 solid", "even mesh", "Q3 solid", "fewer instants", "refined mesh"})
    EXPECT_NE(std::find(models.begin(), models.end(), model), models.end()) << model << outcome.out;

  const Study study(files / "accuracy.h5", models.size());
  const auto estimated = study.column("error_estimated"), truth = study.column("error_true"),
             seconds = study.column("seconds"), value = study.column("value"),
             unknowns = study.column("unknowns");
  const double reference_error = *std::min_element(estimated.begin(), estimated.end());
  std::size_t n_bounded = 0;
  for (std::size_t i = 0; i < models.size(); ++i) {
    n_bounded += estimated[i] + reference_error >= truth[i];
    EXPECT_GT(value[i], 0) << models[i];
    EXPECT_GE(seconds[i], seconds[i > 0 ? i - 1 : 0]) << "cheapest first";
    EXPECT_GT(unknowns[i], models[i] == "even mesh" || models[i] == "Q3 solid" ? 1000 : 0) << models[i];
  }
  EXPECT_GE(n_bounded + 1, models.size()) << outcome.out;

  const auto png = results_test::bytes(files / "shaft.png");
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_GT(png.size(), 10000u);
  EXPECT_FALSE(fs::exists(files / "shaft")) << "scratch";
}

// Harmonics on three sections: the first two agree better than either is right, and said so. A search on
// finer ones knows the stress to a tenth of what they miss.
TEST(Accuracy, SectionsThatAgreeByChanceAreNotTrusted) {
  const results_test::Directory directory;
  const std::string scene = "'" + shipped("shaft.toml").string() +
                            "' --set shaft.mesh.sectors=8 --set 'machine.constants[3].value=1010600' -o out ";
  const auto study_of = millstress(directory.path, "accuracy " + scene + "--time-limit '8 s'");
  ASSERT_EQ(study_of.exit_code, 0) << study_of.err;
  const auto models = first_column(directory / "out/accuracy/shaft.csv");
  const auto run = millstress(
      directory.path,
      "run " + scene + "--method axisymmetric --tolerance '0.2 %' --force --set results.pictures=false");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const double true_Pa = summary(directory / "out")["bodies"]["shaft"]["peak_von_mises"]["value"];
  const Study study(directory / "out/accuracy/accuracy.h5", models.size());
  const auto value = study.column("value"), estimated = study.column("error_estimated");
  EXPECT_GE(std::count(models.begin(), models.end(), "axisymmetric"), 3) << study_of.out;
  for (std::size_t i = 0; i < models.size(); ++i)
    if (models[i] == "axisymmetric") {
      EXPECT_LT(std::abs(value[i] - true_Pa), estimated[i]) << i << study_of.out;
    }
}

// Of two cells on a fillet's quarter there are no fewer: the first mesh of the study is the scene's own. Its
// instants are varied all the same, and each row says how many it has.
TEST(Accuracy, FewerInstantsAreThereWhereCoarserMeshesAreTheSame) {
  const results_test::Directory directory;
  auto scene = stepped_shaft();
  scene.replace(scene.find("quarter = 4"), 11, "quarter = 2");
  scene.replace(scene.find("sectors = 12"), 12, "sectors = 8");
  write(directory / "small.toml", scene);
  const auto outcome =
      millstress(directory.path, "accuracy small.toml -o out --tolerance '20 %' --time-limit '40 s'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* text :
       {"24 instants per turn; cells on", "12 instants per turn; cells on", "effects on the shaft"})
    EXPECT_NE(outcome.out.find(text), std::string::npos) << text << outcome.out;
  // What other places may exceed the largest by is as at all instants. Red where it is left out: 0.
  const auto models = first_column(directory / "out/accuracy/shaft.csv");
  const auto others =
      Study(directory / "out/accuracy/accuracy.h5", models.size()).column("error.other_places");
  for (std::size_t i = 0; i < models.size(); ++i) {
    const auto is_of_mesh = [&](std::size_t k) { return models[k] == "even mesh" && others[k] == others[i]; };
    bool is_known = models[i] != "fewer instants";
    for (std::size_t k = 0; k < models.size(); ++k) is_known = is_known || is_of_mesh(k);
    EXPECT_TRUE(is_known) << outcome.out;
  }
}

// Where natural frequencies are asked for, every row states what resonance may add, the steps of a search
// too; cheap models, which a run refuses then, have no row. Red where they stand without it.
TEST(Accuracy, EveryRowKnowsOfResonance) {
  const results_test::Directory directory;
  auto scene = stepped_shaft();
  scene.replace(scene.find("bearings = "), 0, "natural_frequencies = 1\n");
  scene.replace(scene.find("quarter = 4"), 11, "quarter = 2");
  scene.replace(scene.find("sectors = 12"), 12, "sectors = 8");
  write(directory / "small.toml", scene);
  const auto outcome = millstress(directory.path, "accuracy small.toml -o out --time-limit '1 s'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* text : {"beam            left out: the shaft asks for natural frequencies",
                           "axisymmetric    left out: the shaft asks for natural frequencies",
                           // What the time has left out is named, too.
                           "even mesh, cells 1/3 left out: "})
    EXPECT_NE(outcome.out.find(text), std::string::npos) << text << outcome.out;
  // A second is up before the search begins or within it.
  EXPECT_TRUE(std::regex_search(outcome.out,
                                std::regex("refined mesh    left out: (no time is left|the time was up)")))
      << outcome.out;
  const auto models = first_column(directory / "out/accuracy/shaft.csv");
  ASSERT_FALSE(models.empty());
  const Study study(directory / "out/accuracy/accuracy.h5", models.size());
  for (const double resonance_Pa : study.column("error.quasi_static"))
    EXPECT_GT(resonance_Pa, 0) << outcome.out;
}

// 48 instants tell order 20, half of them do not: the study goes on without fewer instants.
TEST(Accuracy, FewerInstantsThatCannotTellTheLoadsAreLeftOut) {
  const results_test::Directory directory;
  auto scene = stepped_shaft();
  scene.replace(scene.find("order = 1"), 9, "order = 20");
  write(directory / "small.toml", scene);
  const auto outcome =
      millstress(directory.path, "accuracy small.toml -o out --tolerance '20 %' --time-limit '25 s'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("even mesh"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("effects on the shaft"), std::string::npos) << "the scene's own mesh was run";
  EXPECT_EQ(outcome.out.find("fewer instants"), std::string::npos) << outcome.out;
}

// Three systematic meshes of a shoulder fillet in torsion, whose largest stress is known: 190.192 MPa (the
// scene's head). The order is one that quadratic cells can have, the extrapolated value is closer than the
// finest mesh, and the index bounds that mesh's error without exceeding half a per cent.
TEST(Accuracy, GridConvergenceIndexOfAFillet) {
  constexpr double known_Pa = 190.192e6;
  const results_test::Directory directory;
  fs::copy_file(fs::path(SOURCE_DIR) / "tests/benchmarks/accuracy/torsion_fillet.toml",
                directory / "fillet.toml");
  const auto outcome = millstress(
      directory.path,
      "accuracy fillet.toml -o out --gci --reference '190.192 MPa' --tolerance '50 %' --time-limit '600 s'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("observed order"), std::string::npos) << outcome.out;
  const auto files = directory / "out/accuracy";
  EXPECT_EQ(first_column(files / "shaft_gci.csv").size(), 3u);

  const auto models = first_column(files / "shaft.csv");
  const Study study(files / "accuracy.h5", models.size());
  const double order = study.attribute("grid_convergence_order"),
               index = study.attribute("grid_convergence_index_Pa"),
               extrapolated = study.attribute("grid_convergence_extrapolated_Pa");
  EXPECT_GT(order, 1) << outcome.out;
  EXPECT_LE(order, 4);
  const auto value = study.column("value"), entry = study.column("error.discretisation"),
             unknowns = study.column("unknowns");
  std::size_t finest = models.size();
  for (std::size_t i = 0; i < models.size(); ++i)
    if (models[i] == "systematic mesh" && (finest == models.size() || unknowns[i] > unknowns[finest]))
      finest = i;
  ASSERT_LT(finest, models.size());
  EXPECT_EQ(entry[finest], index);
  EXPECT_LE(std::abs(value[finest] - known_Pa), index);
  EXPECT_LT(index, 0.005 * known_Pa);
  // That index covers what lies between nodes too. Without it, it bounds the error of the largest stress
  // there.
  const double between_nodes = study.attribute("grid_convergence_between_nodes_Pa");
  EXPECT_GT(between_nodes, 0.1e6) << "0.2 MPa on meshes of these sizes; nothing if nodes alone are looked at";
  EXPECT_LE(std::abs(value[finest] + between_nodes - known_Pa), index - between_nodes);
  EXPECT_LE(std::abs(extrapolated - known_Pa), std::abs(value[finest] - known_Pa));
}

// The cheapest model of a chamber bounds what solids say of its weld toes.
TEST(Accuracy, AThinShellBoundsAChambersHotSpot) {
  const results_test::Directory directory;
  write(directory / "mill.toml", chamber_alone({{"instants_per_turn = 120", "instants_per_turn = 24"},
                                                {"  \"gravity_shaft\", \"shaft_inertia\",", "  #"}}));
  const auto outcome =
      millstress(directory.path, "accuracy mill.toml -o out --tolerance '50 %' --time-limit '60 s'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto files = directory / "out/accuracy";
  const auto models = first_column(files / "chamber.csv");
  ASSERT_EQ(models.front(), "shell") << "cheapest first" << outcome.out;
  ASSERT_NE(std::find(models.begin(), models.end(), "even mesh"), models.end()) << outcome.out;
  const Study study(files / "accuracy.h5", models.size(), "chamber");
  const auto estimated = study.column("error_estimated"), truth = study.column("error_true"),
             seconds = study.column("seconds"), value = study.column("value");
  EXPECT_LE(truth[0], estimated[0]) << outcome.out;
  EXPECT_LE(truth[0], 0.35 * value[0]) << "worse than it was made: 10 to 20 % off";
  EXPECT_LT(seconds[0], 2);
}

TEST(Accuracy, WrongRequestsAreRefused) {
  const results_test::Directory directory;
  write(directory / "small.toml", stepped_shaft());
  for (const auto& [arguments, word] :
       std::map<std::string, std::string>{{"--body chamber", "--body chamber"},
                                          {"--reference heavy", "--reference heavy"},
                                          {"--time-limit '0 s'", "positive"}}) {
    const auto run = millstress(directory.path, "accuracy small.toml -o out " + arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
    EXPECT_FALSE(fs::exists(directory / "out")) << arguments;
  }
}

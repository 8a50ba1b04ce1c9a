#include <hdf5.h>

#include "tests/cases/program.h"
#include "tests/cases/stepped_shaft.h"

using namespace cases;

namespace {

/// One study for all tests: it takes some seconds.
class AccuracyOfTheSmallShaft : public testing::Test {
protected:
  void SetUp() override {
    if (outcome) return;
    directory = new results_test::Directory;
    write(*directory / "small.toml", stepped_shaft());
    outcome = new Outcome(
        millstress(directory->path, "accuracy small.toml -o out --threads 1 --time-limit '40 s'"));
  }
  static void TearDownTestSuite() {
    delete directory;
    delete outcome;
  }
  static fs::path file(const std::string& name) { return *directory / "out/accuracy" / name; }
  static std::vector<std::string> rungs() {
    std::vector<std::string> result;
    std::istringstream lines(results_test::bytes(file("shaft.csv")));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) result.push_back(line.substr(0, line.find(',')));
    return result;
  }

  static results_test::Directory* directory;
  static Outcome* outcome;
};
results_test::Directory* AccuracyOfTheSmallShaft::directory = nullptr;
Outcome* AccuracyOfTheSmallShaft::outcome = nullptr;

}  // namespace

TEST_F(AccuracyOfTheSmallShaft, HasEveryRungOfTheLadder) {
  ASSERT_EQ(outcome->exit_code, 0) << outcome->err;
  const auto names = rungs();
  for (const std::string rung : {"beam", "axisymmetric", "even mesh", "fewer instants", "refined mesh"})
    EXPECT_NE(std::find(names.begin(), names.end(), rung), names.end()) << rung;
  EXPECT_NE(outcome->out.find("the next factor of two in accuracy costs"), std::string::npos) << outcome->out;
}

// Against the overkill run, whose own estimate counts too. A rung whose estimate were forgotten would stick
// out.
TEST_F(AccuracyOfTheSmallShaft, EstimatesBoundTheTrueErrors) {
  ASSERT_EQ(outcome->exit_code, 0) << outcome->err;
  const auto names = rungs();
  // Text columns hold commas in quotes: numbers are read from the file's own HDF5 twin.
  const hid_t h5 = H5Fopen(file("accuracy.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(h5, 0);
  const auto column = [&](const std::string& name) {
    std::vector<double> values(names.size());
    const hid_t set = H5Dopen2(h5, ("/shaft/" + name).c_str(), H5P_DEFAULT);
    EXPECT_GE(set, 0) << name;
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(set);
    return values;
  };
  const auto estimated = column("error_estimated"), truth = column("error_true"), seconds = column("seconds"),
             value = column("value"), unknowns = column("unknowns");
  const double reference_error = *std::min_element(estimated.begin(), estimated.end());
  std::size_t n_bounded = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    n_bounded += estimated[i] + reference_error >= truth[i];
    EXPECT_GT(value[i], 0) << names[i];
    EXPECT_GT(seconds[i], 0) << names[i];
    EXPECT_GE(seconds[i], seconds[i > 0 ? i - 1 : 0]) << "cheapest first";
    EXPECT_GT(unknowns[i], names[i] == "even mesh" ? 1000 : 0) << names[i];
  }
  EXPECT_GE(double(n_bounded), 0.95 * double(names.size()));
  H5Fclose(h5);
}

TEST_F(AccuracyOfTheSmallShaft, LeavesTheChartAndNoScratch) {
  ASSERT_EQ(outcome->exit_code, 0) << outcome->err;
  const auto png = results_test::bytes(file("shaft.png"));
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_GT(png.size(), 10000u);
  EXPECT_FALSE(fs::exists(file("shaft")));
}

TEST(Accuracy, WrongWishesAreRefused) {
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

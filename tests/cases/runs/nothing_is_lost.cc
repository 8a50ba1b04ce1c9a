#include <sys/stat.h>

#include <algorithm>

#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

/// Loads alone: a run in a fraction of a second.
std::string loads_alone(const std::string& file = "") {
  return "title = \"loads\"\neffects = [\"pull\"]\n[machine]\ntype = \"load_table\"\nspeed = \"600 rpm\"\n" +
         (file.empty() ? "[[machine.constants]]\neffect = \"pull\"\nload = \"seat.fx\"\nvalue = \"1 N\"\n"
                       : "[[machine.files]]\neffect = \"pull\"\nfile = \"" + file + "\"\n") +
         "[sampling]\ninstants_per_turn = 24\nturns = 1\n";
}

/// Everything in a directory, links and pipes by their kind.
std::map<std::string, std::string> everything(const fs::path& directory) {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    const auto name = fs::relative(entry.path(), directory).string();
    if (name.rfind("cache", 0) == 0) continue;
    found[name] = entry.is_symlink()        ? "link to " + fs::read_symlink(entry.path()).string()
                  : entry.is_regular_file() ? results_test::bytes(entry.path())
                                            : "no file";
  }
  return found;
}

void expect_refused(const fs::path& directory, const std::string& arguments, const std::string& fragment) {
  const auto before = everything(directory);
  const auto outcome = millstress(directory, arguments);
  EXPECT_EQ(outcome.exit_code, 2) << arguments << '\n' << outcome.err;
  EXPECT_NE(outcome.err.find(fragment), std::string::npos) << arguments << '\n' << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(everything(directory) == before) << arguments << " has touched something";
}

}  // namespace

TEST(Outputs, NeverReplaceWhatIsNotTheirs) {
  const results_test::Directory directory;
  write(directory / "pull.csv", "angle [deg],seat.fx [N]\n0,1\n90,2\n180,3\n270,2\n");
  write(directory / "scene.txt", loads_alone("pull.csv"));
  write(directory / "own.csv", "mine\n");
  write(directory / "own.h5", "mine");
  fs::create_symlink("own.csv", directory / "link.csv");
  fs::create_directory(directory / "folder.csv");
  ASSERT_EQ(mkfifo((directory / "pipe.csv").c_str(), 0600), 0);
  const std::string loads = "loads scene.txt -q ";
  expect_refused(directory.path, loads + "--csv scene.txt", "--csv scene.txt: is an input of this run");
  expect_refused(directory.path, loads + "--csv pull.csv", "--csv pull.csv: is an input of this run");
  expect_refused(directory.path, loads + "--csv ./link.csv", "--csv ./link.csv: is a symbolic link");
  expect_refused(directory.path, loads + "--csv pipe.csv", "--csv pipe.csv: is a pipe");
  expect_refused(directory.path, loads + "--csv folder.csv", "is a directory");
  expect_refused(directory.path, loads + "--csv /dev/null", "--csv /dev/null: is a device");
  expect_refused(directory.path, loads + "-o /dev/null", "--output /dev/null: is a device");
  expect_refused(directory.path, loads + "--csv own.csv", "--csv own.csv: is there already");
  expect_refused(directory.path, loads + "-o own.h5", "--output own.h5: is there already");
  expect_refused(directory.path, loads + "-o same --csv ./same", "is the file that --output writes too");
  expect_refused(directory.path, loads + "--statistics s --csv s/polar.csv", "--statistics writes too");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));

  // The program's own files are replaced as ever.
  for (int run = 0; run < 2; ++run)
    EXPECT_EQ(millstress(directory.path, loads + "--csv new.csv -o new.h5").exit_code, 0) << run;

  // A result directory with files of others, or with the input under a result's name.
  fs::create_directory(directory / "results");
  write(directory / "results/loads.csv", results_test::bytes(directory / "pull.csv"));
  write(directory / "results/scene.toml", loads_alone("loads.csv"));
  expect_refused(directory.path, "run scene.txt -q -o results", "-o results/loads.csv: is there already");
  expect_refused(directory.path, "run results/scene.toml -q -o results", "results/loads.csv: is an input");
  ASSERT_EQ(millstress(directory.path, "run scene.txt -o out").exit_code, 0);
  fs::rename(directory / "out/summary.json", directory / "moved.json");
  fs::create_symlink("../moved.json", directory / "out/summary.json");
  expect_refused(directory.path, "run scene.txt -q -o out", "out/summary.json: is a symbolic link");
}

TEST(Outputs, FullDiskBehindStdoutIsAnError) {
  const results_test::Directory directory;
  write(directory / "scene.toml", loads_alone());
  for (const std::string arguments :
       {"--version", "run scene.toml -q", "run scene.toml -q --json", "check scene.toml"}) {
    // The second redirection wins.
    const auto outcome = as_a_user(directory.path, arguments + " > /dev/full 2> told #");
    EXPECT_NE(outcome.exit_code, 0) << arguments;
    const auto told = results_test::bytes(directory / "told");
    EXPECT_EQ(told, "millstress: standard output cannot be written; is the disk full behind it?\n")
        << arguments;
  }
}

// A rerun with other loads on a disk that is full at some sizes: an error, and the earlier results are whole.
// Without a body, since MPI needs files of megabytes to start; the unit test FullDisk has the VTK files.
TEST(Outputs, ADiskThatIsFullLeavesOneRun) {
  const results_test::Directory directory;
  const std::string run = "run scene.toml -q -o out";
  write(directory / "scene.toml", loads_alone());
  ASSERT_EQ(millstress(directory.path, run).exit_code, 0);
  const auto first = contents(directory / "out");
  write(directory / "scene.toml", with_edits(loads_alone(), {{"1 N", "2 N"}}));
  int n_refused = 0;
  // A file may have so many blocks of 512 bytes, in some shells of 1024.
  for (const int blocks : {1, 2, 4, 8, 16, 32, 1000}) {
    const auto outcome =
        millstress(directory.path, run, "trap '' XFSZ && ulimit -f " + std::to_string(blocks));
    if (outcome.exit_code == 0) break;
    ++n_refused;
    EXPECT_EQ(outcome.exit_code, 3) << blocks << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << blocks << outcome.err;
    EXPECT_TRUE(contents(directory / "out") == first) << blocks;
  }
  EXPECT_GT(n_refused, 3);
  EXPECT_LT(n_refused, 7);
  EXPECT_FALSE(contents(directory / "out") == first);
  EXPECT_EQ(millstress(directory.path, "report out").exit_code, 0);
}

// Files of two runs side by side, as a kill or a copy leaves them, are no results: 163 and 18 MPa stood on
// one page.
TEST(Outputs, AReportOfTwoRunsIsRefused) {
  const results_test::Directory directory;
  for (const char* size : {"1 kN", "2 kN"}) {
    write(directory / "scene.toml", small_shaft({{"pull", "middle.fy", size}}, "mm", "600 rpm", ""));
    ASSERT_EQ(
        millstress(directory.path, "run scene.toml --method beam -q -o " + std::string(1, size[0])).exit_code,
        0);
  }
  const auto page = results_test::bytes(directory / "1/report.html");
  fs::copy_file(directory / "2/shaft/zones.csv", directory / "1/shaft/zones.csv",
                fs::copy_options::overwrite_existing);
  expect_refused(directory.path, "report 1", "1: shaft/zones.csv is not as the run wrote it");
  EXPECT_EQ(results_test::bytes(directory / "1/report.html"), page);
  const auto again = millstress(directory.path, "run scene.toml --method beam -q -o 1");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.err.find("shaft/zones.csv is not as the run wrote it"), std::string::npos) << again.err;
  EXPECT_EQ(millstress(directory.path, "report 1").exit_code, 0);
}

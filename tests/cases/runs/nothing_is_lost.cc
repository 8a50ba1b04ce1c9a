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

namespace {

/// A scene of loads, one with a body, and a sweep of it.
void write_scenes(const fs::path& directory) {
  write(directory / "scene.toml", loads_alone());
  write(directory / "body.toml", small_shaft({{"pull", "middle.fy", "1 kN"}}, "mm", "600 rpm", ""));
}

const std::string by_beam = "run body.toml -q --method beam --tolerance none --threads 1 -o out";
const std::string sweep_of_body =
    "sweep body.toml -q --set method=beam --tolerance none -o points --vary 'machine.constants[1].value = "
    "1000..2000 N / 3'";

}  // namespace

// PETSc flushed what others had printed, told of the failure in a page of its own, and the exit code was 0.
TEST(Outputs, FullDiskBehindStdoutIsAnError) {
  const results_test::Directory directory;
  write_scenes(directory.path);
  for (const std::string& arguments :
       {std::string("--version"), std::string("--help"), std::string("run scene.toml -q"),
        std::string("run scene.toml -q --json"), std::string("check scene.toml"), by_beam,
        by_beam + " --json", sweep_of_body})
    for (const char* out : {" > /dev/full", " >&-"}) {
      // The second redirection wins.
      const auto outcome = as_a_user(directory.path, arguments + out + " 2> told #");
      EXPECT_EQ(outcome.exit_code, 3) << arguments << out;
      const auto told = results_test::bytes(directory / "told");
      EXPECT_EQ(told,
                "millstress: standard output cannot be written; is it closed, or the disk full behind it?\n")
          << arguments << out;
    }
  EXPECT_EQ(millstress(directory.path, "report out").exit_code, 0);  // the results are whole
}

// Without stdin, stdout and stderr files would be opened as these, and take what is printed.
TEST(Outputs, ClosedStreamsTakeNoFile) {
  const results_test::Directory directory;
  write_scenes(directory.path);
  ASSERT_EQ(as_a_user(directory.path, by_beam).exit_code, 0);
  const auto wanted = contents(directory / "out");
  for (const auto& [closed, exit_code] : {std::pair("<&- > /dev/null 2>&-", 0), {"<&- >&- 2>&-", 3}}) {
    fs::remove_all(directory / "out");
    EXPECT_EQ(as_a_user(directory.path, by_beam + ' ' + closed + " #").exit_code, exit_code) << closed;
    EXPECT_TRUE(contents(directory / "out") == wanted) << closed;
  }
}

// `run ... | head -1`: the run goes on to its end, and then ends as others in a pipeline do.
TEST(Outputs, AReaderThatGoesAwayEndsNoRun) {
  const results_test::Directory directory;
  write_scenes(directory.path);
  as_a_user(directory.path, by_beam + " 2> told; echo $? > code ) | true #", "( true");
  EXPECT_EQ(results_test::bytes(directory / "told"), "");
  EXPECT_EQ(results_test::bytes(directory / "code"), "141\n");
  EXPECT_EQ(millstress(directory.path, "report out").exit_code, 0);
  // Who ignores the signal hears of it.
  as_a_user(directory.path, by_beam + " 2> told; echo $? > code ) | true #", "( trap '' PIPE");
  EXPECT_EQ(results_test::bytes(directory / "code"), "3\n");
  EXPECT_EQ(results_test::bytes(directory / "told").rfind("millstress: standard output cannot be written", 0),
            0u);
}

// With pictures a run ended with exit code 3 after all its work, and kept nothing; without them it left an
// envelope.vtu that nothing reads.
TEST(Outputs, NamesWithMarkupReachEveryFile) {
  const results_test::Directory directory;
  const std::string name = "R&D <b> 'x' $a_b$ %s {} ä";
  const auto scene =
      small_shaft({{name, "middle.fy", "1 kN"}, {"pull; plain", "middle.fx", "1 kN"}}, "mm", "600 rpm", "");
  write(directory / "a&b <c>.toml",
        with_edits(scene, {{"title = \"Small shaft\"", "title = \"<title> & $x$\""},
                           {"pictures = false", "pictures = true"},
                           {"snapshots = 0", "snapshots = 1"},
                           {"name = \"left\"", "name = \"<left> & 'x'\""},
                           {"name = \"steel\"", "name = \"S355 / \\\"x\\\" & <y>\""}}));
  const auto run = as_a_user(directory.path, "run 'a&b <c>.toml' --method solid --tolerance none -q -o out");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  for (const char* file : {"envelope.vtu", "cycle_000.vtu"}) {
    const auto text = results_test::bytes(directory / "out/shaft" / file);
    const auto head = text.substr(0, text.find("<AppendedData"));
    EXPECT_EQ(head.find("R&D"), std::string::npos) << file;
    if (std::string(file) == "envelope.vtu") {
      EXPECT_NE(head.find("R&amp;D &lt;b&gt; &#39;x&#39; $a_b$ %s {} ä"), std::string::npos) << file;
    }
  }
  const auto page = results_test::bytes(directory / "out/report.html");
  EXPECT_EQ(page.find("<b>"), std::string::npos);
  EXPECT_EQ(page.find("<left>"), std::string::npos);
  EXPECT_EQ(page.find("<title> &"), std::string::npos);
  EXPECT_NE(page.find("R&amp;D &lt;b&gt;"), std::string::npos);
  EXPECT_EQ(summary(directory / "out")["input"]["effects"][0], name);
  ASSERT_EQ(millstress(directory.path, "loads 'a&b <c>.toml' -q --csv loads.csv").exit_code, 0);
  const auto loads = csv(directory / "loads.csv");
  EXPECT_EQ(loads.count(name + "/middle.fy"), 1u);
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
    const auto outcome = millstress(directory.path, run, "ulimit -f " + std::to_string(blocks));
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
  expect_refused(directory.path, "run scene.toml --method beam -q -o 1",
                 "-o 1/shaft/zones.csv: is there already, and no manifest.json of this program lists it");
  fs::remove(directory / "1/shaft/zones.csv");
  EXPECT_EQ(millstress(directory.path, "run scene.toml --method beam -q -o 1").exit_code, 0);
  EXPECT_EQ(millstress(directory.path, "report 1").exit_code, 0);
}

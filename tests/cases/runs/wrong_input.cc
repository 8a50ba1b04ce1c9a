#include <algorithm>

#include "tests/cases/program/program.h"

using namespace cases;

// A wrong scene: exit code 2, one line per error with file:line:column, nothing of an earlier run touched,
// and no directory made for a run that never was.
TEST(WrongInput, LeavesEarlierResultsUntouched) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  ASSERT_EQ(millstress(directory.path, "run mill.toml --method beam -o out").exit_code, 0);
  std::map<std::string, fs::file_time_type> times;
  for (const auto& entry : fs::recursive_directory_iterator(directory / "out"))
    times[entry.path().string()] = fs::last_write_time(entry.path());
  const auto before = contents(directory / "out");

  const std::vector<Edits> wrong{{{"mass = \"20 kg\"", "mass = \"-20 kg\""}},
                                 {{"\"springs\", \"spring_damping\"", "\"spring\", \"spring_damping\""}},
                                 {{"{ fillet = \"1 mm\" },\n  { port = \"debalance_1\"",
                                   "{ fillet = \"9 mm\" },\n  { port = \"debalance_1\""}},
                                 {{"convention = \"consistent\"", "convention = \"published\""}},
                                 {{"speed = \"151.844 rad/s\"", "speed = nan"}}};
  for (const auto& edits : wrong) {
    write(directory / "mill.toml", shaft_alone(coarse() + edits));
    for (const char* out : {"out", "other"}) {
      if (out == std::string("other") && &edits != &wrong.front()) continue;
      const auto run = millstress(directory.path, std::string("run mill.toml -o ") + out);
      EXPECT_EQ(run.exit_code, 2);
      EXPECT_EQ(run.out, "");
      EXPECT_EQ(run.err.rfind("mill.toml:", 0), 0u) << run.err;
      EXPECT_EQ(run.err.find("terminate"), std::string::npos) << run.err;
    }
  }
  EXPECT_FALSE(fs::exists(directory / "other"));
  EXPECT_EQ(contents(directory / "out"), before);
  for (const auto& [file, time] : times) EXPECT_EQ(fs::last_write_time(file), time) << file;
}

TEST(WrongInput, IsNamedBeforeAnythingRuns) {
  const results_test::Directory directory;
  write(directory / "empty.toml", "");
  fs::create_directory(directory / "folder.toml");
  for (const char* arguments : {"run missing.toml", "run empty.toml", "run folder.toml", "check folder.toml",
                                "loads missing.toml", "calculix missing.toml", "calculix empty.toml", "run",
                                "walk mill.toml", "run --threads 0 empty.toml"}) {
    const auto outcome = millstress(directory.path, arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_FALSE(outcome.err.empty()) << arguments;
  }
  EXPECT_FALSE(fs::exists(directory / "results"));
}

// A script's empty variable, a value without use, or a slip in the command is no wish for the default.
TEST(WrongInput, OfTheCommandLineIsTold) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  write(directory / "train.toml", edited("drive_train.toml", {}));
  const std::string sweep = "sweep mill.toml --vary 'machine.drive.speed = 1400, 1500 rpm' ";
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"run mill.toml --tolerance ''", "--tolerance: is empty"},
      {"run mill.toml --time-limit ''", "--time-limit: is empty"},
      {"run mill.toml --method ''", "--method: is empty"},
      {"run train.toml --method solid", "--method solid: the scene has no body"},
      {"history train.toml", "has no body, and only bodies have a stress"},
      {"run mill.toml -o ''", "--output: is empty"},
      {"loads mill.toml --csv -", "--csv: is -, which would be a file of that name"},
      {"run mill.toml --tolerance nan", "is not a finite number"},
      {"rnu mill.toml", "rnu: is no command; did you mean \"run\"?"},
      {"accuracy mill.toml --reference '0 MPa'", "--reference 0 MPa: must be positive"},
      {"check mill.toml --set machine.drive.sped='90 rpm'", "unknown key; did you mean \"speed\"?"},
      {"check mill.toml --set shaft.matrial.density=7850", "shaft.matrial: unknown key; did you mean"},
      {"free-body mill.toml --at '1e300 deg'", "--at 1e300 deg: is more than a million turns"},
      {sweep + "--points 3", "--points: has no use"},
      {sweep + "--seed 3", "--seed: has no use"},
      {sweep + "--loads --zones", "--zones: has no use"},
      {sweep + "--loads --tolerance '5 %'", "--tolerance: has no use"},
      {sweep + "--loads --time-limit '5 s'", "--time-limit: has no use"}};
  for (const auto& [arguments, message] : wrong) {
    const auto outcome = millstress(directory.path, arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << arguments << '\n' << outcome.err;
  }
  EXPECT_FALSE(fs::exists(directory / "results"));
}

// Libraries abort at such variables, and hang or end by a signal within such limits: all that is loaded takes
// some 400 MB, and a block of OpenBLAS' 160.
TEST(WrongInput, OfTheProcessItselfIsTold) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  for (const std::string threads : {"xx", "", "0", "-1", "1.5", "99999999999"}) {
    const auto outcome = millstress(directory.path, "run mill.toml", "export DEAL_II_NUM_THREADS=" + threads);
    EXPECT_EQ(outcome.exit_code, 2) << threads;
    const std::string told = "millstress: DEAL_II_NUM_THREADS = \"" + threads + "\"";
    EXPECT_EQ(outcome.err.rfind(told, 0), 0u) << outcome.err;
  }
  const auto small_stack = millstress(directory.path, "run mill.toml", "ulimit -s 256");
  EXPECT_EQ(small_stack.exit_code, 2);
  EXPECT_NE(small_stack.err.find("256 kB (ulimit -s)"), std::string::npos) << small_stack.err;
  const auto few_files = millstress(directory.path, "run mill.toml", "ulimit -n 20");
  EXPECT_EQ(few_files.exit_code, 2);
  EXPECT_EQ(few_files.err.rfind("millstress: this process may have 20 files open (ulimit -n)", 0), 0u)
      << few_files.err;
  const auto least_memory = millstress(directory.path, "run mill.toml", "ulimit -v 700000");
  EXPECT_EQ(least_memory.exit_code, 3);
  EXPECT_EQ(least_memory.err.rfind("millstress: this process may have 683 MB of memory (ulimit -v)", 0), 0u)
      << least_memory.err;
  const auto little_memory = millstress(directory.path, "run mill.toml", "ulimit -v 800000");
  EXPECT_EQ(little_memory.exit_code, 3);
  EXPECT_NE(little_memory.err.find("781 MB of memory (ulimit -v or -d)"), std::string::npos)
      << little_memory.err;
}

// Its name stands in summary.json, which is UTF-8: an internal error came after the run.
TEST(WrongInput, ASceneWhoseNameIsNoTextIsRefused) {
  const results_test::Directory directory;
  for (const std::string name : {"latin_\xe4.toml", "two\nlines.toml", "right_to_left_\xe2\x80\xae.toml"}) {
    write(directory / name, shaft_alone(coarse()));
    const auto outcome = millstress(directory.path, "check '" + name + "'");
    EXPECT_EQ(outcome.exit_code, 2) << name;
    EXPECT_NE(outcome.err.find("is no text in UTF-8; rename the file"), std::string::npos) << outcome.err;
  }
}

TEST(WrongInput, AFolderInTheManifestsPlaceIsNamed) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  ASSERT_EQ(millstress(directory.path, "run mill.toml --method beam -o out").exit_code, 0);
  fs::remove(directory / "out/manifest.json");
  fs::create_directory(directory / "out/manifest.json");
  const auto run = millstress(directory.path, "run mill.toml --method beam -o out");
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_NE(run.err.find("manifest.json: is a directory"), std::string::npos) << run.err;
}

// What only a stage finds is told with the place in the scene, too.
TEST(WrongInput, StagesNameThePlaceInTheScene) {
  const results_test::Directory directory;
  const auto refusal = [&](const std::string& scene, const std::string& command) {
    write(directory / "scene.toml", scene);
    const auto outcome = millstress(directory.path, command + " scene.toml");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    return outcome.err;
  };
  const auto line_of = [](const std::string& text, const std::string& words) {
    return std::to_string(1 +
                          std::count(text.begin(), text.begin() + long(text.find("\n" + words) + 1), '\n'));
  };
  const std::string train = edited("drive_train.toml", {}), mill = edited("vibratory_mill.toml", {});
  EXPECT_NE(refusal(train, "springs").find("scene.toml:" + line_of(train, "type = \"drive_train\"")),
            std::string::npos);
  EXPECT_NE(refusal(mill, "torsion").find("scene.toml:" + line_of(mill, "type = \"vibratory_mill\"")),
            std::string::npos);
  const std::string heavy = chamber_alone({{"bearings\nmass = \"6 kg\"", "bearings\nmass = \"16 kg\""},
                                           {"  \"gravity_shaft\", \"shaft_inertia\",", "  #"}});
  const auto masses = refusal(heavy, "check");
  EXPECT_NE(masses.find("scene.toml:" + line_of(heavy, "[chamber]") + ":"), std::string::npos) << masses;
  EXPECT_NE(masses.find("exciter mass"), std::string::npos) << masses;
}

// What `run` refuses after meshing is refused by `check` with the same words, and nothing is called valid.
TEST(WrongInput, CheckRefusesWhatARunRefuses) {
  const results_test::Directory directory;
  fs::copy_file(shipped("belt_pull.csv"), directory / "belt_pull.csv");
  for (const char* support : {"torque_support = \"disc_seat\"\n", "axial_support = \"bearing_1\"\n",
                              "bearings = [\"bearing_1\", \"bearing_2\"]\n"}) {
    write(directory / "table.toml", edited("load_table.toml", {{support, ""}}));
    const auto check = millstress(directory.path, "check table.toml"),
               run = millstress(directory.path, "run table.toml -q -o out");
    EXPECT_EQ(check.exit_code, 2) << support;
    EXPECT_EQ(run.exit_code, 2) << support;
    EXPECT_EQ(check.out, "");
    EXPECT_EQ(check.err, run.err);
    const std::string key = std::string(support).substr(0, std::string(support).find(' '));
    EXPECT_NE(check.err.find("table.toml:46:1: shaft." + key + ": is missing"), std::string::npos)
        << check.err;
  }
}

TEST(WrongInput, FormatsAndBareNumbersAreNotGuessed) {
  const results_test::Directory directory;
  const std::string scene = " '" + shipped("drive_train.toml").string() + "' ";
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"loads" + scene + "-o x.csv", "--csv x.csv"},
      {"loads" + scene + "--csv x.h5", "-o x.h5"},
      {"run" + scene + "--tolerance 0.5", "\"50 %\""},
      {"run" + scene + "--tolerance '0 %'", "write a tolerance above 0, or none"},
      {"effects" + scene + "--threshold 1", "\"1 %\""},
      {"run" + scene + "--tolerance none --time-limit 60", "--tolerance none"}};
  for (const auto& [arguments, fragment] : wrong) {
    const auto outcome = millstress(directory.path, arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.err.find(fragment), std::string::npos) << outcome.err;
  }
  EXPECT_TRUE(fs::is_empty(directory.path));
}

TEST(WrongInput, OutputThatCannotBeWrittenIsNamed) {
  const results_test::Directory directory;
  write(directory / "mill.toml", shaft_alone(coarse()));
  write(directory / "file", "not a directory");
  const auto outcome = millstress(directory.path, "run mill.toml -o file/out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("file/out"), std::string::npos) << outcome.err;
  EXPECT_EQ(results_test::bytes(directory / "file"), "not a directory");
  fs::create_symlink("nowhere", directory / "link");
  for (const auto& [option, said] :
       {std::pair{"--statistics file", "--statistics file/manifest.json: lies in file, which"},
        {"--csv file/loads.csv", "--csv file/loads.csv: lies in file, which is no directory"},
        {"--statistics link/s", "lies in link, a symbolic link to nothing"}}) {
    const auto loads = millstress(directory.path, std::string("loads mill.toml -o loads.h5 ") + option);
    EXPECT_EQ(loads.exit_code, 2) << option;
    EXPECT_NE(loads.err.find(said), std::string::npos) << loads.err;
    EXPECT_FALSE(fs::exists(directory / "loads.h5")) << "before anything runs";
  }
}

// MPI kept a directory in TMPDIR that all runs shared: one that ended took it from one that started, which
// then failed. Nothing needs TMPDIR to be a directory.
TEST(WrongInput, TmpdirDoesNotMatter) {
  const results_test::Directory directory;
  write(directory / "file", "no directory\n");
  write(directory / "scene.toml", edited("shaft.toml", {}));
  const std::string tmpdir = (directory / "file").string();
  const char* before = std::getenv("TMPDIR");
  const std::string restored = before != nullptr ? before : "";
  setenv("TMPDIR", tmpdir.c_str(), 1);
  const auto run = millstress(directory.path, "run scene.toml --method beam -o out"),
             check = millstress(directory.path, "check scene.toml");
  restored.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", restored.c_str(), 1);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(check.exit_code, 0) << check.err;
}

TEST(WrongInput, ModelForCalculixNeedsAFreeBody) {
  const results_test::Directory directory;
  fs::copy_file(shipped("drive_train.toml"), directory / "train.toml");
  const auto train = millstress(directory.path, "calculix train.toml -o out");
  EXPECT_EQ(train.exit_code, 2);
  EXPECT_NE(train.err.find("has no body"), std::string::npos) << train.err;
  write(directory / "mill.toml",
        edited("vibratory_mill.toml", {{"elastic_feet = false", "elastic_feet = true"}}));
  const auto feet = millstress(directory.path, "calculix mill.toml -o out");
  EXPECT_EQ(feet.exit_code, 2);
  EXPECT_NE(feet.err.find("elastic_feet = true"), std::string::npos) << feet.err;
  EXPECT_FALSE(fs::exists(directory / "out"));
}

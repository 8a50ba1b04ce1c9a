// A run that is asked for again computes nothing, as long as nothing at all has changed.
#include <algorithm>

#include "tests/cases/program/program.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

const std::string told = "unchanged since the last run: nothing was computed (--fresh computes anew)\n";

bool is_unchanged(const Outcome& outcome) {
  return outcome.err.find("nothing was computed") != std::string::npos;
}

struct Stamp {
  std::string bytes;
  fs::file_time_type written;
  bool operator==(const Stamp& other) const { return bytes == other.bytes && written == other.written; }
};

std::map<std::string, Stamp> stamps(const fs::path& directory) {
  std::map<std::string, Stamp> files;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), directory).string()] = {results_test::bytes(entry.path()),
                                                               entry.last_write_time()};
  return files;
}

std::string beam() {
  return small_shaft({{"pull", "middle.fy", "1 kN"}}, "mm", "600 rpm", "");
}

/// Loads from a file, without a body.
std::string samples(const fs::path& directory) {
  write(directory / "pull.csv", "angle [deg],seat.fx [N]\n0,1\n90,2\n180,3\n270,2\n");
  return "title = \"loads\"\neffects = [\"pull\"]\n[machine]\ntype = \"load_table\"\nspeed = \"600 rpm\"\n"
         "[[machine.files]]\neffect = \"pull\"\nfile = \"pull.csv\"\n"
         "[sampling]\ninstants_per_turn = 24\nturns = 1\n";
}

/// Runs twice: what the second one prints is what the first one did, and no file is touched.
void expect_nothing_computed(const fs::path& directory, const std::string& run) {
  const auto first = millstress(directory, run);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_FALSE(is_unchanged(first)) << run;
  const auto before = stamps(directory / "out");
  const auto second = millstress(directory, run);
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(second.out, first.out);
  EXPECT_EQ(second.err, told);
  const auto json = millstress(directory, run + " --json");
  EXPECT_EQ(json.out, results_test::bytes(directory / "out/summary.json"));
  EXPECT_EQ(json.err, told);
  EXPECT_EQ(millstress(directory, run + " -q").err, "");
  EXPECT_TRUE(stamps(directory / "out") == before) << run << " has touched results";
}

}  // namespace

// With the table of the bodies, without bodies, and with that of a drive train.
TEST(UnchangedRuns, PrintWhatTheFirstOnePrinted) {
  const auto expect_of = [](const std::string& what, const fs::path& directory, const std::string& scene,
                            const std::string& options) {
    SCOPED_TRACE(what);
    write(directory / "scene.toml", scene);
    expect_nothing_computed(directory, "run scene.toml -o out " + options);
  };
  const results_test::Directory a, b, c;
  expect_of("a body", a.path, beam(), "--method beam");
  expect_of("samples", b.path, samples(b.path), "");
  expect_of("a drive train", c.path, results_test::bytes(shipped("drive_train.toml")), "");
}

// --json first: the table is there all the same.
TEST(UnchangedRuns, PrintBothFormsWhicheverWasFirst) {
  const results_test::Directory directory;
  write(directory / "scene.toml", beam());
  const std::string run = "run scene.toml -o out --method beam";
  const auto json = millstress(directory.path, run + " --json");
  ASSERT_EQ(json.exit_code, 0) << json.err;
  const auto table = millstress(directory.path, run);
  EXPECT_TRUE(is_unchanged(table)) << table.err;
  EXPECT_NE(table.out.find("peak von Mises stress"), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("\n  results in out\n"), std::string::npos) << table.out;
  EXPECT_EQ(millstress(directory.path, run + " --json").out, json.out);
  // The directory under another name: its results are the same, and are said to lie there.
  const auto renamed = millstress(directory.path, "run scene.toml -o ./out --method beam");
  EXPECT_TRUE(is_unchanged(renamed)) << renamed.err;
  EXPECT_NE(renamed.out.find("\n  results in ./out\n"), std::string::npos) << renamed.out;
}

TEST(UnchangedRuns, AnyChangeOfInputsOrOptionsComputesAnew) {
  const results_test::Directory directory;
  const auto scene = directory / "scene.toml", table = directory / "pull.csv";
  write(scene, samples(directory.path));
  const auto run = [&](const std::string& options) {
    auto outcome = millstress(directory.path, "run scene.toml --force -o out " + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome;
  };
  const auto expect_anew = [&](const std::string& what, const std::string& options) {
    EXPECT_FALSE(is_unchanged(run(options))) << what;
    EXPECT_TRUE(is_unchanged(run(options))) << what << ", the second time";
  };
  expect_anew("the first run", "");
  write(scene, results_test::bytes(scene) + "#");
  expect_anew("a sign in the scene", "");
  write(table, with_edits(results_test::bytes(table), {{"180,3", "180,4"}}));
  expect_anew("a figure in the table", "");
  ASSERT_EQ(millstress(directory.path, "loads scene.toml --csv loads.csv").exit_code, 0);
  EXPECT_NEAR(csv(directory / "loads.csv").at("seat.fx")[12], 4, 1e-12);
  expect_anew("a key", "--set machine.speed=\"610 rpm\"");
  expect_anew("another key", "--set machine.speed=\"620 rpm\"");
  expect_anew("no key", "");
  expect_anew("threads", "--threads 2");
  expect_anew("a tolerance", "--tolerance \"3 %\"");
  expect_anew("a time limit", "--tolerance \"3 %\" --time-limit \"9 s\"");
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(is_unchanged(run("--fresh"))) << "--fresh";
  fs::copy(directory / "out", directory / "elsewhere", fs::copy_options::recursive);
  EXPECT_FALSE(is_unchanged(millstress(directory.path, "run scene.toml -o third"))) << "another directory";
}

// One scene under another path; and under the same name another scene, whose table alone is another.
TEST(UnchangedRuns, AScenesFolderMayBeWrittenOtherwise) {
  const results_test::Directory directory;
  write(directory / "scene.toml", samples(directory.path));
  const auto run = [&](const std::string& scene) {
    const auto outcome = millstress(directory.path, "run " + scene + " --force -o out");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return is_unchanged(outcome);
  };
  EXPECT_FALSE(run("scene.toml"));
  EXPECT_TRUE(run("'" + (directory / "scene.toml").string() + "'"));
  EXPECT_TRUE(run("./scene.toml"));
  fs::create_directory(directory / "other");
  write(directory / "other/scene.toml", samples(directory / "other"));
  EXPECT_TRUE(run("other/scene.toml"));
  write(directory / "other/pull.csv",
        with_edits(results_test::bytes(directory / "other/pull.csv"), {{"180,3", "180,4"}}));
  EXPECT_FALSE(run("other/scene.toml"));
}

// The method is the scene's, or that of the command line.
TEST(UnchangedRuns, AnotherMethodComputesAnew) {
  const results_test::Directory directory;
  write(directory / "scene.toml", beam());
  const auto run = [&](const std::string& method) {
    return is_unchanged(millstress(directory.path, "run scene.toml -o out --method " + method));
  };
  EXPECT_FALSE(run("beam"));
  EXPECT_TRUE(run("beam"));
  EXPECT_FALSE(run("axisymmetric"));
  EXPECT_TRUE(run("axisymmetric"));
}

// Of every file that the run wrote one byte is changed: it is this program's no more, and stops the run.
// Gone, it is made anew; without the manifest none of the others is this program's.
TEST(UnchangedRuns, AnyChangeOfAResultIsRefusedAndWhatIsGoneIsMadeAnew) {
  const results_test::Directory directory;
  write(directory / "scene.toml", beam());
  const auto run = [&] { return millstress(directory.path, "run scene.toml -o out --method beam"); };
  ASSERT_EQ(run().exit_code, 0);
  const auto whole = contents(directory / "out");
  EXPECT_GT(whole.size(), 6u);
  for (const auto& [name, ignored] : whole) {
    const auto file = directory / "out" / name;
    const auto own = results_test::bytes(file);
    auto bytes = own;
    bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 1);
    write(file, bytes);
    const auto changed = run();
    EXPECT_EQ(changed.exit_code, 2) << name;
    EXPECT_NE(changed.err.find("-o out/" + name + ": is there already, and "), std::string::npos)
        << name << changed.err;
    EXPECT_TRUE(results_test::bytes(file) == bytes) << name;
    fs::remove(file);
    if (name == "manifest.json") {
      EXPECT_EQ(run().exit_code, 2);
      write(file, own);
    } else {
      EXPECT_FALSE(is_unchanged(run())) << name << " gone";
    }
    EXPECT_TRUE(contents(directory / "out") == whole) << name;
  }
  EXPECT_TRUE(is_unchanged(run()));
  fs::create_symlink("loads.csv", directory / "out/shaft/mesh.msh");
  EXPECT_EQ(run().exit_code, 2) << "a link under a result's name";
}

// What is kept for later runs is none of the results, but a run mends it. Where it is gone nobody misses it.
TEST(UnchangedRuns, DamagedUnitResponsesComputeAnew) {
  const results_test::Directory directory;
  write(directory / "scene.toml", beam());
  const auto run = [&] { return millstress(directory.path, "run scene.toml -o out --method solid"); };
  ASSERT_EQ(run().exit_code, 0);
  const auto kept = cached_responses(directory.path, "out");
  auto bytes = results_test::bytes(kept);
  bytes[bytes.size() / 3] = char(bytes[bytes.size() / 3] ^ 1);
  write(kept, bytes);
  const auto damaged = run();
  EXPECT_NE(damaged.err.find(kept.filename().string() + ": is damaged"), std::string::npos) << damaged.err;
  // The results tell of the damage; those of the next run do not, nor is it told again.
  const auto mended = run();
  EXPECT_FALSE(is_unchanged(mended)) << mended.err;
  EXPECT_TRUE(summary(directory / "out")["warnings"].empty());
  EXPECT_TRUE(is_unchanged(run()));
  fs::remove(kept);
  EXPECT_TRUE(is_unchanged(run()));
}

TEST(UnchangedRuns, WhatMissedItsToleranceIsTriedAgain) {
  const results_test::Directory directory;
  write(directory / "scene.toml", beam());
  const auto run = [&](const std::string& options) {
    return as_a_user(directory.path, "run scene.toml -o out " + options);
  };
  for (int i = 0; i < 2; ++i) {
    const auto missed = run("--method beam --tolerance \"0.01 %\"");
    EXPECT_EQ(missed.exit_code, 4) << missed.err;
    EXPECT_FALSE(is_unchanged(missed));
  }
  for (int i = 0; i < 2; ++i) {
    const auto ended = run("--method solid --time-limit \"0.01 s\"");
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_NE(ended.out.find("the time is up"), std::string::npos) << ended.out;
    EXPECT_FALSE(is_unchanged(ended)) << "more time may be had";
  }
}

// Nobody asked for the default's 5 %: that it is missed is told again, and nothing is computed again.
TEST(UnchangedRuns, WhatMissesTheDefaultIsKeptWithItsWarning) {
  const results_test::Directory directory;
  write(directory / "scene.toml", beam());
  const auto first = as_a_user(directory.path, "run scene.toml -o out --method beam");
  EXPECT_EQ(first.exit_code, 0) << first.err;
  ASSERT_NE(first.err.find("the default is 5 % within 60 s"), std::string::npos)
      << "the test wants a beam that is known less well: " << first.err;
  const auto again = as_a_user(directory.path, "run scene.toml -o out --method beam");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(is_unchanged(again));
  EXPECT_NE(again.err.find("the default is 5 % within 60 s"), std::string::npos) << again.err;
  EXPECT_EQ(again.out, first.out);
}

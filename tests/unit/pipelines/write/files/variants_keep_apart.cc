// Results of another scene, sweep or --set are not replaced.
#include <gtest/gtest.h>

#include <fstream>

#include "pipelines/write/files/variant.h"
#include "tests/unit/pipelines/examples/staged_samples.h"

using namespace staged_samples;
using results_test::Directory;

namespace {

void publish(const fs::path& directory, const Variant& variant) {
  StagedResults staged(directory, run_names({"shaft"}), "-o", variant);
  write_second(staged);
  staged.publish();
}

TEST(Variants, OfOneSceneGoIntoDirectoriesOfTheirOwn) {
  const Directory at;
  const auto results = at / "results/mill";
  const Variant plain{at / "mill.toml", {}}, fast{at / "mill.toml", {"speed=2"}},
      slow{at / "mill.toml", {"speed=1"}};
  EXPECT_EQ(directory_for(results, fast), results);
  publish(results, plain);
  EXPECT_EQ(directory_for(results, plain), results);
  EXPECT_EQ(directory_for(results, fast), at / "results/mill-2");
  publish(at / "results/mill-2", fast);
  EXPECT_EQ(directory_for(results, fast), at / "results/mill-2");
  EXPECT_EQ(directory_for(results, slow), at / "results/mill-3");
  expect_in(held_of_another(results, fast), "results of this scene without --set");
  expect_in(held_of_another(at / "results/mill-2", slow), "results of this scene with --set 'speed=2'");
  expect_in(held_of_another(results, {at / "other/mill.toml", {}}), "results of another scene, ");
  auto forced = slow;
  forced.replaces_others = true;
  EXPECT_EQ(directory_for(results, forced), results);
}

// Neither the order of settings, nor spaces round their signs, nor how the file is named makes another one.
TEST(Variants, AreTheSameHoweverTheyAreWritten) {
  const Directory at;
  publish(at / "out", {at / "mill.toml", {"a.b = 1", "c=2 mm"}});
  fs::create_directory(at / "folder");
  EXPECT_EQ(held_of_another(at / "out", {at / "folder/../mill.toml", {"c = 2 mm", "a.b=1"}}), "");
  EXPECT_NE(held_of_another(at / "out", {at / "mill.toml", {"c=2 mm"}}), "");
  // Scene and results that are moved together stay together.
  fs::create_directory(at / "moved");
  fs::rename(at / "out", at / "moved/out");
  EXPECT_EQ(held_of_another(at / "moved/out", {at / "moved/mill.toml", {"a.b=1", "c=2 mm"}}), "");
  EXPECT_NE(held_of_another(at / "moved/out", {at / "mill.toml", {"a.b=1", "c=2 mm"}}), "");
}

TEST(Variants, OfSweepsKeepApartToo) {
  const Directory at;
  Variant run{at / "mill.toml", {}}, sweep = run, other = run;
  sweep.sweep = {"--vary a = 1, 2"};
  other.sweep = {"--vary a = 1, 2, 3"};
  publish(at / "out", sweep);
  EXPECT_EQ(held_of_another(at / "out", run), "");
  publish(at / "out", run);  // the sweep stays beside it
  expect_in(held_of_another(at / "out", other), "another sweep of this scene, --vary a = 1, 2");
  other.has_all_of = [&](const auto& earlier) { return earlier == *sweep.sweep; };
  EXPECT_EQ(held_of_another(at / "out", other), "");
}

// A run of hours must not replace what another process has put there meanwhile.
TEST(Variants, ThatCameMeanwhileAreNotReplaced) {
  const Directory at;
  const Variant plain{at / "mill.toml", {}}, fast{at / "mill.toml", {"speed=2"}};
  StagedResults late(at / "out", run_names({"shaft"}), "-o", plain);
  write_second(late);
  publish(at / "out", fast);
  const auto before = visible_files(at / "out");
  EXPECT_THROW(late.publish(), OptionError);
  EXPECT_EQ(visible_files(at / "out"), before);
}

// A name that is no UTF-8 comes back changed from JSON, and is the same scene all the same.
TEST(Variants, OfANameThatIsNoTextAreTheSame) {
  const Directory at;
  const Variant variant{at / "latin_\xe4/mill.toml", {}};
  publish(at / "out", variant);
  EXPECT_EQ(held_of_another(at / "out", variant), "");
}

}  // namespace

#include <gtest/gtest.h>

#include "tests/cases/program/program.h"

namespace cases {
namespace {

/// Rows of a comparison by group.
std::vector<nlohmann::json> figures(const nlohmann::json& comparison, const std::string& group) {
  std::vector<nlohmann::json> rows;
  for (const auto& row : comparison.at("figures"))
    if (row.at("group") == group) rows.push_back(row);
  return rows;
}

nlohmann::json figure(const nlohmann::json& comparison, const std::string& name) {
  for (const auto& row : comparison.at("figures"))
    if (row.at("name") == name) return row;
  return nullptr;
}

class Comparisons : public ::testing::Test {
protected:
  void SetUp() override {
    write(directory_ / "a.toml", edited("shaft.toml", {{"pictures = true", "pictures = false"}}));
    ASSERT_EQ(millstress(directory_, "run a.toml --method beam -o a").exit_code, 0);
  }

  const results_test::Directory made_;
  const fs::path& directory_ = made_.path;
};

TEST_F(Comparisons, OfASceneWithItselfHaveNoDifference) {
  ASSERT_EQ(millstress(directory_, "run a.toml --method beam -o again").exit_code, 0);
  const auto comparison = json_of(directory_, "compare a again --json");
  EXPECT_TRUE(comparison.at("keys").empty());
  std::size_t n = 0;
  for (const auto& row : comparison.at("figures"))
    if (row.at("group") != "cost") {
      EXPECT_EQ(row.at("from_first").at(1).at("text"), "the same") << row;
      ++n;
    }
  EXPECT_GT(n, 20u);
}

TEST_F(Comparisons, OfOneKeyNameItAndWhatSingleRunsSay) {
  ASSERT_EQ(millstress(directory_, "run a.toml --method beam --set 'machine.speed=1000 rpm' -o b").exit_code,
            0);
  const auto comparison = json_of(directory_, "compare a b --json");
  ASSERT_EQ(comparison.at("keys").size(), 1u);
  EXPECT_EQ(comparison.at("keys").at("machine.speed").at(1), "1000 rpm");
  const auto stress = figure(comparison, "shaft: peak von mises");
  ASSERT_TRUE(stress.is_object());
  for (int i = 0; i < 2; ++i) {
    const auto run = summary(directory_ / (i == 0 ? "a" : "b")).at("bodies").at("shaft").at("peak_von_mises");
    const double value = run.at("value"), error = run.at("error").at("total");
    EXPECT_EQ(stress.at("values").at(i).at("value"), value);
    EXPECT_DOUBLE_EQ(stress.at("values").at(i).at("most").get<double>(), value + error);
  }
  EXPECT_FALSE(figures(comparison, "loads").empty());
}

TEST_F(Comparisons, RunScenesAndWriteTheirFiles) {
  write(directory_ / "b.toml", edited("shaft.toml", {{"pictures = true", "pictures = false"},
                                                     {"diameter = \"42 mm\"", "diameter = \"43 mm\""}}));
  const auto outcome = millstress(directory_, "compare a b.toml --method beam --tolerance none -o both");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("A: a: "), std::string::npos);
  EXPECT_NE(outcome.out.find("43 mm"), std::string::npos);
  for (const auto* name : {"comparison.json", "comparison.csv", "comparison.html", "manifest.json"})
    EXPECT_TRUE(fs::exists(directory_ / "both" / name)) << name;
  EXPECT_EQ(csv(directory_ / "both/comparison.csv").count("A"), 1u);
}

TEST_F(Comparisons, RefuseWhatIsNoRun) {
  fs::create_directory(directory_ / "empty");
  auto outcome = millstress(directory_, "compare a empty");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("empty: holds no results of a run"), std::string::npos) << outcome.err;
  EXPECT_EQ(millstress(directory_, "compare a").exit_code, 2);
  write(directory_ / "a/summary.json", "{}");
  outcome = millstress(directory_, "compare a a");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("were changed since"), std::string::npos) << outcome.err;
  fs::create_directory(directory_ / "mine");
  write(directory_ / "mine/comparison.csv", "my own");
  ASSERT_EQ(millstress(directory_, "run a.toml --method beam -o c").exit_code, 0);
  EXPECT_EQ(millstress(directory_, "compare c c -o mine").exit_code, 2);
}

}  // namespace
}  // namespace cases

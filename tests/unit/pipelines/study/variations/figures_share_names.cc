/// Rows of a sweep share the names of their figures until one has others.
#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/study/variations/sweep_figures.h"

using pipelines::SweepFigures;

namespace {

std::vector<std::string> texts_of(const SweepFigures& figures) {
  std::vector<std::string> texts;
  for (const auto figure : figures)
    texts.push_back(figure.name + " [" + figure.unit + "] " + std::to_string(int(figure.value)));
  return texts;
}

}  // namespace

// Red if a row that goes on otherwise changes the names of those that share them.
TEST(SweepFiguresTest, RowsThatDifferKeepTheirOwnNames) {
  const SweepFigures first{{"a.max", "N", 1}, {"a.min", "N", 2}, {"b.max", "Pa", 3}};
  auto same = SweepFigures::like(first);
  EXPECT_TRUE(same.empty());
  EXPECT_TRUE(std::isnan(same.value("a.max"))) << "names without values are no figures";
  same.add({"a", ".max"}, "N", 4);
  EXPECT_FALSE(same.share_names(first)) << "one of three so far";
  same.add({"a.", "min"}, "N", 5);
  same.add({"b.max"}, "Pa", 6);
  EXPECT_TRUE(same.share_names(first));

  auto other_unit = SweepFigures::like(first);
  other_unit.add({"a.max"}, "N", 7);
  other_unit.add({"a.min"}, "kN", 8);
  other_unit.add({"b.max"}, "Pa", 9);
  auto longer = first;
  longer.add({"c"}, "", 10);
  auto prefix = SweepFigures::like(first);
  prefix.add({"a.ma"}, "N", 11);
  EXPECT_EQ(texts_of(first), (std::vector<std::string>{"a.max [N] 1", "a.min [N] 2", "b.max [Pa] 3"}));
  EXPECT_EQ(texts_of(same), (std::vector<std::string>{"a.max [N] 4", "a.min [N] 5", "b.max [Pa] 6"}));
  EXPECT_EQ(texts_of(other_unit), (std::vector<std::string>{"a.max [N] 7", "a.min [kN] 8", "b.max [Pa] 9"}));
  EXPECT_EQ(texts_of(longer),
            (std::vector<std::string>{"a.max [N] 1", "a.min [N] 2", "b.max [Pa] 3", "c [] 10"}));
  EXPECT_EQ(texts_of(prefix), (std::vector<std::string>{"a.ma [N] 11"}));
  EXPECT_FALSE(longer.share_names(first));
  EXPECT_FALSE(other_unit.share_names(first));
}

// Red if places are not looked up again after a row has grown.
TEST(SweepFiguresTest, AreFoundByName) {
  SweepFigures figures{{"a", "", 1}, {"b", "", 2}, {"a", "", 3}};
  EXPECT_EQ(figures.value("a"), 1) << "the first of that name";
  EXPECT_TRUE(std::isnan(figures.value("c")));
  figures.add({"c"}, "", 4);
  EXPECT_EQ(figures.value("c"), 4);
  EXPECT_EQ(figures.value("b"), 2);
  EXPECT_TRUE(std::isnan(SweepFigures().value("a")));
}

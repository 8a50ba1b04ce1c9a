#include <gtest/gtest.h>

#include "kinetics/values/edit_distance.h"
#include "kinetics/values/wrong_input.h"

using kinetics::edit_distance;

// Distances by hand; "ca" to "abc" is the textbook pair on which optimal string alignment (3) and the
// unrestricted distance of Damerau and Levenshtein (2) part.
TEST(EditDistance, IsTheFewestEdits) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("gravity_chrage", "gravity_charge"), 1U);
  EXPECT_EQ(edit_distance("ca", "abc"), 3U);
  EXPECT_EQ(edit_distance("abcdef", "badcfe"), 3U);
  EXPECT_EQ(edit_distance("Shaft", "shAFT"), 0U);
}

TEST(EditDistance, IsTheSameBothWays) {
  const std::string words[] = {"", "bearing_1", "bearing_2", "baering_1", "roller", "pulley"};
  for (const auto& a : words)
    for (const auto& b : words) EXPECT_EQ(edit_distance(a, b), edit_distance(b, a)) << a << ' ' << b;
}

// Without swaps both are two edits away, and the first would be taken.
TEST(EditDistance, SuggestsTheNameWithSwappedLetters) {
  EXPECT_EQ(kinetics::nearest("chrage", {"chra", "charge"}), "charge");
  EXPECT_EQ(kinetics::nearest("anything", {}), "");
}

// Boxes of words do not cover each other, and stay where they are if they may.
// Turns red: a box that is not looked at, a shift of the first one, spots outside of the window.
#include "pipelines/write/drawing/note_boxes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pipelines;

TEST(NoteBoxes, MakeRoomForEachOther) {
  const std::vector<NoteBox> same(6, {100, 100, 60, 20});
  const auto moved = moved_apart(same, 4, 400, 300);
  ASSERT_EQ(moved.size(), same.size());
  EXPECT_EQ(moved[0].left, 100);
  EXPECT_EQ(moved[0].bottom, 100);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    EXPECT_LE(std::hypot(moved[i].left - 100, moved[i].bottom - 100), 160) << "six of 60 x 20 fit near by";
    EXPECT_GE(moved[i].left, 0);
    EXPECT_LE(moved[i].left + 60, 400);
    EXPECT_GE(moved[i].bottom, 0);
    EXPECT_LE(moved[i].bottom + 20, 300);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_TRUE(std::abs(moved[i].left - moved[j].left) >= 60 ||
                  std::abs(moved[i].bottom - moved[j].bottom) >= 20)
          << i << j;
  }
}

TEST(NoteBoxes, StayWhereTheyAreFree) {
  const auto moved = moved_apart({{10, 10, 60, 20}, {200, 10, 60, 20}, {380, 290, 60, 20}}, 4, 400, 300);
  EXPECT_EQ(moved[0].left, 10);
  EXPECT_EQ(moved[1].left, 200);
  EXPECT_EQ(moved[2].left, 340) << "into the window";
  EXPECT_EQ(moved[2].bottom, 280);
}

// Where there is no room at all, nothing is lost.
TEST(NoteBoxes, OverlapWhereTheWindowIsFull) {
  EXPECT_EQ(moved_apart({{0, 0, 60, 20}, {0, 0, 60, 20}}, 4, 60, 20).size(), 2u);
}

// FAT classes by name, text and list. The classes are those of IIW-1823-07, table 3.3-1.
// Exponents of wall thickness: table 3.5-1, cruciform and T joints and attachments 0.3, transverse butt welds
// 0.2. Turns red: another class of a type, one exponent for all, a text taken for a class, a class outside
// IIW's list passed over.
#include <gtest/gtest.h>

#include "pipelines/base/fatigue/weld_classes.h"

using namespace pipelines;

TEST(WeldClasses, FollowFromTheType) {
  ASSERT_NE(weld_type("load-carrying"), nullptr);
  EXPECT_EQ(weld_type("load-carrying")->fat_Pa, 90e6);
  for (const char* other : {"non-load-carrying", "butt", "full penetration"}) {
    ASSERT_NE(weld_type(other), nullptr) << other;
    EXPECT_EQ(weld_type(other)->fat_Pa, 100e6) << other;
  }
  EXPECT_EQ(weld_type("Butt"), nullptr);
  EXPECT_EQ(thickness_exponent_of("butt"), 0.2);
  for (const char* other : {"load-carrying", "non-load-carrying", "full penetration", ""})
    EXPECT_EQ(thickness_exponent_of(other), 0.3) << other;
}

TEST(WeldClasses, AreReadFromTexts) {
  EXPECT_EQ(fat_of_text("FAT 90"), 90e6);
  EXPECT_EQ(fat_of_text("fat112"), 112e6);
  for (const char* other : {"FAT", "90", "FAT 90 MPa", "FAT -90", "FAT 9.5", "FATAL 90"})
    EXPECT_FALSE(fat_of_text(other)) << other;
  for (const double known : {36e6, 90e6, 100e6, 160e6}) EXPECT_TRUE(is_fat_class(known)) << known;
  for (const double other : {95e6, 35e6, 0.0, 90.1e6}) EXPECT_FALSE(is_fat_class(other)) << other;
}

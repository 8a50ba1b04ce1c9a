// Options of the command line: what they mean, and what is refused because it may be meant in two ways.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "pipelines/base/common/errors.h"
#include "pipelines/command/options/option_value.h"

namespace {

using namespace pipelines;

std::string option_refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const OptionError& error) {
    return error.what();
  }
  return "";
}

TEST(Options, ABareShareIsNeitherAShareNorAPercentage) {
  for (const char* text : {"0.5", "2", "1e-2"}) {
    const auto why = option_refusal([&] { option_in_si("--tolerance", text, "1"); });
    EXPECT_NE(why.find(std::string("\"") + text + " %\""), std::string::npos) << why;
  }
  EXPECT_NE(option_refusal([] { option_in_si("--tolerance", "0.5", "1"); }).find("\"50 %\""),
            std::string::npos);
  EXPECT_EQ(option_in_si("--tolerance", "2 %", "1"), 0.02);
}

TEST(Options, ABareTimeIsInSecondsAndOtherBareNumbersAreRefused) {
  EXPECT_EQ(option_in_si("--time-limit", "60", "s"), 60);
  EXPECT_EQ(option_in_si("--time-limit", "2 min", "s"), 120);
  EXPECT_NE(option_refusal([] { option_in_si("--reference", "104.8", "Pa"); }).find("has no unit"),
            std::string::npos);
  EXPECT_NE(option_refusal([] { option_in_si("--time-limit", "3 kg", "s"); }).find("--time-limit 3 kg"),
            std::string::npos);
}

TEST(Options, WhatIsNotFiniteIsToldSo) {
  for (const char* text : {"nan", "inf", "1e400"})
    for (const char* unit : {"1", "s", "Pa"})
      EXPECT_NE(option_refusal([&] { option_in_si("--option", text, unit); }).find("is not a finite number"),
                std::string::npos)
          << text << ' ' << unit;
}

TEST(Options, OfASearchComeBeforeTheScenes) {
  const RequestedAccuracy scene{0.05, 60};
  EXPECT_EQ(requested_search("", "", scene).tolerance, 0.05);
  EXPECT_EQ(requested_search("2 %", "", scene).tolerance, 0.02);
  EXPECT_EQ(requested_search("2 %", "", scene).time_limit_s, 60);
  const auto once = requested_search("none", "", scene);
  EXPECT_TRUE(once.once);
  EXPECT_FALSE(once.any());
  // A scene's own "none" stands until the command line asks for more.
  EXPECT_TRUE(requested_search("", "", once).once);
  for (const auto& asked : {requested_search("5 %", "", once), requested_search("", "10 s", once)}) {
    EXPECT_FALSE(asked.once);
    EXPECT_TRUE(asked.any());
  }
  EXPECT_NE(option_refusal([] { requested_search("none", "60 s", {}); }), "");
  EXPECT_NE(option_refusal([] { requested_search("", "-1 s", {}); }), "");
}

// 0 % would mean that nobody asked, and the default of 5 %.
TEST(Options, AToleranceHasTheLimitsOfAScenes) {
  for (const char* text : {"0 %", "-2 %"})
    EXPECT_EQ(option_refusal([&] { requested_search(text, "", {}); }),
              std::string("--tolerance ") + text +
                  ": must lie between 0.01 and 50 %; write a tolerance above 0, or none");
  for (const char* text : {"0.009 %", "51 %", "200 %"})
    EXPECT_EQ(option_refusal([&] { requested_search(text, "", {}); }),
              std::string("--tolerance ") + text +
                  ": must lie between 0.01 and 50 %; write one in between, or none");
  EXPECT_EQ(requested_search("0.01 %", "", {}).tolerance, least_tolerance);
  EXPECT_EQ(requested_search("50 %", "", {}).tolerance, largest_tolerance);
  // A study of accuracy knows no "none".
  EXPECT_EQ(option_refusal([] { tolerance_option("0 %"); }),
            "--tolerance 0 %: must lie between 0.01 and 50 %; write a tolerance above 0");
}

TEST(Options, ATimeLimitIsPositive) {
  for (const char* text : {"0", "0 s", "-1 min"})
    EXPECT_NE(option_refusal([&] { requested_search("", text, {}); }).find("must be positive"),
              std::string::npos)
        << text;
}

TEST(Options, FilesAreNamedAfterTheirFormat) {
  const auto check = [](const char* file) { require_extension("-o", file, {".h5"}, "write --csv"); };
  EXPECT_EQ(option_refusal([&] { check(""); }), "");
  EXPECT_EQ(option_refusal([&] { check("loads.h5"); }), "");
  EXPECT_EQ(option_refusal([&] { check("loads"); }), "");
  EXPECT_EQ(option_refusal([&] { check("x.csv"); }), "-o x.csv: write --csv");
}

}  // namespace

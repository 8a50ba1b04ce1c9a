#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "pipelines/base/names/units.h"

namespace {

using pipelines::parse_ratio;
using pipelines::to_si;
using pipelines::UnitError;

constexpr double pi = 3.14159265358979323846;

/// A product of a few roundings: the conversion factors of udunits are correct to the last digit or two.
void expect_same(double value, double expected) {
  EXPECT_NEAR(value, expected, 4e-16 * std::abs(expected));
}

std::string refusal(const std::string& quantity, const std::string& si_unit) {
  try {
    const double value = to_si(quantity, si_unit);
    return "accepted as " + std::to_string(value);
  } catch (const UnitError& error) {
    return error.what();
  }
}

TEST(units, EngineersUnitsBecomeSi) {
  expect_same(to_si("210 GPa", "Pa"), 210e9);
  expect_same(to_si("305 N/mm2", "Pa"), 305e6);
  expect_same(to_si("305 N/mm²", "Pa"), 305e6);
  expect_same(to_si("4.5 t/m3", "kg/m3"), 4500);
  expect_same(to_si("8.5 kN/mm", "N/m"), 8.5e6);
  expect_same(to_si("30 mm", "m"), 0.03);
  expect_same(to_si("30mm", "m"), 0.03);
  expect_same(to_si("  +30   mm ", "m"), 0.03);
  expect_same(to_si("-2.5e-1 mm", "m"), -2.5e-4);
  expect_same(to_si("25 µm", "m"), 25e-6);
  expect_same(to_si("2 %", "1"), 0.02);
  expect_same(to_si("0.02", "1"), 0.02);
  expect_same(to_si("60 N s/m", "N s/m"), 60);
  expect_same(to_si("60 N*s/m", "N s/m"), 60);
  expect_same(to_si("60 N/(m/s)", "N s/m"), 60);
  expect_same(to_si("1 min", "s"), 60);
}

TEST(units, AnglesAreRadians) {
  expect_same(to_si("40 deg", "rad"), 40 * pi / 180);
  expect_same(to_si("40°", "rad"), 40 * pi / 180);
  expect_same(to_si("1 turn", "rad"), 2 * pi);
  expect_same(to_si("0.7 rad", "rad"), 0.7);
}

TEST(units, HertzCountTurnsWhereAnAngularSpeedIsWanted) {
  expect_same(to_si("24.2 Hz", "rad/s"), 24.2 * 2 * pi);
  expect_same(to_si("0.0242 kHz", "rad/s"), 24.2 * 2 * pi);
  expect_same(to_si("24.2 hertz", "rad/s"), 24.2 * 2 * pi);
  expect_same(to_si("24.2 Hz", "1/s"), 24.2);  // a frequency stays one
}

TEST(units, SpeedsThatNameTheirAngleAreNotMultipliedAgain) {
  expect_same(to_si("1450 rpm", "rad/s"), 1450 * 2 * pi / 60);
  expect_same(to_si("1450 rev/min", "rad/s"), 1450 * 2 * pi / 60);
  expect_same(to_si("24 turn/s", "rad/s"), 24 * 2 * pi);
  expect_same(to_si("151.844 rad/s", "rad/s"), 151.844);
  expect_same(to_si("90 deg/s", "rad/s"), pi / 2);
}

TEST(units, SpeedsThatMayCountTurnsOrRadiansAreRefused) {
  for (const char* speed : {"24.2 1/s", "1450 1/min", "1450 min-1", "24.2 s^-1", "24.2 Bq"})
    EXPECT_NE(refusal(speed, "rad/s").find("turns or radians; write \"1450 rpm\""), std::string::npos)
        << speed;
}

TEST(units, AnotherDimensionIsRefused) {
  EXPECT_NE(
      refusal("210 mm", "Pa").find("\"mm\" is no unit of this quantity (SI unit Pa); write \"206 GPa\""),
      std::string::npos);
  EXPECT_NE(refusal("210 rpm", "1").find("is no unit of this quantity"), std::string::npos);
  EXPECT_NE(refusal("30 rad", "1").find("is no unit of this quantity"), std::string::npos)
      << "an angle is no number";
  EXPECT_NE(refusal("30 %", "rad").find("is no unit of this quantity"), std::string::npos)
      << "nor the reverse";
  EXPECT_NE(refusal("5 s", "1/s").find("is no unit of this quantity"), std::string::npos)
      << "udunits would take 1/5";
  EXPECT_NE(refusal("5 s", "rad/s").find("is no unit of this quantity"), std::string::npos);
  EXPECT_NE(refusal("3 lg(re 1 mW)", "W").find("nit"), std::string::npos) << "decibels are no watts";
  EXPECT_NE(refusal("3 seconds since 2000-01-01", "s").find("nit"), std::string::npos);
}

TEST(units, GarbageIsRefused) {
  for (const char* unit :
       {"mm)", "(mm", "3 mm", "mm 10", "mm/", "/mm", "kgm2", "w", "furlongs per", "mm;", "10^3 m"})
    EXPECT_NE(refusal("30 " + std::string(unit), "m").find("unit"), std::string::npos) << unit;
  for (const char* text : {"", " ", "mm", "--3 mm", "+-3 mm", "about 3 mm", ".", "−3 mm"})
    EXPECT_NE(refusal(text, "m").find("does not begin with a number"), std::string::npos) << text;
  EXPECT_NE(refusal("1,5 mm", "m").find("comma"), std::string::npos);
  EXPECT_NE(refusal("1'500 mm", "m").find("unit"), std::string::npos);
  EXPECT_NE(refusal("0x10 m", "m").find("unit"), std::string::npos);
  EXPECT_NE(refusal("30", "m").find("has no unit; write \"30 mm\", or the number without quotes in m"),
            std::string::npos);
}

TEST(units, WhatIsNotFiniteIsRefused) {
  for (const char* text : {"nan mm", "inf mm", "-inf mm", "1e400 mm"})
    EXPECT_NE(refusal(text, "m").find("is not a finite number"), std::string::npos) << text;
  EXPECT_NE(refusal("1e308 km", "m").find("is not finite in m"), std::string::npos);
}

TEST(units, TheLibraryKeepsSilent) {
  testing::internal::CaptureStderr();
  refusal("3 furlongs per fortnight", "m");
  refusal("3 mm", "Pa");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// In a process of its own, because the database is read once.
TEST(units_deathtest, AStalePathToTheDatabaseIsPassedOver) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto convert_with_stale_path = [] {
    setenv("UDUNITS2_XML_PATH", "/nowhere/udunits2.xml", 1);
    std::exit(to_si("30 mm", "m") == 0.03 ? 0 : 1);
  };
  EXPECT_EXIT(convert_with_stale_path(), testing::ExitedWithCode(0), "");
}

TEST(units, Ratios) {
  EXPECT_EQ(parse_ratio("-1/20"), -1.0 / 20);
  EXPECT_EQ(parse_ratio(" 3 / 4 "), 0.75);
  EXPECT_EQ(parse_ratio("2"), 2);
  for (const char* text :
       {"", "/", "1/", "/20", "1/0", "1/-20", "1:20", "1/20/3", "0.5/2", "1/20 turns", "99999999999"})
    EXPECT_THROW(parse_ratio(text), UnitError) << text;
}

}  // namespace

// The library of materials against values that data sheets quote, and rules that every row keeps.
// Turns red: a digit of a row, a range missing or out of order, strengths of two columns exchanged.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "pipelines/base/names/nearest_name.h"
#include "pipelines/scene/materials/material_library.h"
#include "pipelines/scene/materials/material_report.h"

using namespace pipelines;

namespace {

/// R_e and R_m in MPa at a thickness in mm.
std::pair<double, double> strengths(const std::string& name, double thickness_mm) {
  const auto* range = range_of(*find_material(name), 1e-3 * thickness_mm);
  return range == nullptr ? std::pair(0.0, 0.0) : std::pair(range->yield_Pa / 1e6, range->tensile_Pa / 1e6);
}

using Strengths = std::pair<double, double>;

/// A line of a data sheet: up to a thickness in mm, R_e and R_m in MPa.
struct Line {
  double up_to_mm, yield_MPa, tensile_MPa;
};

/// Every line at its largest thickness and just above that of the line before.
void expect_sheet(const std::string& name, const std::vector<Line>& sheet) {
  double before_mm = 0;
  for (const auto& line : sheet) {
    const Strengths printed(line.yield_MPa, line.tensile_MPa);
    EXPECT_EQ(strengths(name, line.up_to_mm), printed) << name << ' ' << line.up_to_mm;
    EXPECT_EQ(strengths(name, before_mm + 0.1), printed) << name << ' ' << before_mm + 0.1;
    before_mm = line.up_to_mm;
  }
}

}  // namespace

// Data sheet "Saarstahl C45E (Ck45), C45R (Cm45)" by EN 10083: normalised 340, 305, 275 and 620, 580, 560 up
// to 16, 100, 250 mm; quenched and tempered 490, 430, 370 and 700, 650, 630 up to 16, 40, 100 mm.
TEST(Materials, C45IsThatOfItsDataSheet) {
  EXPECT_EQ(strengths("C45+N", 16), Strengths(340, 620));
  EXPECT_EQ(strengths("C45+N", 60), Strengths(305, 580));
  EXPECT_EQ(strengths("C45+N", 101), Strengths(275, 560));
  EXPECT_EQ(strengths("C45+QT", 10), Strengths(490, 700));
  EXPECT_EQ(strengths("C45+QT", 40), Strengths(430, 650));
  EXPECT_EQ(strengths("C45+QT", 40.1), Strengths(370, 630));
  EXPECT_EQ(range_of(*find_material("C45+QT"), 0.1001), nullptr);
}

// R_e of the textbook table "Baustahl" of EN 10025-2 (16, 40, 63, 80 mm): S235 235 225 215 215, S275 275 265
// 255 245, S355 355 345 335 325; S355JR beyond, 295, 285, 275 up to 150, 200, 250 mm (github marthoch,
// EngineeringTools).
TEST(Materials, StructuralSteelsAreThoseOfTheTextbook) {
  const double sizes_mm[] = {16, 40, 63, 80};
  const std::pair<const char*, std::array<double, 4>> rows[] = {
      {"S235", {235, 225, 215, 215}}, {"S275", {275, 265, 255, 245}}, {"S355", {355, 345, 335, 325}}};
  for (const auto& [name, yield_MPa] : rows)
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_EQ(strengths(name, sizes_mm[i]).first, yield_MPa[i]) << name << ' ' << sizes_mm[i];
  EXPECT_EQ(strengths("S355", 150), Strengths(295, 450));
  EXPECT_EQ(strengths("S355", 200), Strengths(285, 450));
  EXPECT_EQ(strengths("S355", 250), Strengths(275, 450));
  EXPECT_EQ(strengths("S235", 3), Strengths(235, 360));
}

// R_m of the textbook table "Vergütungsstahl" of EN 10083-3, above 16 to 40 mm and above 40 to 100 mm; R_e of
// the thinnest bars from a second collection (github, "celik-islah").
TEST(Materials, AlloySteelsAreThoseOfTheTextbook) {
  struct Row {
    const char* name;
    double up_to_40_MPa, up_to_100_MPa;
  };
  for (const auto& row : {Row{"25CrMo4", 800, 700}, Row{"34CrMo4", 900, 800}, Row{"42CrMo4", 1000, 900},
                          Row{"34CrNiMo6", 1100, 1000}}) {
    EXPECT_EQ(strengths(row.name, 30).second, row.up_to_40_MPa) << row.name;
    EXPECT_EQ(strengths(row.name, 60).second, row.up_to_100_MPa) << row.name;
  }
  EXPECT_EQ(strengths("42CrMo4", 16), Strengths(900, 1100));
  EXPECT_EQ(strengths("34CrNiMo6", 16), Strengths(1000, 1200));
}

// E295 and E335 of table 2, "Non-alloy structural steels according to European standard", of a catalogue of
// rolled sections (Polish, English, Czech), which ends at 125 mm.
TEST(Materials, EngineeringSteelsAreThoseOfTheSectionsCatalogue) {
  expect_sheet(
      "E295",
      {{16, 295, 470}, {40, 285, 470}, {63, 275, 470}, {80, 265, 470}, {100, 255, 470}, {125, 245, 450}});
  expect_sheet(
      "E335",
      {{16, 335, 570}, {40, 325, 570}, {63, 315, 570}, {80, 305, 570}, {100, 295, 570}, {125, 275, 550}});
}

// Saarstahl, "C60" by EN 10083, normalised.
TEST(Materials, C60IsThatOfItsDataSheet) {
  expect_sheet("C60+N", {{16, 380, 710}, {100, 340, 670}, {250, 310, 650}});
}

// Lucefin Group, technical card "25CrMo4"; Granit Engineering, sheet "34CrMo4", both by EN 10083-3:2006;
// Saarstahl, "42CrMo4 - 42CrMoS4", and Lucefin Group, technical card "42CrMo4", which agree.
TEST(Materials, ThickAlloySteelsAreThoseOfTheirDataSheets) {
  expect_sheet("25CrMo4+QT", {{16, 700, 900}, {40, 600, 800}, {100, 450, 700}, {160, 400, 650}});
  expect_sheet("34CrMo4+QT",
               {{16, 800, 1000}, {40, 650, 900}, {100, 550, 800}, {160, 500, 750}, {250, 450, 700}});
  expect_sheet("42CrMo4+QT",
               {{16, 900, 1100}, {40, 750, 1000}, {100, 650, 900}, {160, 550, 800}, {250, 500, 750}});
}

// R_m expected in a casting of EN-GJL-250: foundry Brackelsberg, table "Grauguss" by DIN EN 1561, and
// Modelleria Zuin, "Pig iron" by UNI EN 1561, which agree.
TEST(Materials, GreyIronIsThatOfTheFoundries) {
  const std::pair<double, double> sheet[] = {{10, 250}, {20, 225}, {40, 195}, {80, 170}, {150, 155}};
  for (const auto& [up_to_mm, tensile_MPa] : sheet)
    EXPECT_EQ(strengths("EN-GJL-250", up_to_mm).second, tensile_MPa) << up_to_mm;
}

// Extruded bars by EN 755-2: extruder's sheet "Extrusion aluminium alloy EN AW-6082"; Euralliage, "7075".
TEST(Materials, AluminiumBarsAreThoseOfTheirDataSheets) {
  expect_sheet("EN AW-6082 T6", {{20, 250, 295}, {150, 260, 310}, {200, 240, 280}, {250, 200, 270}});
  expect_sheet("EN AW-7075 T6", {{25, 480, 540}, {100, 500, 560}});
}

// R_m of GS 45 or GE 240, R_e and R_m of GS 60 or GE 300, thin: a foundry's table "Stahlguss für allgemeine
// Verwendung", which has R_e 230 of DIN 1681 for the former.
TEST(Materials, CastSteelsAreThoseOfTheFoundry) {
  EXPECT_EQ(strengths("GE240", 30).second, 450);
  EXPECT_EQ(strengths("GE300", 30), Strengths(300, 600));
}

// 1.4301 by EN 10088-3 (dealer innorat.ch): 190 and 500. Ductile iron by EN 1563 (iron-foundry.com): 250 and
// 400, 320 and 500.
TEST(Materials, OthersAreThoseOfTheirDealers) {
  EXPECT_EQ(strengths("1.4301", 160), Strengths(190, 500));
  EXPECT_EQ(strengths("EN-GJS-400-15", 20), Strengths(250, 400));
  EXPECT_EQ(strengths("EN-GJS-500-7", 20), Strengths(320, 500));
  EXPECT_EQ(strengths("G20Mn5+QT", 60).first, 300);
}

TEST(Materials, EveryRowIsSound) {
  std::set<std::string> names;
  for (const auto& material : material_library()) {
    EXPECT_EQ(find_material(material.name), &material);
    EXPECT_TRUE(names.insert(material.name).second) << material.name;
    for (const auto& alias : material.aliases) {
      EXPECT_TRUE(names.insert(alias).second) << alias;
      EXPECT_EQ(find_material(alias), &material) << alias;
    }
    ASSERT_FALSE(material.ranges.empty()) << material.name;
    double before_m = 0;
    for (const auto& range : material.ranges) {
      EXPECT_GT(range.up_to_m, before_m) << material.name;
      EXPECT_GT(range.yield_Pa, 90e6) << material.name;
      EXPECT_LT(range.yield_Pa, range.tensile_Pa) << material.name;
      EXPECT_NO_THROW(require_sound({material.group, range.tensile_Pa, range.yield_Pa, {}}));
      EXPECT_EQ(range_of(material, range.up_to_m), &range) << material.name;
      before_m = range.up_to_m;
    }
    // Sound runs along bars of all these metals at 3.5 to 5.3 km/s.
    const double speed_m_s = std::sqrt(material.youngs_modulus_Pa / material.density_kg_m3);
    EXPECT_GT(speed_m_s, 3500) << material.name;
    EXPECT_LT(speed_m_s, 5300) << material.name;
    EXPECT_GT(material.poisson_ratio, 0.25) << material.name;
    EXPECT_LT(material.poisson_ratio, 0.34) << material.name;
    EXPECT_EQ(material.standard.rfind("EN ", 0), 0u) << material.name;
  }
}

TEST(Materials, NamesAreFound) {
  EXPECT_EQ(find_material("s355")->name, "S355J2");
  EXPECT_EQ(find_material("EN AW 6082"), nullptr);
  EXPECT_EQ(find_material("EN AW-6082T6")->name, "EN AW-6082 T6");
  EXPECT_EQ(find_material(""), nullptr);
  EXPECT_EQ(near_materials("S355J3").front(), "S355J2");
  EXPECT_EQ(near_materials("42CrMo").front(), "42CrMo4+QT");
  EXPECT_EQ(near_materials("C45+C").front(), "C45+N");
  EXPECT_TRUE(near_materials("unobtainium").empty());
}

TEST(Materials, RangesHaveWords) {
  const auto& steel = *find_material("S355");
  EXPECT_EQ(range_text(steel, *range_of(steel, 0.016)), "up to 16 mm");
  EXPECT_EQ(range_text(steel, *range_of(steel, 0.0161)), "above 16 to 40 mm");
  EXPECT_EQ(weakest_range(steel).tensile_Pa, 450e6);
  const auto text = materials_text({steel});
  EXPECT_NE(text.find("S355J2                0-16      355      470"), std::string::npos) << text;
  EXPECT_NE(materials_json({steel}).find("\"yield_strength_Pa\": 355000000.0"), std::string::npos);
}

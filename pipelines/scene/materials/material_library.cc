#include "pipelines/scene/materials/material_library.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

#include "pipelines/base/names/nearest_name.h"

namespace pipelines {
namespace {

/// Thickness in mm, R_e and R_m in MPa, as the standards print them.
struct PrintedRange {
  double up_to_mm, yield_MPa, tensile_MPa;
};

std::vector<StrengthRange> in_si(const std::vector<PrintedRange>& printed) {
  std::vector<StrengthRange> ranges;
  for (const auto& row : printed)
    ranges.push_back({row.up_to_mm * 1e-3, row.yield_MPa * 1e6, row.tensile_MPa * 1e6});
  return ranges;
}

LibraryMaterial ferritic_steel(const char* name, std::vector<std::string> aliases, const char* standard,
                               const std::vector<PrintedRange>& printed) {
  return {name, std::move(aliases), standard, 210e9, 0.3, 7850, MaterialGroup::steel, in_si(printed)};
}

void add_structural_steels(std::vector<LibraryMaterial>& all) {
  const char* const standard = "EN 10025-2";
  all.push_back(ferritic_steel(
      "S235JR", {"S235", "S235J2", "1.0038", "St 37-2"}, standard,
      {{16, 235, 360}, {40, 225, 360}, {100, 215, 360}, {150, 195, 350}, {200, 185, 340}, {250, 175, 340}}));
  all.push_back(ferritic_steel("S275JR", {"S275", "S275J2", "1.0044", "St 44-2"}, standard,
                               {{16, 275, 410},
                                {40, 265, 410},
                                {63, 255, 410},
                                {80, 245, 410},
                                {100, 235, 410},
                                {150, 225, 400},
                                {200, 215, 380},
                                {250, 205, 380}}));
  all.push_back(ferritic_steel("S355J2", {"S355", "S355JR", "1.0577", "St 52-3"}, standard,
                               {{16, 355, 470},
                                {40, 345, 470},
                                {63, 335, 470},
                                {80, 325, 470},
                                {100, 315, 470},
                                {150, 295, 450},
                                {200, 285, 450},
                                {250, 275, 450}}));
  all.push_back(ferritic_steel("E295", {"1.0050", "St 50-2"}, standard,
                               {{16, 295, 470},
                                {40, 285, 470},
                                {63, 275, 470},
                                {80, 265, 470},
                                {100, 255, 470},
                                {150, 245, 450},
                                {200, 235, 440},
                                {250, 225, 440}}));
  all.push_back(ferritic_steel("E335", {"1.0060", "St 60-2"}, standard,
                               {{16, 335, 570},
                                {40, 325, 570},
                                {63, 315, 570},
                                {80, 305, 570},
                                {100, 295, 570},
                                {150, 275, 550},
                                {200, 265, 540},
                                {250, 255, 540}}));
}

void add_heat_treatable_steels(std::vector<LibraryMaterial>& all) {
  const char* const unalloyed = "EN 10083-2";
  const char* const alloyed = "EN 10083-3";
  all.push_back(ferritic_steel("C35+N", {"C35", "C35E+N", "1.0501"}, unalloyed,
                               {{16, 300, 550}, {100, 270, 520}, {250, 245, 500}}));
  all.push_back(ferritic_steel("C45+N", {"C45", "C45E", "C45E+N", "1.0503", "1.1191"}, unalloyed,
                               {{16, 340, 620}, {100, 305, 580}, {250, 275, 560}}));
  all.push_back(ferritic_steel("C60+N", {"C60", "C60E+N", "1.0601"}, unalloyed,
                               {{16, 380, 710}, {100, 340, 670}, {250, 310, 650}}));
  all.push_back(
      ferritic_steel("C45+QT", {"C45E+QT"}, unalloyed, {{16, 490, 700}, {40, 430, 650}, {100, 370, 630}}));
  all.push_back(ferritic_steel("25CrMo4+QT", {"25CrMo4", "1.7218"}, alloyed,
                               {{16, 700, 900}, {40, 600, 800}, {100, 450, 700}, {160, 400, 650}}));
  all.push_back(
      ferritic_steel("34CrMo4+QT", {"34CrMo4", "1.7220"}, alloyed,
                     {{16, 800, 1000}, {40, 650, 900}, {100, 550, 800}, {160, 500, 750}, {250, 450, 700}}));
  all.push_back(
      ferritic_steel("42CrMo4+QT", {"42CrMo4", "1.7225"}, alloyed,
                     {{16, 900, 1100}, {40, 750, 1000}, {100, 650, 900}, {160, 550, 800}, {250, 500, 750}}));
  all.push_back(ferritic_steel(
      "34CrNiMo6+QT", {"34CrNiMo6", "1.6582"}, alloyed,
      {{16, 1000, 1200}, {40, 900, 1100}, {100, 800, 1000}, {160, 700, 900}, {250, 600, 800}}));
}

void add_stainless_steels(std::vector<LibraryMaterial>& all) {
  all.push_back({"X5CrNi18-10",
                 {"1.4301"},
                 "EN 10088-3",
                 200e9,
                 0.3,
                 7900,
                 MaterialGroup::stainless_steel,
                 in_si({{250, 190, 500}})});
}

void add_castings(std::vector<LibraryMaterial>& all) {
  all.push_back({"EN-GJL-250",
                 {"GJL-250", "GG-25", "EN-JL1040"},
                 "EN 1561",
                 103e9,
                 0.26,
                 7200,
                 MaterialGroup::grey_cast_iron,
                 in_si({{10, 162, 250}, {20, 146, 225}, {40, 126, 195}, {80, 110, 170}, {150, 100, 155}})});
  all.push_back({"EN-GJS-400-15",
                 {"GJS-400-15", "GGG-40", "EN-JS1030"},
                 "EN 1563",
                 169e9,
                 0.275,
                 7100,
                 MaterialGroup::ductile_cast_iron,
                 in_si({{30, 250, 400}, {60, 250, 390}, {200, 240, 370}})});
  all.push_back({"EN-GJS-500-7",
                 {"GJS-500-7", "GGG-50", "EN-JS1050"},
                 "EN 1563",
                 169e9,
                 0.275,
                 7100,
                 MaterialGroup::ductile_cast_iron,
                 in_si({{30, 320, 500}, {60, 300, 450}, {200, 290, 420}})});
  all.push_back({"GE240+N",
                 {"GE240", "GS-45", "1.0446"},
                 "EN 10293",
                 210e9,
                 0.3,
                 7850,
                 MaterialGroup::cast_steel,
                 in_si({{300, 240, 450}})});
  all.push_back({"GE300+N",
                 {"GE300", "GS-60", "1.0558"},
                 "EN 10293",
                 210e9,
                 0.3,
                 7850,
                 MaterialGroup::cast_steel,
                 in_si({{30, 300, 600}, {100, 300, 520}})});
  all.push_back({"G20Mn5+N",
                 {"G20Mn5", "1.6220"},
                 "EN 10293",
                 210e9,
                 0.3,
                 7850,
                 MaterialGroup::cast_steel,
                 in_si({{30, 300, 480}})});
  all.push_back(
      {"G20Mn5+QT", {}, "EN 10293", 210e9, 0.3, 7850, MaterialGroup::cast_steel, in_si({{100, 300, 500}})});
}

void add_aluminium_alloys(std::vector<LibraryMaterial>& all) {
  all.push_back({"EN AW-5083 H111",
                 {"EN AW-5083", "5083-H111", "AlMg4.5Mn0.7"},
                 "EN 755-2",
                 70e9,
                 0.3,
                 2700,
                 MaterialGroup::wrought_aluminium,
                 in_si({{200, 110, 270}})});
  all.push_back({"EN AW-6082 T6",
                 {"EN AW-6082", "6082-T6", "AlSi1MgMn"},
                 "EN 755-2",
                 70e9,
                 0.3,
                 2700,
                 MaterialGroup::wrought_aluminium,
                 in_si({{20, 250, 295}, {150, 260, 310}, {200, 240, 280}, {250, 200, 270}})});
  all.push_back({"EN AW-7075 T6",
                 {"EN AW-7075", "7075-T6", "AlZn5.5MgCu"},
                 "EN 755-2",
                 71.7e9,
                 0.33,
                 2810,
                 MaterialGroup::wrought_aluminium,
                 in_si({{25, 480, 540}, {100, 500, 560}})});
}

/// Lower case without spaces, in which names are compared.
std::string plain(const std::string& name) {
  std::string result;
  for (const unsigned char c : name)
    if (std::isspace(c) == 0) result += char(std::tolower(c));
  return result;
}

bool begins(const std::string& name, const std::string& with) {
  return !with.empty() && name.compare(0, with.size(), with) == 0;
}

}  // namespace

const std::vector<LibraryMaterial>& material_library() {
  static const std::vector<LibraryMaterial> library = [] {
    std::vector<LibraryMaterial> all;
    add_structural_steels(all);
    add_heat_treatable_steels(all);
    add_stainless_steels(all);
    add_castings(all);
    add_aluminium_alloys(all);
    return all;
  }();
  return library;
}

const LibraryMaterial* find_material(const std::string& name) {
  const auto wanted = plain(name);
  for (const auto& material : material_library()) {
    if (plain(material.name) == wanted) return &material;
    for (const auto& alias : material.aliases)
      if (plain(alias) == wanted) return &material;
  }
  return nullptr;
}

std::vector<std::string> near_materials(const std::string& name) {
  constexpr std::size_t most = 3;
  constexpr std::size_t shortest_beginning = 3;
  std::vector<std::string> names, result;
  for (const auto& material : material_library()) {
    names.push_back(material.name);
    names.insert(names.end(), material.aliases.begin(), material.aliases.end());
  }
  const auto add = [&](const std::string& near) {
    if (result.size() < most && std::find(result.begin(), result.end(), near) == result.end())
      result.push_back(near);
  };
  if (const auto nearest = nearest_name(name, names); !nearest.empty()) add(find_material(nearest)->name);
  const auto wanted = plain(name);
  if (wanted.size() >= shortest_beginning)
    for (const auto& known : names)
      if (begins(plain(known), wanted) || begins(wanted, plain(known))) add(find_material(known)->name);
  return result;
}

const StrengthRange* range_of(const LibraryMaterial& material, double thickness_m) {
  constexpr double rounding = 1e-9;
  for (const auto& range : material.ranges)
    if (thickness_m <= range.up_to_m * (1 + rounding)) return &range;
  return nullptr;
}

const StrengthRange& weakest_range(const LibraryMaterial& material) {
  return *std::min_element(material.ranges.begin(), material.ranges.end(),
                           [](const auto& a, const auto& b) { return a.tensile_Pa < b.tensile_Pa; });
}

std::string range_text(const LibraryMaterial& material, const StrengthRange& range) {
  const StrengthRange* before = nullptr;
  for (const auto& other : material.ranges)
    if (other.up_to_m < range.up_to_m) before = &other;
  return before == nullptr ? fmt::format("up to {:g} mm", 1e3 * range.up_to_m)
                           : fmt::format("above {:g} to {:g} mm", 1e3 * before->up_to_m, 1e3 * range.up_to_m);
}

}  // namespace pipelines

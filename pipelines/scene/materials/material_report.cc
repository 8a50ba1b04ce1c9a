#include "pipelines/scene/materials/material_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace pipelines {
namespace {

std::string thickness_mm(const LibraryMaterial& material, std::size_t i) {
  const double from_mm = i == 0 ? 0 : 1e3 * material.ranges[i - 1].up_to_m;
  return fmt::format("{:g}-{:g}", from_mm, 1e3 * material.ranges[i].up_to_m);
}

}  // namespace

std::string materials_text(const std::vector<LibraryMaterial>& materials) {
  auto text = fmt::format("{:<16} {:>9} {:>8} {:>8} {:>6} {:>8}  {:<18} {:<11} {}\n", "name", "size mm",
                          "R_e MPa", "R_m MPa", "E GPa", "kg/m3", "group", "source", "other names");
  for (const auto& material : materials)
    for (std::size_t i = 0; i < material.ranges.size(); ++i) {
      const auto& range = material.ranges[i];
      auto row = fmt::format("{:<16} {:>9} {:>8.0f} {:>8.0f}", i == 0 ? material.name : "",
                             thickness_mm(material, i), range.yield_Pa / 1e6, range.tensile_Pa / 1e6);
      std::string others;
      for (const auto& alias : material.aliases) others += (others.empty() ? "" : ", ") + alias;
      if (i == 0)
        row +=
            fmt::format(" {:>6g} {:>8g}  {:<18} {:<11} {}", material.youngs_modulus_Pa / 1e9,
                        material.density_kg_m3, constants_of(material.group).name, material.standard, others);
      row.erase(row.find_last_not_of(' ') + 1);
      text += row + "\n";
    }
  return text +
         "sizes: diameter of solid bars, thickness of plates and walls, above the first to the second; "
         "strengths: minimum values of the source\n";
}

std::string materials_json(const std::vector<LibraryMaterial>& materials) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& material : materials) {
    nlohmann::ordered_json json;
    json["name"] = material.name;
    json["aliases"] = material.aliases;
    json["group"] = constants_of(material.group).name;
    json["youngs_modulus_Pa"] = material.youngs_modulus_Pa;
    json["poisson_ratio"] = material.poisson_ratio;
    json["density_kg_m3"] = material.density_kg_m3;
    json["source"] = material.standard;
    double above_m = 0;
    for (const auto& range : material.ranges) {
      json["strengths"].push_back({{"above_m", above_m},
                                   {"up_to_m", range.up_to_m},
                                   {"yield_strength_Pa", range.yield_Pa},
                                   {"tensile_strength_Pa", range.tensile_Pa}});
      above_m = range.up_to_m;
    }
    list.push_back(std::move(json));
  }
  return nlohmann::ordered_json{{"materials", list}}.dump(2) + "\n";
}

}  // namespace pipelines

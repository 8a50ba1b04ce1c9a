#include "pipelines/base/fatigue/weld_classes.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>

#include "pipelines/base/fatigue/weld_fatigue.h"

namespace pipelines {
namespace {

constexpr double MPa = 1e6;
constexpr std::array<int, 13> classes_MPa = {36, 40, 45, 50, 56, 63, 71, 80, 90, 100, 112, 125, 160};

}  // namespace

const std::vector<WeldType>& weld_types() {
  using namespace thickness_exponent;
  static const std::vector<WeldType> types = {
      {"load-carrying", fat_load_carrying_fillet_Pa, cruciform_or_attachment},
      {"non-load-carrying", fat_non_load_carrying_Pa, cruciform_or_attachment},
      {"butt", fat_non_load_carrying_Pa, transverse_butt},
      {"full penetration", fat_non_load_carrying_Pa, cruciform_or_attachment}};
  return types;
}

const WeldType* weld_type(const std::string& name) {
  const auto& types = weld_types();
  const auto found = std::find_if(types.begin(), types.end(), [&](const auto& t) { return t.name == name; });
  return found == types.end() ? nullptr : &*found;
}

double thickness_exponent_of(const std::string& name) {
  const auto* const type = weld_type(name);
  return type ? type->thickness_exponent : thickness_exponent::cruciform_or_attachment;
}

double fat_of_notch_Pa(double radius_m) {
  return (radius_m < notch_radius_m ? 630 : 225) * MPa;
}

bool is_fat_class(double fat_Pa) {
  constexpr double rounding = 1e-9;
  return std::any_of(classes_MPa.begin(), classes_MPa.end(),
                     [&](int known) { return std::abs(fat_Pa - known * MPa) <= rounding * fat_Pa; });
}

std::string fat_classes_text() {
  std::string text = "FAT ";
  for (const int known : classes_MPa) text += fmt::format("{}{}", known == classes_MPa[0] ? "" : ", ", known);
  return text;
}

std::optional<double> fat_of_text(const std::string& text) {
  static const std::regex form(R"(\s*FAT\s*([0-9]{1,4})\s*)", std::regex::icase);
  std::smatch match;
  if (!std::regex_match(text, match, form)) return std::nullopt;
  return std::stod(match[1]) * MPa;
}

}  // namespace pipelines

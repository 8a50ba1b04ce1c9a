#include <algorithm>
#include <array>

#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/base/names/units.h"
#include "pipelines/scene/reader/scene_stages.h"

namespace pipelines {

RequestedAccuracy read_requested_accuracy(SceneTable& root) {
  RequestedAccuracy accuracy;
  for (const char* key : {"tolerance", "time_limit"}) root.know(key);
  if (root.has("tolerance") && root.holds("tolerance", "none"))
    accuracy.once = true;
  else if (root.has("tolerance"))
    accuracy.tolerance = root.quantity("tolerance", "1", between(least_tolerance, largest_tolerance));
  if (accuracy.once && root.has("time_limit"))
    root.refuse("time_limit", "has no use with tolerance = \"none\", which solves once; remove one of them");
  if (root.has("time_limit")) accuracy.time_limit_s = root.quantity("time_limit", "s", positive(1e7));
  return accuracy;
}

/// "50 % of peak", "40 % of yield"
ZoneRule read_zones(SceneTable zones) {
  ZoneRule rule;
  const std::string level = zones.text_or("level", "50 % of peak", "where a zone begins");
  if (!level.empty()) {
    const std::string remedy =
        "is no level; write a share above 0 and up to 100 %, such as \"50 % of peak\" or \"40 % of yield\"";
    const auto of = level.find(" of ");
    const std::string whole = of == std::string::npos ? "" : level.substr(of + 4);
    try {
      rule.share = to_si(level.substr(0, of), "1");
      if (!(rule.share > 0 && rule.share <= 1) || (whole != "peak" && whole != "yield"))
        zones.refuse("level", remedy);
    } catch (const UnitError&) {
      zones.refuse("level", remedy);
    }
    rule.reference = whole == "yield" ? ZoneRule::Reference::yield : ZoneRule::Reference::peak;
  }
  zones.finish();
  return rule;
}

namespace {

/// Lubrication of a bearing: all three keys, or none.
std::optional<kinetics::Lubrication> read_lubrication(SceneTable& table) {
  const std::array<const char*, 3> keys = {"viscosity_ratio", "contamination_factor", "fatigue_load_limit"};
  for (const char* key : keys) table.know(key);
  if (std::none_of(keys.begin(), keys.end(), [&](const char* key) { return table.has(key); }))
    return std::nullopt;
  return kinetics::Lubrication{table.quantity("viscosity_ratio", "1", {0.1, 100}),
                               table.quantity("contamination_factor", "1", {0, 1, true}),
                               table.quantity("fatigue_load_limit", "N", positive(1e9))};
}

}  // namespace

std::vector<BearingScene> read_bearings(SceneTable& root) {
  std::vector<BearingScene> bearings;
  for (SceneTable& table : root.tables_if_any("bearings")) {
    BearingScene bearing;
    bearing.name = table.name("name");
    bearing.load = table.text("load");
    bearing.share = table.quantity_or("share", "1", {0, 1, true}, 1, "the bearing carries the whole load");
    bearing.dynamic_rating_N = table.quantity("dynamic_rating", "N", positive(1e9));
    const std::string element = table.text("element");
    if (element == "roller")
      bearing.element = kinetics::RollingElement::roller;
    else if (!element.empty() && element != "ball")
      table.refuse("element", "unknown rolling element; write \"ball\" or \"roller\"");
    bearing.reliability = table.quantity_if_given("reliability", "1", {0.9, 0.9995});
    bearing.required_life_s = table.quantity_if_given("required_life", "s", positive(1e12));
    bearing.static_rating_N = table.quantity_if_given("static_rating", "N", positive(1e9));
    bearing.lubrication = read_lubrication(table);
    bearing.speed_rad_s = table.quantity_if_given("speed", "rad/s", positive(1e6));
    table.finish();
    bearings.push_back(std::move(bearing));
  }
  return bearings;
}

LimitsScene read_limits(SceneTable table) {
  LimitsScene limits;
  limits.yield_safety = table.quantity_or("yield_safety", "1", between(1, 10), limits.yield_safety,
                                          "FKM: severe consequences, the load is likely (j_p)");
  limits.wanted_life_s = table.quantity_or("wanted_life", "s", positive(1e12), limits.wanted_life_s,
                                           "20000 h: a machine that works eight hours a day at full load");
  limits.dynamic_amplification =
      table.quantity_or("dynamic_amplification", "1", between(1, 50), limits.dynamic_amplification,
                        "what resonance may put on the largest stress");
  limits.resonance_margin =
      table.quantity_or("resonance_margin", "1", between(0, 0.9), limits.resonance_margin,
                        "of a drive train's excitations from its frequencies (API 671)");
  if (!table.is_given("left_out")) {
    table.finish();
    return limits;
  }
  for (const auto& criterion : table.texts("left_out")) {
    if (!contains(names_of_criteria(), criterion.text))
      table.refuse("left_out", "\"" + criterion.text + "\" is no criterion; the verdict weighs " +
                                   listed(names_of_criteria()));
    limits.left_out.push_back(criterion.text);
  }
  table.finish();
  return limits;
}

void read_results(SceneTable results, Scene& scene) {
  scene.snapshots = results.count_or("snapshots", 0, 3600, 12, "over the turn that contains the peak");
  scene.pictures = results.flag_or("pictures", true, "of the envelope, as PNG");
  const std::string keep =
      results.text_or("keep", "results", "unit responses are in the user's cache (millstress cache)");
  if (keep == "all")
    scene.keep = Keep::all;
  else if (keep == "report")
    scene.keep = Keep::report;
  else if (keep != "results" && !keep.empty())
    results.refuse(
        "keep",
        "write \"results\", \"all\" for unit responses and loads.csv too, or \"report\" for summary.json and "
        "report.html alone");
  results.finish();
}

}  // namespace pipelines

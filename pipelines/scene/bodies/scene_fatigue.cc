#include "pipelines/scene/bodies/scene_fatigue.h"

#include <fmt/core.h>

#include <regex>
#include <stdexcept>

#include "pipelines/base/fatigue/endurance.h"
#include "pipelines/base/fatigue/weld_classes.h"
#include "pipelines/base/names/nearest_name.h"

namespace pipelines {
namespace {

std::vector<std::string> group_names() {
  std::vector<std::string> names;
  for (const auto& group : material_groups()) names.emplace_back(group.name);
  return names;
}

void read_group(SceneTable& table, MaterialGroup of_material, FatigueScene& fatigue) {
  const auto name =
      table.text_or("group", constants_of(of_material).name, "material group of the FKM guideline");
  if (name.empty()) return;
  const auto names = group_names();
  for (const auto& group : material_groups())
    if (name == group.name) {
      fatigue.material.group = group.group;
      return;
    }
  table.refuse("group", "is no material group; write one of " + listed(names));
}

/// Whether strengths were read that a material can have; else an error tells of them.
bool is_readable(const FatigueMaterial& material) {
  return material.yield_strength_Pa > 0 && material.tensile_strength_Pa >= material.yield_strength_Pa;
}

/// Beyond 1.21, that of the thinnest grey iron, and below 0.5 FKM and DIN 743 have no factor.
void read_size(SceneTable& table, FatigueScene& fatigue) {
  auto& material = fatigue.material;
  fatigue.size_factor = table.quantity_or("size_factor", "1", between(0.5, 1.25), 1,
                                          "K_d; tensile_strength is that of the part, at its size");
  const bool is_told = !is_readable(material);
  if (!(fatigue.size_factor > 0)) return;  // told already
  material.tensile_strength_Pa *= fatigue.size_factor;
  if (!is_told && !is_readable(material))
    table.refuse(
        "size_factor",
        "makes the tensile strength less than the material's yield_strength; give the yield strength "
        "of the part's size too, or a larger factor");
}

/// The rules have ranges of their own: strengths that a group never has.
void try_rules(SceneTable& table, const FatigueScene& fatigue) {
  if (!is_readable(fatigue.material) || !(fatigue.roughness_m > 0) || !(fatigue.treatment > 0)) return;
  SurfaceState surface;
  surface.roughness_m = fatigue.roughness_m;
  surface.treatment_factor = fatigue.treatment;
  try {
    endurance_limit(fatigue.material, StressKind::normal, 0, surface, {}, 1);
  } catch (const std::invalid_argument& error) {
    table.refuse("tensile_strength", std::string("the group's rules refuse it: ") + error.what());
  }
}

/// j_D of the FKM guideline by consequences of a failure, inspection, and casting.
void read_safety(SceneTable& table, FatigueScene& fatigue) {
  table.know("safety_factor");
  const auto consequences = table.text_or("consequences", "severe", "of a failure");
  const bool inspected = table.flag_or("inspected", false, "no regular inspection");
  if (!consequences.empty() && consequences != "severe" && consequences != "moderate")
    table.refuse("consequences", "write \"severe\" or \"moderate\"");
  const bool is_cast = constants_of(fatigue.material.group).is_cast;
  bool tested = false;
  table.know("casting_tested");
  if (is_cast)
    tested = table.flag_or("casting_tested", false, "not every casting is tested");
  else if (table.has("casting_tested"))
    table.refuse("casting_tested", "the group is no casting; remove it, or name a cast group");
  if (!table.has("safety_factor")) {
    if (!is_readable(fatigue.material)) return;  // told already
    fatigue.safety = required_safety(
        fatigue.material, consequences == "moderate" ? Consequences::moderate : Consequences::severe,
        inspected ? Inspection::regular : Inspection::none,
        !is_cast ? Casting::not_cast
        : tested ? Casting::tested
                 : Casting::untested);
    fatigue.safety_reason = fmt::format("FKM: {} consequences, {}{}", consequences,
                                        inspected ? "regular inspection" : "no inspection",
                                        !is_cast ? ""
                                        : tested ? ", tested casting"
                                                 : ", untested casting");
    return;
  }
  fatigue.safety = table.quantity("safety_factor", "1", between(1, 10));
  fatigue.safety_reason = "of the scene";
  for (const char* other : {"consequences", "inspected", "casting_tested"})
    if (table.has(other))
      table.refuse("safety_factor",
                   "stands beside " + std::string(other) + ", which gives one too; remove one");
}

std::string type_names() {
  std::vector<std::string> names;
  for (const auto& type : weld_types()) names.emplace_back(type.name);
  return listed(names);
}

bool begins_with_fat(const std::string& as_written) {
  return std::regex_search(as_written, std::regex(R"(^["']\s*FAT)", std::regex::icase));
}

/// "FAT 90" or a range.
double read_class(SceneTable& table) {
  if (!begins_with_fat(table.written_at("class").as_written))
    return table.quantity("class", "Pa", between(10e6, 200e6));
  const auto fat_Pa = fat_of_text(table.text("class"));
  if (fat_Pa && is_fat_class(*fat_Pa)) return *fat_Pa;
  table.refuse("class", "is no FAT class; IIW has " + fat_classes_text() + " for steel, of hot-spot stress " +
                            "90 and 100; write one of them, or a range in MPa that was measured");
  return WeldToeScene().class_Pa;
}

/// Type or class; what is not written stays.
void read_class_or_type(SceneTable& table, WeldToeScene& toe) {
  for (const char* key : {"type", "class"}) table.know(key);
  if (table.has("type") && table.has("class"))
    table.refuse("class", "stands beside type, which gives the class; remove one");
  if (table.has("type")) {
    const auto name = table.text("type");
    if (const auto* type = weld_type(name)) {
      toe.type = type->name;
      toe.class_Pa = type->fat_Pa;
    } else if (!name.empty())
      table.refuse("type", "is no type of weld; write one of " + type_names());
  } else if (table.has("class")) {
    toe.type.clear();
    toe.class_Pa = read_class(table);
  } else if (!toe.type.empty())
    table.record_default("type", "\"" + toe.type + "\"",
                         fmt::format("FAT {:.0f} of structural hot-spot stress (IIW)", toe.class_Pa / 1e6));
}

void read_toe(SceneTable& table, WeldToeScene& toe) {
  read_class_or_type(table, toe);
  toe.partial_factor = table.quantity_or("partial_factor", "1", between(1, 2), toe.partial_factor,
                                         "gamma_M; 1.35: safe life, severe consequences (Eurocode 3-1-9)");
}

void read_toes(SceneTable& table, FatigueScene& fatigue) {
  auto welds = table.table_or_empty("welds");
  read_toe(welds, fatigue.toes);
  for (SceneTable& entry : welds.tables_if_any("toes")) {
    WeldToeScene toe = fatigue.toes;
    const auto name = entry.text("name");
    read_toe(entry, toe);
    if (!entry.has("type") && !entry.has("class") && !entry.has("partial_factor"))
      entry.refuse("name",
                   "is a toe of which nothing is said; give it a type, a class or a "
                   "partial_factor, or remove the entry");
    toe.origin = entry.origin();
    if (!name.empty() && !fatigue.toes_by_name.emplace(name, toe).second)
      entry.refuse("name", "has an entry already; give each weld toe one");
    entry.finish();
  }
  welds.finish();
}

}  // namespace

namespace {

/// R_m of the table, or of the material.
void read_tensile_strength(SceneTable& table, const KnownStrength& strength, FatigueScene& fatigue) {
  auto& tensile_Pa = fatigue.material.tensile_strength_Pa;
  if (table.is_given("tensile_strength") || !strength.why_none.empty()) {
    tensile_Pa = table.quantity("tensile_strength", "Pa", between(1e7, 3e9));
  } else {
    tensile_Pa = strength.tensile_Pa;
    fatigue.strength_source = strength.source;
    if (tensile_Pa > 0)
      table.record_default("tensile_strength", fmt::format("{:g} MPa", tensile_Pa / 1e6),
                           strength.source.empty() ? "that of the material" : strength.source);
  }
  if (tensile_Pa < fatigue.material.yield_strength_Pa)
    table.refuse("tensile_strength", "is below the material's yield_strength; correct one of them");
}

bool has_welds(const BodyScene& body) {
  const auto* part = std::get_if<meshes::Import>(&body.shape);
  return std::holds_alternative<ChamberShape>(body.shape) ||
         (part != nullptr && !(part->welds.empty() && part->notches.empty()));
}

FatigueScene read_rules(SceneTable& table, const KnownStrength& strength, const BodyScene& body) {
  FatigueScene fatigue;
  fatigue.material.yield_strength_Pa = body.yield_strength_Pa;
  read_tensile_strength(table, strength, fatigue);
  read_size(table, fatigue);
  read_group(table, strength.group, fatigue);
  fatigue.material.elongation = table.quantity_if_given("elongation", "1", between(0, 1));
  fatigue.roughness_m = table.quantity_or("roughness", "m", {1e-7, 1e-3}, 25e-6, "R_z of a turned surface");
  fatigue.treatment = table.quantity_or("surface_treatment", "1", between(0.5, 3), 1, "none (K_V)");
  read_safety(table, fatigue);
  fatigue.reliability =
      table.quantity_or("reliability", "1", between(0.5, 0.999999), 0.975, "of the guideline's strengths");
  fatigue.endurance_Pa = table.quantity_if_given("endurance_limit", "Pa", between(1e6, 3e9));
  fatigue.wanted_life_s = table.quantity_if_given("wanted_life", "s", positive(1e12));
  if (has_welds(body)) read_toes(table, fatigue);
  try_rules(table, fatigue);
  return fatigue;
}

/// Judges fatigue without a table, by defaults alone, which refuse nothing.
void judge_by_default(const KnownStrength& strength, bool has_run_up, BodyScene& body,
                      SceneFindings& findings) {
  static const TomlNode no_keys;
  SceneFindings own;
  own.are_noted = findings.are_noted;
  SceneTable table(no_keys, body.name + ".fatigue", own);
  if (has_run_up)
    body.fatigue_missing = "fatigue is judged for steady running, and this is a run-up";
  else if (!strength.why_none.empty())
    body.fatigue_missing = strength.why_none;
  else if (strength.tensile_Pa > 0 && body.yield_strength_Pa > 0) {  // else an error is told already
    auto rules = read_rules(table, strength, body);
    findings.keys.insert(own.keys.begin(), own.keys.end());
    if (own.errors.empty()) {
      body.fatigue = std::move(rules);
      findings.defaults.insert(findings.defaults.end(), own.defaults.begin(), own.defaults.end());
    } else
      body.fatigue_missing = own.errors.front().remedy;
  }
}

}  // namespace

void read_fatigue(SceneTable& table, const KnownStrength& strength, bool has_run_up, BodyScene& body,
                  SceneFindings& findings) {
  table.know("fatigue");
  body.fatigue_off = table.holds("fatigue", "off");
  if (body.fatigue_off) return;
  if (!table.has("fatigue")) return judge_by_default(strength, has_run_up, body, findings);
  if (table.has_text("fatigue"))
    return table.refuse("fatigue", "write \"off\", or the table [" + table.key() + ".fatigue]");
  auto rules = table.table("fatigue");
  body.fatigue = read_rules(rules, strength, body);
  rules.finish();
  if (has_run_up) table.refuse("fatigue", "is judged for steady running; remove it, or the run-up");
}

}  // namespace pipelines

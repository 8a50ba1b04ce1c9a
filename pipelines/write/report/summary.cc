#include "pipelines/write/report/summary.h"

#include <algorithm>
#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/statistics.h"
#include "pipelines/base/common/version.h"
#include "pipelines/base/files/content_hash.h"
#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/verdict/verdict_text.h"
#include "pipelines/loads/bodies/chamber.h"
#include "pipelines/loads/channels/load_figures.h"
#include "pipelines/scene/machines/load_table_reader.h"
#include "pipelines/scene/whole/machine_kind.h"
#include "pipelines/write/fields/bearing_fields.h"
#include "pipelines/write/fields/run_fields.h"
#include "pipelines/write/fields/train_fields.h"
#include "pipelines/write/parts/duty_report.h"
#include "pipelines/write/parts/fatigue_report.h"
#include "pipelines/write/report/summary_parts.h"

namespace pipelines {
namespace {

using namespace summary;

/// The couple of a named guide: how large, and against what.
Json carried_json(const BodyLoads& loads) {
  if (loads.carried_moment_Nm.size() == 0) return 0.0;
  const double most = loads.carried_moment_Nm.abs().maxCoeff();
  return object({{"effect", pitch_guide},
                 {"max_Nm", number(most)},
                 {"rms_Nm", number(std::sqrt(loads.carried_moment_Nm.square().mean()))},
                 {"share", number_or_none(most / loads.carried_moment_scale_Nm)}});
}

/// What effects = "auto" has switched off: shares of the loads, bounds of the governing stresses.
Json choice_json(const RunReport& report) {
  const auto& choice = report.scene.effect_choice;
  Json json = object({{"limit", choice.limit},
                      {"share_of_loads", number_or_none(choice.share)},
                      {"load_change", object({{"load", choice.load_change.load},
                                              {"share", number_or_none(choice.load_change.share)}})},
                      {"taken_back", choice.taken_back},
                      {"effects", Json::object()}});
  for (const auto& dropped : choice.dropped)
    json["effects"][dropped.effect]["share_of_loads"] = number_or_none(dropped.share);
  for (const auto& analysis : report.bodies) {
    if (!analysis.dropped) continue;
    const auto bound = [&](const EffectBound& b) {
      return object(
          {{"bound_Pa", number_or_none(b.bound_Pa)}, {"estimated_Pa", number_or_none(b.estimated_Pa)}});
    };
    for (const auto& effect : analysis.dropped->effects)
      json["effects"][effect.effect]["bodies"][analysis.scene.name] = bound(effect);
    json["bodies"][analysis.scene.name] = bound(analysis.dropped->together);
  }
  return json;
}

/// Turns and instants; a run-up has its own.
void take_window(const RunReport& report, Json& input) {
  const auto& grid = report.scene.sampling;
  input["turns"] = report.scene.run_up ? Json(nullptr) : Json(grid.turns);
  input["instants_per_turn"] = report.scene.run_up ? Json(nullptr) : Json(grid.instants_per_turn);
  if (!report.scene.run_up) return;
  const auto& loads = report.loads;
  const auto last = loads.n_instants() - 1;
  input["run_up"] = object({{"duration", figure(loads.time_s[last], "s")},
                            {"turns", figure((loads.phi_rad[last] - loads.phi_rad[0]) / (2 * pi), "1")},
                            {"instants", loads.n_instants()}});
}

/// Of the file that a text of the scene names, counted from its folder; empty: it names none.
std::string hash_of_file_beside(const std::filesystem::path& scene, const std::string& text) {
  const std::filesystem::path name(text);
  if (!name.has_extension()) return "";
  const auto file = scene.parent_path() / name;
  std::error_code none;
  return std::filesystem::is_regular_file(file, none) ? content_hash(file) : "";
}

}  // namespace

std::string summary_json(const RunReport& report) {
  Json json;
  json["program"] = object({{"name", "millstress"}, {"version", version}});
  json["input"] = object({{"scene", report.scene.file.filename().string()},
                          {"title", report.scene.title},
                          {"hash", content_hash(report.scene.file)},
                          {"machine", report.loads.machine},
                          {"convention", report.loads.convention},
                          {"effects", report.scene.effects}});
  json["verdict"] = verdict_json(judge(report));
  take_window(report, json["input"]);
  if (!report.scene.settings.empty()) json["input"]["settings"] = report.scene.settings;
  json["input"]["keys"] = report.scene.keys;
  for (const auto& [key, text] : report.scene.keys)
    if (const auto hash = hash_of_file_beside(report.scene.file, text); !hash.empty())
      json["input"]["files"][key] = hash;
  for (const auto& samples : samples_read(report.scene.machine, report.scene.sampling))
    json["input"]["samples"].push_back(object({{"effect", samples.effect},
                                               {"rows", samples.n},
                                               {"from_deg", number(samples.from_deg)},
                                               {"to_deg", number(samples.to_deg)},
                                               {"read", samples.origin}}));
  if (!report.scene.effect_choice.offered.empty()) json["dropped_effects"] = choice_json(report);
  json["warnings"] = Json::array();
  for (const auto& analysis : report.bodies)
    if (const auto text = not_known_well(governing_stress(analysis), analysis.search); !text.empty())
      json["warnings"].push_back(analysis.scene.name + ": NOT KNOWN WELL: " + text);
  for (const auto& analysis : report.bodies)
    if (const auto text = rises_towards_edge(analysis); !text.empty())
      json["warnings"].push_back(analysis.scene.name + ": SHARP EDGE: " + text);
  for (const auto* warnings : {&report.loads.warnings, &report.scene.warnings})
    for (const auto& warning : *warnings) json["warnings"].push_back(warning);
  const Machine& machine = report.scene.machine;
  if (const auto figures = load_figures(report.scene, report.loads); !figures.empty())
    json["loads"] = loads_json(figures);
  for (const double w : kind_of(machine).natural_frequencies_rad_s(machine))
    json["torsion"]["natural_frequencies"].push_back(summary_row(train_mode_fields(), {w, ""}));
  if (report.torsion != nullptr) {
    json["torsion"]["elements"] = train_elements_json(*report.torsion);
    json["torsion"]["margins"] = margins_json(*report.torsion);
  }
  for (const auto& analysis : report.bodies) {
    json["bodies"][analysis.scene.name] = body_json(report, analysis);
    const Closure& closure = analysis.closure;
    json["closure"][analysis.scene.name] = object({{"force", number(closure.worst_force())},
                                                   {"moment", number(closure.worst_moment())},
                                                   {"carried_moment", carried_json(analysis.loads)},
                                                   {"force_scale_N", closure.force_scale_N},
                                                   {"moment_scale_Nm", closure.moment_scale_Nm},
                                                   {"channel_resultant", number(closure.channel_resultant)}});
  }
  for (const auto& e : resampling_errors(report.scene.machine, report.scene.sampling))
    json["resampling"][e.effect + "/" + e.port + "." + e.component] =
        object({{"largest", e.largest}, {"jump", e.jump}, {"between_samples", e.between}});
  if (!report.bearings.empty()) json["bearings"] = bearings_json(report.bearings);
  if (const auto ranking = fatigue_ranking_json(report); !ranking.empty()) json["fatigue_ranking"] = ranking;
  if (report.duty != nullptr) json["duty"] = duty_json(*report.duty);
  for (const auto& cost : report.costs) json["timing"][cost.stage] = summary_row(stage_fields(), cost);
  return json.dump(2) + "\n";
}

}  // namespace pipelines

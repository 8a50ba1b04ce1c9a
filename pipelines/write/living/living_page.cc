#include "pipelines/write/living/living_page.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/several_ranks.h"
#include "pipelines/base/files/whole_file.h"
#include "pipelines/scene/values/effect_groups.h"
#include "pipelines/scene/whole/body_effects.h"
#include "pipelines/write/exports/html_page.h"
#include "pipelines/write/living/living_body.h"

namespace pipelines {
namespace {

using Eigen::Index;
using summary::Json;

constexpr Index most_instants = 4800;
constexpr std::size_t most_quantities = 80, most_scene_bytes = 300'000;
/// Loads without each effect are computed again, which takes the load stage's time for each.
constexpr Index most_instants_of_toggles = 20'000;

const std::string keys_element = "<script type=\"application/json\" id=\"living-keys\">",
                  data_element = "<script type=\"text/plain\" id=\"living-data\">",
                  element_end = "</script>\n";

/// The instant of the peak of the body that has the least safety; the first instant without bodies.
Index leading_instant(const std::vector<Judged>& analyses) {
  Index instant = 0;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& analysis : analyses)
    if (analysis.peak.safety < least) least = analysis.peak.safety, instant = analysis.peak.instant;
  return instant;
}

ShownInstants shown_instants(const Scene& scene, Index n, Index leading) {
  ShownInstants shown;
  shown.is_all = n <= most_instants;
  Index first = 0, last = n, stride = 1;
  if (!shown.is_all && scene.run_up) {
    stride = (n + most_instants - 1) / most_instants;
    first = leading % stride;
  } else if (!shown.is_all) {
    const Index per_turn = scene.sampling.instants_per_turn;
    stride = std::max<Index>(1, (per_turn + most_instants - 1) / most_instants);
    const Index turns = std::max<Index>(1, most_instants * stride / per_turn);
    const Index turn = leading / per_turn, all = n / per_turn;
    const Index from = std::max<Index>(0, std::min(turn - turns / 2, all - turns));
    first = from * per_turn + leading % stride;
    last = std::min(n, (from + turns) * per_turn);
  }
  for (Index t = first; t < last; t += stride) shown.instants.push_back(t);
  return shown;
}

std::vector<double> series(const ShownInstants& shown, const Eigen::ArrayXd& values) {
  std::vector<double> result;
  for (const auto t : shown.instants) result.push_back(values[t]);
  return result;
}

Json cycle_json(const Scene& scene, const kinetics::LoadHistory& loads, const ShownInstants& shown,
                PackedBlock& block) {
  std::vector<double> angle_deg, turn;
  const double first_rad = loads.phi_rad.size() > 0 ? loads.phi_rad[0] : 0;
  for (const auto t : shown.instants) {
    const double turns = std::abs(loads.phi_rad[t] - first_rad) / (2 * pi);
    const double whole = std::floor(turns + 1e-9);
    turn.push_back(whole + 1);
    angle_deg.push_back(std::max(0.0, 360 * (turns - whole)));
  }
  Json json = summary::object({{"instants", shown.instants.size()},
                               {"is_run_up", bool(scene.run_up)},
                               {"is_all", shown.is_all},
                               {"of_instants", loads.n_instants()}});
  const auto per_turn = scene.sampling.instants_per_turn;
  json["per_turn"] =
      scene.run_up || per_turn <= 0
          ? Json(0)
          : Json(std::count_if(turn.begin(), turn.end(), [&](double t) { return t == turn[0]; }));
  json["time_s"] = block.add_range("cycle/time", series(shown, loads.time_s));
  json["angle_deg"] = block.add_range("cycle/angle", angle_deg);
  json["turn"] = block.add_range("cycle/turn", turn);
  json["speed_rpm"] =
      summary::number(loads.speed_rad_s.size() > 0 ? std::abs(loads.speed_rad_s.mean()) * 30 / pi : 0);
  return json;
}

Json quantities_json(const kinetics::LoadHistory& loads, const ShownInstants& shown, PackedBlock& block) {
  auto json = Json::array();
  for (const auto& quantity : loads.quantities) {
    if (!quantity.has_statistics || json.size() == most_quantities) continue;
    const auto values = series(shown, quantity.values);
    if (std::all_of(values.begin(), values.end(), [](double v) { return v == 0; })) continue;
    json.push_back(summary::object({{"name", quantity.name},
                                    {"unit", quantity.unit},
                                    {"meaning", quantity.description},
                                    {"range", block.add_range("quantity/" + quantity.name, values)}}));
  }
  return json;
}

Json resultants_json(const kinetics::LoadHistory& loads, const ShownInstants& shown, PackedBlock& block) {
  auto json = Json::array();
  for (const auto& resultant : loads.resultants) {
    if (!(resultant.total.topRows(2) != 0).any()) continue;
    const auto add = [&](Index row, const char* component) {
      return block.add_range("resultant/" + resultant.role + component,
                             series(shown, resultant.total.row(row).transpose()));
    };
    json.push_back(summary::object({{"name", resultant.role},
                                    {"meaning", resultant.description},
                                    {"x", add(0, ".fx")},
                                    {"y", add(1, ".fy")}}));
  }
  return json;
}

Json effects_json(const Scene& scene) {
  Json json = summary::object({{"on", Json::array()}, {"off", Json::array()}, {"groups", Json::array()}});
  const auto table = effect_table(scene);
  const auto entry = [&](const std::string& name) {
    for (const auto& info : table)
      if (info.name == name) return summary::object({{"name", name}, {"meaning", info.description}});
    return summary::object({{"name", name}, {"meaning", ""}});
  };
  for (const auto& name : scene.effects) json["on"].push_back(entry(name));
  for (const auto& name : scene.effects_key.offered)
    if (!scene.has_effect(name)) json["off"].push_back(entry(name));
  for (const auto& group : effect_groups(scene.effects))
    json["groups"].push_back(summary::object({{"name", group.name}, {"effects", group.effects}}));
  return json;
}

Json toggles_json(const std::vector<EffectToggle>& toggles) {
  auto json = Json::array();
  for (const auto& toggle : toggles)
    json.push_back(summary::object({{"name", toggle.name},
                                    {"effects", toggle.effects},
                                    {"off", toggle.off},
                                    {"why", toggle.why},
                                    {"has_table", !toggle.without.empty()}}));
  return json;
}

/// No text of a scene ends the element that it stands in.
std::string in_script(std::string text) {
  for (std::size_t i = 0; (i = text.find('<', i)) != std::string::npos; i += 6) text.replace(i, 1, "\\u003c");
  return text;
}

}  // namespace

LivingPage living_page(const Loaded& loaded, const std::vector<Judged>& analyses, int n_threads) {
  for (const auto& analysis : analyses) bring_page_rows(analysis);
  if (!is_first_rank()) return {};
  const auto& loads = loaded.loads;
  const auto shown = shown_instants(loaded.scene, loads.n_instants(), leading_instant(analyses));
  std::vector<FactorSignals> signals;
  for (const auto& analysis : analyses) signals.push_back(factor_signals(analysis.loads));
  const bool has_toggles = !analyses.empty() && loads.n_instants() <= most_instants_of_toggles;
  const auto toggles =
      has_toggles ? effect_toggles(loaded, analyses, signals, n_threads) : std::vector<EffectToggle>();
  PackedBlock block;
  Json json;
  json["cycle"] = cycle_json(loaded.scene, loads, shown, block);
  json["effects"] = effects_json(loaded.scene);
  json["toggles"] = toggles_json(toggles);
  json["bodies"] = Json::array();
  for (std::size_t i = 0; i < analyses.size(); ++i)
    json["bodies"].push_back(living_body(analyses[i], i, signals[i], toggles, shown, block));
  json["quantities"] = quantities_json(loads, shown, block);
  json["resultants"] = resultants_json(loads, shown, block);
  json["scene"] = whole_file(loaded.scene.file, most_scene_bytes).value_or("");
  json["index"] = block.index();
  return {in_script(json.dump(-1, ' ', false, Json::error_handler_t::replace)), block.deflated()};
}

std::string living_elements(const LivingPage& living) {
  if (living.empty()) return {};
  return keys_element + living.keys + element_end + data_element + base64(living.data) + element_end;
}

std::string living_file(const LivingPage& living) {
  return living.keys + '\n' + living.data;
}

LivingPage living_of(const std::string& content) {
  const auto line = content.find('\n');
  if (line == std::string::npos) return {};
  return {content.substr(0, line), content.substr(line + 1)};
}

}  // namespace pipelines

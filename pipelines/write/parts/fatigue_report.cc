#include "pipelines/write/parts/fatigue_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <tuple>

#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/judge/life/duty_result.h"
#include "pipelines/judge/texts/damage_share_text.h"
#include "pipelines/judge/texts/life_text.h"
#include "pipelines/judge/texts/zone_text.h"
#include "pipelines/write/parts/fatigue_assumptions.h"

namespace pipelines {
namespace {

using summary::Json;

constexpr std::size_t n_places_shown = 6;

BodyResult result_of(const RunReport& report, const Judged& analysis) {
  return {report.scene, report.loads, analysis};
}

void print_welds(std::ostream& out, const BodyResult& body) {
  const auto& welds = body.analysis.fatigue->welds;
  if (welds.empty()) return;
  const auto fields = weld_fields();
  print_rows(out, "fatigue of weld toes",
             shown_rows(fields_of(fields), summary_rows(fields, body, welds), n_places_shown));
  const auto& first = welds.front();
  const auto& effects = body.analysis.loads.history.effects;
  if (!first.effect_share.empty())
    out << fmt::format("    {}: range by {}; {}\n", first.name,
                       largest_shares(group_shares(effects, first.effect_share)),
                       damage_text(effects, first.damage_share, first.damage_per_turn > 0));
  print_may_last_less(out, first.name, may_last_less(welds, [](const auto& weld) { return weld.name; }));
}

void print_nominal(std::ostream& out, const BodyResult& body) {
  const auto& nominal = body.analysis.fatigue->nominal;
  if (nominal.empty()) return;
  const auto fields = din_743_fields();
  print_rows(out, "DIN 743, nominal stresses (1.2 is asked)",
             shown_rows(fields_of(fields), summary_rows(fields, body, nominal), 1));
}

}  // namespace

void print_may_last_less(std::ostream& out, const std::string& first,
                         const std::vector<std::string>& others) {
  constexpr std::size_t most = 3;
  if (others.empty()) return;
  std::string names;
  for (std::size_t i = 0; i < std::min(most, others.size()); ++i) names += (i > 0 ? "; " : "") + others[i];
  if (others.size() > most) names += fmt::format("; and {} more", others.size() - most);
  out << fmt::format("    by the errors of their stresses these may last less than {}: {}\n", first, names);
}

void print_fatigue(std::ostream& out, const RunReport& report, const Judged& analysis) {
  if (!analysis.fatigue || analysis.fatigue->places.empty()) return;
  const auto body = result_of(report, analysis);
  const auto& places = analysis.fatigue->places;
  const auto fields = fatigue_fields();
  const auto rows = summary_rows(fields, body, places);
  print_rows(out, "fatigue of the surface", shown_rows(fields_of(fields), rows, n_places_shown));
  const auto& first = places.front();
  const auto& effects = analysis.loads.history.effects;
  if (first.cycle.amplitude_Pa > 0)
    out << fmt::format(
        "    {}: amplitude by {}; {}; n_sigma {:.3f} at {:.3g}/mm; error of the amplitude {}, which the "
        "least "
        "and the most have\n",
        first.feature, largest_shares(group_shares(effects, first.effect_share)),
        damage_text(effects, first.damage_share, first.damage_per_turn > 0), first.support,
        first.gradient_per_m * 1e-3,
        std::isfinite(first.error_share) ? fmt::format("{:.1f} %", 100 * first.error_share) : "not known");
  if (first.life_safety)
    out << fmt::format("    safety against the wanted life, beyond the safety factor: {}\n",
                       safety_text(*first.life_safety, first.error_share));
  print_rows(out, "safety by other rules, same limit", shown_details(fields_of(fields), rows, 1));
  print_nominal(out, body);
  print_welds(out, body);
  for (const auto& line : fatigue_assumptions(analysis)) out << "    " << line << '\n';
}

std::vector<RankedPlace> fatigue_ranking(const RunReport& report) {
  std::vector<RankedPlace> ranking;
  std::size_t n_judged = 0;
  for (const auto& analysis : report.bodies) {
    if (!analysis.fatigue) continue;
    ++n_judged;
    const auto& body = analysis.scene.name;
    if (report.duty != nullptr) {
      const auto places = report.duty->places.find(body);
      if (places == report.duty->places.end()) continue;
      for (const auto& place : places->second)
        ranking.push_back({body, place.feature, place.is_weld, place.life_s, place.certainty,
                           place.is_weld ? std::nullopt : std::optional(place.utilisation),
                           place.error_share});
      continue;
    }
    for (const auto& place : analysis.fatigue->places)
      ranking.push_back(
          {body, place.feature, false, place.life_s, place.certainty, place.utilisation, place.error_share});
    for (const auto& weld : analysis.fatigue->welds)
      ranking.push_back({body, weld.name, true, weld.life_s, weld.certainty, std::nullopt, weld.error_share});
  }
  if (n_judged < 2) return {};
  std::stable_sort(ranking.begin(), ranking.end(), [](const auto& a, const auto& b) {
    const auto order = [](const RankedPlace& place) {
      constexpr double never = std::numeric_limits<double>::infinity();
      const auto& range = place.certainty.range;
      return std::make_tuple(place.life_s.value_or(never), range ? range->least_s.value_or(never) : never,
                             -place.utilisation.value_or(0));
    };
    return order(a) < order(b);
  });
  return ranking;
}

std::vector<std::size_t> rows_shown(const std::vector<std::string>& bodies, std::size_t most) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (i < most || std::find(bodies.begin(), bodies.begin() + std::ptrdiff_t(i), bodies[i]) ==
                        bodies.begin() + std::ptrdiff_t(i))
      rows.push_back(i);
  return rows;
}

Json fatigue_ranking_json(const RunReport& report) {
  const auto fields = ranking_fields();
  auto places = Json::array();
  for (const auto& place : fatigue_ranking(report)) places.push_back(summary_row(fields, place));
  return places;
}

void print_shortest_lives(std::ostream& out, const RunReport& report) {
  constexpr std::size_t most = 5;
  const auto ranking = fatigue_ranking(report);
  if (ranking.empty()) return;
  std::vector<std::string> bodies;
  for (const auto& place : ranking) bodies.push_back(place.body);
  const auto fields = ranking_fields();
  auto rows = Json::array();
  for (const auto i : rows_shown(bodies, most)) rows.push_back(summary_row(fields, ranking[i]));
  print_rows(out,
             std::string("fatigue of all bodies, ") + (report.duty != nullptr ? "over all blocks, " : "") +
                 "shortest life first",
             shown_rows(fields_of(fields), rows, rows.size()));
}

Json fatigue_json(const RunReport& report, const Judged& analysis) {
  const auto body = result_of(report, analysis);
  const auto& fatigue = *analysis.fatigue;
  Json json;
  json["assumptions"] = fatigue_assumptions(analysis);
  json["safety_factor"] = summary::figure(analysis.scene.fatigue->safety, "1");
  json["size_factor"] = summary::figure(analysis.scene.fatigue->size_factor, "1");
  json["places"] = summary_rows(fatigue_fields(), body, fatigue.places);
  if (!fatigue.nominal.empty()) json["din_743"] = summary_rows(din_743_fields(), body, fatigue.nominal);
  if (!fatigue.welds.empty()) json["welds"] = summary_rows(weld_fields(), body, fatigue.welds);
  return json;
}

void write_weld_fatigue(const std::filesystem::path& file, const BodyResult& body) {
  write_rows(file, weld_fields(), body, body.analysis.fatigue->welds);
}

void write_fatigue(const std::filesystem::path& file, const BodyResult& body) {
  write_rows(file, fatigue_fields(), body, body.analysis.fatigue->places);
}

}  // namespace pipelines

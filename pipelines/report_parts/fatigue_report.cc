#include "pipelines/report_parts/fatigue_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <tuple>

#include "pipelines/analysis/error_text.h"
#include "pipelines/common/constants.h"
#include "pipelines/files/csv.h"
#include "pipelines/life/duty_result.h"
#include "pipelines/report_parts/damage_share_text.h"
#include "pipelines/report_parts/fatigue_assumptions.h"
#include "pipelines/report_parts/moment.h"
#include "pipelines/report_parts/zone_text.h"

namespace pipelines {
namespace {

constexpr std::size_t n_places_shown = 6;
constexpr double seconds_per_hour = 3600;

/// Safety of a place with amplitude or without: infinite ones say so.
std::string safety_text(double safety) {
  return std::isfinite(safety) ? fixed(safety, 2) : "-";
}

template <typename Get>
CsvColumn numbers(const char* name, const char* unit, const std::vector<FatiguePlace>& places, Get&& get) {
  std::vector<double> cells;
  for (const auto& place : places) cells.push_back(get(place));
  return {name, unit, std::move(cells)};
}

template <typename Get>
CsvColumn texts(const char* name, const char* unit, const std::vector<FatiguePlace>& places, Get&& get) {
  std::vector<std::string> cells;
  for (const auto& place : places) cells.push_back(get(place));
  return {name, unit, std::move(cells)};
}

std::string utilisation_text(double utilisation, double error_share) {
  return fmt::format("{:.1f}% ({})", 100 * utilisation,
                     std::isfinite(error_share)
                         ? fmt::format("{:.1f}%", 100 * utilisation * (1 + error_share))
                         : std::string("-"));
}

std::string least_cell(double safety, double error_share) {
  const auto least = least_safety(safety, error_share);
  return least && std::isfinite(*least) ? shortest(*least) : std::string();
}

/// Empty where there is none: a place that endures has no life.
std::string cell(double value) {
  return std::isfinite(value) ? shortest(value) : std::string();
}

void print_welds(std::ostream& out, const BodyFatigue& fatigue, const std::vector<std::string>& effects) {
  if (fatigue.welds.empty()) return;
  out << fmt::format("\n  {:<40}{:>11}{:>12}{:>13}{:>11}{:>6}  {}\n", "fatigue of weld toes", "range MPa",
                     "thickness", "f(t), n", "angle deg", "FAT", "life");
  for (std::size_t i = 0; i < std::min(n_places_shown, fatigue.welds.size()); ++i) {
    const auto& weld = fatigue.welds[i];
    out << fmt::format(
        "  {:<40}{:>11}{:>9.1f} mm{:>13}{:>11.0f}{:>6.0f}  {}\n", weld.name, fixed(weld.range_Pa / 1e6, 1),
        1e3 * weld.thickness_m, fmt::format("{:.3g}, {:.2g}", weld.thickness_factor, weld.thickness_exponent),
        weld.angle_rad * 180 / pi, weld.class_Pa / 1e6, life_text(weld.life_s, weld.certainty));
  }
  const auto& first = fatigue.welds.front();
  if (!first.effect_share.empty())
    out << fmt::format("    {}: range by {}; {}\n", first.name,
                       largest_shares(group_shares(effects, first.effect_share)),
                       damage_text(effects, first.damage_share, first.damage_per_turn > 0));
  print_may_last_less(out, first.name,
                      may_last_less(fatigue.welds, [](const auto& weld) { return weld.name; }));
}

summary::Json welds_json(const BodyFatigue& fatigue, const std::vector<std::string>& effects) {
  auto json = summary::Json::array();
  for (const auto& weld : fatigue.welds)
    json.push_back(summary::object(
        {{"name", weld.name},
         {"position_m", weld.toe_m},
         {"type", weld.type.empty() ? summary::Json(nullptr) : summary::Json(weld.type)},
         {"class_Pa", summary::number(weld.class_Pa)},
         {"thickness_m", summary::number(weld.thickness_m)},
         {"thickness_factor", summary::number(weld.thickness_factor)},
         {"thickness_exponent", summary::number(weld.thickness_exponent)},
         {"range_Pa", summary::number(weld.range_Pa)},
         {"angle_rad", summary::number(weld.angle_rad)},
         {"principal", weld.is_principal},
         {"counted_cycles", weld.n_counted},
         {"damage_per_turn", summary::number(weld.damage_per_turn)},
         {"life_h", weld.life_s ? summary::number(*weld.life_s / seconds_per_hour) : summary::Json(nullptr)},
         {"life_range_h", life_range_json(weld.certainty)},
         {"beyond_sn_curve", beyond_json(weld.certainty)},
         {"life_safety", weld.life_safety ? summary::number(*weld.life_safety) : summary::Json(nullptr)},
         {"life_safety_least",
          weld.life_safety ? least_safety_json(*weld.life_safety, weld.error_share) : summary::Json(nullptr)},
         {"stress_error", summary::number_or_none(weld.error_share)},
         {"effect_share_of_range", effect_shares_json(effects, weld.effect_share)},
         {"effect_share_of_damage", effect_shares_json(effects, weld.damage_share)}}));
  return json;
}

}  // namespace

/// Two digits without an exponent below a million.
std::string plain_hours(double life_s) {
  const double hours = life_s / seconds_per_hour;
  if (!(hours >= 0.01) || hours >= 1e6) return fmt::format("{:.2g}", hours);
  const double digit = std::pow(10, std::floor(std::log10(hours)) - 1);
  return fmt::format("{:g}", std::round(hours / digit) * digit);
}

std::string hours_text(double life_s) {
  return plain_hours(life_s) + " h";
}

std::string life_text(const std::optional<double>& life_s) {
  return life_s ? hours_text(*life_s) : "endures";
}

std::string life_text(const std::optional<double>& life_s, const LifeCertainty& certainty) {
  const auto text = life_text(life_s);
  if (!certainty.beyond.empty()) return text + ", beyond the S-N curve";
  const auto& range = certainty.range;
  if (!life_s && !range) return text + ", its error not known";
  if (!life_s)
    return range->least_s ? text + "; " + life_text(range->least_s) + " with the stated error" : text;
  if (!range) return text + ", not known well";
  return fmt::format("{} ({} to {})", text, plain_hours(range->least_s.value_or(*life_s)),
                     range->most_s ? plain_hours(*range->most_s) : "ever");
}

std::string safety_text(double safety, double error_share) {
  if (!std::isfinite(safety)) return "-";
  const auto least = least_safety(safety, error_share);
  return fmt::format("{} ({})", fixed(safety, 2), least ? fixed(*least, 2) : "-");
}

summary::Json least_safety_json(double safety, double error_share) {
  const auto least = least_safety(safety, error_share);
  return least ? summary::number_or_none(*least) : summary::Json(nullptr);
}

summary::Json life_range_json(const LifeCertainty& certainty) {
  if (!certainty.range) return nullptr;
  const auto hours = [](const std::optional<double>& life_s) {
    return life_s ? summary::number(*life_s / seconds_per_hour) : summary::Json(nullptr);
  };
  return summary::Json::array({hours(certainty.range->least_s), hours(certainty.range->most_s)});
}

summary::Json beyond_json(const LifeCertainty& certainty) {
  return certainty.beyond.empty() ? summary::Json(nullptr) : summary::Json(certainty.beyond);
}

std::string life_cell(const LifeCertainty& certainty, std::optional<double> LifeRange::*end) {
  if (!certainty.range) return "";
  const auto& life_s = (*certainty.range).*end;
  return life_s ? shortest(*life_s / seconds_per_hour) : std::string();
}

void print_may_last_less(std::ostream& out, const std::string& first,
                         const std::vector<std::string>& others) {
  constexpr std::size_t most = 3;
  if (others.empty()) return;
  std::string names;
  for (std::size_t i = 0; i < std::min(most, others.size()); ++i) names += (i > 0 ? "; " : "") + others[i];
  if (others.size() > most) names += fmt::format("; and {} more", others.size() - most);
  out << fmt::format("    by the errors of their stresses these may last less than {}: {}\n", first, names);
}

/// Without what rounding leaves of a reversed stress.
double rounded_mean_Pa(const StressCycle& cycle) {
  return std::abs(cycle.signed_mean_Pa) > 1e-9 * cycle.amplitude_Pa ? cycle.signed_mean_Pa : 0;
}

void print_fatigue(std::ostream& out, const RunReport& report, const BodyAnalysis& analysis) {
  if (!analysis.fatigue) return;
  const auto& fatigue = *analysis.fatigue;
  out << fmt::format("\n  {:<30}{:>13}{:>10}{:>12}{:>15}{:>18}  {}\n", "fatigue of the surface",
                     "amplitude MPa", "mean MPa", "endured MPa", "safety (least)", "utilis. (most)",
                     "life at the design limit");
  for (std::size_t i = 0; i < std::min(n_places_shown, fatigue.places.size()); ++i) {
    const auto& place = fatigue.places[i];
    out << fmt::format("  {:<30}{:>13}{:>10}{:>12}{:>15}{:>18}  {}\n", place.feature,
                       fixed(place.cycle.amplitude_Pa / 1e6, 1), fixed(rounded_mean_Pa(place.cycle) / 1e6, 1),
                       fixed(place.endurance_Pa / 1e6, 1), safety_text(place.safety, place.error_share),
                       utilisation_text(place.utilisation, place.error_share),
                       life_text(place.life_s, place.certainty));
  }
  if (fatigue.places.empty()) return;
  const auto& first = fatigue.places.front();
  const auto at = [&](double instant) {
    const auto moment = moment_between(report.scene, report.loads, instant);
    return fmt::format("turn {}, {:.0f} deg", moment.turn, moment.angle_rad * 180 / pi);
  };
  if (first.cycle.amplitude_Pa > 0)
    out << fmt::format(
        "    {}: from {} to {}; amplitude by {}; {}; n_sigma {:.3f} at {:.3g}/mm; error of the "
        "amplitude {}, which the least and the most have\n",
        first.feature, at(first.from), at(first.to),
        largest_shares(group_shares(analysis.loads.history.effects, first.effect_share)),
        damage_text(analysis.loads.history.effects, first.damage_share, first.damage_per_turn > 0),
        first.support, first.gradient_per_m * 1e-3,
        std::isfinite(first.error_share) ? fmt::format("{:.1f} %", 100 * first.error_share) : "not known");
  if (first.life_safety)
    out << fmt::format("    safety against the wanted life, beyond the safety factor: {}\n",
                       safety_text(*first.life_safety, first.error_share));
  out << fmt::format(
      "    safety by other rules, same limit: Findley {}, Goodman {}, Gerber {}, Soderberg {}\n",
      safety_text(first.others.findley, first.error_share),
      safety_text(first.others.goodman, first.error_share),
      safety_text(first.others.gerber, first.error_share),
      safety_text(first.others.soderberg, first.error_share));
  if (!fatigue.nominal.empty()) {
    const auto& least = fatigue.nominal.front();
    out << fmt::format(
        "    DIN 743 from nominal stresses, least safe of {} fillets: {}, safety {} (1.2 is asked; "
        "bending {:.1f} MPa x {:.2f}, torsion {:.1f} MPa x {:.2f}{})\n",
        fatigue.nominal.size(), least.fillet,
        fmt::format("{} ({})", safety_text(least.safety.fatigue),
                    least.least_safety ? safety_text(*least.least_safety) : "-"),
        least.load.amplitude_Pa.bending / 1e6, least.shape_factor.bending,
        least.load.amplitude_Pa.torsion / 1e6, least.shape_factor.torsion,
        std::isfinite(least.error_share) ? fmt::format("; factors +- {:.2g} %", 100 * least.error_share)
                                         : "; the error of the factors is not known");
  }
  print_welds(out, fatigue, analysis.loads.history.effects);
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

void print_shortest_lives(std::ostream& out, const RunReport& report) {
  constexpr std::size_t most = 5;
  const auto ranking = fatigue_ranking(report);
  if (ranking.empty()) return;
  out << fmt::format("\n  {:<62}{}\n",
                     std::string("fatigue of all bodies, ") +
                         (report.duty != nullptr ? "over all blocks, " : "") + "shortest life first",
                     "life");
  std::vector<std::string> bodies;
  for (const auto& place : ranking) bodies.push_back(place.body);
  for (const auto i : rows_shown(bodies, most)) {
    const auto& place = ranking[i];
    auto life = life_text(place.life_s, place.certainty);
    if (!place.life_s && place.utilisation)
      life += "; used " + utilisation_text(*place.utilisation, place.error_share);
    out << fmt::format("  {:>4}  {:<56}{}\n", i + 1,
                       place.body + ", " + place.feature + (place.is_weld ? " (weld toe)" : ""), life);
  }
}

summary::Json fatigue_ranking_json(const RunReport& report) {
  auto places = summary::Json::array();
  for (const auto& place : fatigue_ranking(report))
    places.push_back(summary::object(
        {{"body", place.body},
         {"feature", place.feature},
         {"weld_toe", place.is_weld},
         {"life_h",
          place.life_s ? summary::number(*place.life_s / seconds_per_hour) : summary::Json(nullptr)},
         {"life_range_h", life_range_json(place.certainty)},
         {"beyond_sn_curve", beyond_json(place.certainty)},
         {"utilisation", place.utilisation ? summary::number(*place.utilisation) : summary::Json(nullptr)},
         {"utilisation_most", place.utilisation
                                  ? summary::number_or_none(*place.utilisation * (1 + place.error_share))
                                  : summary::Json(nullptr)}}));
  return places;
}

summary::Json fatigue_json(const RunReport& report, const BodyAnalysis& analysis) {
  using summary::figure;
  using summary::number;
  using summary::number_or_none;
  using summary::object;
  const auto& fatigue = *analysis.fatigue;
  const auto& effects = analysis.loads.history.effects;
  summary::Json json;
  json["assumptions"] = fatigue_assumptions(analysis);
  json["safety_factor"] = figure(analysis.scene.fatigue->safety, "1");
  json["size_factor"] = figure(analysis.scene.fatigue->size_factor, "1");
  json["places"] = summary::Json::array();
  for (const auto& place : fatigue.places) {
    const auto moment = [&](double instant) {
      const auto m = moment_between(report.scene, report.loads, instant);
      return object({{"turn", m.turn}, {"drive_angle_rad", m.angle_rad}});
    };
    const auto life = place.life_s.value_or(std::numeric_limits<double>::infinity());
    json["places"].push_back(object(
        {{"feature", place.feature},
         {"place", to_string(place.surface)},
         {"position_m", place.position_m},
         {"amplitude_Pa", number(place.cycle.amplitude_Pa)},
         {"mean_Pa", number(place.cycle.signed_mean_Pa)},
         {"half_range_Pa", place.cycle.half_range_Pa},
         {"mean_tensor_Pa", place.cycle.mean_Pa},
         {"from", moment(place.from)},
         {"to", moment(place.to)},
         {"related_gradient_1_m", number(place.gradient_per_m)},
         {"support_factor", number(place.support)},
         {"endurance_Pa", number(place.endurance_Pa)},
         {"safety_against_endurance", number_or_none(place.safety)},
         {"safety_least", least_safety_json(place.safety, place.error_share)},
         {"utilisation", number(place.utilisation)},
         {"utilisation_most", number_or_none(place.utilisation * (1 + place.error_share))},
         {"counted_cycles", place.n_counted},
         {"damage_per_turn", number(place.damage_per_turn)},
         {"damage_per_hour", number(place.life_s ? seconds_per_hour / *place.life_s : 0)},
         {"life_turns", number_or_none(place.life_s ? 1 / place.damage_per_turn : life)},
         {"life_h", number_or_none(life / seconds_per_hour)},
         {"life_range_h", life_range_json(place.certainty)},
         {"beyond_sn_curve", beyond_json(place.certainty)},
         {"life_safety", number_or_none(place.life_safety.value_or(std::numeric_limits<double>::infinity()))},
         {"life_safety_least",
          least_safety_json(place.life_safety.value_or(std::numeric_limits<double>::infinity()),
                            place.error_share)},
         {"safety_by", object({{"findley", number_or_none(place.others.findley)},
                               {"goodman", number_or_none(place.others.goodman)},
                               {"gerber", number_or_none(place.others.gerber)},
                               {"soderberg", number_or_none(place.others.soderberg)}})},
         {"stress_error", number_or_none(place.error_share)},
         {"effect_share_of_amplitude", effect_shares_json(effects, place.effect_share)},
         {"effect_share_of_damage", effect_shares_json(effects, place.damage_share)}}));
  }
  for (const auto& nominal : fatigue.nominal) {
    const auto triple = [](const DinTriple& t) {
      return object(
          {{"tension", number(t.tension)}, {"bending", number(t.bending)}, {"torsion", number(t.torsion)}});
    };
    json["din_743"].push_back(
        object({{"feature", nominal.fillet},
                {"z_m", nominal.z_m},
                {"diameter_m", nominal.diameter_m},
                {"amplitude_Pa", triple(nominal.load.amplitude_Pa)},
                {"mean_Pa", triple(nominal.load.mean_Pa)},
                {"shape_factor", triple(nominal.shape_factor)},
                {"stress_error", number_or_none(nominal.error_share)},
                {"notch_effect", triple(nominal.safety.notch_effect)},
                {"safety_against_fatigue", number_or_none(nominal.safety.fatigue)},
                {"safety_against_fatigue_least",
                 nominal.least_safety ? number_or_none(*nominal.least_safety) : summary::Json(nullptr)},
                {"safety_against_yielding", number_or_none(nominal.safety.yielding)}}));
  }
  if (!fatigue.welds.empty()) json["welds"] = welds_json(fatigue, effects);
  return json;
}

void write_weld_fatigue(const std::filesystem::path& file, const BodyAnalysis& analysis) {
  std::vector<std::string> names, types, lives, least, most, error;
  std::vector<double> range, thickness, factor, exponent, angle, fat, damage;
  std::array<std::vector<double>, 3> toe;
  std::vector<std::vector<double>> shares;
  for (const auto& weld : analysis.fatigue->welds) {
    shares.push_back(weld.damage_share);
    names.push_back(weld.name);
    types.push_back(weld.type);
    least.push_back(life_cell(weld.certainty, &LifeRange::least_s));
    most.push_back(life_cell(weld.certainty, &LifeRange::most_s));
    error.push_back(cell(weld.error_share));
    range.push_back(weld.range_Pa);
    thickness.push_back(weld.thickness_m);
    factor.push_back(weld.thickness_factor);
    exponent.push_back(weld.thickness_exponent);
    angle.push_back(weld.angle_rad);
    fat.push_back(weld.class_Pa);
    damage.push_back(weld.damage_per_turn);
    lives.push_back(weld.life_s ? shortest(*weld.life_s / seconds_per_hour) : std::string());
    for (std::size_t d = 0; d < 3; ++d) toe[d].push_back(weld.toe_m[d]);
  }
  std::vector<CsvColumn> columns{{"toe", "", names},
                                 {"range", "Pa", range},
                                 {"thickness", "m", thickness},
                                 {"angle", "rad", angle},
                                 {"class", "Pa", fat},
                                 {"damage_per_turn", "", damage},
                                 {"life", "h", lives},
                                 {"life_least", "h", least},
                                 {"life_most", "h", most},
                                 {"stress_error", "", error},
                                 {"type", "", types},
                                 {"thickness_factor", "", factor},
                                 {"thickness_exponent", "", exponent},
                                 {"x", "m", toe[0]},
                                 {"y", "m", toe[1]},
                                 {"z", "m", toe[2]}};
  add_damage_shares(columns, analysis.loads.history.effects, shares);
  write_csv(file, columns);
}

void write_fatigue(const std::filesystem::path& file, const Scene& scene, const kinetics::LoadHistory& loads,
                   const BodyAnalysis& analysis) {
  const auto& places = analysis.fatigue->places;
  std::vector<CsvColumn> columns;
  columns.push_back(texts("feature", "", places, [](const auto& p) { return p.feature; }));
  columns.push_back(texts("place", "", places, [](const auto& p) { return to_string(p.surface); }));
  columns.push_back(numbers("amplitude", "Pa", places, [](const auto& p) { return p.cycle.amplitude_Pa; }));
  columns.push_back(numbers("mean", "Pa", places, [](const auto& p) { return p.cycle.signed_mean_Pa; }));
  columns.push_back(numbers("endurance", "Pa", places, [](const auto& p) { return p.endurance_Pa; }));
  columns.push_back(
      texts("safety_against_endurance", "", places, [](const auto& p) { return cell(p.safety); }));
  columns.push_back(
      texts("safety_least", "", places, [](const auto& p) { return least_cell(p.safety, p.error_share); }));
  columns.push_back(numbers("utilisation", "", places, [](const auto& p) { return p.utilisation; }));
  columns.push_back(texts("utilisation_most", "", places,
                          [](const auto& p) { return cell(p.utilisation * (1 + p.error_share)); }));
  columns.push_back(numbers("damage_per_turn", "", places, [](const auto& p) { return p.damage_per_turn; }));
  columns.push_back(numbers("damage_per_hour", "1/h", places,
                            [](const auto& p) { return p.life_s ? seconds_per_hour / *p.life_s : 0; }));
  columns.push_back(texts("life", "h", places, [](const auto& p) {
    return p.life_s ? shortest(*p.life_s / seconds_per_hour) : std::string();
  }));
  columns.push_back(texts("life_least", "h", places,
                          [](const auto& p) { return life_cell(p.certainty, &LifeRange::least_s); }));
  columns.push_back(texts("life_most", "h", places,
                          [](const auto& p) { return life_cell(p.certainty, &LifeRange::most_s); }));
  columns.push_back(texts("stress_error", "", places, [](const auto& p) { return cell(p.error_share); }));
  columns.push_back(numbers("support_factor", "", places, [](const auto& p) { return p.support; }));
  columns.push_back(
      numbers("related_gradient", "1/m", places, [](const auto& p) { return p.gradient_per_m; }));
  columns.push_back(
      texts("safety_findley", "", places, [](const auto& p) { return cell(p.others.findley); }));
  columns.push_back(
      texts("safety_goodman", "", places, [](const auto& p) { return cell(p.others.goodman); }));
  columns.push_back(texts("safety_gerber", "", places, [](const auto& p) { return cell(p.others.gerber); }));
  columns.push_back(
      texts("safety_soderberg", "", places, [](const auto& p) { return cell(p.others.soderberg); }));
  for (std::size_t c = 0; c < 3; ++c) {
    const char* const names[] = {"x", "y", "z"};
    columns.push_back(numbers(names[c], "m", places, [&](const auto& p) { return p.position_m[c]; }));
  }
  const auto angle = [&](double instant) {
    const auto moment = moment_between(scene, loads, instant);
    return 2 * pi * (moment.turn - 1) + moment.angle_rad;
  };
  columns.push_back(numbers("drive_angle_from", "rad", places, [&](const auto& p) { return angle(p.from); }));
  columns.push_back(numbers("drive_angle_to", "rad", places, [&](const auto& p) { return angle(p.to); }));
  std::vector<std::vector<double>> of_amplitude, of_damage;
  for (const auto& place : places) {
    of_amplitude.push_back(place.cycle.amplitude_Pa > 0 ? place.effect_share : std::vector<double>());
    of_damage.push_back(place.damage_share);
  }
  add_shares(columns, "amplitude_share_", analysis.loads.history.effects, of_amplitude);
  add_damage_shares(columns, analysis.loads.history.effects, of_damage);
  write_csv(file, columns);
}

}  // namespace pipelines

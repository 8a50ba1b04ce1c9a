#include "pipelines/report/fatigue_html.h"

#include <fmt/core.h>

#include <string>
#include <vector>

#include "pipelines/report/html_values.h"
#include "pipelines/report_parts/fatigue_report.h"

namespace pipelines {
namespace {

using html::Json, html::moment, html::number, html::Rows;

constexpr std::size_t n_rows_of_fatigue = 12;

/// In h.
std::string life(const Json& hours) {
  return hours.is_null() ? "endures" : number(hours, 1, "{:.3g}");
}

/// What a place's error leaves of its life: null where it endures, too; none of results of earlier versions,
/// of lives beyond the curve and where the error is not known.
const Json* life_range(const Json& place) {
  if (!place.contains("life_range_h") || place.at("life_range_h").is_null()) return nullptr;
  return &place.at("life_range_h");
}

/// In h; what endures by its stress alone, and not with the error of that, says so.
std::string life_of(const Json& place) {
  const auto text = life(place.at("life_h"));
  if (!place.at("life_h").is_null() || !place.contains("life_range_h")) return text;
  const auto* range = life_range(place);
  return range != nullptr && (*range)[0].is_null() ? text : text + ", without the error of its stress";
}

/// "1.09": a figure that results of earlier versions do not have.
std::string figure_of(const Json& place, const char* key, double unit, const char* format) {
  return place.contains(key) ? number(place.at(key), unit, format) : "-";
}

/// What the error of the stress leaves of a life at least, h; results of earlier versions have none.
std::string least_life(const Json& place) {
  if (!place.contains("life_range_h")) return "-";
  if (place.contains("beyond_sn_curve") && !place["beyond_sn_curve"].is_null()) return "beyond the S-N curve";
  const auto& range = place["life_range_h"];
  return range.is_null() ? "not known" : life(range[0]);
}

void add_welds(HtmlPage& page, const Json& welds) {
  Rows rows;
  for (const auto& weld : welds) {
    if (rows.size() == n_rows_of_fatigue) break;
    rows.push_back({weld.at("name").get<std::string>(), number(weld.at("range_Pa"), 1e-6, "{:.1f}"),
                    number(weld.at("class_Pa"), 1e-6, "{:.0f}"), life_of(weld), least_life(weld)});
  }
  page.table({"weld toe", "range MPa", "FAT MPa", "life h", "at least h"}, rows);
}

/// Results of earlier versions may have none.
std::string moment_of(const Json& place, const char* key) {
  return place.contains(key) ? moment(place.at(key)) : "-";
}

void add_other_rules(HtmlPage& page, const Json& places) {
  Rows rows;
  for (const auto& place : places) {
    if (rows.size() == n_rows_of_fatigue || !place.contains("safety_by")) break;
    std::vector<std::string> row{place.at("feature").get<std::string>()};
    for (const char* rule : {"findley", "goodman", "gerber", "soderberg"})
      row.push_back(number(place.at("safety_by").at(rule), 1, "{:.2f}"));
    rows.push_back(std::move(row));
  }
  if (!rows.empty())
    page.table({"safety by other rules, same limit", "Findley", "Goodman", "Gerber", "Soderberg"}, rows);
}

void add_din_743(HtmlPage& page, const Json& fatigue) {
  if (!fatigue.contains("din_743")) return;
  Rows rows;
  for (const auto& fillet : fatigue.at("din_743")) {
    const auto nominal = [&](const char* stress) {
      return fmt::format("{} x {}", number(fillet.at("amplitude_Pa").at(stress), 1e-6, "{:.1f}"),
                         number(fillet.at("shape_factor").at(stress), 1, "{:.2f}"));
    };
    const auto error =
        fillet.value("stress_error", Json(nullptr));  // results of an earlier version have none
    rows.push_back({fillet.at("feature").get<std::string>(), nominal("tension"), nominal("bending"),
                    nominal("torsion"), error.is_null() ? "not known" : number(error, 100, "{:.2g} %"),
                    number(fillet.at("safety_against_fatigue"), 1, "{:.2f}"),
                    number(fillet.at("safety_against_yielding"), 1, "{:.2f}"),
                    figure_of(fillet, "safety_against_fatigue_least", 1, "{:.2f}")});
  }
  page.table({"DIN 743, nominal stresses: fillet", "tension MPa x factor", "bending", "torsion",
              "error of factors", "safety against fatigue", "against yielding", "against fatigue at least"},
             rows);
}

void add_duty_places(HtmlPage& page, const std::string& body, const Json& places) {
  Rows rows;
  for (const auto& place : places) {
    if (rows.size() == n_rows_of_fatigue) break;
    rows.push_back(
        {place.at("feature").get<std::string>(), place.at("weld_toe").get<bool>() ? "weld toe" : "",
         number(place.at("damage_per_hour"), 1, "{:.3g}"), life_of(place), least_life(place),
         number(place.at("life_safety"), 1, "{:.2f}"), figure_of(place, "life_safety_least", 1, "{:.2f}")});
  }
  page.heading(3, body + ": life over all blocks");
  page.table({"place", "", "damage per hour", "life h in operation", "at least h",
              "safety against the wanted life", "at least"},
             rows);
}

}  // namespace

void add_fatigue(HtmlPage& page, const Json& body) {
  if (!body.contains("fatigue")) return;
  const Json& fatigue = body.at("fatigue");
  Rows rows;
  for (const auto& place : fatigue.at("places")) {
    if (rows.size() == n_rows_of_fatigue) break;
    rows.push_back(
        {place.at("feature").get<std::string>(), number(place.at("amplitude_Pa"), 1e-6, "{:.1f}"),
         number(place.at("mean_Pa"), 1e-6, "{:.1f}"), number(place.at("endurance_Pa"), 1e-6, "{:.1f}"),
         number(place.at("safety_against_endurance"), 1, "{:.2f}"),
         figure_of(place, "safety_least", 1, "{:.2f}"), number(place.at("utilisation"), 100, "{:.0f}"),
         figure_of(place, "utilisation_most", 100, "{:.0f}"), life_of(place), least_life(place),
         moment_of(place, "from"), moment_of(place, "to")});
  }
  page.heading(3, "Fatigue");
  page.table({"place", "amplitude MPa", "mean MPa", "endured MPa", "safety", "at least", "utilisation %",
              "at most %", "life h", "at least h", "from", "to"},
             rows);
  add_other_rules(page, fatigue.at("places"));
  add_din_743(page, fatigue);
  if (fatigue.contains("welds")) add_welds(page, fatigue.at("welds"));
  for (const auto& line : fatigue.at("assumptions")) page.paragraph(line.get<std::string>());
}

void add_fatigue_ranking(HtmlPage& page, const Json& summary) {
  if (!summary.contains("fatigue_ranking")) return;
  const auto& ranking = summary.at("fatigue_ranking");
  std::vector<std::string> bodies;
  for (const auto& place : ranking) bodies.push_back(place.at("body").get<std::string>());
  Rows rows;
  for (const auto i : rows_shown(bodies, n_rows_of_fatigue)) {
    const auto& place = ranking.at(i);
    rows.push_back({fmt::format("{}", i + 1), bodies[i], place.at("feature").get<std::string>(),
                    place.at("weld_toe").get<bool>() ? "weld toe" : "", life_of(place), least_life(place),
                    number(place.at("utilisation"), 100, "{:.0f}"),
                    figure_of(place, "utilisation_most", 100, "{:.0f}")});
  }
  page.heading(2, std::string("Fatigue of all bodies") +
                      (summary.contains("duty") ? ", over all operating blocks" : ""));
  page.table({"", "body", "place", "", "life h", "at least h", "utilisation %", "at most %"}, rows);
}

void add_duty(HtmlPage& page, const Json& summary) {
  if (!summary.contains("duty")) return;
  const Json& duty = summary.at("duty");
  page.heading(2, "Operating blocks");
  Rows rows;
  for (const auto& [name, block] : duty.at("blocks").items()) {
    const auto share = number(block.at("share"), 100, "{:.4g}"),
               starts = number(block.at("starts_per_day"), 1, "{:.4g}");
    if (block.at("bodies").empty()) rows.push_back({name, share, starts, "-", "-", "-", "-"});
    for (const auto& [body, stress] : block.at("bodies").items())
      rows.push_back({name, share, starts, body, number(stress.at("von_mises").at("value"), 1e-6, "{:.1f}"),
                      number(stress.at("safety"), 1, "{:.2f}"), stress.at("feature").get<std::string>()});
  }
  page.table({"block", "share %", "starts per day", "body", "largest stress MPa", "safety", "at"}, rows);
  if (duty.contains("places"))
    for (const auto& [body, places] : duty.at("places").items()) add_duty_places(page, body, places);
  if (!duty.contains("bearings")) return;
  Rows bearings;
  for (const auto& [name, bearing] : duty.at("bearings").items())
    bearings.push_back(
        {name, number(bearing.at("equivalent_load").at("value")),
         bearing.at("L10h").is_null() ? "-" : number(bearing.at("L10h").at("value"), 1, "{:.0f}")});
  page.table({"bearing over all blocks", "equivalent load N", "L10h hours"}, bearings);
}

}  // namespace pipelines

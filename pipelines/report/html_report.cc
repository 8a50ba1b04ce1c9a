#include "pipelines/report/html_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipelines/common/constants.h"
#include "pipelines/common/errors.h"
#include "pipelines/common/statistics.h"
#include "pipelines/exports/html_page.h"
#include "pipelines/files/atomic_file.h"
#include "pipelines/files/json_file.h"
#include "pipelines/files/whole_file.h"
#include "pipelines/report/fatigue_html.h"
#include "pipelines/report/html_values.h"
#include "pipelines/report/torsion_html.h"
#include "pipelines/report_parts/zone_text.h"

namespace pipelines {
namespace {

using html::Json, html::moment, html::MPa, html::number, html::Rows;

std::string file_text(const std::filesystem::path& file) {
  return whole_file(file).value_or("");
}

std::string where(const Json& at) {
  const auto& x = at.at("position_m");
  const std::string feature = at.at("feature").get<std::string>();
  return fmt::format("{}{}({}, {}, {}) mm", feature, feature.empty() ? "" : ", ",
                     number(x.at(0), 1e3, "{:.1f}"), number(x.at(1), 1e3, "{:.1f}"),
                     number(x.at(2), 1e3, "{:.1f}"));
}

std::string with_spaces(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

void add_budget(HtmlPage& page, const std::string& of, const Json& error, double value_Pa) {
  Rows rows;
  for (const auto& [source, method] : error.at("methods").items())
    rows.push_back({with_spaces(source), MPa(error.at(source)),
                    number(error.at(source), value_Pa > 0 ? 100 / value_Pa : 0, "{:.2f} %"),
                    method.get<std::string>()});
  rows.push_back({"all together", MPa(error.at("total")),
                  number(error.at("total"), value_Pa > 0 ? 100 / value_Pa : 0, "{:.2f} %"), "sum"});
  page.heading(3, "How well the " + of + " is known");
  page.table({"source of error", "MPa", "share", "how it was estimated"}, rows);
}

void add_headlines(HtmlPage& page, const Json& body) {
  const auto& governing = body.at("governing");
  const auto& peak = body.at("peak_von_mises");
  Rows rows{
      {governing.at("name").get<std::string>(), governing.at("text").get<std::string>(), where(governing),
       moment(governing)},
      {"safety against yield", number(governing.at("safety_against_yield"), 1, "{:.2f}"),
       body.at("material").get<std::string>() + ", " + MPa(body.at("yield_strength").at("value")) + " MPa",
       ""}};
  if (governing.at("kind") != "peak_von_mises")
    rows.push_back({"peak von Mises stress outside the exclusion distances",
                    MPa(peak.at("value")) + " MPa, error " + MPa(peak.at("error").at("total")), where(peak),
                    moment(peak)});
  rows.push_back({"largest principal stress", MPa(body.at("peak_principal").at("value")) + " MPa",
                  where(body.at("peak_principal")), moment(body.at("peak_principal"))});
  if (body.contains("hot_spots") && governing.at("kind") != "hot_spot") {
    const auto& spot = body.at("hot_spots").at(0);
    rows.push_back({"hot-spot stress",
                    MPa(spot.at("von_mises_Pa")) + " MPa, error " + MPa(spot.at("error").at("total")),
                    spot.at("name").get<std::string>(), ""});
  }
  if (body.contains("torsion")) {
    const auto& shear = body.at("torsion").at("max_shear_stress");
    const auto error = shear.value("error", Json(nullptr));  // not known, or results of an earlier version
    rows.push_back({"largest torsional stress",
                    MPa(shear.at("value")) + " MPa" + (error.is_null() ? "" : ", error " + MPa(error)),
                    shear.contains("feature") ? shear.at("feature").get<std::string>() : "", ""});
  }
  page.table({"", "value", "where", "when"}, rows);
}

void add_effects(HtmlPage& page, const Json& peak) {
  if (!peak.contains("effect_share")) return;
  Rows rows;
  for (const auto& [effect, share] : peak.at("effect_share").items())
    rows.push_back({effect, number(share, 100, "{:.2f} %")});
  page.heading(3, "What the peak is made of");
  page.table({"effect", "share"}, rows);
  if (!peak.contains("effect_group_share")) return;
  Rows sums;
  for (const auto& [group, share] : peak.at("effect_group_share").items())
    sums.push_back({group, number(share, 100, "{:.2f} %")});
  page.table({"in sum", "share"}, sums);
}

/// Of "causes.peak", "causes.amplitude" or "causes.damage".
std::string brought_by(const Json& causes) {
  std::vector<NamedShare> shares;
  if (causes.contains("effects"))
    for (const auto& [name, share] : causes.at(causes.contains("groups") ? "groups" : "effects").items())
      shares.push_back({name, share.get<double>()});
  return largest_shares(std::move(shares));
}

void add_zone_causes(HtmlPage& page, const Json& zones) {
  Rows rows;
  std::size_t n = 0;
  for (const auto& zone : zones) {
    ++n;
    if (!zone.contains("causes")) continue;
    const auto& amplitude = zone.at("causes").at("amplitude");
    rows.push_back({fmt::format("{}", n), MPa(zone.at("peak_von_mises_Pa")),
                    brought_by(zone.at("causes").at("peak")), MPa(amplitude.at("value_Pa")),
                    brought_by(amplitude)});
    if (zone.at("causes").contains("damage"))
      rows.back().push_back(brought_by(zone.at("causes").at("damage")));
  }
  std::vector<std::string> titles{"", "peak MPa", "brought by", "amplitude MPa", "brought by"};
  if (!rows.empty() && rows.front().size() > titles.size()) titles.emplace_back("damage by");
  page.table(titles, rows);
  Rows parts;
  for (const auto& zone : zones)
    if (zone.contains("parts"))
      for (const auto& part : zone.at("parts"))
        parts.push_back({part.at("zone").get<std::string>(), MPa(part.at("level_Pa")),
                         MPa(part.at("peak_von_mises_Pa")), where(part), moment(part)});
  page.table({"part", "above MPa", "peak MPa", "where", "when"}, parts);
}

/// Results of earlier versions have no error.
VolumeText volume_of(const Json& zone) {
  const auto known = [&](const char* key) {
    return zone.contains(key) && zone.at(key).is_number() ? std::optional<double>(zone.at(key).get<double>())
                                                          : std::nullopt;
  };
  return volume_text(known("volume_m3").value_or(std::nan("")), known("volume_error_m3"));
}

void add_zones(HtmlPage& page, const Json& body) {
  Rows rows;
  for (const auto& zone : body.at("zones")) {
    const auto volume = volume_of(zone);
    rows.push_back({fmt::format("{}", rows.size() + 1), MPa(zone.at("peak_von_mises_Pa")),
                    MPa(zone.at("error_Pa")), number(zone.at("safety_against_yield"), 1, "{:.2f}"),
                    volume.volume, volume.error, where(zone), moment(zone),
                    zone.at("place").get<std::string>()});
  }
  page.heading(3, "Zones above " + MPa(body.at("zone_level").at("value")) + " MPa");
  page.table({"", "peak MPa", "error MPa", "safety", "volume mm3", "error mm3", "where", "when", "surface"},
             rows);
  add_zone_causes(page, body.at("zones"));
}

void add_search(HtmlPage& page, const Json& body) {
  if (!body.contains("search")) return;
  const auto& search = body.at("search");
  Rows rows;
  for (const auto& step : search.at("steps"))
    rows.push_back({fmt::format("{}", rows.size() + 1), number(step.at("dofs"), 1, "{:.0f}"),
                    MPa(step.at("value_Pa")), MPa(step.at("error").at("total")),
                    with_spaces(step.at("dominated_by").get<std::string>()),
                    step.at("mesh").get<std::string>()});
  page.heading(3, search.at("tolerance") == 0
                      ? "The way within the time limit"
                      : "The way to the tolerance of " + number(search.at("tolerance"), 100, "{:g} %"));
  page.table({"step", "unknowns", "MPa", "error MPa", "dominated by", "mesh"}, rows);
  page.paragraph("It ended because " + search.at("ended").get<std::string>() + ".");
}

void add_seats(HtmlPage& page, const Json& body) {
  if (!body.contains("seats")) return;
  Rows rows;
  for (const auto& [port, seat] : body.at("seats").items())
    rows.push_back({port, number(seat.at("max_deflection_m"), 1e3, "{:.4f}"),
                    number(seat.at("max_slope_rad"), 1e3, "{:.3f}")});
  page.heading(3, "Deflection and slope");
  page.table({"seat", "deflection mm", "slope mrad"}, rows);
}

/// The model, and of a solid how it was solved.
std::string solved_by(const Json& body) {
  const auto& solver = body.at("solver");
  const std::string method = body.value("method", "solid");
  if (method == "beam") return "by the beam model: no section diagrams, no torsion, zones without volume";
  if (method != "solid") return "by the " + method + " model";
  return std::string("solved by ") +
         (solver.at("used") == "iterative" ? "conjugate gradients" : "factorisation") + " (" +
         solver.at("reason").get<std::string>() + ")";
}

/// First of all: what the machine is judged by. Results of earlier versions have none.
void add_verdict(HtmlPage& page, const Json& summary) {
  if (!summary.contains("verdict")) return;
  const auto& verdict = summary.at("verdict");
  page.verdict(verdict.at("judgement").get<std::string>(), verdict.at("headline").get<std::string>());
  Rows rows;
  for (const auto& [name, part] : verdict.at("parts").items())
    for (const auto& finding : part.at("findings"))
      rows.push_back({name, finding.at("judgement").get<std::string>(),
                      finding.at("criterion").get<std::string>(), finding.at("figure").get<std::string>(),
                      finding.at("place").get<std::string>(), finding.at("remedy").get<std::string>()});
  std::string left_out;
  for (const auto& what : verdict.value("left_out", Json::array()))
    left_out += (left_out.empty() ? "" : ", ") + what.get<std::string>();
  if (!left_out.empty()) page.paragraph("Not weighed, by the scene: " + left_out + ".");
  page.table({"", "verdict", "criterion", "figure and limit", "weakest place", "what to do"}, rows);
}

void add_body(HtmlPage& page, const std::filesystem::path& directory, const std::string& name,
              const Json& body) {
  page.heading(2, "The " + name);
  if (const auto trouble = body.at("governing").value("not_known_well", ""); !trouble.empty())
    page.warning("Not known well: " + trouble);
  if (const auto strength = body.value("fatigue_strength", ""); !strength.empty()) page.paragraph(strength);
  if (const auto rise = body.at("governing").value("rises_towards_edge", ""); !rise.empty())
    page.warning("Sharp edge: " + rise);
  page.paragraph(number(body.at("dofs"), 1, "{:.0f}") + " unknowns, " + number(body.at("mass").at("value")) +
                 " kg, " + solved_by(body) + ".");
  add_headlines(page, body);
  page.picture(directory / name / "envelope.png", "Largest von Mises stress over the cycle, " + name);
  add_zones(page, body);
  const auto& governing = body.at("governing");
  const auto& peak = body.at("peak_von_mises");
  page.folded("How well the stress is known", [&] {
    add_budget(page, governing.at("name").get<std::string>(), governing.at("error"),
               governing.at("value").get<double>());
  });
  page.folded("How the mesh was found", [&] { add_search(page, body); });
  page.folded("Shares of all effects", [&] { add_effects(page, peak); });
  add_shaft_torsion(page, body);
  add_seats(page, body);
  add_fatigue(page, body);
}

/// What rounding leaves of a mean that is none is 0.
std::string mean_of(const Json& load) {
  const auto size = [&](const char* key) {
    return load.at(key).is_number() ? std::abs(load.at(key).get<double>()) : 0.0;
  };
  if (!load.at("mean").is_number()) return "-";
  return number(without_rounding(load.at("mean").get<double>(), std::max(size("max"), size("min"))));
}

void add_loads(HtmlPage& page, const Json& summary) {
  if (!summary.contains("loads")) return;  // all are zero
  Rows rows;
  for (const auto& [name, load] : summary.at("loads").items())
    rows.push_back({name, number(load.at("max")), number(load.at("min")), mean_of(load),
                    number(load.at("rms")), load.at("unit").get<std::string>()});
  page.heading(2, "Loads over the cycle");
  page.table({"load", "max", "min", "mean", "rms", "unit"}, rows);
}

/// What the scene asks beyond L10; a table only if it asks.
void add_bearing_answers(HtmlPage& page, const Json& bearings) {
  const std::vector<std::pair<const char*, const char*>> keys = {
      {"reliability", "reliability"},
      {"a1", "a1 (ISO 281)"},
      {"a_ISO", "a_ISO (ISO 281)"},
      {"modified_life", "modified life h (ISO 281)"},
      {"required_life", "required life h"},
      {"required_rating", "required rating N (ISO 281)"},
      {"required_rating_weibull", "required rating N (Weibull)"},
      {"reliability_weibull", "reliability at the required life (Weibull)"},
      {"static_safety", "static safety"}};
  Rows rows;
  for (const auto& [name, bearing] : bearings.items())
    for (const auto& [key, title] : keys)
      if (bearing.contains(key)) {
        const Json& value = bearing.at(key);
        rows.push_back({name, title, number(value.is_object() ? value.at("value") : value, 1, "{:.5g}")});
      }
  if (!rows.empty()) page.table({"bearing", "asked", ""}, rows);
}

void add_bearings(HtmlPage& page, const Json& summary) {
  if (!summary.contains("bearings")) return;
  Rows rows;
  for (const auto& [name, bearing] : summary.at("bearings").items())
    rows.push_back(
        {name, number(bearing.at("equivalent_load").at("value")),
         number(bearing.at("largest_load").at("value")),
         bearing.at("L10h").is_null() ? "-" : number(bearing.at("L10h").at("value"), 1, "{:.0f}")});
  page.heading(2, "Bearings");
  page.table({"bearing", "equivalent load N", "largest N", "L10h hours"}, rows);
  add_bearing_answers(page, summary.at("bearings"));
}

void add_natural_frequencies(HtmlPage& page, const Json& summary) {
  if (!summary.contains("torsion")) return;
  Rows rows;
  for (const auto& frequency : summary.at("torsion").at("natural_frequencies"))
    rows.push_back({fmt::format("{}", rows.size() + 1), number(frequency.at("value")),
                    number(frequency.at("value"), 60 / (2 * pi))});
  page.heading(2, "Torsional natural frequencies");
  page.table({"mode", "rad/s", "per minute"}, rows);
}

void add_accuracy(HtmlPage& page, const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> tables;
  if (std::filesystem::is_directory(directory))
    for (const auto& entry : std::filesystem::directory_iterator(directory))
      if (entry.path().extension() == ".txt") tables.push_back(entry.path());
  if (tables.empty()) return;
  std::sort(tables.begin(), tables.end());
  page.heading(2, "What accuracy costs in time");
  for (const auto& table : tables) {
    auto chart = table;
    page.picture(chart.replace_extension(".png"), "Error against seconds, " + table.stem().string());
    page.preformatted(file_text(table));
  }
}

void add_timing(HtmlPage& page, const Json& summary) {
  Rows rows;
  for (const auto& [stage, cost] : summary.at("timing").items())
    rows.push_back({stage, number(cost.at("seconds"), 1, "{:.2f}"),
                    number(cost.at("peak_memory_gigabytes"), 1, "{:.2f}")});
  page.heading(2, "Time and memory");
  page.table({"stage", "seconds", "largest memory so far, GB"}, rows);
}

std::string window_of(const Json& input) {
  if (!input.contains("run_up"))
    return fmt::format("{} turn{} of {} instants", number(input.at("turns"), 1, "{:.0f}"),
                       input.at("turns") == 1 ? "" : "s", number(input.at("instants_per_turn"), 1, "{:.0f}"));
  const auto& run = input.at("run_up");
  return fmt::format("a run-up of {} s, {} turns, {} instants", number(run.at("duration").at("value")),
                     number(run.at("turns").at("value"), 1, "{:.3g}"),
                     number(run.at("instants"), 1, "{:.0f}"));
}

std::string page_of(const Json& summary, const std::filesystem::path& directory,
                    const std::filesystem::path& accuracy) {
  const auto& input = summary.at("input");
  HtmlPage page(input.at("title").get<std::string>());
  page.heading(1, input.at("title").get<std::string>());
  page.paragraph(fmt::format("{}, {}; scene {} ({}); millstress {}",
                             with_spaces(input.at("machine").get<std::string>()), window_of(input),
                             input.at("scene").get<std::string>(), input.at("hash").get<std::string>(),
                             summary.at("program").at("version").get<std::string>()));
  if (input.contains("settings"))
    for (const auto& setting : input.at("settings"))
      page.paragraph("Set on the command line: " + setting.get<std::string>());
  add_verdict(page, summary);
  page.folded(fmt::format("Warnings ({})", summary.at("warnings").size()), [&] {
    for (const auto& warning : summary.at("warnings")) page.warning(warning.get<std::string>());
  });
  if (summary.contains("bodies"))
    for (const auto& [name, body] : summary.at("bodies").items()) add_body(page, directory, name, body);
  add_loads(page, summary);
  add_bearings(page, summary);
  add_fatigue_ranking(page, summary);
  add_duty(page, summary);
  add_natural_frequencies(page, summary);
  add_resonance_margins(page, summary);
  add_accuracy(page, accuracy);
  if (summary.contains("timing")) page.folded("Time and memory", [&] { add_timing(page, summary); });
  return page.text();
}

}  // namespace

std::string html_report(const std::filesystem::path& directory, const std::filesystem::path& accuracy) {
  const auto file = directory / "summary.json";
  if (std::error_code none; !std::filesystem::exists(file, none))
    throw OptionError(file.string() +
                      ": there is no such file; give the result directory of a run "
                      "(millstress run SCENE -o DIR leaves one)");
  const auto refuse = [&](const std::string& why) {
    throw OptionError(file.string() + ": is no summary of a run (" + why +
                      "); run the scene again with this version");
  };
  const auto summary = read_json_file(file);
  if (const auto size = size_of_file(file); size > most_bytes_of_a_result)
    refuse("it has " + size_text(size) + ", more than any of them");
  if (summary.is_discarded()) refuse("it is no whole JSON text");
  std::string page;
  try {
    page = page_of(summary, directory, accuracy);
  } catch (const nlohmann::json::exception& error) {
    refuse(error.what());
  }
  return page;
}

bool is_html_report(const std::filesystem::path& file) {
  const std::string text = file_text(file), program = "; millstress ";
  const std::string begin = HtmlPage("").text().substr(0, 60), end = "</body>\n</html>\n";
  return text.compare(0, begin.size(), begin) == 0 && text.size() > end.size() &&
         text.compare(text.size() - end.size(), end.size(), end) == 0 &&
         text.find(program) != std::string::npos;
}

void write_html_report(const std::filesystem::path& directory, const std::filesystem::path& accuracy) {
  write_text_file(directory / "report.html", html_report(directory, accuracy));
}

}  // namespace pipelines

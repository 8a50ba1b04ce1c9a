#include "pipelines/write/report/html_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/json_file.h"
#include "pipelines/base/files/whole_file.h"
#include "pipelines/judge/verdict/verdict_text.h"
#include "pipelines/loads/channels/load_figures.h"
#include "pipelines/write/exports/html_page.h"
#include "pipelines/write/fields/bearing_fields.h"
#include "pipelines/write/fields/run_fields.h"
#include "pipelines/write/fields/train_fields.h"
#include "pipelines/write/fields/zone_fields.h"
#include "pipelines/write/living/living_assets.h"
#include "pipelines/write/parts/duty_report.h"
#include "pipelines/write/parts/fatigue_report.h"
#include "pipelines/write/parts/shaft_torsion_report.h"
#include "pipelines/write/report/page_parts.h"

namespace pipelines {
namespace {

using summary::Json;
using Rows = std::vector<std::vector<std::string>>;

constexpr std::size_t n_rows_of_fatigue = 12;

/// JSON has no infinities: they are null or text there. "-" for what is no number and no text.
std::string number(const Json& value, double factor = 1, const char* format = "{:.4g}") {
  if (!value.is_number()) return value.is_string() ? value.get<std::string>() : "-";
  const double shown = factor * value.get<double>();
  return std::isfinite(shown) ? fmt::format(fmt::runtime(format), shown) : "-";
}

/// A stress given in Pa.
std::string MPa(const Json& pascals) {
  return number(pascals, 1e-6, "{:.1f}");
}

std::string file_text(const std::filesystem::path& file) {
  return whole_file(file).value_or("");
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
  page.table({{"source of error", "MPa", "share", "how it was estimated"}, rows});
}

void add_effects(HtmlPage& page, const Json& peak) {
  if (!peak.contains("effect_share")) return;
  Rows rows;
  for (const auto& [effect, share] : peak.at("effect_share").items())
    rows.push_back({effect, number(share, 100, "{:.2f} %")});
  page.heading(3, "What the peak is made of");
  page.table({{"effect", "share"}, rows});
  if (!peak.contains("effect_group_share")) return;
  Rows sums;
  for (const auto& [group, share] : peak.at("effect_group_share").items())
    sums.push_back({group, number(share, 100, "{:.2f} %")});
  page.table({{"in sum", "share"}, sums});
}

void add_zones(HtmlPage& page, const std::string& name, const Json& body) {
  const auto& zones = body.at("zones");
  const auto fields = fields_of(zone_fields());
  page.heading(3, "Zones above " + MPa(body.at("zone_level").at("value")) + " MPa");
  page.table(shown_rows(fields, zones, zones.size()));
  page.folded("What brings the zones of the " + name,
              [&] { page.table(shown_details(fields, zones, zones.size())); });
  auto parts = Json::array();
  for (const auto& zone : zones)
    for (const auto& part : zone.value("parts", Json::array())) parts.push_back(part);
  page.folded("Parts of the zones of the " + name,
              [&] { page.table(shown_rows(fields_of(zone_part_fields()), parts, parts.size())); });
  if (!body.contains("hot_spots")) return;
  constexpr std::size_t most = 12;
  page.heading(3, "Hot-spot stress at weld toes");
  page.table(shown_rows(fields_of(hot_spot_fields()), body.at("hot_spots"), most));
}

void add_search(HtmlPage& page, const Json& body) {
  if (!body.contains("search")) return;
  const auto& search = body.at("search");
  page.heading(3, search.at("tolerance") == 0
                      ? "The way within the time limit"
                      : "The way to the tolerance of " + number(search.at("tolerance"), 100, "{:g} %"));
  page.table(shown_named_rows("step", fields_of(search_step_fields()), search.at("steps")));
  page.paragraph("It ended because " + search.at("ended").get<std::string>() + ".");
}

void add_seats(HtmlPage& page, const Json& body) {
  if (!body.contains("seats")) return;
  page.heading(3, "Deflection and slope");
  page.table(shown_seats(body.at("seats")));
}

void add_shaft_torsion(HtmlPage& page, const Json& body) {
  if (body.contains("torsion") && body.at("torsion").contains("elements")) {
    const auto& elements = body.at("torsion").at("elements");
    page.heading(3, "Torsion");
    page.table(shown_element_torques(elements));
    page.table(shown_element_stresses(elements));
  }
  if (!body.contains("start_up")) return;
  page.heading(3, "Start-up");
  page.table(shown_start_up(body.at("start_up")));
}

void add_vibration(HtmlPage& page, const Json& body) {
  if (!body.contains("natural_frequencies")) return;
  page.heading(3, "Natural frequencies");
  page.table(shown_named_rows("mode", fields_of(natural_frequency_fields()), body.at("natural_frequencies")));
}

void add_critical_speeds(HtmlPage& page, const std::filesystem::path& folder, const Json& body) {
  if (!body.contains("critical_speeds")) return;
  const auto& speeds = body.at("critical_speeds");
  page.heading(3, "Critical speeds");
  for (const char* key : {"modes", "loads"})
    page.table(shown_rows(fields_of(critical_speed_fields()), speeds.at(key), speeds.at(key).size()));
  page.paragraph(speeds.at("held").get<std::string>() + "; " + speeds.at("model").get<std::string>() + ".");
  page.picture(folder / "campbell.png", "Whirl over the speed of the shaft, and the orders of its loads");
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

/// First of all: what the machine is judged by.
void add_verdict(HtmlPage& page, const Json& summary) {
  const auto& verdict = summary.at("verdict");
  page.verdict(verdict.at("judgement").get<std::string>(), verdict.at("headline").get<std::string>());
  std::string left_out;
  for (const auto& what : verdict.value("left_out", Json::array()))
    left_out += (left_out.empty() ? "" : ", ") + what.get<std::string>();
  if (!left_out.empty()) page.paragraph("Not weighed, by the scene: " + left_out + ".");
  ShownRows rows;
  for (const auto& [name, part] : verdict.at("parts").items()) {
    auto own = shown_rows(fields_of(finding_fields()), part.at("findings"), part.at("findings").size());
    rows.titles = std::move(own.titles);
    for (auto& cells : own.cells) cells.insert(cells.begin(), name), rows.cells.push_back(std::move(cells));
  }
  rows.titles.insert(rows.titles.begin(), "of");
  page.table(rows);
}

/// The first table of a list in summary.json; nothing without it.
template <typename Row>
void add_list(HtmlPage& page, const FieldTable<Row>& fields, const Json& of, const char* key) {
  if (of.contains(key)) page.table(shown_rows(fields_of(fields), of.at(key), n_rows_of_fatigue));
}

void add_fatigue(HtmlPage& page, const Json& body) {
  if (!body.contains("fatigue")) return;
  const Json& fatigue = body.at("fatigue");
  page.heading(3, "Fatigue");
  add_list(page, fatigue_fields(), fatigue, "places");
  add_list(page, weld_fields(), fatigue, "welds");
  page.folded("Other rules and assumptions of fatigue", [&] {
    page.table(shown_details(fields_of(fatigue_fields()), fatigue.at("places"), n_rows_of_fatigue));
    add_list(page, din_743_fields(), fatigue, "din_743");
    for (const auto& line : fatigue.at("assumptions")) page.paragraph(line.get<std::string>());
  });
}

void add_fatigue_ranking(HtmlPage& page, const Json& summary) {
  if (!summary.contains("fatigue_ranking")) return;
  const auto& ranking = summary.at("fatigue_ranking");
  std::vector<std::string> bodies;
  for (const auto& place : ranking) bodies.push_back(place.at("body").get<std::string>());
  auto rows = Json::array();
  for (const auto i : rows_shown(bodies, n_rows_of_fatigue)) rows.push_back(ranking.at(i));
  page.heading(2, std::string("Fatigue of all bodies") +
                      (summary.contains("duty") ? ", over all operating blocks" : ""));
  page.table(shown_rows(fields_of(ranking_fields()), rows, rows.size()));
}

void add_duty(HtmlPage& page, const Json& summary) {
  if (!summary.contains("duty")) return;
  const Json& duty = summary.at("duty");
  page.heading(2, "Operating blocks");
  page.table(shown_blocks(duty.at("blocks")));
  if (duty.contains("places"))
    for (const auto& [body, places] : duty.at("places").items()) {
      page.heading(3, body + ": life over all blocks");
      page.table(shown_duty_places(places, n_rows_of_fatigue));
    }
  if (duty.contains("bearings")) page.table(shown_duty_bearings(duty.at("bearings")));
}

void add_body(HtmlPage& page, const std::filesystem::path& directory, const std::string& name,
              const Json& body) {
  page.heading(2, "The " + name);
  if (const auto trouble = body.at("governing").value("not_known_well", ""); !trouble.empty())
    page.warning("Not known well: " + trouble);
  if (const auto strength = body.value("fatigue_strength", ""); !strength.empty()) page.paragraph(strength);
  if (const auto rise = body.at("governing").value("rises_towards_edge", ""); !rise.empty())
    page.warning("Sharp edge: " + rise);
  page.paragraph(fmt::format("{} unknowns, {} kg of {} with a yield strength of {} MPa, {}.",
                             number(body.at("dofs"), 1, "{:.0f}"), number(body.at("mass").at("value")),
                             body.at("material").get<std::string>(),
                             MPa(body.at("yield_strength").at("value")), solved_by(body)));
  page.table(headline_rows(body));
  page.markup("<div class=\"still\">\n");  // in print, and where nothing draws in three dimensions
  page.picture(directory / name / "envelope.png", "Largest von Mises stress over the cycle, " + name);
  page.markup("</div>\n");
  add_zones(page, name, body);
  const auto& governing = body.at("governing");
  const auto& peak = body.at("peak_von_mises");
  page.folded("How well the stress is known", [&] {
    add_budget(page, governing.at("name").get<std::string>(), governing.at("error"),
               governing.at("value").get<double>());
  });
  page.folded("How the mesh was found", [&] { add_search(page, body); });
  page.folded("Shares of all effects", [&] { add_effects(page, peak); });
  add_vibration(page, body);
  add_critical_speeds(page, directory / name, body);
  add_shaft_torsion(page, body);
  add_seats(page, body);
  add_fatigue(page, body);
}

void add_loads(HtmlPage& page, const Json& summary) {
  if (!summary.contains("loads")) return;  // all are zero
  page.heading(2, "Loads over the cycle");
  page.table(shown_named_rows("load", fields_of(load_fields()), summary.at("loads")));
}

void add_bearings(HtmlPage& page, const Json& summary) {
  if (!summary.contains("bearings")) return;
  page.heading(2, "Bearings");
  page.table(shown_bearings(summary.at("bearings")));
  page.table(shown_bearing_answers(summary.at("bearings")));
}

/// Frequencies and torques of a drive train; nothing of other machines.
void add_train(HtmlPage& page, const Json& summary) {
  if (!summary.contains("torsion")) return;
  const auto& torsion = summary.at("torsion");
  page.heading(2, "Torsional natural frequencies");
  page.table(shown_named_rows("mode", fields_of(train_mode_fields()), torsion.at("natural_frequencies"), 0));
  if (!torsion.contains("margins") || torsion.at("margins").empty()) return;
  const auto rows = shown_margins(torsion.at("margins"));
  page.heading(2, "Resonance margins");
  page.table(rows);
  if (const auto text = margins_left_out(torsion.at("margins").size(), rows.cells.size()); !text.empty())
    page.paragraph("Not shown: " + text.substr(4) + " (torsion/margins.csv).");
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
  page.heading(2, "Time and memory");
  page.table(shown_named_rows("stage", fields_of(stage_fields()), summary.at("timing")));
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

/// Keys of the living page; null where there is none.
Json keys_of(const LivingPage& living) {
  return living.empty() ? Json(nullptr) : Json::parse(living.keys);
}

void add_head(HtmlPage& page, const Json& summary) {
  const auto& input = summary.at("input");
  page.markup("<header>\n");
  page.heading(1, input.at("title").get<std::string>());
  page.paragraph(fmt::format("{}, {}; scene {} ({}); millstress {}",
                             with_spaces(input.at("machine").get<std::string>()), window_of(input),
                             input.at("scene").get<std::string>(), input.at("hash").get<std::string>(),
                             summary.at("program").at("version").get<std::string>()));
  add_verdict(page, summary);
  add_cards(page, summary);
  if (input.contains("settings"))
    for (const auto& setting : input.at("settings"))
      page.paragraph("Set on the command line: " + setting.get<std::string>());
  page.folded(fmt::format("Warnings ({})", summary.at("warnings").size()), [&] {
    for (const auto& warning : summary.at("warnings")) page.warning(warning.get<std::string>());
  });
  page.markup("</header>\n");
}

std::string page_of(const Json& summary, const std::filesystem::path& directory,
                    const std::filesystem::path& accuracy, const LivingPage& living) {
  HtmlPage page(summary.at("input").at("title").get<std::string>(), page_style(),
                living.empty() ? "" : page_script());
  add_head(page, summary);
  page.markup("<main>\n<div id=\"living\"></div>\n");
  if (summary.contains("bodies"))
    for (const auto& [name, body] : summary.at("bodies").items()) add_body(page, directory, name, body);
  add_loads(page, summary);
  add_bearings(page, summary);
  add_fatigue_ranking(page, summary);
  add_duty(page, summary);
  add_train(page, summary);
  add_accuracy(page, accuracy);
  add_inputs(page, summary, keys_of(living));
  if (summary.contains("timing")) page.folded("Time and memory", [&] { add_timing(page, summary); });
  page.markup("</main>\n" + living_elements(living));
  return page.text();
}

std::string report_of(const std::filesystem::path& directory, const std::filesystem::path& accuracy,
                      const LivingPage& living) {
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
    page = page_of(summary, directory, accuracy, living);
  } catch (const nlohmann::json::exception& error) {
    refuse(error.what());
  }
  return page;
}

}  // namespace

std::string html_report(const std::filesystem::path& directory, const std::filesystem::path& accuracy) {
  return report_of(directory, accuracy, living_of(file_text(directory / living_data_name)));
}

void write_html_report(const std::filesystem::path& directory, const std::filesystem::path& accuracy,
                       const LivingPage& living) {
  if (!living.empty()) write_text_file(directory / living_data_name, living_file(living));
  write_text_file(directory / "report.html", report_of(directory, accuracy, living));
}

}  // namespace pipelines

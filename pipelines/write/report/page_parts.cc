#include "pipelines/write/report/page_parts.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "pipelines/base/files/toml_tree.h"
#include "pipelines/base/names/typography.h"
#include "pipelines/scene/reader/key_settings.h"
#include "pipelines/write/exports/markup.h"

namespace pipelines {
namespace {

using summary::Json;

std::string text_of(const std::string& text) {
  return escaped(typographic(text));
}

std::string megapascals(double pascals) {
  return fmt::format("{:.{}f}", pascals / 1e6, std::abs(pascals) < 100e6 ? 2 : 1);
}

/// The stress as a bar up to the yield strength, with the error on both sides of its end.
std::string bar(double stress_Pa, double error_Pa, double yield_Pa) {
  const auto percent = [&](double pascals) { return std::clamp(100 * pascals / yield_Pa, 0.0, 100.0); };
  const double from = percent(stress_Pa - error_Pa), to = percent(stress_Pa + error_Pa);
  return fmt::format(
      "<div class=\"bar\" role=\"img\" aria-label=\"{0:.0f} % of the yield strength\"><i "
      "style=\"width:{1:.1f}%\"></i>"
      "<u style=\"left:{2:.1f}%;width:{3:.1f}%\"></u></div><p class=\"ends\"><span>{0:.0f} % of yield</span>"
      "<span>{4} MPa</span></p>",
      100 * stress_Pa / yield_Pa, percent(stress_Pa), from, to - from, megapascals(yield_Pa));
}

/// "fatigue: 12000 h of 20000 h" of all that was judged beside yield.
std::string findings_of(const Json& part) {
  std::string lines;
  for (const auto& finding : part.at("findings"))
    if (finding.at("criterion") != "yield")
      lines += "<li>" +
               text_of(finding.at("criterion").get<std::string>() + ": " +
                       finding.at("figure").get<std::string>()) +
               "</li>";
  return lines.empty() ? "" : "<ul>" + lines + "</ul>";
}

/// @param parts  of the verdict
std::string card(const std::string& name, const Json& body, const Json& parts) {
  const auto& governing = body.at("governing");
  const double stress_Pa = governing.at("value").get<double>();
  const auto& total = governing.at("error").at("total");
  const double error_Pa = total.is_number() ? total.get<double>() : 0;
  const auto& strength = body.at("yield_strength").at("value");
  const auto safety = governing.at("safety_against_yield");
  std::string judgement, findings;
  if (parts.contains(name)) {
    const auto& part = parts.at(name);
    judgement = part.at("judgement").get<std::string>();
    findings = findings_of(part);
  }
  const char* colour = judgement == "OK" ? "ok" : judgement == "NOT OK" ? "not-ok" : "not-judged";
  return fmt::format(
      "<div class=\"card\" data-body=\"{0}\"><p class=\"of\"><strong>{0}</strong><span class=\"pill "
      "{1}\">{2}</span></p>"
      "<p class=\"figure\">{3} <small>{4} MPa</small></p>{5}<p>{6}{7}</p>{8}</div>\n",
      text_of(name), colour, text_of(judgement), megapascals(stress_Pa),
      total.is_number() ? "± " + megapascals(error_Pa) : "",
      strength.is_number() && strength.get<double>() > 0 ? bar(stress_Pa, error_Pa, strength.get<double>())
                                                         : "",
      safety.is_number() ? fmt::format("<strong>Safety {:.2f}</strong> against yield, ", safety.get<double>())
                         : "",
      text_of(governing.at("name").get<std::string>() + " at " + governing.at("feature").get<std::string>()),
      findings);
}

std::string names_in(const Json& effects) {
  std::string names;
  for (const auto& effect : effects)
    names += (names.empty() ? "" : ", ") + effect.at("name").get<std::string>();
  return names.empty() ? "none" : names;
}

void add_scene(HtmlPage& page, const std::string& scene) {
  if (scene.empty()) return;
  page.folded("Every input of the scene", [&] {
    ShownRows rows{{"key", "as it is written"}, {}};
    try {
      for_each_value(parse_toml(scene), [&](const std::string& key, const TomlNode& value) {
        rows.cells.push_back({key, value.as_written});
      });
    } catch (const TomlSyntaxError&) {  // cut, or of another version: the text below still says it
      return;
    }
    page.table(rows);
  });
  page.folded("The scene's text", [&] { page.preformatted(scene); });
}

}  // namespace

void add_cards(HtmlPage& page, const Json& summary) {
  if (!summary.contains("bodies")) return;
  std::string cards;
  for (const auto& [name, body] : summary.at("bodies").items())
    cards += card(name, body, summary.at("verdict").at("parts"));
  page.markup("<div class=\"cards\">\n" + cards + "</div>\n");
}

void add_inputs(HtmlPage& page, const Json& summary, const Json& living) {
  const auto& input = summary.at("input");
  page.heading(2, "Inputs");
  ShownRows rows{{"", ""}, {}};
  rows.cells.push_back({"machine", input.at("machine").get<std::string>()});
  if (!living.is_null()) {
    rows.cells.push_back(
        {"speed of the drive", fmt::format("{:.5g} rpm", living.at("cycle").at("speed_rpm").get<double>())});
    rows.cells.push_back({"effects on", names_in(living.at("effects").at("on"))});
    rows.cells.push_back({"effects off", names_in(living.at("effects").at("off"))});
  }
  if (summary.contains("bodies"))
    for (const auto& [name, body] : summary.at("bodies").items())
      rows.cells.push_back({name + ", material", body.at("material").get<std::string>()});
  if (input.contains("settings"))
    for (const auto& setting : input.at("settings"))
      rows.cells.push_back({"set on the command line", setting.get<std::string>()});
  page.table(rows);
  if (!living.is_null()) add_scene(page, living.value("scene", ""));
}

}  // namespace pipelines

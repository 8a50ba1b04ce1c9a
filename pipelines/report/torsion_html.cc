#include "pipelines/report/torsion_html.h"

#include <fmt/core.h>

#include <string>
#include <vector>

#include "pipelines/common/constants.h"

namespace pipelines {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

constexpr double two_pi = 2 * pi;

std::string text_of(const Json& value, double factor = 1, const char* format = "{:.4g}") {
  return value.is_number() ? fmt::format(fmt::runtime(format), factor * value.get<double>()) : "-";
}

void add_start_row(const std::string& name, const Json& of, double factor, const std::string& where,
                   Rows& rows) {
  rows.push_back({name, text_of(of.at("value"), factor), text_of(of.at("time_s")),
                  text_of(of.at("steady"), factor), text_of(of.at("factor"), 1, "{:.2f}"), where});
}

}  // namespace

void add_resonance_margins(HtmlPage& page, const Json& summary) {
  if (!summary.contains("torsion") || !summary.at("torsion").contains("margins")) return;
  Rows rows;
  for (const auto& m : summary.at("torsion").at("margins"))
    rows.push_back({m.at("excitation").get<std::string>(), text_of(m.at("frequency_rad_s"), 1 / two_pi),
                    text_of(m.at("mode"), 1, "{:.0f}"), text_of(m.at("natural_frequency_rad_s"), 1 / two_pi),
                    text_of(m.at("margin"), 100, "{:.1f} %"), text_of(m.at("amplification"), 1, "{:.3g}")});
  if (rows.empty()) return;
  page.heading(2, "Resonance margins");
  page.table({"excitation", "Hz", "mode", "natural Hz", "margin", "amplification"}, rows);
}

void add_shaft_torsion(HtmlPage& page, const Json& body) {
  if (body.contains("torsion") && body.at("torsion").contains("elements")) {
    Rows rows;
    for (const auto& [element, of] : body.at("torsion").at("elements").items()) {
      std::vector<std::string> row{
          element, of.at("port").get<std::string>(), text_of(of.at("torque").at("mean")),
          text_of(of.at("torque").at("amplitude")), text_of(of.at("torque_by_stress").at("largest"))};
      if (of.contains("largest_stress")) {
        const auto& stress = of.at("largest_stress");
        for (const char* part : {"mean", "amplitude"}) row.push_back(text_of(stress.at(part), 1e-6));
        row.push_back(text_of(stress.at("factor"), 1, "{:.2f}"));
        row.push_back(stress.at("feature").get<std::string>());
      } else {
        row.resize(9, "-");
      }
      rows.push_back(std::move(row));
    }
    page.heading(3, "Torsion");
    page.table({"element", "port", "mean N m", "amplitude N m", "largest by stress field N m", "static MPa",
                "oscillating MPa", "K_ts", "where"},
               rows);
  }
  if (!body.contains("start_up")) return;
  const auto& start = body.at("start_up");
  Rows rows;
  const auto& peak = start.at("peak_von_mises");
  add_start_row("von Mises stress MPa", peak, 1e-6, peak.at("feature").get<std::string>(), rows);
  if (start.contains("torsional_stress"))
    add_start_row("torsional stress MPa", start.at("torsional_stress"), 1e-6,
                  start.at("torsional_stress").at("feature").get<std::string>(), rows);
  if (start.contains("elements"))
    for (const auto& [element, of] : start.at("elements").items())
      add_start_row("torque of " + element + " N m", of, 1, of.at("port").get<std::string>(), rows);
  page.heading(3, "Start-up");
  page.table({"", "largest", "at s", "in steady running", "factor", "where"}, rows);
}

}  // namespace pipelines

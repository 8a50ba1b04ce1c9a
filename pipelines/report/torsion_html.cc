#include "pipelines/report/torsion_html.h"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <vector>

#include "pipelines/common/constants.h"
#include "pipelines/machine_reports/torsion_report.h"
#include "pipelines/report/html_values.h"

namespace pipelines {
namespace {

using html::Json, html::number, html::Rows;

constexpr double two_pi = 2 * pi;

void add_start_row(const std::string& name, const Json& of, double factor, const std::string& where,
                   Rows& rows) {
  rows.push_back({name, number(of.at("value"), factor), number(of.at("time_s")),
                  number(of.at("steady"), factor), number(of.at("factor"), 1, "{:.2f}"), where});
}

/// As LineMargin::matters; of older results all do.
bool matters(const Json& margin) {
  return !margin.contains("torque_share") || std::abs(margin.at("margin").get<double>()) <= near_resonance ||
         margin.at("torque_share").get<double>() >= felt_torque_share;
}

}  // namespace

void add_resonance_margins(HtmlPage& page, const Json& summary) {
  if (!summary.contains("torsion") || !summary.at("torsion").contains("margins")) return;
  const auto& margins = summary.at("torsion").at("margins");
  Rows rows;
  for (const auto& m : margins)
    if (matters(m) || rows.empty())
      rows.push_back({m.at("excitation").get<std::string>(), number(m.at("frequency_rad_s"), 1 / two_pi),
                      number(m.at("mode"), 1, "{:.0f}"), number(m.at("natural_frequency_rad_s"), 1 / two_pi),
                      number(m.at("margin"), 100, "{:.1f} %"), number(m.at("amplification"), 1, "{:.3g}"),
                      m.contains("torque_share") ? number(m.at("torque_share"), 100, "{:.1f} %") : "-"});
  if (rows.empty()) return;
  page.heading(2, "Resonance margins");
  page.table({"excitation", "Hz", "mode", "natural Hz", "margin", "amplification", "of the torque"}, rows);
  if (rows.size() < margins.size())
    page.paragraph(
        fmt::format("And {} more in torsion/margins.csv, farther than {:g} % from a natural frequency and "
                    "below {:g} % of "
                    "every torque.",
                    margins.size() - rows.size(), 100 * near_resonance, 100 * felt_torque_share));
}

void add_shaft_torsion(HtmlPage& page, const Json& body) {
  if (body.contains("torsion") && body.at("torsion").contains("elements")) {
    Rows rows;
    for (const auto& [element, of] : body.at("torsion").at("elements").items()) {
      std::vector<std::string> row{
          element, of.at("port").get<std::string>(), number(of.at("torque").at("mean")),
          number(of.at("torque").at("amplitude")), number(of.at("torque_by_stress").at("largest"))};
      if (of.contains("largest_stress")) {
        const auto& stress = of.at("largest_stress");
        for (const char* part : {"mean", "amplitude"}) row.push_back(number(stress.at(part), 1e-6));
        row.push_back(number(stress.at("factor"), 1, "{:.2f}"));
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

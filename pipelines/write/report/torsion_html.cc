#include "pipelines/write/report/torsion_html.h"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <vector>

#include "pipelines/base/common/constants.h"
#include "pipelines/judge/verdict/torsion_report.h"
#include "pipelines/write/parts/shaft_torsion_report.h"
#include "pipelines/write/report/html_values.h"

namespace pipelines {
namespace {

using html::Json, html::number, html::Rows;

constexpr double two_pi = 2 * pi;

/// Whether a margin matters, as LineMargin::matters; of older results all do.
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
    const auto& elements = body.at("torsion").at("elements");
    page.heading(3, "Torsion");
    for (const auto& shown : {shown_element_torques(elements), shown_element_stresses(elements)})
      page.table(shown.titles, shown.cells);
  }
  if (!body.contains("start_up")) return;
  const auto shown = shown_start_up(body.at("start_up"));
  page.heading(3, "Start-up");
  page.table(shown.titles, shown.cells);
}

}  // namespace pipelines

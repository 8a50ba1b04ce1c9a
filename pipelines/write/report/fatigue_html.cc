#include "pipelines/write/report/fatigue_html.h"

#include <string>
#include <vector>

#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/write/parts/duty_report.h"
#include "pipelines/write/parts/fatigue_report.h"

namespace pipelines {
namespace {

using summary::Json;

constexpr std::size_t n_rows_of_fatigue = 12;

/// The first table of a list in summary.json; nothing without it.
template <typename Row>
void add_list(HtmlPage& page, const FieldTable<Row>& fields, const Json& of, const char* key) {
  if (of.contains(key)) page.table(shown_rows(fields_of(fields), of.at(key), n_rows_of_fatigue));
}

}  // namespace

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

}  // namespace pipelines

#include "pipelines/write/parts/duty_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <ostream>

#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/judge/analysis/weld_places.h"
#include "pipelines/judge/texts/damage_share_text.h"
#include "pipelines/write/fields/duty_fields.h"
#include "pipelines/write/parts/fatigue_report.h"

namespace pipelines {
namespace {

using summary::Json;

constexpr std::size_t n_duty_places_shown = 4;

std::string rule_of_lives() {
  return fmt::format(
      "lives: Palmgren-Miner over all blocks and starts, at each place one S-N curve for the cycles of all, "
      "at a damage sum of 1, at weld toes {:.3g}; the order of blocks does not count",
      damage_sum_of_spectra);
}

Json blocks_json(const DutyResult& duty) {
  const auto fields = block_fields();
  const auto of_stress = block_stress_fields();
  Json json;
  for (const auto& block : duty.blocks) {
    auto& entry = json[block.name] = summary_row(fields, block);
    entry["bodies"] = Json::object();
    for (const auto& stress : block.stresses) entry["bodies"][stress.body] = summary_row(of_stress, stress);
  }
  return json;
}

Json places_json(const DutyResult& duty, const std::string& body, const std::vector<DutyPlace>& places) {
  const auto fields = duty_place_fields();
  auto rows = Json::array();
  for (const auto& place : places) rows.push_back(summary_row(fields, DutyPlaceRow{duty, body, place}));
  return rows;
}

Json bearings_json(const DutyResult& duty) {
  const auto fields = duty_bearing_fields();
  Json json = Json::object();
  for (const auto& bearing : duty.bearings) json[bearing.name] = summary_row(fields, bearing);
  return json;
}

void print_places(std::ostream& out, const DutyResult& duty) {
  for (const auto& [body, places] : duty.places) {
    std::vector<std::vector<std::string>> notes;
    for (const auto& place : places)
      notes.push_back({damage_text(duty.effects.at(body), place.effect_share, place.damage_per_s > 0)});
    print_rows(out, body + " over all blocks",
               shown_duty_places(places_json(duty, body, places), n_duty_places_shown), notes);
    print_may_last_less(out, places.empty() ? "" : places.front().feature,
                        may_last_less(places, [](const auto& place) { return place.feature; }));
  }
  if (!duty.places.empty()) out << "    " << rule_of_lives() << '\n';
}

}  // namespace

ShownRows shown_blocks(const Json& blocks) {
  const auto of_block = fields_of(block_fields()), of_stress = fields_of(block_stress_fields());
  ShownRows table{{"operating block"}, {}};
  const auto cells_of = [](const std::vector<Field>& fields, const Json& row) {
    return shown_rows(fields, Json::array({row}), 1);
  };
  const auto add = [](std::vector<std::string>& to, const std::vector<std::string>& cells) {
    to.insert(to.end(), cells.begin(), cells.end());
  };
  add(table.titles, cells_of(of_block, Json::object()).titles);
  table.titles.push_back("body");
  add(table.titles, cells_of(of_stress, Json::object()).titles);
  for (const auto& [name, block] : blocks.items()) {
    auto bodies = block.at("bodies");
    if (bodies.empty()) bodies["-"] = Json::object();
    for (const auto& [body, stress] : bodies.items()) {
      auto& cells = table.cells.emplace_back(std::vector<std::string>{name});
      add(cells, cells_of(of_block, block).cells[0]);
      cells.push_back(body);
      add(cells, cells_of(of_stress, stress).cells[0]);
    }
  }
  return table;
}

ShownRows shown_duty_places(const Json& places, std::size_t most) {
  return shown_rows(fields_of(duty_place_fields()), places, most);
}

ShownRows shown_duty_bearings(const Json& bearings) {
  return shown_named_rows("bearing over all blocks", fields_of(duty_bearing_fields()), bearings);
}

void print_duty(std::ostream& out, const DutyResult& duty) {
  print_rows(out, "operating block", shown_blocks(blocks_json(duty)));
  const bool at_once = std::any_of(duty.blocks.begin(), duty.blocks.end(), [](const auto& block) {
    return block.starts_per_day > 0 && !block.has_transient;
  });
  if (at_once) out << "    starts without transient go from rest to running at once\n";
  if (duty.in_operation < 1 - 1e-9)
    out << fmt::format("    in operation {:.4g} % of the time; lives are hours in operation\n",
                       100 * duty.in_operation);
  print_places(out, duty);
  print_rows(out, "bearings over all blocks", shown_duty_bearings(bearings_json(duty)));
}

Json duty_json(const DutyResult& duty) {
  Json json;
  json["in_operation"] = summary::number(duty.in_operation);
  if (!duty.places.empty()) json["rule"] = rule_of_lives();
  json["blocks"] = blocks_json(duty);
  for (const auto& [body, places] : duty.places) json["places"][body] = places_json(duty, body, places);
  if (!duty.bearings.empty()) json["bearings"] = bearings_json(duty);
  return json;
}

void write_duty(const std::filesystem::path& file, const DutyResult& duty) {
  const auto fields = duty_place_fields();
  auto rows = Json::array();
  for (const auto& [body, places] : duty.places)
    for (const auto& place : places) rows.push_back(whole_row(fields, DutyPlaceRow{duty, body, place}));
  write_csv(file, csv_columns(fields_of(fields), rows));
}

}  // namespace pipelines

/// The README's tables of result files are those that the program writes by.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "pipelines/judge/verdict/verdict_text.h"
#include "pipelines/loads/channels/load_figures.h"
#include "pipelines/study/accuracy/accuracy_report.h"
#include "pipelines/study/effects/body_effect_report.h"
#include "pipelines/study/effects/effect_prices.h"
#include "pipelines/write/fields/bearing_fields.h"
#include "pipelines/write/fields/duty_fields.h"
#include "pipelines/write/fields/fatigue_fields.h"
#include "pipelines/write/fields/run_fields.h"
#include "pipelines/write/fields/shaft_fields.h"
#include "pipelines/write/fields/train_fields.h"
#include "pipelines/write/fields/zone_fields.h"
#include "pipelines/write/machines/free_body_report.h"
#include "tests/unit/pipelines/base/fields/tables_of_results.h"

using namespace pipelines;

namespace fields_test {

std::vector<Table> all_tables() {
  const std::string body = "`bodies.<body>.";
  return {
      {"`bodies.<body>`: what leads its report", fields_of(headline_fields())},
      {"`zones.csv`, " + body + "zones`", fields_of(zone_fields())},
      {"`zone_tree.csv`, " + body + "zones[].parts`", fields_of(zone_part_fields())},
      {"`hot_spots.csv`, " + body + "hot_spots`", fields_of(hot_spot_fields())},
      {body + "places`", fields_of(place_fields())},
      {"`fatigue.csv`, " + body + "fatigue.places`", fields_of(fatigue_fields())},
      {"`weld_fatigue.csv`, " + body + "fatigue.welds`", fields_of(weld_fields())},
      {body + "fatigue.din_743`", fields_of(din_743_fields())},
      {"`fatigue_ranking`", fields_of(ranking_fields())},
      {"`diagrams.csv`", fields_of(section_fields())},
      {"`torsion.csv`", fields_of(torsion_fields())},
      {body + "seats.<port>`", fields_of(seat_fields())},
      {body + "torsion.elements.<element>`",
       fields_of(joined(element_torque_fields(), element_stress_fields()))},
      {body + "start_up`: peak_von_mises, torsional_stress, elements.<element>",
       fields_of(joined(start_up_fields(), start_up_peak_fields()))},
      {"`bearings.<bearing>`", fields_of(joined(bearing_fields(), bearing_answer_fields()))},
      {"`duty.blocks.<block>`", fields_of(block_fields())},
      {"`duty.blocks.<block>.bodies.<body>`", fields_of(block_stress_fields())},
      {"`duty.csv`, `duty.places.<body>`", fields_of(duty_place_fields())},
      {"`duty.bearings.<bearing>`", fields_of(duty_bearing_fields())},
      {"`statistics.csv`, `loads.<name>`", fields_of(load_fields())},
      {"`torsion.natural_frequencies`", fields_of(train_mode_fields())},
      {"`torsion.elements.<element>`", fields_of(train_element_fields())},
      {"`margins.csv`, `torsion.margins`", fields_of(margin_fields())},
      {body + "natural_frequencies`", fields_of(natural_frequency_fields())},
      {body + "critical_speeds`: modes, loads", fields_of(critical_speed_fields())},
      {body + "search.steps`", fields_of(search_step_fields())},
      {"`timing.<stage>`", fields_of(stage_fields())},
      {"`verdict.parts.<part>.findings`", fields_of(finding_fields())},
      {"`effects.<effect>.loads.<load>` of `effects --json`", fields_of(load_share_fields())},
      {"effects on a body, of `check`", fields_of(effect_size_fields())},
      {"effects, of `accuracy`", fields_of(effect_price_fields())},
      {"`accuracy/<body>.csv`, series of `accuracy/accuracy.h5`", fields_of(accuracy_fields())},
      {"`accuracy/<body>_gci.csv`", fields_of(grid_fields())},
      {"`free_body.csv`", fields_of(free_body_fields())},
  };
}

}  // namespace fields_test

namespace {

// tests/README.md says how to renew the README after a field was added.
TEST(FieldTables, StandInTheReadme) {
  std::string expected;
  for (const auto& table : fields_test::all_tables())
    expected += "\n### " + table.title + "\n\n" + markdown_table(table.fields);
  const std::string path = SOURCE_DIR "/pipelines/base/fields/README.md";
  const std::string title = "## The tables\n";
  std::ifstream in(path);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto begin = text.find(title);
  ASSERT_NE(begin, std::string::npos) << path;
  if (text.substr(begin + title.size()) == expected) return;
  const std::string renewed = "field_tables.md";
  std::ofstream(renewed) << text.substr(0, begin + title.size()) << expected;
  FAIL() << path << " is not what the tables of fields say; the text that it should have is in " << renewed;
}

TEST(FieldTables, SayWhatTheirFieldsMean) {
  for (const auto& table : fields_test::all_tables())
    for (const auto& field : table.fields) EXPECT_NE(field.meaning, "") << table.title << " " << field.key;
}

}  // namespace

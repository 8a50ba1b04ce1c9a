/// A field is one row of a table: what is declared there stands in every output.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/unit/pipelines/base/fields/tables_of_results.h"

using namespace pipelines;
using summary::Json;

namespace {

struct Sample {
  double stress_Pa = 0;
};

/// One field of each shape.
FieldTable<Sample> sample_fields() {
  using Field = FieldOf<Sample>;
  return {
      {"name", quantities::text, "its name", "sample", [](const Sample&) { return "a, b"; }},
      {"stress", quantities::stress, "of a sample", "stress", &Sample::stress_Pa},
      Field("force", as_figure(quantities::force), "in its unit",
            [](const Sample&) { return summary::figure(12.5, "N"); })
          .detail("force"),
      {"is_welded", quantities::flag, "or not", [](const Sample&) { return true; }},
      {"position", quantities::position, "of it", "at",
       [](const Sample&) {
         return Json::array({0.001, -0.0000001, 0.3});
       }},
      Field("from", quantities::moment, "an instant", "from",
            [](const Sample&) {
              return summary::object({{"turn", 3}, {"drive_angle_rad", 1.5707963267948966}});
            })
          .in_column("drive_angle_from"),
      Field("life_range", quantities::range_of_hours, "of a life",
            [](const Sample&) {
              return Json::array({10, nullptr});
            })
          .in_column("life"),
      Field("share", quantities::percentages, "by effect",
            [](const Sample& s) {
              return s.stress_Pa > 0 ? Json({{"belt", 0.25}}) : Json::object();
            })
          .in_column("share_"),
      Field("safety_by.goodman", quantities::ratio, "of one rule", "Goodman",
            [](const Sample&) { return Json(nullptr); })
          .in_column("safety_goodman"),
      {"causes", quantities::structure, "more",
       [](const Sample&) {
         return Json({{"a", 1}});
       }},
      Field("kind", quantities::text, "in CSV alone", [](const Sample&) { return "surface"; })
          .without_summary(),
      Field("days", quantities::count, "in the summary alone", [](const Sample&) { return 2; }).without_csv(),
  };
}

Json rows_of(const FieldTable<Sample>& fields, bool whole) {
  auto rows = Json::array();
  for (const Sample& s : {Sample{42.5e6}, Sample{0}})
    rows.push_back(whole ? whole_row(fields, s) : summary_row(fields, s));
  return rows;
}

std::string title(const CsvColumn& column) {
  return column.unit.empty() ? column.name : column.name + " [" + column.unit + "]";
}

TEST(FieldOutputs, SummaryHasSiUnits) {
  EXPECT_EQ(
      rows_of(sample_fields(), false)[0].dump(),
      R"({"name":"a, b","stress_Pa":42500000.0,"force":{"value":12.5,"unit":"N"},"is_welded":true,)"
      R"("position_m":[0.001,-1e-07,0.3],"from":{"turn":3,"drive_angle_rad":1.5707963267948966},)"
      R"("life_range_h":[10,null],"share":{"belt":0.25},"safety_by":{"goodman":null},"causes":{"a":1},"days":2})");
}

TEST(FieldOutputs, CsvHasTheUnitsOfPeople) {
  std::string titles, first, second;
  for (const auto& column : csv_columns(fields_of(sample_fields()), rows_of(sample_fields(), true))) {
    titles += title(column) + "|";
    const auto& cells = std::get<std::vector<std::string>>(column.cells);
    first += cells.at(0) + "|";
    second += cells.at(1) + "|";
  }
  EXPECT_EQ(
      titles,
      "name|stress [MPa]|force [N]|is_welded|x [mm]|y [mm]|z [mm]|drive_angle_from [deg]|life_least [h]|"
      "life_most [h]|share_belt [%]|safety_goodman|kind|");
  EXPECT_EQ(first, "a, b|42.5|12.5|1|1|-0.0001|300|810|10||25||surface|");
  EXPECT_EQ(second, "a, b|0|12.5|1|1|-0.0001|300|810|10||||surface|") << "no share: an empty cell";
}

TEST(FieldOutputs, PeopleReadLabelledFields) {
  const auto fields = fields_of(sample_fields());
  const auto rows = rows_of(sample_fields(), false);
  const auto shown = shown_rows(fields, rows, 1);
  EXPECT_EQ(shown.titles, (std::vector<std::string>{"sample", "stress MPa", "at mm", "from", "Goodman"}));
  ASSERT_EQ(shown.cells.size(), 1u) << "the first row alone";
  EXPECT_EQ(shown.cells[0],
            (std::vector<std::string>{"a, b", "42.5", "(1.0, 0.0, 300.0)", "turn 3, 90 deg", "-"}));
  EXPECT_EQ(shown_details(fields, rows, 9).titles, (std::vector<std::string>{"sample", "force N"}));
  EXPECT_EQ(shown_value(fields[1], Json::object()), "-") << "a row of an earlier version";
  std::ostringstream out;
  print_rows(out, "samples", shown, {{"by belt 25 %", ""}});
  EXPECT_EQ(out.str(),
            "\n  samples  stress MPa  at mm              from            Goodman\n"
            "  a, b           42.5  (1.0, 0.0, 300.0)  turn 3, 90 deg        -\n"
            "       by belt 25 %\n");
}

// Of each result: one row more, and it is in CSV, summary, tables for people, and README.
TEST(FieldOutputs, OneMoreRowIsInAllOfThem) {
  for (const auto& table : fields_test::all_tables()) {
    SCOPED_TRACE(table.title);
    auto fields = table.fields;
    const FieldOf<Sample> extra = FieldOf<Sample>("wear", quantities::length, "of a test", "wear",
                                                  [](const Sample&) { return 0.0425; });
    fields.push_back(extra);
    auto row = Json::object();
    set_value(row, extra, extra.value({}));
    const auto rows = Json::array({row});
    EXPECT_EQ(row.at("wear_m"), 0.0425);
    EXPECT_EQ(shown_rows(fields, Json::array(), 1).titles.back(), "wear mm");
    EXPECT_EQ(shown_value(fields.back(), row), "42.5");
    const auto column = csv_columns(fields, rows).back();
    EXPECT_EQ(title(column), "wear [mm]");
    EXPECT_EQ(std::get<std::vector<std::string>>(column.cells).at(0), "42.5");
    EXPECT_NE(markdown_table(fields).find("| `wear` | mm | `wear_m` | wear mm | of a test |"),
              std::string::npos);
  }
}

}  // namespace

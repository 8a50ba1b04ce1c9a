// Tables as spreadsheets and data loggers export them: one set of numbers in every form, and what has to be
// refused because nobody can tell.
#include <gtest/gtest.h>

#include <fstream>

#include "pipelines/base/common/errors.h"
#include "pipelines/scene/tables/table_file.h"
#include "tests/unit/pipelines/examples/results_directory.h"

namespace {

using pipelines::TableForm;
using results_test::Directory;
using Values = std::vector<double>;

/// All columns, whatever their titles.
pipelines::TableFile logged(const std::string& bytes, const TableForm& form = {},
                            const std::vector<std::string>& wanted = {}) {
  const Directory directory;
  std::ofstream(directory / "log.csv", std::ios::binary) << bytes;
  const auto open = pipelines::open_table(directory / "log.csv", form, wanted);
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < open.columns.size(); ++i) all.push_back(i);
  return pipelines::read_columns(open, all, pipelines::Titles::are_chosen);
}

/// The findings, each "line:column value: remedy", one on a line.
std::string refusal_of(const std::string& bytes, const TableForm& form = {}) {
  try {
    logged(bytes, form);
  } catch (const pipelines::SceneError& refused) {
    std::string all;
    for (const auto& e : refused.findings())
      all += std::to_string(e.line) + ":" + std::to_string(e.column) + " " + e.value + ": " + e.remedy + "\n";
    return all;
  }
  return "accepted";
}

bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  for (auto at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()))
    text.replace(at, old.size(), by);
  return text;
}

std::string utf16(const std::string& ascii, bool little_endian, bool has_mark) {
  std::string bytes = !has_mark ? "" : little_endian ? "\xFF\xFE" : "\xFE\xFF";
  for (const char c : ascii) bytes += little_endian ? std::string{c, '\0'} : std::string{'\0', c};
  return bytes;
}

const std::string german =
    "Zeit;Kraft X;Moment\ns;N;Nm\n0,000;0,0;60,0\n0,010;-700,5;62,5\n0,0625;1e3;58,0\n";

void expect_german(const std::string& bytes, const TableForm& form = {}) {
  const auto table = logged(bytes, form);
  ASSERT_EQ(table.columns.size(), 3u) << bytes;
  EXPECT_EQ(table.columns[0].name, "Zeit") << bytes;
  EXPECT_EQ(table.columns[1].name, "Kraft X") << bytes;
  EXPECT_EQ(table.columns[0].unit, "s") << bytes;
  EXPECT_EQ(table.columns[1].unit, "N") << bytes;
  EXPECT_EQ(table.columns[2].unit, "Nm") << bytes;
  EXPECT_EQ(table.columns[0].values, (Values{0, 0.01, 0.0625})) << bytes;
  EXPECT_EQ(table.columns[1].values, (Values{0, -700.5, 1000})) << bytes;
  EXPECT_EQ(table.columns[2].values, (Values{60, 62.5, 58})) << bytes;
}

}  // namespace

TEST(LoggedTables, OfOneContentInManyForms) {
  expect_german(german);
  expect_german(replaced(german, ";", "\t"));
  expect_german(replaced(german, ",", "."));                      // semicolons and points
  expect_german(replaced(replaced(german, ",", "."), ";", ","));  // commas and points
  expect_german(replaced(german, ";", " ; "));
  expect_german(replaced(german, "\n", "\r\n"));
  expect_german(replaced(german, "\n", "\r"));   // of old Macintosh programs
  expect_german(replaced(german, "\n", ";\n"));  // a delimiter at the end of each line
  expect_german("\xEF\xBB\xBF" + german);
  expect_german("sep=;\n" + german);
  expect_german("\"sep=;\"\r\n" + german);
  expect_german(replaced(
      replaced(german, "Zeit;Kraft X;Moment\ns;N;Nm", "Zeit   Kraft X   Moment\ns   N   Nm"), ";", "   "));
  expect_german(replaced(german, "s;N;Nm\n", "[s];[N];[Nm]\n"));
  expect_german(replaced(german, "s;N;Nm\n", "(s);(N);(Nm)\n"));
  for (const std::string titles : {"Zeit [s];Kraft X [N];Moment [Nm]\n", "Zeit (s);Kraft X (N);Moment (Nm)\n",
                                   "Zeit / s;Kraft X / N;Moment / Nm\n", "Zeit/s;Kraft X/N;Moment/Nm\n",
                                   "Zeit in s;Kraft X in N;Moment in Nm\n", "Zeit, s;Kraft X, N;Moment, Nm\n",
                                   "\"Zeit [s]\";\"Kraft X [N]\";\"Moment [Nm]\"\n"})
    expect_german(replaced(german, "Zeit;Kraft X;Moment\ns;N;Nm\n", titles));
  for (const bool little : {true, false})
    for (const bool mark : {true, false}) expect_german(utf16(german, little, mark));
}

TEST(LoggedTables, BelowOtherLines) {
  const std::string above = "Logger 4711\nDatum;2026-11-28\nKanaele;3\nRate;100\n\n";
  expect_german(above + german);
  expect_german("# a comment\n" + above + german);
  TableForm form;
  form.skip_rows = 5;
  expect_german(above + german, form);
  // Of two lines that could be titles the one that the scene names.
  const std::string twice = "Zeit;Kraft X;Moment\nKanal 1;Kanal 2;Kanal 3\n0;1;2\n1;2;3\n";
  EXPECT_EQ(logged(twice, {}, {"Kraft X"}).columns[1].name, "Kraft X");
  EXPECT_EQ(logged(twice, {}, {"Kraft X"}).form,
            "';' with decimal point, 1 line below the titles passed over");
  EXPECT_EQ(logged(twice).columns[1].name, "Kanal 2");
  EXPECT_EQ(logged(above + german).title_line, 6);
  EXPECT_EQ(logged(above + german).lines.front(), 8);
}

TEST(LoggedTables, SayHowTheyAreWritten) {
  EXPECT_EQ(logged(german).form, "';' with decimal comma, units in row 2");
  EXPECT_EQ(logged(utf16(replaced(german, ";", "\t"), true, true)).form,
            "tabs with decimal comma, UTF-16 LE, units in row 2");
  EXPECT_EQ(logged("Stra\xDF"
                   "e;Kraft [N]\n0;1.5\n1;2\n")
                .form,
            "';' with decimal point, Windows-1252");
  EXPECT_EQ(logged("Stra\xDF"
                   "e;Kraft [N]\n0;1.5\n1;2\n")
                .columns[0]
                .name,
            "Stra\xC3\x9F"
            "e");
  EXPECT_EQ(logged("a;b \x80\n0;1\n1;2\n").columns[1].name, "b \xE2\x82\xAC");  // the Euro of Windows
}

TEST(LoggedTables, UnitsInTitlesAreUnits) {
  const auto units = [](const std::string& titles) {
    const auto table = logged(titles + "\n0;1\n1;2\n");
    return table.columns[0].name + "|" + table.columns[0].unit + "|" + table.columns[1].name + "|" +
           table.columns[1].unit;
  };
  EXPECT_EQ(units("Winkel [Grad];v / m/s"), "Winkel|deg|v|m/s");
  EXPECT_EQ(units("Zeit (Sek);Weg x/y"), "Zeit|s|Weg x/y|");
  EXPECT_EQ(units("t;Lager (links) [kN]"), "t||Lager (links)|kN");
  // a unit in the row below makes the bracket a part of the name
  const auto below = logged("Zeit;Lager (links)\ns;kN\n0;1\n1;2\n");
  EXPECT_EQ(below.columns[1].name, "Lager (links)");
  EXPECT_EQ(below.columns[1].unit, "kN");
  EXPECT_TRUE(has(refusal_of("Zeit;F [N]\ns;kN\n0;1\n1;2\n"),
                  "1:6 F [N]: has the unit \"N\" in its title and \"kN\""));
}

// Nobody can tell a decimal comma from one between thousands.
TEST(LoggedTables, ThatNobodyCanTellAreRefused) {
  EXPECT_TRUE(
      has(refusal_of("t;F\n1,234;1\n2,345;2\n"), "2:1 1,234: may have a decimal comma or a comma between"));
  TableForm comma;
  comma.decimal = ',';
  EXPECT_EQ(logged("t;F\n1,234;1\n2,345;2\n", comma).columns[0].values, (Values{1.234, 2.345}));
  EXPECT_EQ(logged("t;F\n1,234;1\n2,34;2\n").columns[0].values, (Values{1.234, 2.34}));  // now it is plain
  EXPECT_EQ(logged("t;F\n0,234;1\n2,345;2\n").columns[0].values, (Values{0.234, 2.345}));
  EXPECT_TRUE(
      has(refusal_of("t;F\n0,1;1.234\n0,2;2.5\n"), "2:5 1.234: has a point, and 2 cells such as \"0,1\""));
  for (const std::string number : {"1.234,5", "1,234.5", "1.234.567", "1 234", "1'234,5",
                                   "1\xC2\xA0"
                                   "234",
                                   "1\xE2\x80\xAF"
                                   "234,5"})
    EXPECT_TRUE(
        has(refusal_of("t;F\n0;1\n1;" + number + "\n"), "3:3 " + number + ": has separators of thousands"))
        << refusal_of("t;F\n0;1\n1;" + number + "\n");
  // Commas between columns and in numbers.
  const auto four = refusal_of("t,F\n0,0,1,5\n0,1,2,5\n0,2,3,5\n");
  EXPECT_TRUE(has(four, "2:1 0,0,1,5: has 4 cells where the titles name 2 columns") &&
              has(four, "export with ';'") && has(four, "the first of 3 such rows, to line 4"))
      << four;
  EXPECT_TRUE(
      has(refusal_of("t,F\n\"0,1\",\"1,5\"\n1,2\n"), "2:1 0,1: has a decimal comma where a point is wanted"));
  EXPECT_EQ(logged("t,F\n\"0,1\",\"1,5\"\n1,2\n", comma).columns[1].values, (Values{1.5, 2}));
}

// Red where the first sample is taken for titles.
TEST(LoggedTables, WithoutTitlesAreRefused) {
  EXPECT_TRUE(has(refusal_of("0;1,5\n1;2,5\n"), "1:1 : has numbers where titles are wanted"));
}

TEST(LoggedTables, FaultsOfAKindAreOne) {
  std::string rows;
  for (int i = 0; i < 1000; ++i) rows += std::to_string(i) + ";--;1\n";
  const auto refused = refusal_of("t;F;G\n0;1;2\n" + rows + "1000;;1\n");
  EXPECT_TRUE(has(refused, "3:3 --: is not a finite number") &&
              has(refused, "the first of 1000 such cells of this column, to line 1002"))
      << refused;
  EXPECT_TRUE(has(refused, "1003:6 : the cell is empty"));
  EXPECT_EQ(std::count(refused.begin(), refused.end(), '\n'), 2);
}

TEST(LoggedTables, NameWhatStandsInACell) {
  EXPECT_TRUE(has(refusal_of("t;F\n0;1\n12:30:01;2\n"), "is a time of day"));
  EXPECT_TRUE(has(refusal_of("t;F\n0;1\n1;\xE2\x88\x92"
                             "5\n"),
                  "it has a minus sign of mathematics (U+2212)"));
}

TEST(LoggedTables, OtherFilesAreNamed) {
  using namespace std::string_literals;
  EXPECT_TRUE(has(refusal_of("PK\x03\x04 a sheet"), "is a workbook of Excel"));
  EXPECT_TRUE(has(refusal_of("\xD0\xCF\x11\xE0 a sheet"), "is a workbook of an old Excel"));
  EXPECT_TRUE(has(refusal_of("TDSm"), "TDMS"));
  EXPECT_TRUE(has(refusal_of("\xFF\xFE\0\0t\0\0\0"s), "is written in UTF-32 LE"));
  EXPECT_TRUE(has(refusal_of("\xFF\xFEt\0;\0\x00\xD8"s), "begins like UTF-16 LE"));  // half a pair
  EXPECT_TRUE(has(refusal_of("t;F\x81\n0;1\n"), "neither in UTF-8 nor in UTF-16 nor in Windows-1252"));
  EXPECT_TRUE(has(refusal_of("t;F\n0;1\n1;\0002\n3;4\n5;6\n7;8\n"s), "has bytes that are zero"));
}

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "meshes/values/utf8.h"
#include "pipelines/scene/tables/table_file.h"
#include "pipelines/scene/whole/scene.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using results_test::Directory;

namespace {

pipelines::TableFile read_table(const std::string& text) {
  const Directory directory;
  std::ofstream(directory / "log.csv", std::ios::binary) << text;
  return pipelines::read_table_file(directory / "log.csv");
}

/// The refusals as "line:column key = value", without file and remedy.
std::vector<std::string> refusals(const std::string& text) {
  try {
    read_table(text);
  } catch (const pipelines::SceneError& refused) {
    std::vector<std::string> places;
    for (const auto& e : refused.findings()) {
      EXPECT_FALSE(e.remedy.empty());
      places.push_back(std::to_string(e.line) + ":" + std::to_string(e.column) + " " + e.key + " = " +
                       e.value);
    }
    return places;
  }
  return {};
}

using Places = std::vector<std::string>;

}  // namespace

TEST(TableFile, ReadsCommasSemicolonsTabsQuotesAndWindowsLines) {
  for (const std::string text :
       {"time [s],a.fx [N]\n0,1\n0.5,-2e3\n", "time [s];a.fx [N]\r\n0;1\r\n0.5;-2e3\r\n",
        "\xef\xbb\xbf# logger 7\n\ntime [s]\ta.fx [N]\n0\t 1\n# pause\n+0.5\t-2000\n",
        "\"time [s]\",\"a.fx [N]\"\n 0 , 1\n.5,\"-2000\""}) {
    const auto table = read_table(text);
    ASSERT_EQ(table.columns.size(), 2u) << text;
    EXPECT_EQ(table.columns[0].name, "time");
    EXPECT_EQ(table.columns[0].unit, "s");
    EXPECT_EQ(table.columns[1].name, "a.fx");
    EXPECT_EQ(table.columns[1].unit, "N");
    EXPECT_EQ(table.columns[0].values, (std::vector<double>{0, 0.5})) << text;
    EXPECT_EQ(table.columns[1].values, (std::vector<double>{1, -2000})) << text;
  }
  EXPECT_EQ(read_table("\"a \"\"b\"\", c\" [m],t\n1,2\n").columns[0].name, "a \"b\", c");
  EXPECT_EQ(read_table("# first\n\nt [s],x\n\n1,2\n3,4\n").lines, (std::vector<int>{5, 6}));
}

// A copy that broke off at its last character was read without a word.
TEST(TableFile, DoubtsAFileThatMayBeCutOff) {
  std::string whole = "time [s],a.fx [N],b.fy [N]\n";
  for (int i = 0; i < 12; ++i)
    whole += std::to_string(0.25 * i).substr(0, 4) + "," + std::to_string(10 + i) + "," +
             std::to_string(1.5 + 0.01 * i).substr(0, 5) + "\n";
  EXPECT_EQ(read_table(whole).doubt, "");
  EXPECT_EQ(read_table(whole).n_rows(), 12u);
  const auto doubt = [&](const std::string& text) { return read_table(text).doubt; };
  const auto has = [](const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
  };
  const auto end = whole.size();
  EXPECT_TRUE(
      has(doubt(whole.substr(0, end - 1)), "log.csv:13: the last of 12 rows may be cut off: it has no end"));
  const auto two = doubt(whole.substr(0, end - 2));
  EXPECT_TRUE(has(two, "it has no end of line") && has(two, "b.fy has 2 digits behind the point, not 3"))
      << two;
  EXPECT_TRUE(has(doubt(whole.substr(0, end - 2) + "\n"), "b.fy has 2 digits behind the point, not 3"));
  EXPECT_TRUE(has(doubt(whole + "2.80,20,1.600\n"), "time goes on by 0.05, and by 0.25 in all rows before"));
  // Loggers that drop zeros at the end, uneven samples, and a comment behind the rows are no reason.
  EXPECT_EQ(doubt("time [s],a.fx [N]\n0,1.5\n0.1,2\n0.25,2.25\n0.3,1\n0.5,2\n0.9,3\n# end\n"), "");
}

TEST(TableFile, OfGigabytesIsNotRead) {
  const Directory directory;
  std::ofstream(directory / "log.csv") << "time [s],a.fx [N]\n0,1\n";
  std::filesystem::resize_file(directory / "log.csv", 6'400'000'000);
  try {
    pipelines::read_table_file(directory / "log.csv");
    FAIL() << "accepted";
  } catch (const pipelines::SceneError& refused) {
    EXPECT_NE(std::string(refused.what()).find("log.csv: has 6.4 GB, and a table has 500 MB at most"),
              std::string::npos)
        << refused.what();
  }
}

TEST(TableFile, NamesEveryWrongCellAtItsPlace) {
  EXPECT_EQ(refusals("t [s],x [N]\n1,2\n3,4;5\n"), Places{"3:3 x = 4;5"});
  EXPECT_EQ(refusals("t [s],x [N]\n1,nan\n,2\n1e999,0x10\n"),
            (Places{"2:3 x = nan", "3:1 t = ", "4:1 t = 1e999", "4:7 x = 0x10"}));
  EXPECT_EQ(refusals("t [s],x [N]\n1,+-5\n"), Places{"2:3 x = +-5"});
  EXPECT_EQ(refusals("t [s],x [N]\n1,2\n3\n"), Places{"3:1  = 3"});
  EXPECT_EQ(refusals("t [s],t [N]\n1,2\n"), Places{"1:7 t = t [N]"});
  EXPECT_EQ(refusals("t [s], \n1,2\n"), Places{"1:7  = "});
  EXPECT_EQ(refusals("t [s,x\n1,2\n"), Places{"1:1 t = t [s"});
  EXPECT_EQ(refusals(""), Places{"0:0  = "});
  EXPECT_EQ(refusals("t [s],x [N]\n"), Places{"0:0  = "});
  EXPECT_EQ(refusals("t [s],x [N]\n" +
                     [] {
                       std::string rows;
                       for (int i = 0; i < 50; ++i) rows += "a,b\n";
                       return rows;
                     }())
                .size(),
            2u);  // one for each column
  EXPECT_THROW(pipelines::read_table_file("/nowhere/log.csv"), pipelines::SceneError);
  EXPECT_THROW(pipelines::read_table_file("/tmp"), pipelines::SceneError);
  EXPECT_THROW(pipelines::read_table_file("/tmp/" + std::string(300, 'a')), pipelines::SceneError);
}

// Whoever opens a pipe without a writer waits for ever; the alarm ends this test then.
TEST(TableFile, IsNoPipe) {
  const Directory directory;
  ASSERT_EQ(mkfifo((directory / "log.csv").c_str(), 0600), 0);
  alarm(60);
  try {
    pipelines::read_table_file(directory / "log.csv");
    ADD_FAILURE() << "was read";
  } catch (const pipelines::SceneError& refused) {
    EXPECT_NE(std::string(refused.what()).find("is no regular file"), std::string::npos) << refused.what();
  }
  alarm(0);
}

// Loggers on Windows write the sign for degrees in Latin-1: such names ended a run at the writing of its
// results.
TEST(TableFile, TitlesBecomeUtf8) {
  EXPECT_EQ(refusals("angle [\xB0],seat.fx [N]\n0,1\n1,\xB0\n"), Places{"3:3 seat.fx = \xC2\xB0"});
  for (const std::string sign : {"\xC2\xB0", "\xB0"})
    EXPECT_EQ(read_table("angle [" + sign + "],seat.fx [N]\n0,1\n").columns.front().unit, "\xC2\xB0");
}

// The shortest and the longest of each length, and what RFC 3629, section 4, leaves out.
TEST(Utf8, IsToldFromBytes) {
  for (const std::string text : {"", "a", "\x7F", "\xC2\x80", "\xDF\xBF", "\xE0\xA0\x80", "\xED\x9F\xBF",
                                 "\xEF\xBF\xBF", "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"})
    EXPECT_TRUE(meshes::is_utf8(text)) << text;
  for (const std::string bytes :
       {"\x80", "\xBF", "\xC0\x80", "\xC1\xBF", "\xC2", "\xC2\x41", "\xE0\x9F\xBF", "\xED\xA0\x80",
        "\xEF\xBF", "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xFF"})
    EXPECT_FALSE(meshes::is_utf8("a" + bytes)) << bytes;
}

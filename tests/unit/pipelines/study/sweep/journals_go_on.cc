/// The journal of a sweep gives back the rows that were whole, bit for bit, and no other.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <tuple>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/files/content_hash.h"
#include "pipelines/study/sweep/sweep_journal.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;

namespace {

using Known = std::vector<std::optional<SweepRow>>;

SweepPlan plan_of(const std::vector<std::string>& speeds) {
  SweepPlan plan;
  for (const auto& speed : speeds)
    plan.points.push_back({{speed}, {}, {"machine.speed=" + speed, "b=\"é\""}});
  return plan;
}

/// Of a number that is none the sign alone.
std::uint64_t bits_of(double value) {
  if (std::isnan(value)) value = std::copysign(std::nan(""), value);
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

void expect_same(const std::optional<SweepRow>& found, const SweepRow& wanted) {
  ASSERT_TRUE(found);
  EXPECT_EQ(found->refused, wanted.refused);
  EXPECT_EQ(found->texts, wanted.texts);
  ASSERT_EQ(found->figures.size(), wanted.figures.size());
  for (std::size_t f = 0; f < wanted.figures.size(); ++f) {
    EXPECT_EQ(found->figures[f].name, wanted.figures[f].name);
    EXPECT_EQ(found->figures[f].unit, wanted.figures[f].unit);
    EXPECT_EQ(bits_of(found->figures[f].value), bits_of(wanted.figures[f].value)) << wanted.figures[f].value;
  }
  ASSERT_EQ(found->zones.size(), wanted.zones.size());
  for (std::size_t z = 0; z < wanted.zones.size(); ++z) {
    const auto &a = found->zones[z], &b = wanted.zones[z];
    EXPECT_EQ(std::tie(a.body, a.feature, a.place, a.safety, a.peak_Pa, a.peak_m, a.low_m, a.high_m,
                       a.volume_m3, a.instant, a.n_nodes),
              std::tie(b.body, b.feature, b.place, b.safety, b.peak_Pa, b.peak_m, b.low_m, b.high_m,
                       b.volume_m3, b.instant, b.n_nodes));
    EXPECT_EQ(bits_of(a.error_Pa), bits_of(b.error_Pa));
  }
}

SweptZone a_zone() {
  SweptZone zone;
  zone.body = "shaft";
  zone.feature = "fillet \"1\"";
  zone.place = "free surface";
  zone.peak_Pa = 1e8 / 3;
  zone.error_Pa = std::nan("1");
  zone.safety = 3;
  zone.peak_m = {0.1, -0.0, 1. / 7};
  zone.low_m = {-1e-300, 2, 3};
  zone.high_m = {4, 5, 6};
  zone.volume_m3 = 7e-9;
  zone.instant = 2399;
  zone.n_nodes = 1'000'000'000'000;
  return zone;
}

}  // namespace

/// A journal of three rows, the middle one with other columns, and of one that was refused.
class SweepJournals : public testing::Test {
protected:
  void SetUp() override {
    SweepJournal journal = of_key("key");
    journal.begin(plan, Known(plan.points.size()));
    for (std::size_t p = 0; p < rows.size(); ++p) {
      journal.append(plan.points[p], rows[p]);
      journal.flush();
    }
  }

  SweepJournal of_key(const std::string& key) const { return {file, key}; }
  Known known() const { return of_key("key").known(plan); }

  std::vector<std::string> lines() const {
    std::ifstream in(file, std::ios::binary);
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }
  void write(const std::vector<std::string>& all) const {
    std::ofstream out(file, std::ios::binary);
    for (const auto& line : all) out << line << '\n';
  }
  /// Which rows are known, a digit each.
  std::string whole() const {
    std::string text;
    for (const auto& row : known()) text += row ? '1' : '0';
    return text;
  }

  results_test::Directory directory;
  const std::filesystem::path file = directory / "journal";
  const SweepPlan plan = plan_of({"1 rpm", "2 rpm", "3 rpm", "4 rpm"});
  const std::vector<SweepRow> rows = {
      {"", {{"force", "N", 1.0 / 3}, {"safety", "", -0.0}}, {{"place", "a \"fillet\"\nbelow"}}},
      {"", {{"force", "N", std::numeric_limits<double>::infinity()}, {"life", "", 0}}, {{"place", "seat"}}},
      {"", {{"force", "N", 5e-324}, {"safety", "", -std::nan("7")}}, {{"place", ""}}, {a_zone(), {}}},
      {"no memory", {}, {}}};
};

TEST_F(SweepJournals, GiveBackEveryBit) {
  const auto found = known();
  for (std::size_t p = 0; p < 3; ++p) expect_same(found[p], rows[p]);
  EXPECT_FALSE(found[3]);         // what refused it may be gone
  EXPECT_EQ(lines().size(), 6u);  // the key, two kinds of columns, three rows
}

// As rows go from one process to another.
TEST_F(SweepJournals, AsLinesKeepRefusedRowsToo) {
  const auto lines = SweepJournal::lines_of(plan, {3, 0, 2}, rows);
  const auto found = SweepJournal::rows_of(lines, plan);
  for (const std::size_t p : {0, 2, 3}) expect_same(found[p], rows[p]);
  EXPECT_FALSE(found[1]);
}

TEST_F(SweepJournals, BeginAgainWithWhatIsKnown) {
  auto again = of_key("key");
  again.begin(plan, known());
  EXPECT_EQ(whole(), "1110");
  const auto other = plan_of({"3 rpm", "7 rpm", "1 rpm", "3 rpm"});
  const auto found = again.known(other);
  expect_same(found[0], rows[2]);
  EXPECT_FALSE(found[1]);
  expect_same(found[2], rows[0]);
  expect_same(found[3], rows[2]);
}

TEST_F(SweepJournals, OfOtherKeysAreNotTaken) {
  EXPECT_TRUE(SweepJournal::is_journal(file));
  for (const auto& row : of_key("another").known(plan)) EXPECT_FALSE(row);
}

// Cut at every byte: what is known are the rows before the cut.
TEST_F(SweepJournals, ThatAreCutLoseTheirEndAlone) {
  const auto all = lines();
  std::string text;
  std::vector<std::size_t> ends;  // of the lines, without the line feed
  for (const auto& line : all) {
    ends.push_back(text.size() + line.size());
    text += line + '\n';
  }
  for (std::size_t size = 0; size <= text.size(); ++size) {
    std::ofstream(file, std::ios::binary) << text.substr(0, size);
    const auto wanted = size < ends[2] ? "0000" : size < ends[4] ? "1000" : size < ends[5] ? "1100" : "1110";
    ASSERT_EQ(whole(), wanted) << size;
  }
}

// One byte changed, anywhere in a line: of a row that row is lost, of columns the rows that have them.
TEST_F(SweepJournals, WithAByteChangedLoseThatLine) {
  const auto all = lines();
  const std::vector<std::string> wanted = {"0000", "0100", "0110", "1010", "1010", "1100"};
  for (std::size_t l = 0; l < all.size(); ++l)
    for (std::size_t i = 0; i < all[l].size(); ++i) {
      auto damaged = all;
      damaged[l][i] = char(damaged[l][i] ^ 1);
      write(damaged);
      ASSERT_EQ(whole(), wanted[l]) << "line " << l << ", byte " << i;
    }
}

// The form of before: its first line is the same, its rows are JSON throughout.
TEST_F(SweepJournals, OfTheOldFormAreOursAndComputedAgain) {
  auto all = lines();
  all.resize(1);
  const std::string row =
      R"({"settings":["machine.speed=1 rpm","b=\"é\""],"row":{"refused":"","figures":[["force","N","1"]],"texts":[]}})";
  all.push_back(text_hash(row) + ' ' + row);
  write(all);
  EXPECT_TRUE(SweepJournal::is_journal(file));
  EXPECT_EQ(whole(), "0000");
}

// Lines that are whole but say something else: values of other columns, no number, no lists.
TEST_F(SweepJournals, WithLinesOfNoRowGoOn) {
  auto all = lines();
  for (const std::string line : {"1 1.5 [[\"machine.speed=4 rpm\",\"b=\\\"é\\\"\"],[\"\"]]", "1", "1 ",
                                 "9 1.5 2.5  [[],[]]", "1 1.5 ", "2 1 2  [[]]", "2 1 2  {", "x", "{}", "[]"})
    all.push_back(text_hash(line) + ' ' + line);
  write(all);
  EXPECT_EQ(whole(), "1110");
}

TEST_F(SweepJournals, OfOthersAreRefused) {
  write({"a diary"});
  EXPECT_FALSE(SweepJournal::is_journal(file));
  EXPECT_THROW(of_key("key").begin(plan, known()), OptionError);
}

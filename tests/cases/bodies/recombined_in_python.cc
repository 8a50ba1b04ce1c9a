// The five lines of Python in pipelines/command/commands/README.md, word by word: what they recombine from
// the files of a run is what `millstress history` writes.
#include <algorithm>
#include <cmath>

#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

/// The indented block below a heading that begins with these words.
std::vector<std::string> block_below(const std::string& heading, const std::string& first_words) {
  std::ifstream page(fs::path(SOURCE_DIR) / "pipelines/command/commands/README.md");
  std::vector<std::string> lines;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("#", 0) == 0) inside = line == heading;
    const bool is_indented = line.rfind("    ", 0) == 0;
    if (inside && is_indented && (!lines.empty() || line.rfind("    " + first_words, 0) == 0))
      lines.push_back(line.substr(4));
    else if (!lines.empty())
      break;
  }
  return lines;
}

/// Numbers of a text with one row per line.
std::vector<std::vector<double>> rows_of(const std::string& text) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream row(line);
    rows.push_back({std::istream_iterator<double>(row), {}});
  }
  return rows;
}

/// Debian's python3 with its h5py (pipelines/setup); another one may stand first on the PATH.
std::vector<std::vector<double>> printed_by_python(const fs::path& directory,
                                                   const std::vector<std::string>& lines) {
  std::string script;
  for (const auto& line : lines) script += line + '\n';
  write(directory / "script.py", script);
  const auto status = std::system(
      ("cd '" + directory.string() + "' && /usr/bin/python3 -I script.py > rows.txt 2> faults.txt").c_str());
  EXPECT_EQ(status, 0) << results_test::bytes(directory / "faults.txt");
  return rows_of(results_test::bytes(directory / "rows.txt"));
}

/// histories.h5 has the numbers of the table in its units, which its attributes name: red with Pa or radians.
void expect_same_in_hdf5(const fs::path& directory, const std::string& node,
                         const std::map<std::string, std::vector<double>>& table) {
  const auto rows = printed_by_python(
      directory,
      {"import h5py", "f = h5py.File('h/histories.h5')", "g = f['shaft/node_" + node + "']",
       "stresses = [g[n] for n in ('stress', 'von_mises', 'signed_von_mises', 'principal')]",
       "units = [d.attrs['unit'] for d in [f['time'], f['drive_angle']] + stresses]",
       "text = [u.decode() if isinstance(u, bytes) else str(u) for u in units]",
       "print(int(text == ['s', 'deg', 'MPa', 'MPa', 'MPa', 'MPa']))", "for i in range(len(f['time'])):",
       "  row = [f['time'][i], f['drive_angle'][i], *stresses[0][i], stresses[1][i], stresses[2][i], "
       "*stresses[3][i]]",
       "  print(*[repr(float(x)) for x in row])"});
  ASSERT_EQ(rows.size(), 25u);
  EXPECT_EQ(rows[0], std::vector<double>{1}) << "units";
  const std::vector<std::string> columns = {
      "time",      "drive_angle",      "xx",          "yy",          "zz",         "xy", "yz", "xz",
      "von_mises", "signed_von_mises", "principal_1", "principal_2", "principal_3"};
  for (std::size_t i = 0; i < 24; ++i) {
    ASSERT_EQ(rows[i + 1].size(), columns.size());
    for (std::size_t c = 0; c < columns.size(); ++c)
      EXPECT_EQ(rows[i + 1][c], table.at(columns[c])[i]) << columns[c] << i;
  }
}

/// Runs the five lines on a small shaft by this model, and compares with what `history` writes.
void expect_recombined(const std::string& method) {
  SCOPED_TRACE(method);
  auto lines = block_below("### In five lines of Python", "import h5py");
  ASSERT_EQ(lines.size(), 5u);
  const results_test::Directory directory;
  write(directory / "vibratory_mill.toml",
        "method = \"" + method + "\"\n" +
            small_shaft({{"pull", "middle.fx", "100 N", 1}, {"twist", "middle.torque", "3 N m", 2}}, "mm",
                        "600 rpm", ""));
  ASSERT_EQ(
      millstress(directory.path, "run vibratory_mill.toml --tolerance none --set results.keep=all").exit_code,
      0);
  lines.emplace_back("print(node)");
  lines.emplace_back("for row in stress_Pa: print(*[repr(float(s)) for s in row])");
  const auto rows = printed_by_python(directory.path, lines);
  ASSERT_EQ(rows.size(), 25u) << "the node, and 24 instants";

  const auto node = std::to_string(int(rows[0].at(0)));
  const auto run = millstress(directory.path,
                              "history vibratory_mill.toml --tolerance none --set results.keep=all -o h --at "
                              "'node " +
                                  node + "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto table = csv(directory / ("h/shaft_node_" + node + ".csv"));
  const auto& largest = table.at("von_mises");
  const double scale_MPa = *std::max_element(largest.begin(), largest.end());
  EXPECT_GT(scale_MPa, 10) << "32 F l / (4 pi d^3) is 102 MPa in the middle; the node is half way to it";
  const char* const components[] = {"xx", "yy", "zz", "xy", "yz", "xz"};
  for (std::size_t i = 0; i < 24; ++i) {
    ASSERT_EQ(rows[i + 1].size(), 6u);
    for (std::size_t c = 0; c < 6; ++c)  // both sum the same terms, in another order
      EXPECT_NEAR(rows[i + 1][c] / 1e6, table.at(components[c])[i], 1e-9 * scale_MPa) << components[c] << i;
  }
  expect_same_in_hdf5(directory.path, node, table);
}

}  // namespace

// Red if a dataset is renamed or laid out otherwise, if a channel's name differs between the two files, or if
// the page falls behind them.
TEST(Recombined, ByTheFiveLinesOfThePage) {
  expect_recombined("solid");
}

// Red if harmonics around the axis leave no file, or one of another layout.
TEST(Recombined, OfHarmonicsAroundTheAxisToo) {
  expect_recombined("axisymmetric");
}

// The module that is installed: figures, loads, histories, envelopes of some effects. Red if a file is
// renamed or laid out otherwise, or if the page's example falls behind.
TEST(Recombined, ByTheModule) {
  const results_test::Directory directory;
  write(directory / "shaft.toml",
        "method = \"solid\"\n" +
            small_shaft({{"pull", "middle.fx", "100 N", 1}, {"twist", "middle.torque", "3 N m", 2}}, "mm",
                        "600 rpm", ""));
  ASSERT_EQ(millstress(directory.path, "run shaft.toml --tolerance none").exit_code, 0);
  const auto rows = printed_by_python(
      directory.path,
      {"import os, sys, numpy as np",
       "os.environ['XDG_CACHE_HOME'] = '" + (directory / "cache").string() + "'",
       "sys.path.insert(0, '" SOURCE_DIR "/pipelines/python')", "import millstress",
       "results = millstress.load('results/shaft')", "shaft = results.body('shaft')",
       "peak = results.figures['bodies.shaft.peak_von_mises']",
       "place = results.summary['bodies']['shaft']['peak_von_mises']['position_m']",
       "node = shaft.nearest(place)", "all_Pa, instant = shaft.envelope()",
       "pull_Pa, _ = shaft.envelope(effects=['pull'])",
       "print(repr(peak.value), repr(peak.error), repr(float(all_Pa[node])))", "history = shaft.stress(node)",
       "print(repr(float(millstress.von_mises(history).max())), int(instant[node] == "
       "millstress.von_mises(history).argmax()))",
       "parts = shaft.stress(node, ['pull']) + shaft.stress(node, ['twist'])",
       "print(repr(float(abs(parts - history).max())), repr(float(pull_Pa[node])))",
       "print(len(results.time_s), len(results.effects), int(results.verdict['judgement'] == "
       "results.summary['verdict']['judgement']))"});
  ASSERT_EQ(rows.size(), 4u);
  const double peak_Pa = rows[0].at(0);
  const auto told = summary(directory / "results/shaft")["bodies"]["shaft"]["peak_von_mises"];
  EXPECT_EQ(peak_Pa, told["value"].get<double>());
  EXPECT_EQ(rows[0].at(1), told["error"]["total"].get<double>());
  EXPECT_NEAR(rows[0].at(2), peak_Pa, 1e-9 * peak_Pa) << "the same sum in another order";
  EXPECT_NEAR(rows[1].at(0), peak_Pa, 1e-9 * peak_Pa);
  EXPECT_EQ(rows[1].at(1), 1);
  EXPECT_LT(rows[2].at(0), 1e-9 * peak_Pa);
  EXPECT_LT(rows[2].at(1), 0.999 * peak_Pa) << "the twist is left out";
  EXPECT_GT(rows[2].at(1), 0.1 * peak_Pa);
  EXPECT_EQ(rows[3], (std::vector<double>{24, 2, 1}));
}

/// The first screen of the page, 1280 x 800, and its first printed page hold all verdicts, by a browser.
#include <algorithm>
#include <cctype>
#include <regex>

#include "tests/cases/program/browser.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

using Json = nlohmann::json;

constexpr double screen_height = 800;

/// Everything is wrong with it: yield, fatigue, resonance, both bearings.
std::string unsound_shaft() {
  auto scene = "tolerance = \"none\"\n" +
               small_shaft({{"pull", "middle.fx", "300 N", 1}, {"pull", "middle.fy", "300 N", 1, "90 deg"}},
                           "mm", "8700 rpm", "pressure_harmonics = 0\nnatural_frequencies = 1");
  const std::string steel = "name = \"steel\"";
  scene.replace(scene.find(steel), steel.size(), "name = \"steel\"\ntensile_strength = \"500 MPa\"");
  for (const auto* place : {"1", "2"})
    scene += std::string("[[bearings]]\nname = \"bearing ") + place + "\"\nload = \"bearing_" + place +
             "\"\nelement = \"ball\"\ndynamic_rating = \"300 N\"\n";
  return scene;
}

/// As many verdicts as a machine with two bodies has: those of the shaft once more, with one more. And a
/// dozen settings, as a variant has them.
Json of_two_bodies(Json summary) {
  auto& parts = summary["verdict"]["parts"];
  parts["chamber"] = parts["shaft"];
  auto& findings = parts["chamber"]["findings"];
  const auto longest = *std::max_element(findings.begin(), findings.end(), [](const Json& a, const Json& b) {
    return a["remedy"].get<std::string>().size() < b["remedy"].get<std::string>().size();
  });
  findings.push_back(longest);
  for (int i = 0; i < 12; ++i) summary["input"]["settings"].push_back("shaft.mesh.sectors=8");
  return summary;
}

std::string without_spaces(std::string text) {
  text.erase(std::remove_if(text.begin(), text.end(), [](unsigned char c) { return std::isspace(c) != 0; }),
             text.end());
  return text;
}

/// A finding as the page has it, without spaces: a line of it may end anywhere.
std::string on_page(const Json& finding) {
  const auto text = [&](const char* key) { return finding.at(key).get<std::string>(); };
  const auto all = text("judgement") + text("criterion") + text("figure") +
                   (text("place").empty() ? "" : ", at " + text("place")) + "; to do: " + text("remedy");
  return without_spaces(std::regex_replace(all, std::regex("\\+-"), "\u00b1"));
}

/// The page, which writes into its root how far down the headline and the table of verdicts reach [px], and
/// how many verdicts the table has.
std::string measuring(std::string page) {
  const std::string end = "</body>";
  return page.replace(page.find(end), end.size(), R"(<script>addEventListener("load", () => {
const all = [".verdict", ".verdict ~ table"].map(name => document.querySelector(name));
const root = document.documentElement.dataset;
root.bottom = Math.max(...all.map(element => element.getBoundingClientRect().bottom));
root.rows = all[1].rows.length - 1;
root.width = innerWidth;
})</script></body>)");
}

double measured(const std::string& page, const std::string& name) {
  std::smatch found;
  const std::regex pattern("data-" + name + "=\"([0-9.]+)\"");
  return std::regex_search(page, found, pattern) ? std::stod(found[1]) : -1;
}

}  // namespace

// Turns red: what stands before the verdicts and pushes them down, letters that are too large, a column so
// narrow that findings take many lines.
TEST(VerdictLeadsThePage, OnTheFirstScreenAndTheFirstPrintedPage) {
  SKIP_WITHOUT("chromium");
  SKIP_WITHOUT("pdftotext");
  const results_test::Directory directory;
  if (!has_browser(directory.path)) GTEST_SKIP() << "skipped: chromium does not start in this system";
  const auto json = of_two_bodies(run_small(directory.path, unsound_shaft()));
  std::vector<Json> findings;
  for (const auto& part : json["verdict"]["parts"])
    for (const auto& finding : part["findings"]) findings.push_back(finding);
  ASSERT_EQ(findings.size(), 9u) << json["verdict"].dump(1);
  for (const auto& finding : findings) EXPECT_EQ(finding["judgement"], "NOT OK") << finding;
  fs::create_directory(directory / "page");
  write(directory / "page/summary.json", json.dump());
  fs::copy(directory / "out/shaft", directory / "page/shaft");
  const auto report = millstress(directory.path, "report page");
  ASSERT_EQ(report.exit_code, 0) << report.err;

  write(directory / "measured.html", measuring(results_test::bytes(directory / "page/report.html")));
  const auto screen = elements_after(directory.path, "measured.html", 10);
  EXPECT_EQ(measured(screen, "width"), 1280);
  EXPECT_EQ(measured(screen, "rows"), double(findings.size()));
  EXPECT_GT(measured(screen, "bottom"), 0);
  EXPECT_LE(measured(screen, "bottom"), screen_height);

  browse(directory.path, "--no-pdf-header-footer --print-to-pdf=page.pdf page/report.html");
  const auto to_text = "cd '" + directory.path.string() + "' && pdftotext -l 1 -layout page.pdf page.txt";
  ASSERT_EQ(std::system(to_text.c_str()), 0);
  const auto printed = without_spaces(results_test::bytes(directory / "page.txt"));
  EXPECT_NE(printed.find(without_spaces(json["verdict"]["headline"].get<std::string>())), std::string::npos);
  for (const auto& finding : findings)
    EXPECT_NE(printed.find(on_page(finding)), std::string::npos) << finding << '\n' << printed;
}

#include <gtest/gtest.h>

#include "pipelines/write/exports/html_page.h"
#include "pipelines/write/report/html_report.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;

// RFC 4648, section 10.
TEST(HtmlPage, Base64MeetsTheTestVectors) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\x00\xfb", 3)), "/wD7");  // bytes have no sign, and zero is one
}

// A title of the user's is text, wherever it stands.
TEST(HtmlPage, TextIsNoMarkup) {
  HtmlPage page("a < b & \"c\"");
  page.heading(1, "<script>");
  page.paragraph("x > 'y'");
  page.table({{"<b>"}, {{"<i>"}}});
  const auto text = page.text();
  EXPECT_NE(text.find("<title>a &lt; b &amp; &quot;c&quot;</title>"), std::string::npos);
  EXPECT_NE(text.find("<h1>&lt;script&gt;</h1>"), std::string::npos);
  EXPECT_NE(text.find("<p>x &gt; &#39;y&#39;</p>"), std::string::npos);
  EXPECT_NE(text.find("<th>&lt;b&gt;</th>"), std::string::npos);
  EXPECT_NE(text.find("<td>&lt;i&gt;</td>"), std::string::npos);
}

TEST(HtmlPage, PicturesAreInsideIt) {
  const results_test::Directory directory;
  std::ofstream(directory / "p.png", std::ios::binary) << "foobar";
  HtmlPage page("t");
  page.picture(directory / "p.png", "what");
  EXPECT_NE(page.text().find("src=\"data:image/png;base64,Zm9vYmFy\""), std::string::npos);
  const auto before = page.text();
  page.picture(directory / "missing.png", "what");
  EXPECT_EQ(page.text(), before);
}

namespace {

/// Of a run without a tolerance: one zone that may not be there, a place that endures, and one of which the
/// error leaves no life known.
const char* const one_body = R"({
  "program": {"version": "0"}, "warnings": [], "bearings": {}, "timing": {}, "loads": {},
  "input": {"title": "t", "scene": "s.toml", "hash": "h", "machine": "load_table", "turns": 1,
            "instants_per_turn": 8},
  "verdict": {"judgement": "OK", "headline": "OK", "parts": {}},
  "bodies": {"shaft": {
    "method": "axisymmetric", "dofs": 1, "mass": {"value": 1}, "solver": {}, "material": "C45",
    "yield_strength": {"value": 305e6},
    "governing": {"kind": "peak_von_mises", "name": "peak", "text": "", "value": 1e6, "feature": "",
                  "safety_against_yield": 305, "error": {"total": 0, "methods": {}}, "position_m": [0, 0, 0],
                  "turn": 1, "drive_angle_rad": 0},
    "peak_von_mises": {"value": 1e6},
    "peak_principal": {"value": 1e6, "feature": "", "position_m": [0, 0, 0], "turn": 1, "drive_angle_rad": 0},
    "torsion": {"max_shear_stress": {"value": 2e6, "error": 3e5}},
    "zone_level": {"value": 5e5},
    "zones": [{"peak_von_mises_Pa": 1e6, "error_Pa": 9e5, "safety_against_yield": 305, "volume_m3": 129.3e-9,
               "volume_error_m3": 792.7e-9, "feature": "", "place": "", "position_m": [0, 0, 0], "turn": 1,
               "drive_angle_rad": 0}],
    "search": {"tolerance": 0, "steps": [], "ended": "the time is up"},
    "fatigue": {"assumptions": [], "places": [
      {"feature": "a", "amplitude_Pa": 1, "mean_Pa": 0, "endurance_Pa": 9, "safety_against_endurance": 9,
       "utilisation": 0.1, "life_h": null, "life_range_h": [null, null]},
      {"feature": "b", "amplitude_Pa": 1, "mean_Pa": 0, "endurance_Pa": 9, "safety_against_endurance": 9,
       "utilisation": 0.1, "life_h": 3.5, "life_range_h": null}]}}}})";

}  // namespace

// A dash stood for what endures and for what is not known; a zone of 129 mm3 had an error of "7.9e+02".
TEST(HtmlReport, SaysWhatANumberCannot) {
  const results_test::Directory directory;
  std::ofstream(directory / "summary.json") << one_body;
  write_html_report(directory.path, directory / "accuracy");
  const auto page = results_test::bytes(directory / "report.html");
  const auto has = [&](const std::string& text) { EXPECT_NE(page.find(text), std::string::npos) << text; };
  has(">129, up to 922<");
  has(">endures</td>");
  has(">3.5 h, not known well</td>");
  has("2.000 ± 0.300 MPa");
  has("The way within the time limit");
  EXPECT_EQ(page.find("tolerance of 0"), std::string::npos);
}

TEST(HtmlReport, NeedsASummary) {
  const results_test::Directory directory;
  const auto message = [&] {
    try {
      write_html_report(directory.path, directory / "accuracy");
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message().find("there is no such file"), std::string::npos) << message();
  std::ofstream(directory / "summary.json") << "{\"input\": 3";
  EXPECT_NE(message().find("summary.json: is no summary of a run"), std::string::npos) << message();
  std::ofstream(directory / "summary.json") << "{\"input\": {}}";
  EXPECT_NE(message().find("run the scene again"), std::string::npos) << message();
  EXPECT_FALSE(std::filesystem::exists(directory / "report.html"));
}

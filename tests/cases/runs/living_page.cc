/// report.html puts the stress together anew in the browser: what it shows is held against the run's own
/// files, which come from the unit responses without any of the page's modes, and against runs without the
/// effects that are switched off on the page.
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <regex>

#include "tests/cases/program/browser.h"
#include "tests/cases/program/small_shaft.h"

using namespace cases;

namespace {

using Json = nlohmann::json;

constexpr std::size_t points_of_a_snapshot = 50;

/// What the page has to have at a snapshot: some of its nodes with von Mises stress [m, Pa].
Json expected_of(const fs::path& run, const std::string& body, int snapshot, const Json& off) {
  const auto list = results_test::bytes(run / body / "cycle.pvd");
  const std::regex entry("timestep=\"([^\"]*)\"[^>]*file=\"(cycle_\\d+.vtu)\"");
  auto found = std::sregex_iterator(list.begin(), list.end(), entry);
  std::advance(found, snapshot);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((run / body / (*found)[2].str()).c_str());
  reader->Update();
  const vtkSmartPointer<vtkUnstructuredGrid> grid = reader->GetOutput();
  auto* stress = grid->GetPointData()->GetArray("von Mises stress [Pa]");
  auto* left_out = grid->GetPointData()->GetArray("left_out");
  Json points = Json::array();
  const auto n = grid->GetNumberOfPoints();
  for (vtkIdType k = 0, i = 17 % n; std::size_t(k) < points_of_a_snapshot; ++k, i = (i + 7919) % n)
    if (left_out->GetTuple1(i) == 0) {
      const double* at_m = grid->GetPoint(i);
      points.push_back({at_m[0], at_m[1], at_m[2], stress->GetTuple1(i)});
    }
  return {{"body", body}, {"off", off}, {"time_s", std::stod((*found)[1])}, {"points", points}};
}

/// Runs in the page and leaves its findings as JSON in the element "checked".
const char* const checks = R"(
const faults = [];
addEventListener("error", (event) => faults.push(String(event.message)));
addEventListener("unhandledrejection", (event) => faults.push(String(event.reason)));
document.addEventListener("securitypolicyviolation", (event) => faults.push("refused: " + event.blockedURI));
const consoleError = console.error;
console.error = (...words) => { faults.push(words.join(" ")); consoleError(...words); };

function pixels(page) {
  page.draw();
  const gl = page.view.gl;
  const all = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
  gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, all);
  let [n, sum] = [0, 0];
  const colours = new Set();
  for (let i = 0; i < all.length; i += 4)
    if (all[i + 3] > 200) {
      n++;
      sum = (sum * 31 + all[i] + 7 * all[i + 1] + 13 * all[i + 2]) % 1000003;
      colours.add((all[i] >> 3) * 1024 + (all[i + 1] >> 3) * 32 + (all[i + 2] >> 3));
    }
  return { share: (4 * n) / all.length, sum, colours: colours.size };
}

const toggleOf = (page, name) => page.keys.toggles.find((toggle) => toggle.name === name);

/* Largest difference to the points, over the body's peak, and the largest distance to a node [m]. */
function compare(page, expected) {
  const body = page.bodies.find((own) => own.name === expected.body);
  body.combine(expected.off.map((name) => toggleOf(page, name)));
  const t = page.cycle.time.reduce((best, time, i) =>
    Math.abs(time - expected.time_s) < Math.abs(page.cycle.time[best] - expected.time_s) ? i : best, 0);
  let [worst, farthest, onGraphics] = [0, 0, 0];
  page.state.body = body;
  const drawn = page.view.field(body, t);
  for (const [x, y, z, value] of expected.points) {
    let [node, least] = [0, Infinity];
    for (let i = 0; i < body.points.length / 3; i++) {
      const p = body.points;
      const distance = Math.hypot(p[3 * i] - x, p[3 * i + 1] - y, p[3 * i + 2] - z);
      if (distance < least) [node, least] = [i, distance];
    }
    const own = body.vonMises(node % body.n, t);
    worst = Math.max(worst, Math.abs(own - value));
    onGraphics = Math.max(onGraphics, Math.abs(drawn[node % body.n] - own));
    farthest = Math.max(farthest, least);
  }
  return { worst, onGraphics, farthest, peak: body.keys.peak_Pa, stated: body.keys.stress.error };
}

function peakWithout(page, name, off) {
  const body = page.bodies.find((own) => own.name === name);
  body.combine([toggleOf(page, off)]);
  let peak = 0;
  for (let row = 0; row < body.n; row++) if (!body.excluded[row]) peak = Math.max(peak, body.largestOver(row, 4));
  return peak;
}

async function check() {
  while (!window.millstress && !window.millstressFailed) await new Promise((resume) => setTimeout(resume, 50));
  const found = {};
  if (window.millstressFailed) throw window.millstressFailed;
  const page = window.millstress;
  found.largest = pixels(page);
  const slide = (t) => {
    page.slider.value = t;
    page.slider.dispatchEvent(new Event("input"));
    return pixels(page);
  };
  found.first = slide(0);
  found.later = slide(Math.round(page.cycle.per_turn / 3));
  const places = [...document.querySelectorAll(".place")];
  const before = page.courseTitle.textContent;
  places[places.length - 1].click();
  found.selects = { places: places.length, isPressed: places[places.length - 1].getAttribute("aria-pressed"), before, after: page.courseTitle.textContent };
  const box = page.effects.boxes.find(([toggle]) => toggle.has_table)[1];
  box.click();
  found.offAfterClick = page.effects.off.size;
  box.click();
  found.offAfterTwo = page.effects.off.size;
  found.points = window.expected.points.map((own) => compare(page, own));
  found.peaks = window.expected.peaks.map(([body, off]) => peakWithout(page, body, off));
  found.goTogether = page.keys.toggles.filter((toggle) => toggle.name === "springs").map((toggle) => toggle.off)[0];
  found.requests = performance.getEntriesByType("resource").map((entry) => entry.name);
  return found;
}
check().catch((error) => ({ failed: String(error && error.stack) })).then((found) => {
  found.faults = faults;
  const text = document.createElement("pre");
  text.id = "checked";
  text.textContent = JSON.stringify(found);
  document.body.append(text);
});
)";

/// @param expected  `points` and `peaks` of the checks
Json checked(const fs::path& directory, const fs::path& page, const Json& expected) {
  auto text = results_test::bytes(page);
  const std::string script = "<script>", end = "</body>";
  // Before the page's own script, so that nothing of it is missed.
  text.insert(text.find(script), "<script>window.expected = " + expected.dump() + ";" + checks + "</script>");
  write(directory / "checked.html", text);
  const auto elements = elements_after(directory, "checked.html", 200);
  const std::string begin = "<pre id=\"checked\">";
  const auto from = elements.find(begin);
  if (from == std::string::npos) return {{"failed", "nothing was checked"}};
  const auto first = from + begin.size();
  auto json = elements.substr(first, elements.find("</pre>", first) - first);
  for (const auto& [entity, letter] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
    json = std::regex_replace(json, std::regex(entity), letter);
  return Json::parse(json);
}

void expect_drawn(const Json& found) {
  EXPECT_FALSE(found.contains("failed")) << found["failed"];
  EXPECT_TRUE(found["faults"].empty()) << found["faults"];
  EXPECT_TRUE(found["requests"].empty()) << found["requests"];
  for (const auto* shown : {"largest", "first", "later"}) {
    EXPECT_GT(found[shown]["share"], 0.02) << shown;
    EXPECT_GT(found[shown]["colours"], 20) << shown;
  }
  EXPECT_NE(found["first"]["sum"], found["later"]["sum"]);
  EXPECT_EQ(found["selects"]["isPressed"], "true");
  EXPECT_GT(found["offAfterClick"], 0);
  EXPECT_EQ(found["offAfterTwo"], 0);
}

/// Of single precision, in which the files have the stress and the page its nodes.
void expect_as_stated(const Json& points) {
  for (const auto& one : points) {
    EXPECT_LT(one["farthest"], 1e-7) << one;
    EXPECT_LE(one["worst"], 1.02 * double(one["stated"]) + 1e-6 * double(one["peak"])) << one;
    EXPECT_LT(one["stated"], 0.005 * double(one["peak"])) << one;
    EXPECT_LT(one["onGraphics"], 1e-5 * double(one["peak"])) << one;
  }
}

/// Makes the page of the mill in a directory, and holds it to runs of the mill and of it without each effect.
void expect_stress_of_runs(const results_test::Directory& directory,
                           const std::vector<std::string>& effects) {
  write(directory / "mill.toml", edited("vibratory_mill.toml", coarse()));
  const auto run = [&](const std::string& arguments) {
    const auto outcome = millstress(directory.path, "run mill.toml --set results.snapshots=3 " + arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  };
  run("-o all");
  Json points = Json::array(), peaks = Json::array();
  std::vector<double> wanted_Pa;
  for (const std::string body : {"shaft", "chamber"})
    for (int snapshot = 0; snapshot < 3; ++snapshot)
      points.push_back(expected_of(directory / "all", body, snapshot, Json::array()));
  for (const auto& effect : effects) {
    run("-o " + effect + " --set effects." + effect + "=off");
    const auto summary = Json::parse(results_test::bytes(directory / effect / "summary.json"));
    for (const std::string body : {"shaft", "chamber"}) {
      points.push_back(expected_of(directory / effect, body, 1, Json::array({effect})));
      peaks.push_back({body, effect});
      wanted_Pa.push_back(summary["bodies"][body]["peak_von_mises"]["value"]);
    }
  }
  const auto found =
      checked(directory.path, directory / "all/report.html", {{"points", points}, {"peaks", peaks}});
  expect_drawn(found);
  expect_as_stated(found["points"]);
  for (std::size_t i = 0; i < wanted_Pa.size(); ++i)
    EXPECT_NEAR(found["peaks"][i], wanted_Pa[i], 0.005 * wanted_Pa[i]) << peaks[i];
  // A run refuses springs off alone: nothing but them holds a chamber that pitches.
  EXPECT_EQ(found["goTogether"], Json({"springs", "pitch", "charge_follows_pitch"}));
}

}  // namespace

// Turns red: a mode or a factor in another's place, a table with the wrong effect, pressure that is added up
// effect by effect, a page that asks for a file or throws.
TEST(LivingPage, HasTheStressOfTheRunAndOfARunWithoutAnEffect) {
  SKIP_WITHOUT("chromium");
  const results_test::Directory directory;
  if (!has_browser(directory.path)) GTEST_SKIP() << "skipped: chromium does not start in this system";
  expect_stress_of_runs(directory, {"gravity_charge"});

  SKIP_WITHOUT("pdfinfo");
  browse(directory.path, "--no-pdf-header-footer --print-to-pdf=page.pdf all/report.html");
  const auto count = "cd '" + directory.path.string() + "' && pdfinfo page.pdf > pages.txt";
  ASSERT_EQ(std::system(count.c_str()), 0);
  std::smatch pages;
  const auto told = results_test::bytes(directory / "pages.txt");
  ASSERT_TRUE(std::regex_search(told, pages, std::regex("Pages: *(\\d+)"))) << told;
  EXPECT_LE(std::stoi(pages[1]), 8);
}

TEST(LivingPage, HasTheStressOfRunsWithoutOtherEffects) {
  SKIP_WITHOUT("chromium");
  const results_test::Directory directory;
  if (!has_browser(directory.path)) GTEST_SKIP() << "skipped: chromium does not start in this system";
  expect_stress_of_runs(directory, {"debalance_inertia", "charge_coriolis"});
}

// Turns red: a face in another order, harmonics or a beam without a surface.
TEST(LivingPage, ShowsEveryModelOfAShaft) {
  SKIP_WITHOUT("chromium");
  const results_test::Directory directory;
  if (!has_browser(directory.path)) GTEST_SKIP() << "skipped: chromium does not start in this system";
  write(directory / "shaft.toml",
        small_shaft({{"pull", "middle.fx", "300 N", 1}, {"weight", "middle.fy", "100 N", 0}}));
  for (const std::string method : {"beam", "axisymmetric", "solid"}) {
    const auto outcome =
        millstress(directory.path,
                   "run shaft.toml --set shaft.natural_frequencies=0 --set results.snapshots=4 --method " +
                       method + " -o " + method);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json points{expected_of(directory / method, "shaft", 3, Json::array())};
    const auto found = checked(directory.path, directory / method / "report.html",
                               {{"points", points}, {"peaks", Json::array()}});
    SCOPED_TRACE(method);
    expect_drawn(found);
    expect_as_stated(found["points"]);
  }
}

/// Stated errors of harmonics around the axis beside true ones, on shafts drawn at random.
/// `--help` tells the options.
#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>
#include <vector>

#include "fem/models/solid/model.h"
#include "meshes/values/refused.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/judge/stages/shaft_torsion.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/search/cheap_models/axisymmetric_body.h"
#include "pipelines/search/cheap_models/axisymmetric_refinement.h"
#include "pipelines/search/loop/scene_run.h"
#include "tests/benchmarks/harmonics/strict_section.h"
#include "tests/benchmarks/promises/random_shaft_scene.h"

namespace {

using namespace pipelines;
namespace fs = std::filesystem;

constexpr double share_of_places = 0.3;  ///< of the peak, that a place has to be counted
/// What the truth itself may be off by, relative (--check).
constexpr double error_of_truth = 2e-5;

struct Options {
  int n_shafts = 200;
  unsigned first_seed = 1;
  std::string kind = "plain";
  std::vector<double> tolerances_percent{5, 1, 0.5, 0.2, 0.1};
  int n_sections = 0;
  bool check = false, list = false;
};

struct Figure {
  double value_Pa = 0, stated_Pa = 0, truth_Pa = 0;

  double off_Pa() const { return std::abs(value_Pa - truth_Pa); }
  bool is_bounded() const { return off_Pa() <= stated_Pa + error_of_truth * truth_Pa; }
  double ratio() const { return stated_Pa / std::max(off_Pa(), 1e-12 * truth_Pa); }
};

/// Of all shafts at one tolerance.
struct Table {
  int n_met = 0, n = 0;
  std::vector<Figure> peaks, places, torsion;
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double at = share * double(values.size() - 1);
  const auto below = std::size_t(at);
  const double above = values[std::min(below + 1, values.size() - 1)];
  return values[below] + (at - double(below)) * (above - values[below]);
}

void print_row(double tolerance_percent, const char* what, const std::vector<Figure>& figures) {
  if (figures.empty()) return;
  std::vector<double> ratios, signed_off, off, stated;
  int n_bounded = 0;
  double worst = 0;
  for (const auto& f : figures) {
    ratios.push_back(f.ratio());
    signed_off.push_back(100 * (f.value_Pa / f.truth_Pa - 1));
    off.push_back(std::abs(signed_off.back()));
    stated.push_back(100 * f.stated_Pa / f.truth_Pa);
    n_bounded += f.is_bounded();
    worst = std::max(worst, f.off_Pa() / (f.stated_Pa + error_of_truth * f.truth_Pa));
  }
  const auto n_low = std::count_if(signed_off.begin(), signed_off.end(), [](double x) { return x < 0; });
  fmt::print(
      "| {:g} % | {} | {} | {:.2f} | {:.2f}, {:.2f} | {:.1f} % | {:.2f} | {:.4f} % | {:.4f} % | {:.4f} % | "
      "{:.0f} % |\n",
      tolerance_percent, what, figures.size(), quantile(ratios, 0.5), quantile(ratios, 0.25),
      quantile(ratios, 0.75), 100.0 * n_bounded / double(figures.size()), worst, quantile(stated, 0.5),
      quantile(off, 0.5), quantile(signed_off, 0.5), 100.0 * double(n_low) / double(figures.size()));
}

std::string scene_text(unsigned seed, const std::string& kind) {
  const std::string drawn = promises::random_shaft_scene(seed);
  if (kind == "plain") return drawn;
  std::istringstream lines(drawn);
  std::string text;
  double smallest_mm = 1e9;
  const std::regex diameter("diameter = \"([0-9.]+) mm\""), bore(", bore = \"[0-9.]+ mm\"");
  for (std::sregex_iterator i(drawn.begin(), drawn.end(), diameter), end; i != end; ++i)
    smallest_mm = std::min(smallest_mm, std::stod((*i)[1]));
  int n_segments = 0;
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    const bool is_segment = std::regex_search(line, found, diameter);
    if (kind == "sharp" && line.find("fillet") != std::string::npos) continue;
    if (kind == "drum" && is_segment) {
      line = std::regex_replace(line, bore, "");
      line.replace(line.rfind(" }"), 2, fmt::format(", bore = \"{:.1f} mm\" }}", 0.8 * smallest_mm));
    }
    if (kind == "eccentric" && is_segment && ++n_segments == 2)
      line.replace(line.rfind(" }"), 2, fmt::format(", eccentricity = \"{:.1f} mm\" }}", 0.02 * smallest_mm));
    text += line + '\n';
  }
  return text;
}

struct Run {
  Judged analysis;
  int harmonics = 0;
};

Run run(const Scene& scene, double tolerance) {
  StageClock clock;
  SceneRunOptions options;
  options.n_threads = 1;
  options.fresh = true;
  options.cache = false;
  options.accuracy.tolerance = tolerance;
  auto result = run_scene(scene, options, clock);
  return {std::move(result.analyses.front()), result.loaded.scene.bodies.front().pressure_harmonics};
}

std::vector<std::array<double, 2>> peaks_of(const std::vector<PlaceStress>& places) {
  double largest_Pa = 0;
  for (const auto& place : places) largest_Pa = std::max(largest_Pa, place.value_Pa);
  std::vector<std::array<double, 2>> result;
  for (const auto& place : places)
    if (place.value_Pa >= share_of_places * largest_Pa)
      result.push_back({place.position_m[2], std::hypot(place.position_m[0], place.position_m[1])});
  return result;
}

Scene with_harmonics(Scene scene, int n) {
  scene.bodies.front().pressure_harmonics = n;
  return scene;
}

/// Again where a place is the largest at a point that had no fine cells.
harmonics::StrictStresses truth_of(const Scene& scene, const std::set<int>& truncations,
                                   std::vector<std::array<double, 2>> peaks_m) {
  auto truth = harmonics::strict_stresses(scene, truncations, peaks_m);
  double largest_Pa = 0;
  for (const auto& [feature, stress] : truth.places) largest_Pa = std::max(largest_Pa, stress.value_Pa);
  bool is_elsewhere = false;
  for (const auto& [feature, stress] : truth.places) {
    if (stress.value_Pa < share_of_places * largest_Pa) continue;
    const auto& [z, r] = stress.position_zr_m;
    if (std::any_of(peaks_m.begin(), peaks_m.end(),
                    [&, z = z, r = r](const auto& p) { return std::hypot(p[0] - z, p[1] - r) < 0.03 * r; }))
      continue;
    peaks_m.push_back({z, r});
    is_elsewhere = true;
  }
  return is_elsewhere ? harmonics::strict_stresses(scene, truncations, peaks_m) : truth;
}

/// Section by section: what the estimate is made of.
void print_sections(unsigned seed, const Scene& scene, int n_sections) {
  const auto& body = scene.bodies.front();
  StageClock clock;
  auto loaded = load_bodies(scene, {describe_revolved(body)}, clock);
  loaded.meshed.front().mesh.sections.clear();
  AxisymmetricRefinement refinement(body, loaded.meshed.front(), loaded.body_loads.front(), 1);
  std::map<std::string, std::vector<std::array<double, 2>>> values;
  std::vector<PlaceStress> places;
  std::vector<std::size_t> n_dofs;
  std::vector<LargestTorsion> torsion;
  std::vector<double> seconds;
  for (int i = 0; i < n_sections; ++i) {
    auto step = refinement.next(clock);
    for (const auto& place : step.places) values[place.feature].push_back({place.value_Pa, place.error_Pa});
    places = std::move(step.places);
    n_dofs.push_back(step.responses.n_dofs);
    torsion.push_back(step.torsion);
    seconds.push_back(step.seconds);
  }
  const int last = body.pressure_harmonics;
  const auto truth = truth_of(scene, {last}, peaks_of(places));
  fmt::print("SHAFT {}: {} unknowns of the truth; unknowns and seconds of sections:", seed, truth.n_dofs);
  for (std::size_t i = 0; i < n_dofs.size(); ++i) fmt::print(" {}, {:.3f};", n_dofs[i], seconds[i]);
  fmt::print("\nTORSION {} {:.8g}", seed, truth.torsion_Pa);
  for (const auto& t : torsion) fmt::print(" {:.8g}:{:.6g}", t.value_Pa, t.error_Pa);
  fmt::print("\n");
  for (const auto& [feature, known_Pa] : truth.truncated_Pa.at(last)) {
    const auto found = values.find(feature);
    if (found == values.end()) continue;
    fmt::print("PLACE {} '{}' {:.8g}", seed, feature, known_Pa);
    for (const auto& [value, error] : found->second) fmt::print(" {:.8g}:{:.6g}", value, error);
    fmt::print("\n");
  }
}

void print_check(unsigned seed, const Scene& scene) {
  const auto analysis = run(scene, 0.005).analysis;
  const auto peaks_m = peaks_of(analysis.place_stresses);
  const int last = scene.bodies.front().pressure_harmonics;
  const auto truth = truth_of(scene, {last}, peaks_m),
             finer = harmonics::strict_stresses(scene, {last}, peaks_m, 0.4);
  for (const auto& [feature, stress] : truth.places)
    fmt::print("{} {:20} {:10.5f} MPa, on finer cells {:+.5f} %\n", seed, feature, stress.value_Pa / 1e6,
               100 * (finer.places.at(feature).value_Pa / stress.value_Pa - 1));
}

void judge(unsigned seed, const Scene& scene, const Options& options, std::vector<Table>& tables) {
  std::vector<Run> runs;
  std::set<int> truncations;
  int most = scene.bodies.front().pressure_harmonics;
  for (const double percent : options.tolerances_percent) {
    runs.push_back(run(scene, percent / 100));
    truncations.insert(runs.back().harmonics);
    most = std::max(most, runs.back().harmonics);
  }
  const auto truth =
      truth_of(with_harmonics(scene, 3 * most), truncations, peaks_of(runs.back().analysis.place_stresses));
  double peak_Pa = 0;
  for (const auto& [feature, stress] : truth.places) peak_Pa = std::max(peak_Pa, stress.value_Pa);
  for (std::size_t t = 0; t < runs.size(); ++t) {
    const auto& [analysis, last] = runs[t];
    auto& table = tables[t];
    ++table.n;
    table.n_met += analysis.search.met;
    const Figure peak{analysis.peak.value_Pa, analysis.peak.errors.numerical_Pa(), peak_Pa};
    table.peaks.push_back(peak);
    if (options.list || !peak.is_bounded()) {
      fmt::print("{} at {:g} %: {:.4f} MPa +- {:.4f}, {:.4f} is right ({}, {} sections, {} harmonics{}){}\n",
                 seed, options.tolerances_percent[t], peak.value_Pa / 1e6, peak.stated_Pa / 1e6,
                 peak.truth_Pa / 1e6, analysis.peak.feature, analysis.search.steps.size(), last,
                 analysis.search.met ? "" : ", not met", peak.is_bounded() ? "" : " NOT BOUNDED");
      if (!peak.is_bounded())
        for (const auto& entry : analysis.peak.errors.numerical)
          fmt::print("      {} {:.4f}\n", entry.source, entry.value_Pa / 1e6);
    }
    const auto& known = truth.truncated_Pa.at(last);
    for (const auto& place : analysis.place_stresses) {
      const auto own = known.find(place.feature);
      if (own == known.end() || own->second < share_of_places * peak_Pa) continue;
      const Figure figure{place.value_Pa, place.error_Pa, own->second};
      table.places.push_back(figure);
      if (options.list || !figure.is_bounded())
        fmt::print("   {} at {:g} %: {:20} {:10.4f} MPa +- {:.4f}, {:.4f} is right{}\n", seed,
                   options.tolerances_percent[t], place.feature, figure.value_Pa / 1e6,
                   figure.stated_Pa / 1e6, figure.truth_Pa / 1e6, figure.is_bounded() ? "" : " NOT BOUNDED");
    }
    const auto* ring = analysis.diagrams ? largest_torsion_ring(*analysis.diagrams) : nullptr;
    if (ring == nullptr || is_rounding(analysis, *ring) || truth.torsion_Pa < 1e-3 * peak_Pa) continue;
    const Figure figure{ring->max_Pa, ring_error_Pa(analysis, *ring), truth.torsion_Pa};
    table.torsion.push_back(figure);
    if (options.list || !figure.is_bounded())
      fmt::print("   {} at {:g} %: torsional stress {:.4f} MPa +- {:.4f}, {:.4f} is right{}\n", seed,
                 options.tolerances_percent[t], figure.value_Pa / 1e6, figure.stated_Pa / 1e6,
                 figure.truth_Pa / 1e6, figure.is_bounded() ? "" : " NOT BOUNDED");
  }
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("shafts", options.n_shafts, "how many are drawn (200)")->check(CLI::PositiveNumber);
  app.add_option("first_seed", options.first_seed, "of the first of them (1)");
  app.add_option("--kind", options.kind, "what is made of the drawings")
      ->check(CLI::IsMember({"plain", "sharp", "drum", "eccentric"}));
  app.add_option("--tolerance", options.tolerances_percent,
                 "per cent, any number of times (5, 1, 0.5, 0.2 and 0.1)")
      ->allow_extra_args(false)
      ->check(CLI::PositiveNumber);
  app.add_flag("--list", options.list, "a line for each place");
  auto* sections = app.add_option("--sections", options.n_sections, "instead, values of places on N sections")
                       ->check(CLI::Range(1, AxisymmetricRefinement::most_steps));
  app.add_flag("--check", options.check, "instead, the truth once more on cells a third smaller")
      ->excludes(sections);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Stated errors of harmonics around the axis beside true ones, on shafts drawn at random.",
               "harmonics_benchmark");
  add_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app.help());
    return 0;
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "harmonics_benchmark: {}\n", error.what());
    return 2;
  }
  const fem::Environment environment(1);
  const fs::path directory =
      fs::temp_directory_path() / fmt::format("millstress_harmonics_{}_{}", options.first_seed, getpid());
  fs::create_directories(directory);
  std::vector<Table> tables(options.tolerances_percent.size());
  int n_shafts = 0, n_refused = 0;
  for (unsigned seed = options.first_seed; n_shafts < options.n_shafts && n_refused <= options.n_shafts;
       ++seed) {
    const auto file = directory / "shaft.toml";
    std::ofstream(file) << scene_text(seed, options.kind);
    try {
      auto scene = read_scene(file);
      scene.method = Method::axisymmetric;
      if (options.n_sections > 0)
        print_sections(seed, scene, options.n_sections);
      else if (options.check)
        print_check(seed, scene);
      else
        judge(seed, scene, options, tables);
    } catch (const std::exception& error) {  // a drawing that cannot be meshed
      ++n_refused;
      fmt::print("{}: {}\n", seed, error.what());
      continue;
    }
    ++n_shafts;
    std::fflush(stdout);
  }
  fs::remove_all(directory);
  if (options.n_sections > 0 || options.check) return 0;
  fmt::print("{} shafts ({}), from seed {}, {} drawings refused; met at", n_shafts, options.kind,
             options.first_seed, n_refused);
  for (std::size_t t = 0; t < tables.size(); ++t)
    fmt::print(" {:g} %: {}", options.tolerances_percent[t], tables[t].n_met);
  fmt::print(
      "\n| asked | of | n | stated / true, median | quartiles | bounded | true / stated, worst | stated, "
      "median | "
      "true, median | bias, median | low |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::size_t n_figures = 0, n_bounded = 0;
  for (std::size_t t = 0; t < tables.size(); ++t) {
    print_row(options.tolerances_percent[t], "peak", tables[t].peaks);
    print_row(options.tolerances_percent[t], "places", tables[t].places);
    print_row(options.tolerances_percent[t], "torsion", tables[t].torsion);
    for (const auto* figures : {&tables[t].peaks, &tables[t].places, &tables[t].torsion})
      for (const auto& figure : *figures) {
        ++n_figures;
        n_bounded += figure.is_bounded();
      }
  }
  return n_figures > 0 && n_bounded == n_figures ? 0 : 1;
}

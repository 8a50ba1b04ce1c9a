#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "fem/model/model.h"
#include "fem/ranks/helper_ranks.h"
#include "pipelines/analysis/respond.h"
#include "pipelines/commands/option_value.h"
#include "pipelines/commands/output_files.h"
#include "pipelines/commands/scene_options.h"
#include "pipelines/common/errors.h"
#include "pipelines/common/failure.h"
#include "pipelines/common/several_ranks.h"
#include "pipelines/files/replaceable.h"
#include "pipelines/pictures/chart.h"
#include "pipelines/responses/response_key.h"
#include "pipelines/scene/scene_tree.h"
#include "pipelines/sweep/points_on_ranks.h"
#include "pipelines/sweep/sweep_files.h"
#include "pipelines/sweep/sweep_journal.h"
#include "pipelines/sweep/sweep_request.h"
#include "pipelines/sweep/sweep_run.h"

namespace pipelines {
namespace {

struct SweepCommandOptions : SceneOptions {
  std::vector<std::string> vary;  ///< none: the scene's
  std::string design;             ///< empty: the scene's
  int n_points = 0;               ///< 0: the scene's
  long seed = -1;                 ///< negative: the scene's
  std::filesystem::path output;
  std::string tolerance, time_limit;
  std::vector<std::string> figures;  ///< to print and draw; none: chosen
  int n_threads = all_cores;
  bool loads_only = false, zones = false, fresh = false, json = false;
};

SweepRequest requested(const SweepCommandOptions& options, SweepRequest request) {
  if (!options.vary.empty()) request.vary = options.vary;
  if (!options.design.empty()) request.design = sweep_design(options.design);
  if (options.n_points > 0) request.n_points = options.n_points;
  if (options.seed >= 0) request.seed = std::uint64_t(options.seed);
  request.zones = (request.zones || options.zones) && !options.loads_only;
  return request;
}

/// All that a row depends on beside its settings, once a point was read.
std::string journal_key(const SweepCommandOptions& options, const RequestedAccuracy& accuracy, bool zones,
                        int n_threads) {
  std::string key = program_fingerprint() + '\n';
  for (const auto& input : noted_inputs()) key += input.file.string() + ' ' + input.hash + '\n';
  for (const auto& setting : options.settings) key += setting + '\n';
  return key + fmt::format("{} {} {} {} {} {} {}", options.loads_only, zones, accuracy.tolerance,
                           accuracy.time_limit_s, accuracy.once, accuracy.by_default, n_threads);
}

/// No figure of a sweep depends on these keys: points that look alike would be no answer.
void require_swept(const std::string& key) {
  const auto begins = [&](const std::string& word) {
    return key.compare(0, word.size(), word) == 0 &&
           (key.size() == word.size() || key[word.size()] == '.' || key[word.size()] == '[');
  };
  const auto dot = key.find('.');
  if (begins("duty") || (dot != std::string::npos && key.compare(dot, 8, ".fatigue") == 0 &&
                         (key.size() == dot + 8 || key[dot + 8] == '.')))
    throw OptionError(
        "--vary " + key +
        ": a sweep judges no fatigue and no operating blocks, so that no figure depends on this; "
        "run the scene with --set for each value");
}

void tell_forecast(const SweepForecast& forecast, std::size_t n_known, const RequestedAccuracy& accuracy) {
  std::string text =
      fmt::format("millstress: {} point{}", forecast.n_points, forecast.n_points == 1 ? "" : "s");
  if (n_known > 0) text += fmt::format(", {} known from the sweep before", n_known);
  for (const auto& body : forecast.bodies)
    text += fmt::format("; {}: {} mesh{}, {} solution{}", body.name, body.n_meshes,
                        body.n_meshes == 1 ? "" : "es", body.n_solutions, body.n_solutions == 1 ? "" : "s");
  std::size_t n_meshes = 0;
  for (const auto& body : forecast.bodies) n_meshes += body.n_meshes;
  if (n_meshes > 0 && accuracy.time_limit_s > 0)
    text += fmt::format("; searching takes {:g} s at most", double(n_meshes) * accuracy.time_limit_s);
  std::cerr << text << '\n';
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool have_one_header(const SweepRow& a, const SweepRow& b) {
  return a.figures.share_names(b.figures) ||
         std::equal(a.figures.begin(), a.figures.end(), b.figures.begin(), b.figures.end(),
                    [](const auto& x, const auto& y) { return x.name == y.name; });
}

/// The figures that are shown: those named, governing stresses, or else the largest forces of the first
/// point.
std::vector<std::string> shown_figures(const std::vector<std::string>& named,
                                       const std::vector<SweepRow>& rows) {
  std::vector<std::string> governing;
  std::set<std::string> known;
  std::vector<SweepFigure> forces;
  const SweepRow* before = nullptr;
  for (const auto& row : rows) {
    if (before != nullptr && have_one_header(*before, row)) continue;
    before = &row;
    for (const auto figure : row.figures) {
      if (!known.insert(figure.name).second) continue;
      if (ends_with(figure.name, ".governing")) governing.push_back(figure.name);
      if (figure.unit == "N" && ends_with(figure.name, ".max"))
        forces.push_back({figure.name, figure.unit, figure.value});
    }
  }
  for (const auto& name : named)
    if (known.count(name) == 0)
      throw OptionError("--figure " + name + ": the sweep has no such figure; sweep.csv has their names");
  if (!named.empty()) return named;
  if (!governing.empty()) return governing;
  constexpr std::size_t most_forces = 4;
  std::stable_sort(forces.begin(), forces.end(),
                   [](const auto& a, const auto& b) { return a.value > b.value; });
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(most_forces, forces.size()); ++i) names.push_back(forces[i].name);
  return names;
}

std::string unit_of(const std::vector<SweepRow>& rows, const std::string& figure) {
  for (const auto& row : rows)
    for (const auto f : row.figures)
      if (f.name == figure) return f.unit;
  return "";
}

/// Stresses in MPa, all else in SI.
double scale_of(const std::string& unit) {
  return unit == "Pa" ? 1e-6 : 1;
}
std::string shown_unit(const std::string& unit) {
  return unit == "Pa" ? "MPa" : unit;
}
std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

void print_points(std::ostream& out, const SweepPlan& plan, const std::vector<SweepRow>& rows,
                  const std::vector<std::string>& figures) {
  constexpr std::size_t most_lines = 60;
  std::vector<std::vector<std::string>> lines(1);
  lines.front().push_back("point");
  for (const auto& variation : plan.variations) lines.front().push_back(variation.key);
  std::vector<bool> has_error;
  for (const auto& figure : figures) {
    has_error.push_back(std::any_of(rows.begin(), rows.end(), [&](const SweepRow& row) {
      return !std::isnan(row.figure(figure + ".error"));
    }));
    lines.front().push_back(with_unit(figure, shown_unit(unit_of(rows, figure))));
    if (has_error.back()) lines.front().push_back("+-");
  }
  for (std::size_t p = 0; p < rows.size() && p < most_lines; ++p) {
    lines.push_back({std::to_string(p + 1)});
    for (const auto& value : plan.points[p].values) lines.back().push_back(value);
    if (!rows[p].refused.empty()) {
      lines.back().push_back("refused: " + rows[p].refused.substr(0, rows[p].refused.find('\n')));
      continue;
    }
    for (std::size_t f = 0; f < figures.size(); ++f) {
      const double scale = scale_of(unit_of(rows, figures[f]));
      lines.back().push_back(fmt::format("{:.6g}", scale * rows[p].figure(figures[f])));
      if (has_error[f])
        lines.back().push_back(fmt::format("{:.2g}", scale * rows[p].figure(figures[f] + ".error")));
    }
  }
  std::vector<std::size_t> widths;
  for (const auto& line : lines)
    for (std::size_t c = 0; c < line.size() && c < lines.front().size(); ++c) {
      if (c == widths.size()) widths.push_back(0);
      if (line[c].rfind("refused", 0) != 0) widths[c] = std::max(widths[c], line[c].size());
    }
  for (const auto& line : lines) {
    std::string text = " ";
    for (std::size_t c = 0; c < line.size(); ++c)
      text += fmt::format(" {:>{}}", line[c], c < widths.size() ? widths[c] : 0);
    out << text << '\n';
  }
  if (rows.size() > most_lines) out << fmt::format("  ... {} more in sweep.csv\n", rows.size() - most_lines);
}

/// As one word of a shell's command line.
std::string quoted(const std::string& text) {
  if (text.find_first_of("\"$`\\!") == std::string::npos) return '"' + text + '"';
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string quoted_if_needed(const std::string& text) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || std::strchr("_./-+=,:@%", c) != nullptr;
  };
  return std::all_of(text.begin(), text.end(), is_plain) ? text : quoted(text);
}

/// The point where each figure is largest, and how to look at it.
void print_extremes(std::ostream& out, const SweepCommandOptions& options, const SweepPlan& plan,
                    const std::vector<SweepRow>& rows, const std::vector<std::string>& figures) {
  for (const auto& figure : figures) {
    std::optional<std::size_t> largest;
    for (std::size_t p = 0; p < rows.size(); ++p)
      if (const double value = rows[p].figure(figure); !std::isnan(value))
        if (!largest || value > rows[*largest].figure(figure)) largest = p;
    if (!largest) continue;
    const auto unit = unit_of(rows, figure);
    out << fmt::format("\n  {} is largest at point {}: {:.6g} {}\n", figure, *largest + 1,
                       scale_of(unit) * rows[*largest].figure(figure), shown_unit(unit));
    std::string settings;
    for (const auto* all : {&options.settings, &plan.points[*largest].settings})
      for (const auto& setting : *all) settings += " --set " + quoted(setting);
    if (!options.loads_only) {
      if (!options.tolerance.empty()) settings += " --tolerance " + quoted(options.tolerance);
      if (!options.time_limit.empty()) settings += " --time-limit " + quoted(options.time_limit);
    }
    out << "  millstress " << (options.loads_only ? "loads " : "run ")
        << quoted_if_needed(options.scene.string()) << settings << '\n';
  }
}

/// What becomes of each zone over the points.
void print_zones(std::ostream& out, const std::vector<SweepRow>& rows,
                 const std::vector<std::vector<int>>& numbers) {
  struct Followed {
    std::set<std::string> features;
    std::size_t n_points = 0, leads = 0;
    double least_Pa = std::numeric_limits<double>::max(), most_Pa = 0;
  };
  std::map<std::pair<std::string, int>, Followed> zones;
  for (std::size_t p = 0; p < rows.size(); ++p) {
    std::set<std::string> bodies;
    for (std::size_t z = 0; z < rows[p].zones.size(); ++z) {
      const auto& zone = rows[p].zones[z];
      auto& followed = zones[{zone.body, numbers[p][z]}];
      followed.features.insert(zone.feature);
      ++followed.n_points;
      followed.leads += bodies.insert(zone.body).second;  // zones stand by descending peak
      followed.least_Pa = std::min(followed.least_Pa, zone.peak_Pa);
      followed.most_Pa = std::max(followed.most_Pa, zone.peak_Pa);
    }
  }
  out << "\n  zones, followed over the points\n";
  for (const auto& [name, zone] : zones) {
    if (name.second > int(n_zones_shown)) continue;
    std::string features;
    for (const auto& feature : zone.features) features += (features.empty() ? "" : ", ") + feature;
    out << fmt::format("    {} {}: {}, at {} of {} points, {:.4g} to {:.4g} MPa, leads at {}\n", name.first,
                       name.second, features, zone.n_points, rows.size(), 1e-6 * zone.least_Pa,
                       1e-6 * zone.most_Pa, zone.leads);
  }
  if (zones.empty()) out << "    none\n";
}

/// A curve per figure over one key: of a grid, for all values of the other keys (up to six curves); of other
/// designs the points where this key was varied, as marks.
LineChart line_chart(const std::string& title, const SweepPlan& plan, const std::vector<SweepRow>& rows,
                     const std::vector<std::string>& figures, std::size_t k, SweepDesign design) {
  LineChart chart;
  chart.title = title;
  const auto& variation = plan.variations[k];
  chart.x = {with_unit(variation.key, variation.unit), variation.range && variation.range->is_logarithmic};
  chart.y.title = shown_unit(unit_of(rows, figures.front()));
  constexpr std::size_t most_curves = 6;
  for (const auto& figure : figures) {
    const double scale = scale_of(unit_of(rows, figure));
    std::map<std::vector<std::string>, std::size_t> curves;  // by the other keys' values
    for (std::size_t p = 0; p < rows.size(); ++p) {
      const double x = plan.points[p].numbers[k], y = scale * rows[p].figure(figure);
      if (std::isnan(x) || std::isnan(y)) continue;
      std::vector<std::string> others;
      if (design == SweepDesign::grid)
        for (std::size_t other = 0; other < plan.variations.size(); ++other)
          if (other != k) others.push_back(plan.points[p].values[other]);
      auto curve = curves.find(others);
      if (curve == curves.end()) {
        if (chart.curves.size() >= most_curves) continue;
        std::string name = figure;
        for (const auto& value : others) name += ", " + value;
        curve = curves.emplace(others, chart.curves.size()).first;
        chart.curves.push_back({name, {}, {}, {}, design != SweepDesign::latin_hypercube});
      }
      auto& drawn = chart.curves[curve->second];
      drawn.x.push_back(x);
      drawn.y.push_back(y);
      if (const double error = scale * rows[p].figure(figure + ".error"); !std::isnan(error))
        drawn.error.push_back(error);
    }
  }
  return chart;
}

HeatMap heat_map(const std::string& title, const SweepPlan& plan, const std::vector<SweepRow>& rows,
                 const std::string& figure) {
  HeatMap map;
  const auto& along = plan.variations[1];
  const auto& up = plan.variations[0];
  const auto unit = unit_of(rows, figure);
  map.title = title + ": " + with_unit(figure, shown_unit(unit));
  map.x_title = with_unit(along.key, along.unit);
  map.y_title = with_unit(up.key, up.unit);
  map.figure_title = with_unit(figure, shown_unit(unit));
  const auto labels = [](const Variation& variation) {
    std::vector<std::string> texts;
    for (const double number : variation.numbers) texts.push_back(fmt::format("{:.4g}", number));
    return texts.empty() ? variation.values : texts;
  };
  map.x_values = labels(along);
  map.y_values = labels(up);
  for (const auto& row : rows) map.figures.push_back(scale_of(unit) * row.figure(figure));
  return map;
}

/// Files of this or an earlier sweep's charts and maps in a directory.
std::vector<std::string> charts_in(const std::filesystem::path& directory) {
  static const std::regex of_sweep(R"((chart|map)(_[0-9]+)?\.(png|svg))");
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(directory, none))
    if (const auto name = entry.path().filename().string(); std::regex_match(name, of_sweep))
      names.push_back(name);
  return names;
}

/// Those of an earlier sweep that this one has not drawn are of other points.
void remove_other_charts(const std::filesystem::path& directory, const std::vector<std::string>& drawn) {
  for (const auto& name : charts_in(directory))
    if (std::find(drawn.begin(), drawn.end(), name) == drawn.end()) std::filesystem::remove(directory / name);
}

/// @return the files that were written
std::vector<std::string> draw_charts(const std::filesystem::path& directory, const std::string& title,
                                     const SweepPlan& plan, const std::vector<SweepRow>& rows,
                                     const std::vector<std::string>& figures, SweepDesign design) {
  std::vector<std::string> files;
  const auto draw = [&](const auto& chart, const std::string& name) {
    if (!write_chart(chart, directory / name)) {
      std::cerr << "no chart: this machine offers no EGL (package libegl1); sweep.csv has the figures\n";
      return;
    }
    files.push_back(name + ".png");
    files.push_back(name + ".svg");
  };
  if (figures.empty()) return files;
  const bool is_map = design == SweepDesign::grid && plan.variations.size() == 2 &&
                      plan.variations[0].values.size() > 1 && plan.variations[1].values.size() > 1;
  if (is_map)
    for (std::size_t f = 0; f < std::min<std::size_t>(2, figures.size()); ++f)
      draw(heat_map(title, plan, rows, figures[f]), f == 0 ? "map" : "map_" + std::to_string(f + 1));
  std::vector<std::vector<std::string>> by_unit;  // one axis, one unit
  for (const auto& figure : figures) {
    const auto own = std::find_if(by_unit.begin(), by_unit.end(), [&](const auto& others) {
      return unit_of(rows, others.front()) == unit_of(rows, figure);
    });
    own == by_unit.end() ? by_unit.push_back({figure}) : own->push_back(figure);
  }
  int n_charts = 0;
  for (std::size_t k = 0; k < plan.variations.size(); ++k) {
    if (!plan.variations[k].is_numeric()) continue;
    for (const auto& of_unit : by_unit) {
      const auto chart = line_chart(title, plan, rows, of_unit, k, design);
      if (chart.curves.empty()) continue;
      ++n_charts;
      draw(chart, n_charts == 1 ? "chart" : "chart_" + std::to_string(n_charts));
    }
  }
  return files;
}

/// Points whose governing stress is known less well than the tolerance asks.
std::size_t n_known_worse(const std::vector<SweepRow>& rows, double tolerance) {
  return std::size_t(std::count_if(rows.begin(), rows.end(), [&](const SweepRow& row) {
    return std::any_of(row.figures.begin(), row.figures.end(), [&](const auto& f) {
      return ends_with(f.name, ".governing") && row.figure(f.name + ".error") > tolerance * f.value;
    });
  }));
}

/// What a sweep is about, the same on all ranks.
struct Sweep {
  TomlNode tree;
  SweepRequest request;
  SweepPlan plan;
  std::filesystem::path directory;
  Scene first;  ///< for what all points have alike
  RequestedAccuracy accuracy;
  bool loads_only;

  explicit Sweep(const SweepCommandOptions& options)
      : tree(without_duty(read_scene_tree(options.scene))),
        request(requested(options, read_sweep_request(options.scene, tree))),
        plan(plan_sweep(request)),
        directory(options.output.empty()
                      ? std::filesystem::path("results") / (options.scene.stem().string() + "_sweep")
                      : options.output) {
    for (const auto& variation : plan.variations) require_swept(variation.key);
    try {
      first = read_scene(options.scene, tree, options.settings);
    } catch (const SceneError&) {
      auto settings = options.settings;
      const auto& own = plan.points.front().settings;
      settings.insert(settings.end(), own.begin(), own.end());
      first = read_scene(options.scene, tree, settings);
    }
    accuracy = with_default(requested_search(options.tolerance, options.time_limit, first.accuracy));
    loads_only = options.loads_only || first.bodies.empty();
  }

  SweepOptions options(const SweepCommandOptions& asked, int n_threads, int rank) const {
    return {asked.scene, tree,       asked.settings, directory,     rank,
            n_threads,   loads_only, asked.fresh,    request.zones, accuracy};
  }
};

/// By rank and point: whether the rank computes it. The same on all ranks.
std::vector<std::vector<char>> points_of_ranks(const SweepRun& run) {
  const int n_ranks = fem::n_ranks(MPI_COMM_WORLD);
  const auto rank_of_point = deal_points(run.groups(n_ranks), n_ranks);
  std::vector<std::vector<char>> is_own(std::size_t(n_ranks), std::vector<char>(rank_of_point.size(), 0));
  for (std::size_t p = 0; p < rank_of_point.size(); ++p) is_own[std::size_t(rank_of_point[p])][p] = 1;
  return is_own;
}

void tell_ranks(const std::vector<std::vector<char>>& points_of_ranks) {
  std::string text = "millstress: points by rank:";
  bool has_idle = false;
  for (const auto& is_own : points_of_ranks) {
    const auto n = std::count(is_own.begin(), is_own.end(), 1);
    text += fmt::format(" {}", n);
    has_idle = has_idle || n == 0;
  }
  std::cerr << text << (has_idle ? "; points that share their meshes stay on one rank" : "") << '\n';
}

/// Threads of this rank.
int own_threads(const SweepCommandOptions& options) {
  return options.n_threads > 0 || !started_on_several_ranks() ? options.n_threads
                                                              : fem::Environment::n_threads();
}

/// The journal of a sweep, and the rows of a sweep before that it takes over.
struct KnownRows {
  SweepJournal journal;
  std::vector<std::optional<SweepRow>> rows;

  /// Once every point was read.
  KnownRows(const SweepCommandOptions& options, const Sweep& sweep)
      : journal(sweep.directory / "journal",
                journal_key(options, sweep.accuracy, sweep.request.zones, options.n_threads)),
        rows(options.fresh ? std::vector<std::optional<SweepRow>>(sweep.plan.points.size())
                           : journal.known(sweep.plan)) {}
};

/// On every rank but the first, once that one has begun the journal.
void sweep_beside_first_rank(const SweepCommandOptions& options) {
  work_on_bodies_alone();
  const Sweep sweep(options);
  const int n_threads = own_threads(options), rank = fem::this_rank(MPI_COMM_WORLD);
  SweepRun run(sweep.options(options, n_threads, rank), sweep.plan.points);
  run.keep_points(points_of_ranks(run)[std::size_t(rank)]);
  const fem::Environment environment(n_threads);
  RowsToFirstRank to_first(sweep.plan);
  StageClock silent;
  run.run(silent, KnownRows(options, sweep).rows,
          [&](const auto& points, const auto& rows) { to_first.send(points, rows); });
  to_first.end(run.n_improved_meshes());
}

/// The rows of all points, in the journal too; on rank 0.
std::vector<SweepRow> run_points(const SweepCommandOptions& options, const Sweep& sweep, StageClock& clock) {
  const auto& plan = sweep.plan;
  const int n_threads = own_threads(options), n_ranks = fem::n_ranks(MPI_COMM_WORLD);
  if (n_ranks > 1) work_on_bodies_alone();
  SweepRun run(sweep.options(options, n_threads, 0), plan.points);
  auto outputs = charts_in(sweep.directory);
  for (const char* name : {"sweep.csv", "sweep.h5", "zones.csv", "journal"}) outputs.emplace_back(name);
  require_writable(output_files("-o", sweep.directory, outputs));
  std::optional<fem::Environment> environment;
  if (!sweep.first.bodies.empty()) environment.emplace(n_threads);

  KnownRows known(options, sweep);
  auto& journal = known.journal;
  journal.require_own();
  const auto n_known = std::size_t(
      std::count_if(known.rows.begin(), known.rows.end(), [](const auto& row) { return row.has_value(); }));
  if (!options.quiet) tell_forecast(run.forecast(), n_known, sweep.accuracy);
  if (run.has_chosen_effects())
    std::cerr
        << "millstress: effects = \"auto\" chooses by the point; a sweep has all of them on at every point\n";
  journal.begin(plan, known.rows);
  const auto keep = [&](const std::vector<std::size_t>& points, const std::vector<SweepRow>& all) {
    for (const auto p : points) journal.append(plan.points[p], all[p]);
    journal.flush();
  };
  RowsOfOtherRanks others(plan, n_ranks);
  std::vector<SweepRow> of_others(plan.points.size());
  if (n_ranks > 1) {
    const auto points = points_of_ranks(run);
    if (!options.quiet) tell_ranks(points);
    run.keep_points(points.front());
    fem::let_others_work();
  }
  auto rows = run.run(clock, std::move(known.rows),
                      [&](const std::vector<std::size_t>& points, const std::vector<SweepRow>& all) {
                        keep(points, all);
                        others.take(of_others, keep);
                      });
  others.take_all(of_others, keep);
  fem::others_have_worked();
  for (const auto p : others.points()) rows[p] = std::move(of_others[p]);
  if (const auto n = run.n_improved_meshes() + others.n_improved_meshes(); n > 0)
    std::cerr << fmt::format("millstress: {} more mesh{} searched for points that the first knew less well\n",
                             n, n == 1 ? " was" : "es were");
  return rows;
}

void carry_out(const SweepCommandOptions& options, std::ostream& out) {
  const Sweep sweep(options);
  const auto& [tree, request, plan, directory, first, accuracy, loads_only] = sweep;
  StageClock clock(progress_on_stderr(options.verbosity()));
  auto rows = run_points(options, sweep, clock);
  const auto numbers = follow_zones(plan, rows);
  add_zone_figures(rows, numbers);
  clock.run("write", [&] {
    if (request.zones)
      write_sweep_zones(directory / "zones.csv", plan, rows, numbers);
    else
      std::filesystem::remove(directory / "zones.csv");  // of a sweep before
    write_sweep_csv(directory / "sweep.csv", plan, rows, threads(options.n_threads));
    write_sweep_h5(directory / "sweep.h5", plan, rows, first.title);
  });
  const auto figures = shown_figures(options.figures, rows);
  const auto charts = clock.run(
      "charts", [&] { return draw_charts(directory, first.title, plan, rows, figures, request.design); });
  remove_other_charts(directory, charts);
  if (options.json) {
    out << sweep_json(plan, rows);
  } else {
    print_points(out, plan, rows, figures);
    print_extremes(out, options, plan, rows, figures);
    if (request.zones) print_zones(out, rows, numbers);
    const auto n_refused =
        std::count_if(rows.begin(), rows.end(), [](const auto& row) { return !row.refused.empty(); });
    if (n_refused > 0)
      out << fmt::format("\n  {} of {} points were refused: the column says why\n", n_refused, rows.size());
    out << "\n  sweep.csv, sweep.h5" << (request.zones ? ", zones.csv" : "");
    for (const auto& file : charts) out << ", " << file;
    out << " in " << directory.string() << '\n';
  }
  if (std::all_of(rows.begin(), rows.end(), [](const auto& row) { return !row.refused.empty(); }))
    throw StageRefused("no point could be computed: " + rows.front().refused);
  const auto n_worse = loads_only || accuracy.tolerance <= 0 ? 0 : n_known_worse(rows, accuracy.tolerance);
  if (n_worse == 0) return;
  const auto text = fmt::format(
      "{} of {} points are known less well than {:g} %: a mesh that is searched for them "
      "does better (run them by themselves, or begin the sweep at one of them)",
      n_worse, rows.size(), 100 * accuracy.tolerance);
  if (!accuracy.by_default) throw ToleranceNotMet(text + "; the results are kept");
  std::cerr << "millstress: " << text << '\n';
}

}  // namespace

void add_sweep_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<SweepCommandOptions>();
  auto* command = add_scene_command(
      app, "sweep", "many operating points over one mesh and one set of unit responses", *options);
  command
      ->add_option(
          "--vary", options->vary,
          "\"KEY = A..B UNIT / N [log]\" or \"KEY = V, V, V\"; may be repeated (default: the scene's)")
      ->allow_extra_args(false);
  command->add_option("--design", options->design,
                      "grid, one-at-a-time or latin-hypercube (default: the scene's, or grid)");
  command->add_option("--points", options->n_points, "of a Latin hypercube")->check(CLI::Range(2, 1'000'000));
  command->add_option("--seed", options->seed, "of a Latin hypercube")->check(CLI::Range(0L, 1'000'000'000L));
  command->add_flag("--loads", options->loads_only, "the load stage alone, microseconds a point");
  command->add_flag("--zones", options->zones,
                    "the stress zones of every point, followed from point to point");
  command
      ->add_option("--figure", options->figures,
                   "to print and draw, a column of sweep.csv; may be repeated (default: governing stresses)")
      ->allow_extra_args(false);
  command->add_option("-o,--output", options->output, "result directory (default: results/<scene>_sweep)");
  command->add_option("--tolerance", options->tolerance,
                      "of every mesh that is searched, like \"2 %\" (default: the scene's)");
  command->add_option("--time-limit", options->time_limit,
                      "of every search, like \"60 s\" (default: the scene's)");
  command->add_flag("--fresh", options->fresh, "reuse nothing of an earlier sweep");
  command->add_flag("--json", options->json, "print the rows as JSON instead of the table");
  add_threads_option(*command, options->n_threads, chosen);
  command->callback([options, choose = to_choose(chosen, options, carry_out), &chosen] {
    choose();
    chosen.beside_first_rank = [options] { sweep_beside_first_rank(*options); };
  });
}

}  // namespace pipelines

#include "pipelines/command/study/sweep_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <utility>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/base/fields/shown_unit.h"
#include "pipelines/base/names/nearest_name.h"

namespace pipelines {
namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool have_one_header(const SweepRow& a, const SweepRow& b) {
  return a.figures.share_names(b.figures) ||
         std::equal(a.figures.begin(), a.figures.end(), b.figures.begin(), b.figures.end(),
                    [](const auto& x, const auto& y) { return x.name == y.name; });
}

bool have_same_figures(const SweepRow& a, const SweepRow& b) {
  return a.refused == b.refused && have_one_header(a, b) &&
         std::equal(a.figures.begin(), a.figures.end(), b.figures.begin(), b.figures.end(),
                    [](const auto& x, const auto& y) {
                      return x.value == y.value || (std::isnan(x.value) && std::isnan(y.value));
                    });
}

/// The text as one word of a shell's command line.
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

/// "; did you mean "shaft.governing"?", or nothing.
std::string near_figure(const std::string& name, const std::set<std::string>& known) {
  const auto nearest = nearest_name(name, {known.begin(), known.end()});
  return nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?";
}

}  // namespace

bool is_governing(const std::string& figure) {
  return ends_with(figure, ".governing");
}

std::vector<std::string> shown_figures(const std::vector<std::string>& named,
                                       const std::vector<SweepRow>& rows) {
  std::vector<std::string> governing;
  std::set<std::string> known;
  std::vector<SweepFigure> forces, torques;
  const SweepRow* before = nullptr;
  for (const auto& row : rows) {
    if (before != nullptr && have_one_header(*before, row)) continue;
    before = &row;
    for (const auto figure : row.figures) {
      if (!known.insert(figure.name).second) continue;
      if (is_governing(figure.name)) governing.push_back(figure.name);
      if (!ends_with(figure.name, ".max")) continue;
      if (figure.unit == "N") forces.push_back({figure.name, figure.unit, figure.value});
      if (figure.unit == "N m") torques.push_back({figure.name, figure.unit, figure.value});
    }
  }
  for (const auto& name : named)
    if (known.count(name) == 0)
      throw OptionError("figure \"" + name + "\": the sweep has no such figure" + near_figure(name, known) +
                        "; sweep.csv has their names");
  if (!named.empty()) return named;
  if (!governing.empty()) return governing;
  if (forces.empty()) forces = std::move(torques);
  constexpr std::size_t most_forces = 4;
  std::stable_sort(forces.begin(), forces.end(),
                   [](const auto& a, const auto& b) { return a.value > b.value; });
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(most_forces, forces.size()); ++i) names.push_back(forces[i].name);
  return names;
}

std::vector<std::string> keys_without_effect(const SweepPlan& plan, const std::vector<SweepRow>& rows) {
  std::vector<std::string> keys;
  for (std::size_t v = 0; v < plan.variations.size(); ++v) {
    std::map<std::vector<std::string>, std::size_t> first;  // first of the points with the same other values
    bool is_compared = false, is_same = true;
    for (std::size_t p = 0; p < rows.size() && is_same; ++p) {
      auto others = plan.points[p].values;
      others.erase(others.begin() + std::ptrdiff_t(v));
      const auto [known, is_first] = first.emplace(std::move(others), p);
      if (is_first) continue;
      is_compared = true;
      is_same = have_same_figures(rows[known->second], rows[p]);
    }
    if (is_compared && is_same) keys.push_back(plan.variations[v].key);
  }
  return keys;
}

std::string unit_of(const std::vector<SweepRow>& rows, const std::string& figure) {
  for (const auto& row : rows)
    for (const auto f : row.figures)
      if (f.name == figure) return f.unit;
  return "";
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

void print_points(std::ostream& out, const SweepPlan& plan, const std::vector<SweepRow>& rows,
                  const std::vector<std::string>& figures) {
  constexpr std::size_t most_lines = 60;
  ShownRows table{{"point"}, {}};
  for (const auto& variation : plan.variations) table.titles.push_back(variation.short_key());
  std::vector<bool> has_error;
  for (const auto& figure : figures) {
    has_error.push_back(std::any_of(rows.begin(), rows.end(), [&](const SweepRow& row) {
      return !std::isnan(row.figure(figure + ".error"));
    }));
    table.titles.push_back(with_unit(figure, shown_unit(unit_of(rows, figure)).unit));
    if (has_error.back()) table.titles.emplace_back("+-");
  }
  for (std::size_t p = 0; p < rows.size() && p < most_lines; ++p) {
    auto& cells = table.cells.emplace_back(plan.points[p].values);
    cells.insert(cells.begin(), std::to_string(p + 1));
    if (const auto& refused = rows[p].refused; !refused.empty()) {
      cells.push_back("refused: " + refused.substr(0, refused.find('\n')));
      continue;
    }
    const auto add = [&](const std::string& figure, const char* format, double one) {
      const double value = rows[p].figure(figure) / one;
      cells.push_back(std::isnan(value) ? "-" : fmt::format(fmt::runtime(format), value));
    };
    for (std::size_t f = 0; f < figures.size(); ++f) {
      const double one = shown_unit(unit_of(rows, figures[f])).one;
      add(figures[f], "{:.6g}", one);
      if (has_error[f]) add(figures[f] + ".error", "{:.2g}", one);
    }
  }
  print_first_rows(out, "point", table);
  if (rows.size() > most_lines) out << fmt::format("  ... {} more in sweep.csv\n", rows.size() - most_lines);
}

void print_extremes(std::ostream& out, const SweepCommandOptions& options, const SweepPlan& plan,
                    const std::vector<SweepRow>& rows, const std::vector<std::string>& figures) {
  for (const auto& figure : figures) {
    std::optional<std::size_t> largest;
    for (std::size_t p = 0; p < rows.size(); ++p)
      if (const double value = rows[p].figure(figure); !std::isnan(value))
        if (!largest || value > rows[*largest].figure(figure)) largest = p;
    if (!largest) continue;
    const auto shown = shown_unit(unit_of(rows, figure));
    out << fmt::format("\n  {} is largest at point {}: {:.6g} {}\n", figure, *largest + 1,
                       rows[*largest].figure(figure) / shown.one, shown.unit);
    std::string settings;
    for (const auto* all : {&options.settings, &plan.points[*largest].settings})
      for (const auto& setting : *all) settings += " --set " + quoted(setting);
    if (!options.loads_only) {
      if (!options.tolerance.empty()) settings += " --tolerance " + quoted(options.tolerance);
      if (!options.method.empty()) settings += " --method " + options.method;
      if (!options.time_limit.empty()) settings += " --time-limit " + quoted(options.time_limit);
    }
    out << "  millstress " << (options.loads_only ? "loads " : "run ")
        << quoted_if_needed(options.scene.string()) << settings << '\n';
  }
}

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

}  // namespace pipelines

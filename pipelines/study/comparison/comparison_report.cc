#include "pipelines/study/comparison/comparison_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>

#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/base/fields/shown_unit.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/csv.h"
#include "pipelines/write/exports/html_page.h"
#include "pipelines/write/files/envelope_files.h"
#include "pipelines/write/pictures/picture.h"

namespace pipelines {
namespace {

using summary::Json;

constexpr std::size_t most_places = 12, most_loads = 12;

/// "A", "B" ... of the runs, "A27" beyond the alphabet.
std::string letter(std::size_t run) {
  const std::string text(1, char('A' + run % 26));
  return run < 26 ? text : text + std::to_string(run + 1);
}

std::string value_text(const FigureValue& figure, const std::string& si_unit) {
  const auto shown = shown_unit(si_unit);
  const double value = figure.value / shown.one, least = figure.least / shown.one,
               most = figure.most / shown.one;
  const std::string unit = si_unit == "1" ? "" : " " + shown.unit;
  const double below = value - least, above = most - value;
  const bool is_unbounded = std::isinf(below) && std::isinf(above);
  if (is_unbounded || std::max(below, above) <= 1e-9 * std::abs(value))
    return fmt::format("{:.4g}{}", value, unit);
  if (std::isfinite(most) && std::max(below, above) <= 1.01 * std::min(below, above))
    return fmt::format("{:.4g} +- {:.2g}{}", value, above, unit);
  return fmt::format("{:.4g}{} ({:.3g} to {})", value, unit, least,
                     std::isfinite(most) ? fmt::format("{:.3g}", most) : "any");
}

/// By how much a figure differs most, for the order of loads.
double largest_change(const ComparedFigure& figure) {
  double largest = 0;
  for (const auto& difference : figure.from_first) {
    if (!difference) return 1;
    if (!difference->is_none) largest = std::max(largest, std::abs(difference->relative.value_or(1)));
  }
  return largest;
}

std::vector<const ComparedFigure*> figures_of(const Comparison& comparison, FigureGroup group) {
  std::vector<const ComparedFigure*> found;
  for (const auto& figure : comparison.figures)
    if (figure.group == group) found.push_back(&figure);
  return found;
}

/// A load that cancels is rounding in one run and other rounding in the next.
bool is_of_weight(const ComparedFigure& load, const std::vector<const ComparedFigure*>& loads) {
  double own = 0, largest = 0;
  for (const auto* other : loads)
    if (other->unit == load.unit)
      for (const auto& value : other->values)
        if (value) {
          largest = std::max(largest, std::abs(value->value));
          if (other == &load) own = std::max(own, std::abs(value->value));
        }
  return own > 1e-9 * largest;
}

/// Loads that differ, those by the largest share first.
std::vector<const ComparedFigure*> changed_loads(const Comparison& comparison) {
  const auto loads = figures_of(comparison, FigureGroup::load);
  std::vector<const ComparedFigure*> changed;
  for (const auto* load : loads)
    if (largest_change(*load) > 0 && is_of_weight(*load, loads)) changed.push_back(load);
  std::stable_sort(changed.begin(), changed.end(),
                   [](const auto* a, const auto* b) { return largest_change(*a) > largest_change(*b); });
  return changed;
}

ShownRows rows_of(const Comparison& comparison, const std::string& title,
                  const std::vector<const ComparedFigure*>& figures, std::size_t most) {
  ShownRows rows;
  rows.titles.push_back(title);
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    rows.titles.push_back(letter(i));
    if (i > 0) rows.titles.push_back(letter(i) + " against A");
  }
  for (std::size_t k = 0; k < std::min(most, figures.size()); ++k) {
    const auto& figure = *figures[k];
    auto& cells = rows.cells.emplace_back(1, figure.name);
    for (std::size_t i = 0; i < figure.values.size(); ++i) {
      cells.push_back(figure.values[i] ? value_text(*figure.values[i], figure.unit) : "-");
      if (i > 0) cells.push_back(figure.from_first[i] ? figure.from_first[i]->text() : "-");
    }
  }
  return rows;
}

ShownRows verdict_rows(const Comparison& comparison) {
  ShownRows rows;
  rows.titles.push_back("verdict");
  std::set<std::string> parts;
  for (const auto& run : comparison.runs)
    for (const auto& [part, judgement] : run.judgements) parts.insert(part);
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) rows.titles.push_back(letter(i));
  for (const auto& part : parts) {
    auto& cells = rows.cells.emplace_back(1, part);
    for (const auto& run : comparison.runs) {
      const auto found = run.judgements.find(part);
      cells.push_back(found == run.judgements.end() ? "-" : found->second);
    }
  }
  return rows;
}

ShownRows key_rows(const Comparison& comparison) {
  ShownRows rows;
  rows.titles.push_back("input");
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) rows.titles.push_back(letter(i));
  for (const auto& key : comparison.keys) {
    auto& cells = rows.cells.emplace_back(1, key.key);
    for (const auto& text : key.texts) cells.push_back(text.empty() ? "-" : text);
  }
  return rows;
}

/// All tables, one after the other, with a remark where rows are left out.
template <typename Show>
void show_tables(const Comparison& comparison, bool all, const Show& show) {
  show(verdict_rows(comparison), std::string());
  show(key_rows(comparison), comparison.keys.empty() ? std::string("no input differs") : std::string());
  for (const auto group : {FigureGroup::margin, FigureGroup::headline, FigureGroup::place, FigureGroup::load,
                           FigureGroup::cost}) {
    const bool are_loads = group == FigureGroup::load;
    const auto figures = are_loads && !all ? changed_loads(comparison) : figures_of(comparison, group);
    const std::size_t most = all                           ? figures.size()
                             : are_loads                   ? most_loads
                             : group == FigureGroup::place ? most_places
                                                           : figures.size();
    std::string remark;
    if (figures.size() > most)
      remark = fmt::format("{} more {}", figures.size() - most, to_string(group)) +
               (are_loads ? " that differ" : "") + ": -v, --json";
    else if (are_loads && figures.empty())
      remark = "no load differs";
    show(rows_of(comparison, to_string(group), figures, most), remark);
  }
}

/// A number, or null for a bound that is not known.
Json bound(double value) {
  return summary::number_or_none(value);
}

Json figure_json(const ComparedFigure& figure) {
  Json json = summary::object({{"group", to_string(figure.group)},
                               {"name", figure.name},
                               {"unit", figure.unit},
                               {"values", Json::array()},
                               {"from_first", Json::array()}});
  for (const auto& value : figure.values)
    json["values"].push_back(value ? summary::object({{"value", bound(value->value)},
                                                      {"least", bound(value->least)},
                                                      {"most", bound(value->most)}})
                                   : Json(nullptr));
  const auto ratio = [](const std::optional<double>& value) { return value ? bound(*value) : Json(nullptr); };
  for (const auto& difference : figure.from_first)
    json["from_first"].push_back(difference ? summary::object({{"absolute", bound(difference->absolute)},
                                                               {"relative", ratio(difference->relative)},
                                                               {"least", ratio(difference->least)},
                                                               {"most", ratio(difference->most)},
                                                               {"is_told", difference->is_told},
                                                               {"text", difference->text()}})
                                            : Json(nullptr));
  return json;
}

void write_table(const std::filesystem::path& file, const Comparison& comparison) {
  std::vector<std::string> groups, names, units;
  for (const auto& figure : comparison.figures) {
    groups.push_back(to_string(figure.group));
    names.push_back(figure.name);
    units.push_back(shown_unit(figure.unit).unit);
  }
  std::vector<CsvColumn> columns{{"group", "", groups}, {"name", "", names}, {"unit", "", units}};
  const auto column = [&](const std::string& title, double FigureValue::*member, std::size_t run) {
    std::vector<double> cells;
    for (const auto& figure : comparison.figures) {
      const auto& value = figure.values[run];
      cells.push_back(value ? shown_unit(figure.unit).value((*value).*member) : std::nan(""));
    }
    columns.push_back({letter(run) + title, "", cells});
  };
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    column("", &FigureValue::value, i);
    column(" least", &FigureValue::least, i);
    column(" most", &FigureValue::most, i);
    if (i == 0) continue;
    std::vector<std::string> texts;
    for (const auto& figure : comparison.figures)
      texts.push_back(figure.from_first[i] ? figure.from_first[i]->text() : "");
    columns.push_back({letter(i) + " against A", "", texts});
  }
  write_csv(file, columns);
}

/// The largest stress that the pictures of a body have to show [MPa].
double largest_peak_MPa(const Comparison& comparison, const std::string& body) {
  double largest = 0;
  for (const auto& figure : comparison.figures)
    if (figure.name == body + ": peak von mises")
      for (const auto& value : figure.values)
        if (value) largest = std::max(largest, value->value / 1e6);
  return largest;
}

/// Every run's envelope of a body, in the same colours.
/// @return names of the files
std::vector<std::string> draw_bodies(const std::filesystem::path& folder, const Comparison& comparison) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i)
    for (const auto& body : comparison.runs[i].bodies) {
      const auto envelope = comparison.runs[i].directory / body / "envelope.vtu";
      const double largest = largest_peak_MPa(comparison, body);
      if (std::error_code none; largest <= 0 || !std::filesystem::exists(envelope, none)) continue;
      PictureOptions options;
      options.scale = 1e-6;
      options.excluded = excluded_field;
      options.beyond = beyond_field;
      options.range = {{0, largest}};
      const auto name = body + "_" + letter(i) + ".png";
      if (write_picture(envelope, von_mises_field,
                        letter(i) + ", " + body + ": largest von Mises stress over the cycle", "MPa",
                        folder / name, options))
        names.push_back(name);
    }
  return names;
}

std::string page_of(const Comparison& comparison, const std::filesystem::path& folder,
                    const std::vector<std::string>& pictures) {
  HtmlPage page("Runs compared");
  page.heading(1, "Runs compared");
  for (std::size_t i = 0; i < comparison.runs.size(); ++i)
    page.paragraph(letter(i) + ": " + comparison.runs[i].name + ": " + comparison.runs[i].headline);
  show_tables(comparison, false, [&](const ShownRows& rows, const std::string& remark) {
    page.table(rows);
    if (!remark.empty()) page.paragraph(remark);
  });
  for (const auto& picture : pictures) page.picture(folder / picture, picture);
  return page.text();
}

}  // namespace

void print_comparison(std::ostream& out, const Comparison& comparison, bool all) {
  for (std::size_t i = 0; i < comparison.runs.size(); ++i)
    out << (i == 0 ? "\n" : "") << letter(i) << ": " << comparison.runs[i].name << ": "
        << comparison.runs[i].headline << '\n';
  show_tables(comparison, all, [&](const ShownRows& rows, const std::string& remark) {
    if (!rows.cells.empty()) print_rows(out, rows.titles.front(), rows);
    if (!remark.empty()) out << (rows.cells.empty() ? "\n" : "") << "  " << remark << '\n';
  });
}

std::string comparison_json(const Comparison& comparison) {
  Json json =
      summary::object({{"runs", Json::array()}, {"keys", Json::object()}, {"figures", Json::array()}});
  for (const auto& run : comparison.runs)
    json["runs"].push_back(summary::object({{"name", run.name},
                                            {"directory", run.directory.string()},
                                            {"headline", run.headline},
                                            {"judgements", run.judgements}}));
  for (const auto& key : comparison.keys) json["keys"][key.key] = key.texts;
  for (const auto& figure : comparison.figures) json["figures"].push_back(figure_json(figure));
  return json.dump(2) + "\n";
}

std::vector<std::string> write_comparison(const std::filesystem::path& folder, const Comparison& comparison) {
  std::vector<std::string> names{"comparison.json", "comparison.csv", "comparison.html"};
  write_text_file(folder / names[0], comparison_json(comparison));
  write_table(folder / names[1], comparison);
  const auto pictures = draw_bodies(folder, comparison);
  write_text_file(folder / names[2], page_of(comparison, folder, pictures));
  names.insert(names.end(), pictures.begin(), pictures.end());
  return names;
}

}  // namespace pipelines

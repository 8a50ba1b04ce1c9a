#include "pipelines/scene/tables/load_columns.h"

#include <algorithm>
#include <optional>

#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/scene/tables/load_name.h"

namespace pipelines {
namespace {

/// A text that is one of a few; empty if it is missing or none of them.
std::string one_of(SceneTable& entry, const std::string& key, const std::vector<std::string>& known) {
  if (!entry.is_given(key)) return "";
  const std::string text = entry.text(key);
  if (std::find(known.begin(), known.end(), text) != known.end()) return text;
  std::string all;
  for (const auto& one : known) all += (all.empty() ? "\"" : ", \"") + one + "\"";
  if (!text.empty()) entry.refuse(key, "is none of " + all + "; write one of them");
  return "";
}

TableForm read_form(SceneTable& entry) {
  TableForm form;
  const auto delimiter = one_of(entry, "delimiter", {";", ",", "tab", "blanks"});
  form.delimiter = delimiter == "tab" ? '\t' : delimiter == "blanks" ? runs_of_blanks : delimiter[0];
  form.decimal = one_of(entry, "decimal", {".", ","})[0];
  if (entry.is_given("skip_rows")) form.skip_rows = entry.count_or("skip_rows", 0, 1'000'000, 0, "");
  return form;
}

/// "pulley.fx" in quotes, or pulley.fx without: TOML takes the latter for a table of its own.
void read_wanted(SceneTable columns, const std::string& prefix, std::vector<WantedColumn>& wanted) {
  for (const auto& name : columns.names()) {
    if (columns.has_table(name))
      read_wanted(columns.table(name), prefix + name + ".", wanted);
    else if (const auto title = columns.text(name); !title.empty())
      wanted.push_back({prefix + name, title, columns, name});
  }
}

std::string titles_text(const OpenTable& table) {
  constexpr std::size_t most = 40;
  std::vector<std::string> titles;
  for (const auto& column : table.columns) titles.push_back(column.title.text);
  if (titles.size() > most) titles.resize(most);
  return listed(titles) + (table.columns.size() > most ? " ..." : "");
}

std::string nearest_title(const std::string& title, const OpenTable& table) {
  std::vector<std::string> names, texts;
  for (const auto& column : table.columns) {
    names.push_back(column.title.name);
    texts.push_back(column.title.text);
  }
  const auto text = nearest_name(title, texts);
  return text.empty() ? nearest_name(title, names) : text;
}

std::string si_unit_of(const std::string& key) {
  if (key == "time") return "s";
  if (key == "angle") return "rad";
  const auto load = parse_load(key);
  return load ? load->unit : "";
}

/// Columns of that title, as written or without its unit.
std::vector<std::size_t> columns_of_title(const std::string& title, const std::string& si_unit,
                                          const OpenTable& table) {
  const auto wanted = parse_title(title);
  std::vector<std::size_t> exact, by_name;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const auto& has = table.columns[i].title;
    if (has.text == title) exact.push_back(i);
    const std::string name = without_unit_suffix(has, si_unit).name;
    if (!name.empty() && (name == title || name == wanted.name)) by_name.push_back(i);
  }
  return exact.empty() ? by_name : exact;
}

/// "#3" is the third column.
std::optional<std::size_t> numbered_column(const std::string& title) {
  if (title.size() < 2 || title.size() > 7 || title[0] != '#' ||
      title.find_first_not_of("0123456789", 1) != std::string::npos)
    return std::nullopt;
  return std::size_t(std::stoul(title.substr(1)));
}

std::optional<std::size_t> find_column(WantedColumn& wanted, const OpenTable& table) {
  const auto refuse = [&](const std::string& why) {
    wanted.table.refuse(wanted.name, why);
    return std::nullopt;
  };
  const std::string file = table.file.filename().string();
  if (const auto number = numbered_column(wanted.title)) {
    if (*number >= 1 && *number <= table.columns.size()) return *number - 1;
    return refuse(file + " has " + std::to_string(table.columns.size()) + " columns, counted from #1");
  }
  const auto found = columns_of_title(wanted.title, si_unit_of(wanted.key), table);
  if (found.size() == 1) return found[0];
  if (found.size() > 1)
    return refuse("is the title of " + std::to_string(found.size()) + " columns of " + file +
                  "; write the number of the one that is meant, such as \"#" + std::to_string(found[0] + 1) +
                  "\"");
  const auto nearest = nearest_title(wanted.title, table);
  return refuse("is no title in " + file + (nearest.empty() ? "." : "; did you mean \"" + nearest + "\"?") +
                " Its titles, in line " + std::to_string(table.layout.title_line) +
                ", are: " + titles_text(table));
}

/// The unit of a column that the scene names; SI where neither file nor scene has one, which is told.
std::string unit_of_wanted(WantedColumn& wanted, const OpenTable& table, std::size_t index,
                           SceneFindings& findings) {
  const auto& column = table.columns[index];
  const std::string si_unit = si_unit_of(wanted.key);
  const std::string of_scene = column.title.text == wanted.title ? "" : parse_title(wanted.title).unit;
  const std::string of_file = without_unit_suffix(column.title, si_unit).unit;
  if (!of_scene.empty() && !of_file.empty() && of_scene != of_file)
    wanted.table.refuse(wanted.name, "is in \"" + of_file + "\" by the file; write the title without a unit");
  if (!of_file.empty()) return of_file;
  if (!of_scene.empty()) return of_scene;
  findings.warnings.push_back(table.file.string() + ":" + std::to_string(table.layout.title_line) + ":" +
                              std::to_string(column.column) + ": " + column.title.text +
                              " has no unit and is taken in " + si_unit + "; if that is wrong, write \"" +
                              column.title.text + " [unit]\" in columns");
  return si_unit;
}

}  // namespace

LoadFileKeys read_load_file_keys(SceneTable& entry) {
  LoadFileKeys keys;
  keys.effect = entry.name("effect");
  keys.file = entry.text("file");
  keys.form = read_form(entry);
  keys.turns = one_of(entry, "turns", {"average", "as they are"});
  keys.has_columns = entry.is_given("columns");
  if (keys.has_columns) read_wanted(entry.table("columns"), "", keys.columns);
  entry.finish();
  return keys;
}

std::vector<ChosenColumn> columns_by_scene(SceneTable& entry, LoadFileKeys& keys, const OpenTable& table,
                                           SceneFindings& findings) {
  std::vector<ChosenColumn> chosen;
  std::optional<ChosenColumn> abscissa;
  const std::size_t n_errors = findings.errors.size();
  for (auto& wanted : keys.columns) {
    if (si_unit_of(wanted.key).empty()) {
      wanted.table.refuse(wanted.name,
                          "the key " + wanted.key + " " + not_a_load(wanted.key) + ", or time or angle");
      continue;
    }
    const auto index = find_column(wanted, table);
    if (!index) continue;
    ChosenColumn column{*index, wanted.key, unit_of_wanted(wanted, table, *index, findings)};
    const bool is_load = wanted.key != "time" && wanted.key != "angle";
    if (is_load)
      chosen.push_back(column);
    else if (abscissa)
      wanted.table.refuse(wanted.name, "time and angle are both given; leave out one");
    else
      abscissa = column;
  }
  for (std::size_t i = 0; i < table.columns.size() && !abscissa; ++i)
    for (const std::string key : {"time", "angle"})
      if (const auto title = without_unit_suffix(table.columns[i].title, si_unit_of(key)); title.name == key)
        abscissa = ChosenColumn{i, key, title.unit};
  if (findings.errors.size() > n_errors) return {};
  if (!abscissa)
    entry.refuse("columns",
                 "has neither time nor angle; add time = \"TITLE\", one of: " + titles_text(table));
  else if (chosen.empty())
    entry.refuse("columns", "has no load; add one such as \"pulley_seat.fx\" = \"TITLE\", one of: " +
                                titles_text(table));
  else
    chosen.insert(chosen.begin(), *abscissa);
  return abscissa && findings.errors.size() == n_errors ? chosen : std::vector<ChosenColumn>{};
}

std::vector<ChosenColumn> columns_by_title(const OpenTable& table) {
  std::vector<ChosenColumn> chosen;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const auto& title = table.columns[i].title;
    ChosenColumn column{i, title.name, title.unit};
    const auto line = title.text.rfind('_');
    const auto shorter = line == std::string::npos ? "" : title.text.substr(0, line);
    const auto si_unit = si_unit_of(shorter);
    if (si_unit_of(title.name).empty() && !si_unit.empty())
      if (const auto split = without_unit_suffix(title, si_unit); !split.unit.empty())
        column = {i, split.name, split.unit};
    chosen.push_back(column);
  }
  return chosen;
}

}  // namespace pipelines

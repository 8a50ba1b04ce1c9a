#include "tests/cases/program/field_tables.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <vector>

#include "tests/cases/program/program.h"

namespace cases {
namespace {

using Json = nlohmann::json;

/// A line of a table in the README.
struct FieldLine {
  std::vector<std::string> columns;  ///< titles in CSV with units; "share_*" stands for any name
  std::string key, people;
  bool is_optional;  ///< rows may be without it
};

struct Table {
  std::string file, place;  ///< CSV file; list in summary.json, such as bodies.<body>.zones
  std::vector<FieldLine> lines;
};

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Between back quotes.
std::vector<std::string> in_back_quotes(const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t at = text.find('`'); at != std::string::npos; at = text.find('`', at + 1)) {
    const auto end = text.find('`', at + 1);
    names.push_back(text.substr(at + 1, end - at - 1));
    at = end;
  }
  return names;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  std::string cell;
  std::getline(in, cell, '|');
  while (std::getline(in, cell, '|')) {
    cell.erase(0, cell.find_first_not_of(' '));
    cell.erase(cell.find_last_not_of(' ') + 1);
    cells.push_back(cell);
  }
  return cells;
}

/// As the page writes it.
std::string on_page(std::string title) {
  if (const auto at = title.find("mm3"); at != std::string::npos) title.replace(at, 3, "mm\u00b3");
  if (const auto at = title.find("+-"); at != std::string::npos) title.replace(at, 2, "\u00b1");
  return ">" + title + "</th>";
}

/// "sigma_xx ... sigma_xz" are the six components.
std::vector<std::string> titles_of(const std::string& columns, const std::string& unit) {
  auto names = in_back_quotes(columns);
  if (columns.find("...") != std::string::npos) {
    const auto prefix = names.front().substr(0, names.front().size() - 2);
    names.clear();
    for (const auto* component : {"xx", "yy", "zz", "xy", "yz", "xz"}) names.push_back(prefix + component);
  }
  for (auto& name : names) {
    if (const auto any = name.find("<name>"); any != std::string::npos) name.replace(any, 6, "*");
    if (!unit.empty()) name += " [" + unit + "]";
  }
  return names;
}

std::vector<Table> tables_of_readme() {
  std::istringstream in(text_of(fs::path(SOURCE_DIR) / "pipelines/base/fields/README.md"));
  std::vector<Table> tables;
  bool has_csv = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("### ", 0) == 0) {
      auto& table = tables.emplace_back();
      for (const auto& name : in_back_quotes(line))
        (name.size() > 4 && name.substr(name.size() - 4) == ".csv" ? table.file : table.place) = name;
    } else if (line.rfind("| ", 0) == 0 && !tables.empty()) {
      const auto cells = cells_of(line);
      if (cells[0] == "column" || cells[0] == "in `summary.json`") {
        has_csv = cells[0] == "column";
        continue;
      }
      const std::size_t first = has_csv ? 2 : 0;
      const auto key = in_back_quotes(cells.at(first));
      tables.back().lines.push_back({has_csv ? titles_of(cells[0], cells[1]) : std::vector<std::string>{},
                                     key.empty() ? "" : key[0], cells.at(first + 1),
                                     line.find("(where there is one)") != std::string::npos});
    }
  }
  return tables;
}

bool is_title_of(const std::string& pattern, const std::string& title) {
  const auto star = pattern.find('*');
  if (star == std::string::npos) return pattern == title;
  const auto begin = pattern.substr(0, star), end = pattern.substr(star + 1);
  return title.size() > begin.size() + end.size() && title.rfind(begin, 0) == 0 &&
         title.compare(title.size() - end.size(), end.size(), end) == 0;
}

void expect_columns(const Table& table, const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::vector<std::string> titles, patterns;
  std::istringstream header(line);
  for (std::string title; std::getline(header, title, ',');) titles.push_back(title);
  for (const auto& field : table.lines)
    patterns.insert(patterns.end(), field.columns.begin(), field.columns.end());
  for (const auto& title : titles)
    EXPECT_TRUE(
        std::any_of(patterns.begin(), patterns.end(), [&](const auto& p) { return is_title_of(p, title); }))
        << file << " has a column that no field declares: " << title;
  for (const auto& field : table.lines)
    for (const auto& pattern : field.columns)
      if (!field.is_optional && pattern.find('*') == std::string::npos) {
        EXPECT_EQ(std::count(titles.begin(), titles.end(), pattern), 1) << file << ": " << pattern;
      }
}

bool has_key(const Json& row, const std::string& key) {
  const Json* at = &row;
  std::istringstream in(key);
  for (std::string part; std::getline(in, part, '.');) {
    if (!at->contains(part)) return false;
    at = &at->at(part);
  }
  return true;
}

void expect_keys(const Table& table, const Json& rows) {
  for (const auto& row : rows)
    for (const auto& field : table.lines)
      if (!field.key.empty() && !field.is_optional) {
        EXPECT_TRUE(has_key(row, field.key)) << table.place << ": " << field.key;
      }
}

}  // namespace

std::set<std::string> expect_fields_of_readme(const fs::path& results) {
  std::set<std::string> found;
  const auto json = summary(results);
  const auto page = text_of(results / "report.html");
  for (const auto& table : tables_of_readme()) {
    if (table.file.empty()) continue;
    std::vector<fs::path> files{results / table.file};
    for (const auto& [body, figures] : json.at("bodies").items())
      files.push_back(results / body / table.file);
    for (const auto& file : files)
      if (fs::exists(file)) {
        found.insert(table.file);
        expect_columns(table, file);
        for (const auto& field : table.lines)
          if (!field.people.empty() && !field.is_optional) {
            EXPECT_NE(page.find(on_page(field.people)), std::string::npos)
                << table.file << ": " << field.people;
          }
      }
    const auto dot = table.place.rfind('.');
    const std::string of_body = "bodies.<body>.";
    if (table.place.rfind(of_body, 0) != 0 || dot == std::string::npos) continue;
    for (const auto& [name, body] : json.at("bodies").items()) {
      const Json* at = &body;
      std::istringstream in(table.place.substr(of_body.size()));
      for (std::string part; at != nullptr && std::getline(in, part, '.');)
        at = at->is_object() && at->contains(part) ? &at->at(part) : nullptr;
      if (at != nullptr && at->is_array()) expect_keys(table, *at);
    }
  }
  return found;
}

}  // namespace cases

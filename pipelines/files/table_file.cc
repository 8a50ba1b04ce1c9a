#include "pipelines/files/table_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>

#include "meshes/values/utf8.h"
#include "pipelines/common/errors.h"
#include "pipelines/files/replaceable.h"
#include "pipelines/files/whole_file.h"

namespace pipelines {
namespace {

constexpr std::size_t most_errors = 10;

struct Cell {
  std::string text;
  int column;  // of its first character, 1-based
};

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r"), end = text.find_last_not_of(" \t\r");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

char separator_of(const std::string& titles) {
  for (const char separator : {';', '\t'})
    if (titles.find(separator) != std::string::npos) return separator;
  return ',';
}

/// A quoted cell may hold the separator, and a quote as two quotes.
std::vector<Cell> cells_of(const std::string& line, char separator) {
  std::vector<Cell> cells{{"", 1}};
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      cells.back().text += line[++i];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == separator && !quoted)
      cells.push_back({"", int(i) + 2});
    else
      cells.back().text += line[i];
  }
  for (auto& cell : cells) cell.text = trimmed(cell.text);
  return cells;
}

class Reader {
public:
  explicit Reader(const std::filesystem::path& file) { table_.file = file; }

  TableFile read() {
    std::error_code none;  // a name of 300 characters is none of a file
    const auto status = std::filesystem::status(table_.file, none);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
      // a pipe without a writer would keep whoever opens it waiting for ever
      refuse(0, 0, "", "", "is no regular file, and a table is read more than once; write it into a file");
      throw SceneError(std::move(errors_));
    }
    if (const auto size = size_of_file(table_.file); size > most_bytes_of_a_table) {
      refuse(0, 0, "", "",
             "has " + size_text(size) + ", and a table has " + size_text(most_bytes_of_a_table) +
                 " at most; cut it to the turns that repeat, or write fewer samples");
      throw SceneError(std::move(errors_));
    }
    note_input(table_.file);
    std::ifstream in(table_.file, std::ios::binary);
    if (!std::filesystem::is_regular_file(status) || !in)
      refuse(0, 0, "", "", "cannot be read as a table; give the path of a CSV file, from the scene's folder");
    int number = 0;
    for (std::string line; errors_.size() < most_errors && std::getline(in, line);) {
      has_last_end_ = !in.eof();
      read_line(line, ++number);
    }
    if (errors_.empty() && table_.columns.empty())
      refuse(0, 0, "", "", "is empty; begin with a line of titles such as: time [s], pulley_seat.fx [N]");
    if (errors_.empty() && table_.lines.empty())
      refuse(0, 0, "", "", "has titles but no rows; add one row of numbers per sample");
    if (!errors_.empty()) throw SceneError(std::move(errors_));
    table_.doubt = doubt();
    return std::move(table_);
  }

private:
  /// What speaks for a file that is cut off, at its last row.
  std::string doubt() const {
    std::string reasons;
    const auto add = [&](const std::string& reason) {
      reasons += (reasons.empty() ? "" : ", and ") + reason;
    };
    if (!has_last_end_) add("it has no end of line");
    for (std::size_t c = 0; c < decimals_.size() && table_.n_rows() > 2; ++c)
      if (const auto& of = decimals_[c]; of.are_alike && of.last < of.others)
        add(table_.columns[c].name + " has " + std::to_string(of.last) + " digits behind the point, not " +
            std::to_string(of.others) + " as in all rows before");
    if (const auto step = odd_last_step(); !step.empty()) add(step);
    if (reasons.empty()) return "";
    return table_.file.string() + ":" + std::to_string(table_.lines.back()) + ": the last of " +
           std::to_string(table_.n_rows()) + " rows may be cut off: " + reasons +
           "; check that the file is whole";
  }

  /// Of a first column whose other steps are equal but for rounding.
  std::string odd_last_step() const {
    constexpr double rounding = 0.02, odd = 0.05;
    const auto& at = table_.columns.front().values;
    if (at.size() < 5) return "";
    const double usual = (at[at.size() - 2] - at.front()) / double(at.size() - 2);
    for (std::size_t i = 1; i + 1 < at.size(); ++i)
      if (!(std::abs(at[i] - at[i - 1] - usual) <= rounding * std::abs(usual))) return "";
    const double last = at.back() - at[at.size() - 2];
    if (std::abs(last - usual) <= odd * std::abs(usual)) return "";
    const auto rounded = [](double value) {
      char text[32];
      std::snprintf(text, sizeof text, "%.4g", value);
      return std::string(text);
    };
    return table_.columns.front().name + " goes on by " + rounded(last) + ", and by " + rounded(usual) +
           " in all rows before";
  }

  /// Digits behind the point, of the rows of a column.
  struct Decimals {
    int others = -1, last = -1;  ///< -1: no row yet
    bool are_alike = true;       ///< those of the others

    void take(const std::string& cell) {
      const auto point = cell.find('.');
      const auto end = std::min(cell.find_first_of("eE"), cell.size());
      if (last >= 0) are_alike = are_alike && (others < 0 || others == last);
      if (last >= 0) others = last;
      last = point == std::string::npos ? 0 : int(end - point) - 1;
    }
  };

  void refuse(int line, int column, const std::string& key, const std::string& value,
              const std::string& remedy) {
    errors_.push_back({table_.file.string(), line, column, key, value, remedy});
  }

  void read_line(std::string line, int number) {
    if (number == 1 && line.rfind("\xef\xbb\xbf", 0) == 0) line.erase(0, 3);
    const std::string content = trimmed(line);
    if (content.empty() || content[0] == '#') return;
    if (table_.columns.empty())
      read_titles(line, number);
    else
      read_row(line, number);
  }

  void read_titles(const std::string& line, int number) {
    table_.title_line = number;
    if (!meshes::is_utf8(line)) {
      refuse(number, 1, "", "", "the titles are not written in UTF-8, as results are; save the file so");
      throw SceneError(std::move(errors_));
    }
    separator_ = separator_of(line);
    std::set<std::string> names;
    for (const auto& cell : cells_of(line, separator_)) {
      const auto open = cell.text.find('[');
      TableColumn column;
      column.name = trimmed(cell.text.substr(0, open));
      column.column = cell.column;
      if (open != std::string::npos) {
        const auto close = cell.text.find(']', open);
        column.unit = trimmed(cell.text.substr(open + 1, close - open - 1));
        if (close == std::string::npos)
          refuse(number, cell.column, column.name, cell.text,
                 "the unit's bracket is not closed; write \"name [unit]\"");
      }
      if (errors_.size() >= most_errors) return;
      if (column.name.empty())
        refuse(number, cell.column, "", cell.text, "the column has no name; write \"name [unit]\"");
      else if (!names.insert(column.name).second)
        refuse(number, cell.column, column.name, cell.text,
               "names a second column so; rename one of the two");
      table_.columns.push_back(std::move(column));
    }
  }

  void read_row(const std::string& line, int number) {
    const auto cells = cells_of(line, separator_);
    if (cells.size() != table_.columns.size())
      return refuse(number, 1, "", trimmed(line),
                    "has " + std::to_string(cells.size()) + " cells where the titles name " +
                        std::to_string(table_.columns.size()) + " columns; give one number per column");
    table_.lines.push_back(number);
    decimals_.resize(cells.size());
    for (std::size_t c = 0; c < cells.size() && errors_.size() < most_errors; ++c) {
      double value = 0;
      const std::string& text = cells[c].text;
      const char* const begin = text.c_str() + (text[0] == '+' && text[1] != '-' ? 1 : 0);
      const char* const end = text.c_str() + text.size();
      const auto [stop, error] = std::from_chars(begin, end, value);
      if (error != std::errc() || stop != end || !std::isfinite(value))
        refuse(number, cells[c].column, table_.columns[c].name, text,
               "is not a finite number with a decimal point; correct the cell");
      table_.columns[c].values.push_back(value);
      decimals_[c].take(text);
    }
  }

  TableFile table_;
  std::vector<Decimals> decimals_;  ///< of each column
  bool has_last_end_ = true;        ///< the last line ends with a line feed
  std::vector<SceneFinding> errors_;
  char separator_ = ',';
};

}  // namespace

TableFile read_table_file(const std::filesystem::path& file) {
  return Reader(file).read();
}

}  // namespace pipelines

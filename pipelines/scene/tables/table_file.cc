#include "pipelines/scene/tables/table_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/files/replaceable.h"
#include "pipelines/base/files/text_encoding.h"
#include "pipelines/base/files/whole_file.h"
#include "pipelines/base/names/odd_characters.h"

namespace pipelines {
namespace {

constexpr std::size_t most_errors = 10;

[[noreturn]] void refuse_table(const std::filesystem::path& file, const std::string& remedy) {
  throw SceneError({{file.string(), 0, 0, "", "", remedy}});
}

std::string bytes_of_table(const std::filesystem::path& file) {
  std::error_code none;  // a name of 300 characters is none of a file
  const auto status = std::filesystem::status(file, none);
  // a pipe without a writer would keep whoever opens it waiting for ever
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    refuse_table(file, "is no regular file, and a table is read more than once; write it into a file");
  if (const auto size = size_of_file(file); size > most_bytes_of_a_table)
    refuse_table(file, "has " + size_text(size) + ", and a table has " + size_text(most_bytes_of_a_table) +
                           " at most; cut it to the turns that repeat, or write fewer samples");
  note_input(file);
  auto bytes = whole_file(file, most_bytes_of_a_table);
  if (!bytes)
    refuse_table(file, "cannot be read as a table; give the path of a CSV file, from the scene's folder");
  return *std::move(bytes);
}

TableColumn column_of(const TableLayout& layout, std::size_t i) {
  TableColumn column;
  column.title = parse_title(layout.titles[i].text);
  const std::string below =
      i < layout.units.size() ? unit_as_we_spell_it(layout.units[i].text) : std::string();
  auto& title = column.title;
  if (!below.empty() && !title.is_in_brackets && title.unit != below) {
    title.name = title.text;  // what looked like a unit is a part of the name
    title.unit = below;
  }
  column.name = title.name;
  column.unit = title.unit;
  column.column = layout.titles[i].column;
  if (!below.empty() && title.unit != below)
    title.fault = "has the unit \"" + title.unit + "\" in its title and \"" + below + "\" in line " +
                  std::to_string(layout.unit_line) + "; remove one";
  return column;
}

/// The number of columns; a delimiter at the end of each line begins none.
std::size_t count_columns(const std::string& text, const TableLayout& layout) {
  const std::size_t n = layout.titles.size();
  if (n < 2 || !layout.titles.back().text.empty()) return n;
  TableLines lines(text);
  for (TableLine line; lines.next(line);)
    if (line.number >= layout.first_row) {
      const auto cells = cells_of(line.text, layout.delimiter);
      return cells.size() < n || cells[n - 1].text.empty() ? n - 1 : n;
    }
  return n;
}

std::string delimiter_text(char delimiter) {
  return delimiter == '\t'             ? "tabs"
         : delimiter == runs_of_blanks ? "blanks"
                                       : std::string("'") + delimiter + "'";
}

using Kind = CellNumber::Kind;

std::string remedy_of(const CellNumber& number, const std::string& cell) {
  switch (number.kind) {
    case Kind::thousands:
      return "has separators of thousands, or a decimal point and a comma; export the numbers without "
             "separators of thousands";
    case Kind::other_comma:
      return "has a decimal comma where a point is wanted; export with decimal points, or with ';' or tabs "
             "between the columns, or set decimal = \",\" for the file";
    case Kind::other_point:
      return "has a decimal point, and decimal = \",\" is set for the file; correct one of the two";
    case Kind::time_of_day:
      return "is a time of day, and a column of numbers is wanted; export seconds from the beginning";
    case Kind::odd_character: {
      const auto odd = odd_character_in(cell);
      return "is no number: it has " + odd->name + "; " + odd->remedy;
    }
    case Kind::empty:
      return "the cell is empty, and a finite number is wanted; fill it, or leave out the row";
    default:
      return "is not a finite number with a decimal point; correct the cell";
  }
}

class Reader {
public:
  Reader(const OpenTable& open, const std::vector<std::size_t>& chosen, Titles titles)
      : open_(open), chosen_(chosen), titles_(titles) {
    table_.file = open.file;
    table_.title_line = open.layout.title_line;
    const bool has_commas_between = open.layout.delimiter == ',';
    decimal_ = open.form.decimal != 0 ? open.form.decimal : has_commas_between ? '.' : '\0';
    for (const auto index : chosen) table_.columns.push_back(open.columns[index]);
    decimals_.resize(chosen.size());
  }

  TableFile read() {
    check_titles();
    TableLines lines(*open_.text);
    for (TableLine line; lines.next(line);)
      if (line.number >= open_.layout.first_row)
        read_row(line);
      else if (line.number > open_.layout.title_line && line.number != open_.layout.unit_line)
        ++n_passed_over_;
    has_last_end_ = lines.has_last_end();
    if (faults_.empty() && table_.lines.empty())
      refuse(0, 0, "", "", "has titles but no rows; add one row of numbers per sample");
    if (faults_.empty()) check_decimals();
    if (!faults_.empty()) throw SceneError(findings());
    table_.doubt = doubt();
    table_.form = form();
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

  /// What is odd about the last step of a first column whose other steps are equal but for rounding; empty:
  /// nothing.
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
    bool are_alike = true;       ///< whether the digits of the other rows are alike

    void take(const std::string& cell) {
      const auto point = cell.find_first_of(".,");
      const auto end = std::min(cell.find_first_of("eE"), cell.size());
      if (last >= 0) are_alike = are_alike && (others < 0 || others == last);
      if (last >= 0) others = last;
      last = point == std::string::npos ? 0 : int(end - point) - 1;
    }
  };

  /// One kind of fault in one column, at the first of its places.
  struct Fault {
    SceneFinding first;
    int kind = 0;            ///< the cell's kind; -1: the fault is the row's; -2: counts alone
    std::size_t column = 0;  ///< index among the chosen columns
    std::size_t n = 1;
    int last_line = 0;
  };

  void refuse(int line, int column, const std::string& key, const std::string& value,
              const std::string& remedy) {
    if (faults_.size() < most_errors)
      faults_.push_back({{table_.file.string(), line, column, key, value, remedy}, -2, 0, 1, line});
  }

  /// False where a fault of that kind was there before: it is counted.
  bool is_first(int kind, std::size_t column, int line) {
    const auto same = [&](const Fault& fault) { return fault.kind == kind && fault.column == column; };
    const auto found = std::find_if(faults_.begin(), faults_.end(), same);
    if (found == faults_.end()) return faults_.size() < most_errors;
    ++found->n;
    found->last_line = line;
    return false;
  }

  std::vector<SceneFinding> findings() const {
    std::vector<SceneFinding> all;
    for (const auto& fault : faults_) {
      all.push_back(fault.first);
      if (fault.n > 1)
        all.back().remedy += " (the first of " + std::to_string(fault.n) +
                             (fault.kind == -1 ? " such rows" : " such cells of this column") + ", to line " +
                             std::to_string(fault.last_line) + ")";
    }
    return all;
  }

  void check_titles() {
    const int line = table_.title_line;
    std::set<std::string> names;
    for (const auto& column : table_.columns) {
      const auto& title = column.title;
      if (!title.fault.empty()) refuse(line, column.column, column.name, title.text, title.fault);
      if (titles_ == Titles::are_chosen) continue;
      if (column.name.empty())
        refuse(line, column.column, "", title.text, "the column has no name; write \"name [unit]\"");
      else if (!names.insert(column.name).second)
        refuse(line, column.column, column.name, title.text,
               "names a second column so; rename one of the two");
    }
  }

  void read_row(const TableLine& line) {
    const auto cells = cells_of(line.text, open_.layout.delimiter);
    const auto& titles = open_.layout.titles;
    if (!agree_in_number(titles, cells)) return refuse_row(line, cells);
    table_.lines.push_back(line.number);
    for (std::size_t c = 0; c < chosen_.size(); ++c) {
      const bool is_there = chosen_[c] < cells.size();
      const std::string none, &text = is_there ? cells[chosen_[c]].text : none;
      const auto number = number_of(text, decimal_);
      if (!number.is_number())
        refuse_cell(line.number, is_there ? cells[chosen_[c]].column : 1, c, text, number);
      table_.columns[c].values.push_back(number.value);
      decimals_[c].take(text);
      note_decimal(number.kind, c, line.number, is_there ? cells[chosen_[c]] : Cell{});
    }
  }

  void refuse_row(const TableLine& line, const std::vector<Cell>& cells) {
    if (!is_first(-1, 0, line.number)) return;
    const std::size_t n = open_.layout.titles.size();
    const bool may_be_decimal = open_.layout.delimiter == ',' && cells.size() > n;
    faults_.push_back(
        {{table_.file.string(), line.number, 1, "", without_blanks(std::string(line.text)),
          "has " + std::to_string(cells.size()) + (cells.size() == 1 ? " cell" : " cells") +
              " where the titles name " + std::to_string(n) + " columns; give one number per column" +
              (may_be_decimal ? ", and where commas are decimal commas export with ';' or tabs "
                                "between the columns: commas cannot be both"
                              : "")},
         -1,
         0,
         1,
         line.number});
  }

  void refuse_cell(int line, int at, std::size_t c, const std::string& text, const CellNumber& number) {
    if (!is_first(int(number.kind), c, line)) return;
    faults_.push_back(
        {{table_.file.string(), line, at, table_.columns[c].name, text, remedy_of(number, text)},
         int(number.kind),
         c,
         1,
         line});
  }

  void note_decimal(Kind kind, std::size_t c, int line, const Cell& cell) {
    if (kind > Kind::comma_in_doubt) return;
    auto& seen = seen_[std::size_t(kind)];
    if (seen.n++ == 0)
      seen.first = {table_.file.string(), line, cell.column, table_.columns[c].name, cell.text, ""};
  }

  /// Points and commas in one file, or commas that may stand between thousands: nobody can tell.
  void check_decimals() {
    const auto of = [&](Kind kind) -> const Seen& { return seen_[std::size_t(kind)]; };
    const auto& point = of(Kind::with_point);
    const auto& comma = of(of(Kind::with_comma).n > 0 ? Kind::with_comma : Kind::comma_in_doubt);
    if (decimal_ != 0 || comma.n == 0) return;
    has_decimal_comma_ = true;
    const auto tell = [&](const Seen& seen, const std::string& remedy) {
      refuse(seen.first.line, seen.first.column, seen.first.key, seen.first.value, remedy);
    };
    if (point.n > 0)
      tell(point, "has a point, and " + std::to_string(comma.n) + " cells such as \"" + comma.first.value +
                      "\" in line " + std::to_string(comma.first.line) +
                      " have a comma: one of them may separate thousands; export all numbers with the same "
                      "decimal sign and without separators of thousands");
    else if (of(Kind::with_comma).n == 0)
      tell(comma,
           "may have a decimal comma or a comma between thousands, as all commas of the file; set "
           "decimal = \",\" for the file, or export without separators of thousands");
  }

  std::string form() const {
    const auto& layout = open_.layout;
    const bool has_comma = has_decimal_comma_ || decimal_ == ',';
    return delimiter_text(layout.delimiter) + (has_comma ? " with decimal comma" : " with decimal point") +
           (open_.encoding == "UTF-8" ? "" : ", " + open_.encoding) +
           (layout.title_line > 1 ? ", titles in row " + std::to_string(layout.title_line) : "") +
           (layout.unit_line > 0 ? ", units in row " + std::to_string(layout.unit_line) : "") +
           (n_passed_over_ > 0
                ? ", " + std::to_string(n_passed_over_) + (n_passed_over_ == 1 ? " line" : " lines") +
                      " below the titles passed over"
                : "");
  }

  struct Seen {
    std::size_t n = 0;
    SceneFinding first;
  };

  const OpenTable& open_;
  const std::vector<std::size_t>& chosen_;
  const Titles titles_;
  TableFile table_;
  std::vector<Decimals> decimals_;  ///< digits behind the point in each column
  bool has_last_end_ = true;        ///< the last line ends with a line feed
  bool has_decimal_comma_ = false;
  int n_passed_over_ = 0;  ///< lines between titles and rows that are neither
  std::vector<Fault> faults_;
  char decimal_ = '.';  ///< 0: to be found
  std::array<Seen, std::size_t(Kind::comma_in_doubt) + 1> seen_;
};

}  // namespace

OpenTable open_table(const std::filesystem::path& file, const TableForm& form,
                     const std::vector<std::string>& wanted) {
  auto decoded = decode_text(bytes_of_table(file));
  if (!decoded.refusal.empty()) refuse_table(file, decoded.refusal);
  OpenTable table;
  table.file = file;
  table.encoding = decoded.encoding;
  table.text = std::make_shared<const std::string>(std::move(decoded.text));
  table.form = form;
  table.layout = find_layout(*table.text, form, wanted);
  if (table.layout.title_line == 0)
    refuse_table(file, "is empty; begin with a line of titles such as: time [s], pulley_seat.fx [N]");
  const auto is_number = [](const Cell& cell) { return number_of(cell.text, '\0').is_number(); };
  const auto& titles = table.layout.titles;
  if (std::all_of(titles.begin(), titles.end(), is_number))
    throw SceneError({{file.string(), table.layout.title_line, 1, "", "",
                       "has numbers where titles are wanted; write a line of titles above them"}});
  const std::size_t n = count_columns(*table.text, table.layout);
  for (std::size_t i = 0; i < n; ++i) table.columns.push_back(column_of(table.layout, i));
  return table;
}

TableFile read_columns(const OpenTable& table, const std::vector<std::size_t>& chosen, Titles titles) {
  return Reader(table, chosen, titles).read();
}

TableFile read_table_file(const std::filesystem::path& file) {
  const auto table = open_table(file);
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < table.columns.size(); ++i) all.push_back(i);
  return read_columns(table, all);
}

}  // namespace pipelines

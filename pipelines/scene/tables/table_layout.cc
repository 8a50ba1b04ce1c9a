#include "pipelines/scene/tables/table_layout.h"

#include <algorithm>
#include <optional>

#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/units.h"
#include "pipelines/scene/tables/table_title.h"

namespace pipelines {
namespace {

constexpr std::size_t lines_looked_at = 400;  // headers of loggers have a few dozen

std::vector<TableLine> first_lines(std::string_view text, int skipped) {
  std::vector<TableLine> lines;
  TableLines walk(text);
  for (TableLine line; lines.size() < lines_looked_at && walk.next(line);)
    if (line.number > skipped) lines.push_back(line);
  return lines;
}

/// The delimiter that a line "sep=;" names, for Excel; 0: it is none.
char told_delimiter(std::string_view line) {
  while (!line.empty() && (line.back() == '\r' || line.back() == '"')) line.remove_suffix(1);
  if (!line.empty() && line.front() == '"') line.remove_prefix(1);
  const bool is_one = line.size() == 5 && (line.substr(0, 4) == "sep=" || line.substr(0, 4) == "SEP=");
  return is_one ? line[4] : '\0';
}

/// A stretch of lines with numbers in cells of the same count.
struct Stretch {
  std::size_t begin = 0, n_cells = 0;
  std::size_t n_numbers = 0;  ///< in all its lines
};

std::size_t count_numbers(const std::vector<Cell>& cells) {
  return std::size_t(std::count_if(cells.begin(), cells.end(), [&](const Cell& cell) {
    const auto number = number_of(cell.text, '\0');
    return number.is_number() || number.kind == CellNumber::Kind::not_finite;
  }));
}

Stretch longest_stretch(const std::vector<TableLine>& lines, char delimiter) {
  std::vector<std::size_t> n_cells, n_numbers;
  for (const auto& line : lines) {
    const auto cells = cells_of(line.text, delimiter);
    n_cells.push_back(cells.size());
    n_numbers.push_back(cells.size() < 2 ? 0 : count_numbers(cells));
  }
  Stretch best;
  for (std::size_t begin = 0, end = 0; begin < lines.size(); begin = std::max(end, begin + 1)) {
    for (end = begin; end < lines.size() && n_numbers[end] > 0 && n_cells[end] == n_cells[begin];) ++end;
    // A line of units or of titles with a number in it is no row.
    while (end > begin + 1 && 2 * n_numbers[begin] < n_numbers[begin + 1]) ++begin;
    Stretch stretch{begin, n_cells[begin], 0};
    for (std::size_t i = begin; i < end; ++i) stretch.n_numbers += n_numbers[i];
    if (stretch.n_numbers > best.n_numbers) best = stretch;
  }
  return best;
}

/// Whether half of what stands in the cells are units.
bool are_units(const std::vector<Cell>& cells) {
  std::size_t n_filled = 0, n_units = 0;
  for (const auto& cell : cells) {
    if (cell.text.empty()) continue;
    const bool is_in_brackets = cell.text.front() == '[' && cell.text.back() == ']';
    const auto unit = unit_as_we_spell_it(cell.text);
    ++n_filled;
    n_units += is_in_brackets || unit.empty() || is_unit(unit) ? 1 : 0;
  }
  return n_filled > 0 && 2 * n_units >= n_filled;
}

std::vector<Cell> titles_of(const TableLine& line, char delimiter, std::size_t n_cells) {
  return delimiter == runs_of_blanks ? titles_between_blanks(line.text, n_cells)
                                     : cells_of(line.text, delimiter);
}

std::size_t count_wanted(const std::vector<Cell>& titles, const std::vector<std::string>& wanted) {
  return std::size_t(std::count_if(titles.begin(), titles.end(), [&](const Cell& cell) {
    return contains(wanted, cell.text) || contains(wanted, parse_title(cell.text).name);
  }));
}

struct Above {
  std::size_t line;  ///< index
  std::vector<Cell> cells;
};

/// Lines right above the rows that have as many cells, upwards.
std::vector<Above> lines_above(const std::vector<TableLine>& lines, const Stretch& rows, char delimiter) {
  constexpr std::size_t most = 10;
  const std::vector<Cell> cells_of_row(rows.n_cells, Cell{"0"});
  std::vector<Above> above;
  for (std::size_t i = rows.begin; i > 0 && above.size() < most; --i) {
    auto cells = titles_of(lines[i - 1], delimiter, rows.n_cells);
    if (!agree_in_number(cells, cells_of_row)) break;
    above.push_back({i - 1, std::move(cells)});
  }
  return above;
}

/// Which of the lines above the rows has the titles.
std::size_t title_among(const std::vector<Above>& above, const std::vector<std::string>& wanted) {
  std::size_t best = 0, most = 0;
  for (std::size_t k = 0; k < above.size(); ++k)
    if (const auto n = count_wanted(above[k].cells, wanted); n > most) {
      best = k;
      most = n;
    }
  if (most > 0) return best;
  return above.size() > 1 && are_units(above.front().cells) ? 1 : 0;
}

std::optional<TableLayout> layout_with(const std::vector<TableLine>& lines, char delimiter,
                                       const std::vector<std::string>& wanted) {
  const auto rows = longest_stretch(lines, delimiter);
  if (rows.n_numbers == 0) return std::nullopt;
  auto above = lines_above(lines, rows, delimiter);
  if (above.empty()) return std::nullopt;
  const auto k = title_among(above, wanted);
  TableLayout layout;
  layout.delimiter = delimiter;
  layout.title_line = lines[above[k].line].number;
  layout.titles = above[k].cells;
  for (std::size_t below = k; below > 0; --below)
    if (layout.unit_line == 0 && are_units(above[below - 1].cells)) {
      layout.unit_line = lines[above[below - 1].line].number;
      layout.units = above[below - 1].cells;
    }
  const int last_title = std::max(layout.title_line, layout.unit_line);
  const auto is_row = [&](const TableLine& line) {
    return line.number > last_title && count_numbers(cells_of(line.text, delimiter)) > 0;
  };
  layout.first_row = std::find_if(lines.begin(), lines.end(), is_row)->number;  // the stretch of rows has one
  return layout;
}

char separator_of(std::string_view titles) {
  for (const char separator : {';', '\t'})
    if (titles.find(separator) != std::string_view::npos) return separator;
  return ',';
}

/// The titles stand in the first line, a line of units perhaps below.
TableLayout layout_of_first_line(const std::vector<TableLine>& lines, char delimiter) {
  TableLayout layout;
  if (lines.empty()) return layout;
  layout.delimiter = delimiter != 0 ? delimiter : separator_of(lines[0].text);
  layout.title_line = lines[0].number;
  const auto second = lines.size() > 1 ? cells_of(lines[1].text, layout.delimiter) : std::vector<Cell>{};
  layout.titles = titles_of(lines[0], layout.delimiter, second.size());
  const bool may_have_units = lines.size() > 2 && agree_in_number(layout.titles, second) && are_units(second);
  if (may_have_units && 2 * count_numbers(second) < second.size() &&
      count_numbers(cells_of(lines[2].text, layout.delimiter)) > 0) {
    layout.unit_line = lines[1].number;
    layout.units = second;
  }
  layout.first_row = std::max(layout.title_line, layout.unit_line) + 1;
  return layout;
}

}  // namespace

TableLines::TableLines(std::string_view text)
    : rest_(text), end_(text.find('\n') == std::string_view::npos ? '\r' : '\n') {}

bool TableLines::next(TableLine& line) {
  while (!rest_.empty()) {
    const auto end = rest_.find(end_);
    has_last_end_ = end != std::string_view::npos;
    line = {++number_, rest_.substr(0, end)};
    rest_.remove_prefix(has_last_end_ ? end + 1 : rest_.size());
    const auto first = line.text.find_first_not_of(" \t\r");
    if (first != std::string_view::npos && line.text[first] != '#') return true;
  }
  return false;
}

TableLayout find_layout(std::string_view text, const TableForm& form,
                        const std::vector<std::string>& wanted) {
  auto lines = first_lines(text, std::max(0, form.skip_rows));
  char delimiter = form.delimiter;
  if (const char told = lines.empty() ? '\0' : told_delimiter(lines[0].text); told != 0) {
    if (delimiter == 0) delimiter = told;
    lines.erase(lines.begin());
  }
  if (form.skip_rows >= 0 && delimiter != 0) return layout_of_first_line(lines, delimiter);
  const std::vector<char> all{';', '\t', ',', runs_of_blanks};
  std::optional<TableLayout> found;
  for (const char one : delimiter != 0 ? std::vector<char>{delimiter} : all)
    if (!found) found = layout_with(lines, one, wanted);
  if (form.skip_rows >= 0) return layout_of_first_line(lines, found ? found->delimiter : '\0');
  return found ? *found : layout_of_first_line(lines, delimiter);
}

bool agree_in_number(const std::vector<Cell>& titles, const std::vector<Cell>& cells) {
  if (titles.size() == cells.size()) return true;
  const auto& longer = titles.size() > cells.size() ? titles : cells;
  return longer.size() == std::min(titles.size(), cells.size()) + 1 && longer.back().text.empty();
}

}  // namespace pipelines

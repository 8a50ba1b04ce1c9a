#include "pipelines/base/files/csv.h"

#include <algorithm>
#include <charconv>
#include <deque>
#include <fstream>
#include <future>
#include <stdexcept>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/disk/open_directory.h"
#include "pipelines/base/files/atomic_file.h"

namespace pipelines {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

void add_cell(std::string& text, double value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof(digits), value).ptr);
}
void add_cell(std::string& text, std::int64_t value) {
  text += std::to_string(value);
}
void add_cell(std::string& text, const std::string& value) {
  text += quoted(value);
}

std::size_t n_rows(const CsvColumn& column) {
  return std::visit([](const auto& cells) { return cells.size(); }, column.cells);
}

std::string titles(const std::vector<CsvColumn>& columns) {
  std::string text;
  for (const auto& column : columns) {
    if (n_rows(column) != n_rows(columns.front()))
      throw std::invalid_argument("column \"" + column.name + "\" has " + std::to_string(n_rows(column)) +
                                  " rows, \"" + columns.front().name + "\" has " +
                                  std::to_string(n_rows(columns.front())));
    if (&column != &columns.front()) text += ',';
    text += quoted(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]");
  }
  return text + '\n';
}

/// Rows from `begin` to `end`, not included.
std::string rows_text(const std::vector<CsvColumn>& columns, std::size_t begin, std::size_t end) {
  std::string text;
  for (std::size_t row = begin; row < end; ++row) {
    for (const auto& column : columns) {
      if (&column != &columns.front()) text += ',';
      std::visit([&](const auto& cells) { add_cell(text, cells[row]); }, column.cells);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}

void write_csv(const std::filesystem::path& path, const std::vector<CsvColumn>& columns, int n_threads) {
  constexpr std::size_t rows_at_once = 1000;
  AtomicFile file(path);
  std::ofstream out(file.temporary(), std::ios::binary);
  out << titles(columns);
  const std::size_t n = columns.empty() ? 0 : n_rows(columns.front());
  std::deque<std::future<std::string>> parts;  // in the order of the rows
  const auto write_part = [&] {
    out << parts.front().get();
    parts.pop_front();
  };
  for (std::size_t begin = 0; begin < n; begin += rows_at_once) {
    if (parts.size() == std::size_t(std::max(1, n_threads))) write_part();
    const auto policy = n_threads > 1 ? std::launch::async : std::launch::deferred;
    parts.push_back(std::async(policy, [&columns, begin, end = std::min(n, begin + rows_at_once)] {
      return rows_text(columns, begin, end);
    }));
  }
  while (!parts.empty()) write_part();
  out.close();
  if (!out) throw FileError(shown(path) + ": cannot be written; check the directory and the free space");
  file.commit();
}

}  // namespace pipelines

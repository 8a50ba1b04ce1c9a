#include "pipelines/files/csv.h"

#include <charconv>
#include <stdexcept>

#include "pipelines/files/atomic_file.h"

namespace pipelines {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::string cell(double value) {
  return shortest(value);
}
std::string cell(std::int64_t value) {
  return std::to_string(value);
}
std::string cell(const std::string& value) {
  return quoted(value);
}

std::size_t n_rows(const CsvColumn& column) {
  return std::visit([](const auto& cells) { return cells.size(); }, column.cells);
}

}  // namespace

std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}

std::string to_csv(const std::vector<CsvColumn>& columns) {
  std::string text;
  for (const auto& column : columns) {
    if (n_rows(column) != n_rows(columns.front()))
      throw std::invalid_argument("column \"" + column.name + "\" has " + std::to_string(n_rows(column)) +
                                  " rows, \"" + columns.front().name + "\" has " +
                                  std::to_string(n_rows(columns.front())));
    if (&column != &columns.front()) text += ',';
    text += quoted(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]");
  }
  text += '\n';
  for (std::size_t row = 0; !columns.empty() && row < n_rows(columns.front()); ++row) {
    for (const auto& column : columns) {
      if (&column != &columns.front()) text += ',';
      text += std::visit([row](const auto& cells) { return cell(cells[row]); }, column.cells);
    }
    text += '\n';
  }
  return text;
}

void write_csv(const std::filesystem::path& path, const std::vector<CsvColumn>& columns) {
  write_text_file(path, to_csv(columns));
}

}  // namespace pipelines

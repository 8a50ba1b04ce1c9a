#include "pipelines/study/sweep/sweep_journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/disk/open_directory.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/content_hash.h"
#include "pipelines/base/files/whole_file.h"

namespace pipelines {
namespace {

using JournalJson = nlohmann::ordered_json;

constexpr std::size_t digits_of_hash = 32, digits_of_value = 11, bits_of_digit = 6;

constexpr std::string_view base_64_digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

void append_bits(std::string& text, double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  for (std::size_t i = digits_of_value; i-- > 0;) text += base_64_digits[(bits >> (bits_of_digit * i)) & 63];
}

/// The value of each character as a digit.
std::array<std::uint8_t, 256> digit_values() {
  std::array<std::uint8_t, 256> values{};
  for (std::size_t d = 0; d < base_64_digits.size(); ++d)
    values[std::uint8_t(base_64_digits[d])] = std::uint8_t(d);
  return values;
}

double value_of_bits(std::string_view text) {
  static const auto values = digit_values();
  std::uint64_t bits = 0;
  for (const char c : text) bits = (bits << bits_of_digit) | values[std::uint8_t(c)];
  double value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// What a zone's numbers are, in the order of the journal.
template <typename Zone>
auto numbers_of(Zone& z) {
  return std::array{&z.peak_Pa,   &z.error_Pa,  &z.safety,   &z.peak_m[0], &z.peak_m[1],
                    &z.peak_m[2], &z.low_m[0],  &z.low_m[1], &z.low_m[2],  &z.high_m[0],
                    &z.high_m[1], &z.high_m[2], &z.volume_m3};
}

JournalJson zone_json(const SweptZone& zone) {
  std::string bits;
  for (const double* number : numbers_of(zone)) append_bits(bits, *number);
  return {zone.body, zone.feature, zone.place, zone.instant, zone.n_nodes, bits};
}

SweptZone zone_of(const JournalJson& json) {
  SweptZone zone;
  zone.body = json.at(0);
  zone.feature = json.at(1);
  zone.place = json.at(2);
  zone.instant = json.at(3);
  zone.n_nodes = json.at(4);
  std::string_view bits = json.at(5).get_ref<const std::string&>();
  for (double* number : numbers_of(zone)) {
    *number = value_of_bits(bits.substr(0, digits_of_value));
    bits.remove_prefix(digits_of_value);
  }
  return zone;
}

std::string line_of(const std::string& text) {
  return text_hash(text) + ' ' + text + '\n';
}

/// The text of a line whose checksum is right; empty of any other.
std::string_view checked(std::string_view line) {
  if (line.size() <= digits_of_hash + 1 || line[digits_of_hash] != ' ') return {};
  const auto text = line.substr(digits_of_hash + 1);
  return line.substr(0, digits_of_hash) == text_hash(text) ? text : std::string_view();
}

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const auto n = ::write(file, text.data(), text.size());
    if (n <= 0) return false;
    text.remove_prefix(std::size_t(n));
  }
  return true;
}

/// A line "N VALUES [SETTINGS, TEXTS]", or "N VALUES [SETTINGS, TEXTS, ZONES]".
struct RowLine {
  std::size_t columns = 0;
  std::string_view values;
  std::vector<std::string> settings, texts;
  std::vector<SweptZone> zones;
};

/// The parts of a row's line; none of any other line.
std::optional<RowLine> row_line(std::string_view text) {
  RowLine line;
  const auto end = text.data() + text.size();
  const auto [number_end, error] = std::from_chars(text.data(), end, line.columns);
  if (error != std::errc() || number_end == end || *number_end != ' ') return std::nullopt;
  text.remove_prefix(std::size_t(number_end - text.data()) + 1);
  const auto space = text.find(' ');
  if (space == std::string_view::npos) return std::nullopt;
  line.values = text.substr(0, space);
  const auto json = JournalJson::parse(text.substr(space + 1), nullptr, false);
  if (!json.is_array() || json.size() < 2) return std::nullopt;
  line.settings = json[0].get<std::vector<std::string>>();
  line.texts = json[1].get<std::vector<std::string>>();
  if (json.size() > 2)
    for (const auto& zone : json[2]) line.zones.push_back(zone_of(zone));
  return line;
}

}  // namespace

bool SweepJournal::Columns::are_of(const SweepRow& row) const {
  const auto is_figure = [](const auto& column, const SweepFigures::Item& figure) {
    return column.first == figure.name && column.second == figure.unit;
  };
  const auto is_text = [](const std::string& column, const auto& text) { return column == text.first; };
  const bool has_figures =
      latest.share_names(row.figures) ||
      std::equal(figures.begin(), figures.end(), row.figures.begin(), row.figures.end(), is_figure);
  return has_figures && std::equal(texts.begin(), texts.end(), row.texts.begin(), row.texts.end(), is_text);
}

SweepJournal::SweepJournal(std::filesystem::path file, std::string key)
    : file_(std::move(file)), key_(text_hash(key)) {}

bool SweepJournal::is_journal(const std::filesystem::path& file) {
  return checked(first_line(file)).size() == digits_of_hash;
}

std::vector<std::optional<SweepRow>> SweepJournal::known(const SweepPlan& plan) const {
  std::ifstream in(file_, std::ios::binary);
  std::string line;
  if (checked(first_line(file_)) != key_ || size_of_file(file_) > most_bytes_of_a_result ||
      !std::getline(in, line))
    return std::vector<std::optional<SweepRow>>(plan.points.size());
  return read_rows(in, plan);
}

std::string SweepJournal::lines_of(const SweepPlan& plan, const std::vector<std::size_t>& points,
                                   const std::vector<SweepRow>& rows) {
  SweepJournal lines("", "");
  for (const auto p : points)
    if (rows[p].refused.empty())
      lines.append(plan.points[p], rows[p]);
    else
      lines.pending_ += line_of('!' + JournalJson::array({plan.points[p].settings, rows[p].refused})
                                          .dump(-1, ' ', false, JournalJson::error_handler_t::replace));
  return std::move(lines.pending_);
}

std::vector<std::optional<SweepRow>> SweepJournal::rows_of(const std::string& lines, const SweepPlan& plan) {
  std::istringstream in(lines);
  return read_rows(in, plan);
}

std::vector<std::optional<SweepRow>> SweepJournal::read_rows(std::istream& in, const SweepPlan& plan) {
  std::vector<std::optional<SweepRow>> rows(plan.points.size());
  std::map<std::vector<std::string>, std::vector<std::size_t>> points;  // by settings
  for (std::size_t p = 0; p < rows.size(); ++p) points[plan.points[p].settings].push_back(p);
  std::map<std::size_t, Columns> columns;  // by number: the line of some may be damaged
  std::string line;
  while (std::getline(in, line)) {
    const auto text = checked(line);
    if (text.empty()) continue;
    if (text.front() == '!') {
      const auto json = JournalJson::parse(text.substr(1), nullptr, false);
      if (!json.is_array() || json.size() != 2) continue;
      if (const auto of_settings = points.find(json[0]); of_settings != points.end())
        for (const auto p : of_settings->second) rows[p] = SweepRow{json[1], {}, {}};
      continue;
    }
    if (text.front() == '{') {
      const auto json = JournalJson::parse(text, nullptr, false);
      if (json.is_object() && json.contains("columns"))
        columns[json.at("columns")] = {json.at("figures"), json.at("texts"), {}};
      continue;
    }
    const auto parts = row_line(text);
    if (!parts) continue;
    const auto own = columns.find(parts->columns);
    const auto of_settings = points.find(parts->settings);
    if (own == columns.end() || of_settings == points.end()) continue;
    auto& [figures, texts, latest] = own->second;
    if (parts->values.size() != digits_of_value * figures.size() || parts->texts.size() != texts.size())
      continue;
    SweepRow row;
    row.figures = SweepFigures::like(latest);
    for (std::size_t f = 0; f < figures.size(); ++f)
      row.figures.add({figures[f].first}, figures[f].second,
                      value_of_bits(parts->values.substr(digits_of_value * f, digits_of_value)));
    if (!latest.share_names(row.figures)) latest = row.figures;
    for (std::size_t t = 0; t < texts.size(); ++t) row.texts.emplace_back(texts[t], parts->texts[t]);
    row.zones = parts->zones;
    for (const auto p : of_settings->second) rows[p] = row;
  }
  return rows;
}

void SweepJournal::begin(const SweepPlan& plan, const std::vector<std::optional<SweepRow>>& known) {
  columns_.clear();
  pending_ = line_of(key_);
  for (std::size_t p = 0; p < known.size(); ++p)
    if (known[p]) append(plan.points[p], *known[p]);
  write_text_file(file_, pending_, is_journal);
  pending_.clear();
}

std::size_t SweepJournal::number_of_columns(const SweepRow& row) {
  const auto same =
      std::find_if(columns_.begin(), columns_.end(), [&](const Columns& c) { return c.are_of(row); });
  if (same != columns_.end()) {
    if (!same->latest.share_names(row.figures)) same->latest = row.figures;
    return std::size_t(same - columns_.begin()) + 1;
  }
  Columns columns;
  for (const auto figure : row.figures) columns.figures.emplace_back(figure.name, figure.unit);
  for (const auto& text : row.texts) columns.texts.push_back(text.first);
  columns_.push_back(std::move(columns));
  JournalJson json;
  json["columns"] = columns_.size();
  json["figures"] = columns_.back().figures;
  json["texts"] = columns_.back().texts;
  pending_ += line_of(json.dump());
  return columns_.size();
}

void SweepJournal::append(const SweepPoint& point, const SweepRow& row) {
  if (!row.refused.empty()) return;
  std::vector<std::string> texts;
  for (const auto& text : row.texts) texts.push_back(text.second);
  std::string line = std::to_string(number_of_columns(row)) + ' ';
  line.reserve(line.size() + digits_of_value * row.figures.size());
  for (const auto figure : row.figures) append_bits(line, figure.value);
  auto lists = JournalJson::array({point.settings, texts});
  if (!row.zones.empty()) {
    lists.push_back(JournalJson::array());
    for (const auto& zone : row.zones) lists.back().push_back(zone_json(zone));
  }
  pending_ += line_of(line + ' ' + lists.dump());
}

void SweepJournal::flush() {
  const int file = ::open(file_.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC);
  const bool is_written = file >= 0 && write_all(file, pending_);
  if (file < 0 || ::close(file) != 0 || !is_written)
    throw FileError(shown(file_) + ": cannot be written; check the directory and the free space");
  bring_to_disk(file_);
  pending_.clear();
}

}  // namespace pipelines

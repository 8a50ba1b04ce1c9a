#include "pipelines/study/sweep/sweep_journal.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/disk/open_directory.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/content_hash.h"
#include "pipelines/base/files/replaceable.h"
#include "pipelines/base/files/whole_file.h"
#include "pipelines/respond/responses/response_key.h"

namespace pipelines {
namespace {

using JournalJson = nlohmann::ordered_json;

constexpr std::size_t digits_of_hash = 32;

/// The shortest digits that read back to the same number, and a space.
void append_number(std::string& text, double value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr) += ' ';
}

/// Up to the first word that is none.
std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  const char *at = text.data(), *const end = at + text.size();
  for (double value = 0; at != end; ++at) {
    const auto [after, error] = std::from_chars(at, end, value);
    if (error != std::errc() || after == end || *after != ' ') break;
    numbers.push_back(value);
    at = after;
  }
  return numbers;
}

/// What a zone's numbers are, in the order of the journal.
template <typename Zone>
auto numbers_of(Zone& z) {
  return std::array{&z.peak_Pa,   &z.error_Pa,  &z.safety,   &z.peak_m[0], &z.peak_m[1],
                    &z.peak_m[2], &z.low_m[0],  &z.low_m[1], &z.low_m[2],  &z.high_m[0],
                    &z.high_m[1], &z.high_m[2], &z.volume_m3};
}

JournalJson zone_json(const SweptZone& zone) {
  std::string numbers;
  for (const double* number : numbers_of(zone)) append_number(numbers, *number);
  return {zone.body, zone.feature, zone.place, zone.instant, zone.n_nodes, numbers};
}

SweptZone zone_of(const JournalJson& json) {
  SweptZone zone;
  zone.body = json.at(0);
  zone.feature = json.at(1);
  zone.place = json.at(2);
  zone.instant = json.at(3);
  zone.n_nodes = json.at(4);
  const auto numbers = numbers_in(json.at(5).get_ref<const std::string&>());
  for (std::size_t i = 0; i < numbers_of(zone).size(); ++i) *numbers_of(zone)[i] = numbers.at(i);
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

}  // namespace

std::string journal_key(const std::string& kind, const SweepOptions& options) {
  std::string key = program_fingerprint() + '\n' + kind + '\n';
  for (const auto& input : noted_inputs()) key += input.file.string() + ' ' + input.hash + '\n';
  for (const auto& setting : options.settings) key += setting + '\n';
  const auto& accuracy = options.accuracy;
  return key + fmt::format("{} {} {} {} {} {} {} {}", options.loads_only, options.zones, options.fatigue,
                           accuracy.tolerance, accuracy.time_limit_s, accuracy.once, accuracy.by_default,
                           options.n_threads);
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
      lines.pending_ += line_of(JournalJson::array({plan.points[p].settings, rows[p].refused})
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
  std::map<double, SweepFigures> columns;  // by number: the line of some may be damaged
  std::string line;
  while (std::getline(in, line)) {
    const auto text = checked(line);
    const auto begin = std::min(text.find_first_of("[{"), text.size());
    const auto json = JournalJson::parse(text.substr(begin), nullptr, false);
    if (json.is_object() && json.contains("columns"))
      for (const auto& figure : json.at("figures"))
        columns[json.at("columns")].add({figure.at(0).get_ref<const std::string&>()},
                                        figure.at(1).get_ref<const std::string&>(), 0);
    if (!json.is_array() || json.size() < 2) continue;
    const auto of_settings = points.find(json[0]);
    if (of_settings == points.end()) continue;
    SweepRow row;
    if (json[1].is_string()) {
      row.refused = json[1];
    } else {
      const auto numbers = numbers_in(text.substr(0, begin));
      const auto own = columns.find(numbers.empty() ? 0 : numbers[0]);
      if (own == columns.end() || own->second.size() + 1 != numbers.size()) continue;
      row.figures = SweepFigures::like(own->second);
      for (std::size_t f = 0; f + 1 < numbers.size(); ++f)
        row.figures.add({own->second[f].name}, own->second[f].unit, numbers[f + 1]);
      row.texts = json[1].get<decltype(row.texts)>();
      for (std::size_t z = 2; z < json.size(); ++z) row.zones.push_back(zone_of(json[z]));
    }
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

std::size_t SweepJournal::number_of_columns(const SweepFigures& figures) {
  if (!columns_.empty() && figures.share_names(latest_)) return latest_number_;
  auto names = JournalJson::array();
  for (const auto figure : figures) names.push_back({figure.name, figure.unit});
  const auto [entry, is_new] = columns_.emplace(names.dump(), columns_.size() + 1);
  if (is_new) pending_ += line_of(JournalJson({{"columns", entry->second}, {"figures", names}}).dump());
  latest_ = figures;
  return latest_number_ = entry->second;
}

void SweepJournal::append(const SweepPoint& point, const SweepRow& row) {
  if (!row.refused.empty()) return;
  std::string line = std::to_string(number_of_columns(row.figures)) + ' ';
  for (const auto figure : row.figures) append_number(line, figure.value);
  auto lists = JournalJson::array({point.settings, row.texts});
  for (const auto& zone : row.zones) lists.push_back(zone_json(zone));
  pending_ += line_of(line + lists.dump());
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

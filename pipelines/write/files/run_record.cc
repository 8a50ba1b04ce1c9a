#include "pipelines/write/files/run_record.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/disk/cache.h"
#include "pipelines/base/disk/staging.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/content_hash.h"
#include "pipelines/base/files/csv.h"
#include "pipelines/base/files/json_file.h"
#include "pipelines/base/files/kept_file.h"
#include "pipelines/base/files/whole_file.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/respond/responses/response_key.h"
#include "pipelines/write/files/manifest.h"
#include "pipelines/write/files/result_names.h"
#include "pipelines/write/files/staged_results.h"
#include "pipelines/write/report/html_report.h"

namespace pipelines {
namespace {

namespace fs = std::filesystem;
using RecordJson = nlohmann::ordered_json;

/// Texts behind their lengths: two lists are one text only if they are equal.
class TextList {
public:
  TextList& add(const std::string& text) {
    all_ += std::to_string(text.size()) + ' ' + text + '\n';
    return *this;
  }
  const std::string& text() const { return all_; }

private:
  std::string all_;
};

std::string text_of_file(const fs::path& file) {
  return whole_file(file).value_or("");
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// What the cache has under the hash of a key.
KeptFile in_cache(const std::string& key_hash) {
  try {
    return check_kept_file_of(cached_file(key_hash), key_hash);
  } catch (const FileError&) {  // there is no cache
    return KeptFile::missing;
  }
}

bool are_responses_whole(const FileList& files, const RunRecord& record, bool needed) {
  return std::all_of(record.responses.begin(), record.responses.end(), [&](const auto& of_body) {
    const auto state = in_cache(of_body.second);
    const bool is_beside = files.count(of_body.first + '/' + responses_file_name) > 0;
    return state == KeptFile::whole || (state == KeptFile::missing && (!needed || is_beside));
  });
}

/// Anybody may make the page anew from the results beside it.
bool is_page_whole(const fs::path& directory, const RunRecord& record) {
  return record.is_report_alone ||
         text_of_file(directory / "report.html") == html_report(directory, directory / "accuracy");
}

}  // namespace

std::string run_key(const Scene& scene, const RequestedAccuracy& accuracy, int n_threads, int n_ranks,
                    const std::vector<NotedInput>& inputs) {
  TextList list;
  list.add(program_fingerprint()).add(scene.file.filename().string());
  list.add(std::to_string(scene.settings.size()));
  for (const auto& setting : scene.settings) list.add(setting);
  list.add(std::to_string(int(scene.method))).add(shortest(accuracy.tolerance));
  list.add(shortest(accuracy.time_limit_s));
  list.add(accuracy.once ? "once" : "").add(accuracy.by_default ? "by default" : "");
  list.add(std::to_string(n_threads)).add(std::to_string(n_ranks));
  const auto folder = fs::absolute(scene.file).parent_path();
  for (const auto& [file, hash] : inputs) {
    if (hash.empty()) return "";
    list.add(file.lexically_relative(folder).generic_string()).add(hash);
  }
  return text_hash(list.text());
}

void write_run_record(const fs::path& folder, const RunRecord& record) {
  const auto text_of = [](const RunRecord& content) {
    const RecordJson json{{"key", content.key},
                          {"responses", content.responses},
                          {"report_alone", content.is_report_alone},
                          {"warnings", content.warnings},
                          {"table", lines_of(content.table)},
                          {"full_table", lines_of(content.full_table)}};
    return json.dump(1) + "\n";
  };
  RunRecord of_responses;
  of_responses.responses = record.responses;
  of_responses.is_report_alone = record.is_report_alone;
  std::string text;
  try {
    text = text_of(record.key.empty() ? of_responses : record);
  } catch (const RecordJson::exception&) {  // some text is not UTF-8, and would come back changed
    text = text_of(of_responses);
  }
  write_text_file(folder / run_record_name, text);
}

RunRecord read_run_record(const fs::path& file) {
  RunRecord record;
  const auto json = read_json_file(file);
  try {
    record.warnings = json.at("warnings").get<std::vector<std::string>>();
    record.responses = json.at("responses").get<std::map<std::string, std::string>>();
    record.is_report_alone = json.at("report_alone").get<bool>();
    for (const auto& line : json.at("table")) record.table += line.get<std::string>() + '\n';
    for (const auto& line : json.at("full_table")) record.full_table += line.get<std::string>() + '\n';
    record.key = json.at("key").get<std::string>();
  } catch (const RecordJson::exception&) {
    return {};
  }
  return record;
}

std::optional<EarlierRun> earlier_run(const fs::path& directory, const std::vector<std::string>& bodies,
                                      const std::string& key, bool with_responses) {
  if (key.empty()) return std::nullopt;
  finish_exchange(directory);
  const auto opened = OpenDirectory::existing(directory);
  if (!opened) return std::nullopt;
  remove_abandoned(*opened);
  for (const auto& body : bodies)
    if (const auto folder = opened->folder(body)) remove_abandoned(*folder);
  const DirectoryLock lock(*opened);
  EarlierRun earlier{read_run_record(directory / run_record_name), ""};
  if (earlier.record.key != key) return std::nullopt;
  const auto check = check_manifest(directory);
  if (!check.is_there || check.is_mixed() || !check.missing.empty() ||
      !contains(check.files, run_record_name) || !contains(check.files, "summary.json"))
    return std::nullopt;
  require_own_outputs(*opened, run_names(bodies));
  const auto files = read_manifest(*opened).value_or(FileList());
  if (!are_responses_whole(files, earlier.record, with_responses) ||
      !is_page_whole(directory, earlier.record))
    return std::nullopt;
  earlier.summary = text_of_file(directory / "summary.json");
  return earlier;
}

}  // namespace pipelines

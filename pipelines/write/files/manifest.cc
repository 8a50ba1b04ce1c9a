#include "pipelines/write/files/manifest.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/version.h"
#include "pipelines/base/files/content_hash.h"
#include "pipelines/base/files/json_file.h"
#include "pipelines/base/files/whole_file.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/write/files/result_names.h"

namespace pipelines {
namespace {

namespace fs = std::filesystem;
using ManifestJson = nlohmann::ordered_json;

const std::string program_name = "millstress";

std::string text_of_manifest(const ManifestJson& json) {
  return json.dump(2, ' ', false, ManifestJson::error_handler_t::replace) + "\n";
}

/// Checksum of all but itself.
std::string checksum_of(ManifestJson json) {
  json.erase("checksum");
  return text_hash(json.dump(-1, ' ', false, ManifestJson::error_handler_t::replace));
}

/// A damaged or malicious list must not lead out of the directory, nor to what this program never writes.
bool stays_inside(const std::string& name) {
  const fs::path path(name);
  return !name.empty() && name.find('\0') == std::string::npos && path.is_relative() &&
         std::none_of(path.begin(), path.end(),
                      [](const fs::path& part) { return part.empty() || part.string()[0] == '.'; });
}

bool is_program(const ManifestJson& json) {
  return json.contains("program") && json.at("program").is_object() &&
         json.at("program").value("name", ManifestJson()) == program_name;
}

}  // namespace

std::optional<FileList> read_manifest(const OpenDirectory& directory) {
  const auto status = directory.look(manifest_name);
  if (!status || !S_ISREG(status->st_mode)) return std::nullopt;
  const auto file = directory.path() / manifest_name;
  const ManifestJson json = read_json_file(file);
  if (!json.is_object() || !is_program(json) || !json.contains("files") || !json.contains("checksum"))
    return std::nullopt;
  if (whole_file(file) != text_of_manifest(json))
    return std::nullopt;  // spaces that are none any more mean nothing to JSON
  const auto& files = json.at("files");
  if (!files.is_object() || json.at("checksum") != checksum_of(json)) return std::nullopt;
  FileList list;
  for (const auto& [name, entry] : files.items()) {
    if (!stays_inside(name) || !entry.is_object() || !entry.contains("bytes") ||
        !entry.at("bytes").is_number_unsigned() || !entry.contains("xxh3_128") ||
        !entry.at("xxh3_128").is_string())
      return std::nullopt;
    list[name] = {entry.at("bytes").get<std::uintmax_t>(), entry.at("xxh3_128").get<std::string>()};
  }
  return list;
}

std::optional<ResultsOf> read_results_of(const OpenDirectory& directory) {
  if (!read_manifest(directory)) return std::nullopt;
  const ManifestJson json = read_json_file(directory.path() / manifest_name);
  try {
    const auto& entry = json.at("of");
    ResultsOf of{entry.at("scene").get<std::string>(), entry.at("settings").get<std::vector<std::string>>()};
    if (entry.contains("sweep")) of.sweep = entry.at("sweep").get<std::vector<std::string>>();
    return of;
  } catch (const ManifestJson::exception&) {
    return std::nullopt;
  }
}

ResultsOf as_json_has_it(ResultsOf of) {
  const auto replace = [](std::string& text) {
    text =
        ManifestJson::parse(ManifestJson(text).dump(-1, ' ', false, ManifestJson::error_handler_t::replace))
            .get<std::string>();
  };
  replace(of.scene);
  for (auto& setting : of.settings) replace(setting);
  if (of.sweep)
    for (auto& option : *of.sweep) replace(option);
  return of;
}

std::string manifest_text(const FileList& list, const std::optional<ResultsOf>& of) {
  ManifestJson files = ManifestJson::object();
  for (const auto& [name, file] : list) files[name] = {{"bytes", file.bytes}, {"xxh3_128", file.checksum}};
  ManifestJson json{{"program", {{"name", program_name}, {"version", version}}}};
  if (of) {
    json["of"] = {{"scene", of->scene}, {"settings", of->settings}};
    if (of->sweep) json["of"]["sweep"] = *of->sweep;
  }
  json["files"] = files;
  json["checksum"] = checksum_of(json);
  return text_of_manifest(json);
}

bool is_as_listed(const OpenDirectory& directory, const std::string& name, const ListedFile& listed) {
  const auto status = directory.look(name);
  if (!status || !S_ISREG(status->st_mode) || std::uintmax_t(status->st_size) != listed.bytes) return false;
  try {
    return listed_now(directory, name).checksum == listed.checksum;
  } catch (const FileError&) {
    return false;
  }
}

ListedFile listed_now(const OpenDirectory& directory, const std::string& name) {
  const fs::path file(name);
  const auto folder = directory.folder(file.parent_path());
  const auto status = directory.look(name);
  if (!folder || !status) throw FileError((directory.name() / name).string() + ": is gone");
  return {std::uintmax_t(status->st_size), content_hash(folder->path() / file.filename())};
}

ManifestCheck check_manifest(const fs::path& name) {
  ManifestCheck check;
  const auto directory = OpenDirectory::existing(name);
  check.is_there = directory && directory->look(manifest_name);
  if (!check.is_there) return check;
  const auto list = read_manifest(*directory);
  check.damaged = !list;
  if (check.damaged) return check;
  for (const auto& [file, listed] : *list) {
    if (!is_run_result(file)) continue;
    check.files.push_back(file);
    if (!directory->look(file))
      check.missing.push_back(file);
    else if (!is_as_listed(*directory, file, listed))
      check.changed.push_back(file);
  }
  return check;
}

std::string ManifestCheck::text(const fs::path& directory) const {
  if (damaged) return (directory / manifest_name).string() + ": is damaged, or not of this program";
  return directory.string() + ": " + listed(changed) + (changed.size() == 1 ? " is" : " are") +
         " not as the run wrote it that left manifest.json";
}

}  // namespace pipelines

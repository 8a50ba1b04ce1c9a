#include "pipelines/result_files/manifest.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "pipelines/common/errors.h"
#include "pipelines/common/version.h"
#include "pipelines/files/atomic_file.h"
#include "pipelines/files/content_hash.h"
#include "pipelines/files/json_file.h"
#include "pipelines/names/nearest_name.h"

namespace pipelines {
namespace {

namespace fs = std::filesystem;
using ManifestJson = nlohmann::ordered_json;

struct ListedFile {
  std::string name, checksum;
  std::uintmax_t bytes = 0;
};

std::string text_of_manifest(const ManifestJson& json) {
  return json.dump(2, ' ', false, ManifestJson::error_handler_t::replace) + "\n";
}

std::string list_checksum(const ManifestJson& files) {
  return text_hash(files.dump(-1, ' ', false, ManifestJson::error_handler_t::replace));
}

/// A damaged or malicious list must not lead out of the directory.
bool stays_inside(const fs::path& name) {
  return !name.empty() && name.is_relative() &&
         std::none_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".."; });
}

/// @return false if the manifest cannot be believed
bool read_list(const fs::path& file, std::vector<ListedFile>& list) {
  const ManifestJson json = read_json_file(file);
  if (!json.is_object() || !json.contains("files") || !json.contains("checksum")) return false;
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (text != text_of_manifest(json)) return false;  // spaces that are none any more mean nothing to JSON
  const auto& files = json.at("files");
  if (!files.is_object() || json.at("checksum") != list_checksum(files)) return false;
  for (const auto& [name, entry] : files.items()) {
    if (!stays_inside(name) || !entry.is_object() || !entry.contains("bytes") ||
        !entry.at("bytes").is_number_unsigned() || !entry.contains("xxh3_128") ||
        !entry.at("xxh3_128").is_string())
      return false;
    list.push_back({name, entry.at("xxh3_128").get<std::string>(), entry.at("bytes").get<std::uintmax_t>()});
  }
  return true;
}

bool is_as_listed(const fs::path& file, const ListedFile& listed) {
  std::error_code none;
  if (fs::symlink_status(file, none).type() != fs::file_type::regular ||
      fs::file_size(file, none) != listed.bytes)
    return false;
  try {
    return content_hash(file) == listed.checksum;
  } catch (const FileError&) {
    return false;
  }
}

}  // namespace

void write_manifest(const fs::path& directory) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    const auto name = fs::relative(entry.path(), directory).generic_string();
    if (entry.is_regular_file() && name != manifest_name && name != "report.html") names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  ManifestJson files = ManifestJson::object();
  for (const auto& name : names)
    files[name] = {{"bytes", fs::file_size(directory / name)}, {"xxh3_128", content_hash(directory / name)}};
  const ManifestJson json{{"program", {{"name", "millstress"}, {"version", version}}},
                          {"files", files},
                          {"checksum", list_checksum(files)}};
  write_text_file(directory / manifest_name, text_of_manifest(json));
}

ManifestCheck check_manifest(const fs::path& directory) {
  ManifestCheck check;
  std::error_code none;
  check.is_there = fs::exists(fs::symlink_status(directory / manifest_name, none));
  if (!check.is_there) return check;
  std::vector<ListedFile> list;
  check.damaged = !read_list(directory / manifest_name, list);
  if (check.damaged) return check;
  for (const auto& listed : list) {
    check.files.push_back(listed.name);
    if (!fs::exists(fs::symlink_status(directory / listed.name, none)))
      check.missing.push_back(listed.name);
    else if (!is_as_listed(directory / listed.name, listed))
      check.changed.push_back(listed.name);
  }
  return check;
}

std::vector<std::string> files_of_manifest(const fs::path& directory) {
  std::vector<ListedFile> list;
  std::vector<std::string> names;
  if (read_list(directory / manifest_name, list))
    for (auto& listed : list) names.push_back(std::move(listed.name));
  return names;
}

std::string ManifestCheck::text(const fs::path& directory) const {
  if (damaged) return (directory / manifest_name).string() + ": is damaged";
  return directory.string() + ": " + listed(changed) + (changed.size() == 1 ? " is" : " are") +
         " not as the run wrote it that left manifest.json";
}

}  // namespace pipelines

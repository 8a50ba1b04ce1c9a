#include "pipelines/result_files/staged_results.h"

#include <algorithm>
#include <set>

#include "pipelines/files/atomic_file.h"
#include "pipelines/files/replaceable.h"
#include "pipelines/names/name_lists.h"
#include "pipelines/result_files/directory_lock.h"
#include "pipelines/result_files/manifest.h"
#include "pipelines/result_files/result_names.h"

namespace pipelines {
namespace {

namespace fs = std::filesystem;

fs::path complete_folder(const fs::path& directory) {
  return directory / ".results.complete";
}

/// Every file below a folder, relative to it, in a fixed order with the manifest last.
std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) names.push_back(fs::relative(entry.path(), folder).generic_string());
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return std::pair(a == manifest_name, a) < std::pair(b == manifest_name, b);
  });
  return names;
}

void remove_if_regular(const fs::path& file) {
  std::error_code none;
  if (fs::symlink_status(file, none).type() == fs::file_type::regular) fs::remove(file);
}

void remove_if_empty(const fs::path& folder) {
  std::error_code none;
  if (fs::is_directory(fs::symlink_status(folder, none)) && fs::is_empty(folder, none))
    fs::remove(folder, none);
}

/// The files in a body's folder that have a result's name and are not in the list.
void remove_body_files(const fs::path& directory, const std::string& body,
                       const std::vector<std::string>& stay, bool kept_too) {
  const auto folder = directory / body;
  std::error_code none;
  if (!fs::is_directory(fs::symlink_status(folder, none))) return;
  std::vector<fs::path> own;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto name = entry.path().filename().string();
    if (is_body_file(name) && (kept_too || !is_kept_file(name)) && !contains(stay, body + '/' + name))
      own.push_back(entry.path());
  }
  for (const auto& file : own) remove_if_regular(file);
  remove_if_empty(folder);
}

/// What earlier runs have left and the new results do not have, so that the directory shows one run. To be
/// called before a file of the new results has got its place: it asks the earlier manifest and summary.
void remove_earlier(const fs::path& directory, const std::vector<std::string>& results) {
  for (const auto& name : files_of_manifest(directory))
    if (!contains(results, name)) {
      remove_if_regular(directory / name);
      if (fs::path(name).has_parent_path()) remove_if_empty((directory / name).parent_path());
    }
  std::set<std::string> folders;
  for (const auto& name : results)
    if (const auto parent = fs::path(name).parent_path(); !parent.empty()) folders.insert(parent.string());
  for (const auto& folder : folders) remove_body_files(directory, folder, results, false);
  for (const auto& body : bodies_of_summary(directory / "summary.json"))
    if (folders.count(body) == 0 && fs::path(body).filename() == fs::path(body) && body != "..")
      remove_body_files(directory, body, results, true);
}

/// With the lock held. A kill at any point leaves what the next call needs.
void exchange(const fs::path& directory) {
  const auto complete = complete_folder(directory);
  if (!fs::is_directory(complete)) return;
  const auto results = files_of_manifest(complete);
  // Without the new manifest all are in their places.
  if (!results.empty()) remove_earlier(directory, results);
  std::set<fs::path> folders{directory};
  for (const auto& name : files_below(complete)) {
    const auto target = directory / name;
    if (folders.insert(target.parent_path()).second) fs::create_directories(target.parent_path());
    if (name == manifest_name)
      for (const auto& folder : folders) bring_to_disk(folder);
    fs::rename(complete / name, target);
  }
  bring_to_disk(directory);
  fs::remove_all(complete);
}

}  // namespace

StagedResults::StagedResults(fs::path directory, std::vector<std::string> bodies)
    : directory_(std::move(directory)), bodies_(std::move(bodies)) {
  finish_exchange(directory_);
  refuse_foreign_files(directory_, bodies_);
  folder_ = partial_name(directory_ / "results");
  const DirectoryLock lock(directory_);
  const auto check = check_manifest(directory_);
  if (check.is_mixed()) warning_ = check.text(directory_) + "; they are replaced";
  fs::create_directory(folder_);
}

StagedResults::~StagedResults() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void StagedResults::publish() {
  write_manifest(folder_);
  const DirectoryLock lock(directory_);
  exchange(directory_);
  refuse_foreign_files(directory_, bodies_);
  std::set<fs::path> folders{folder_};
  for (const auto& name : files_below(folder_)) {
    require_replaceable(directory_ / name);
    folders.insert((folder_ / name).parent_path());
  }
  for (const auto& folder : folders) bring_to_disk(folder);
  fs::rename(folder_, complete_folder(directory_));
  bring_to_disk(directory_);
  exchange(directory_);
}

void finish_exchange(const fs::path& directory) {
  if (!fs::is_directory(complete_folder(directory))) return;
  const DirectoryLock lock(directory);
  exchange(directory);
}

}  // namespace pipelines

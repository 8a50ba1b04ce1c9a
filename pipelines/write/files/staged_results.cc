#include "pipelines/write/files/staged_results.h"

#include <unistd.h>

#include <algorithm>
#include <set>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/process_limits.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/replaceable.h"
#include "pipelines/write/files/manifest.h"
#include "pipelines/write/files/run_record.h"
#include "pipelines/write/report/html_report.h"

namespace pipelines {
namespace {

namespace fs = std::filesystem;

const std::string complete_name = ".results.complete";

/// @param option  empty: none asks for it
[[noreturn]] void refuse(const OpenDirectory& directory, const fs::path& file, const std::string& why,
                         const std::string& option) {
  throw OptionError((option.empty() ? "" : option + ' ') + (directory.name() / file).string() + ": " + why +
                    "; move it away" +
                    (option.empty() ? "" : ", or choose another directory with " + option));
}

/// Why a file must not be replaced or removed, as the end of a sentence; empty if it may be, or is not there.
/// @param lists  lists of what this program has written, or has ready to take its place
std::string why_foreign(const OpenDirectory& directory, const std::string& name,
                        const std::vector<const FileList*>& lists) {
  if (const auto obstacle = directory.obstacle_before(name); !obstacle.empty())
    return "lies in " + (directory.name() / obstacle).string() + ", which is a symbolic link or no directory";
  if (!directory.look(name)) return "";
  const auto file = directory.path() / name;
  if (auto why = why_not_replaceable(file); !why.empty()) return why;
  if (name == manifest_name)
    return read_manifest(directory) ? "" : "is there already, and is damaged or none of this program";
  for (const auto* list : lists) {
    const auto listed = list->find(name);
    if (listed != list->end() && is_as_listed(directory, name, listed->second)) return "";
  }
  return "is there already, and no manifest.json of this program lists it as it is";
}

void require_own_in(const OpenDirectory& directory, const fs::path& folder, const OutputNames& names,
                    const FileList& list, const std::string& option) {
  std::set<std::string> found;  // in a fixed order
  for (const auto& entry : fs::directory_iterator(directory.folder(folder)->path()))
    found.insert((folder / entry.path().filename()).generic_string());
  for (const auto& name : found) {
    if (names.has(name) || name == manifest_name)
      if (const auto why = why_foreign(directory, name, {&list}); !why.empty())
        refuse(directory, name, why, option);
    if (!names.enters(name)) continue;
    if (!directory.folder(name))
      refuse(directory, name, "is a symbolic link or no directory, and nothing is written through it",
             option);
    require_own_in(directory, name, names, list, option);
  }
}

void remove_abandoned_in(const OpenDirectory& directory, const fs::path& folder, const OutputNames& names) {
  const auto opened = directory.folder(folder);
  if (!opened) return;
  remove_abandoned(*opened);
  std::vector<std::string> inside;
  for (const auto& entry : fs::directory_iterator(opened->path()))
    inside.push_back((folder / entry.path().filename()).generic_string());
  for (const auto& name : inside)
    if (names.enters(name)) remove_abandoned_in(directory, name, names);
}

/// Everything below a folder that is no folder, with names relative to it, the manifest last.
std::vector<std::string> files_below(const OpenDirectory& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
    if (!fs::is_directory(entry.symlink_status()))
      names.push_back(entry.path().lexically_relative(folder.path()).generic_string());
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return std::pair(a == manifest_name, a) < std::pair(b == manifest_name, b);
  });
  names.erase(std::remove(names.begin(), names.end(), lock_of_staging), names.end());
  return names;
}

/// Removes what earlier commands have left and the new list does not have, so that the directory shows one
/// run.
void remove_earlier(const OpenDirectory& directory, const FileList& earlier, const FileList& results) {
  for (const auto& [name, listed] : earlier) {
    if (results.count(name) > 0 || !is_as_listed(directory, name, listed)) continue;
    directory.remove(name);
    directory.remove_if_empty(fs::path(name).parent_path());
  }
}

/// Removes the folder of results that have their places, and the folders in it: empty ones alone.
void remove_emptied(const OpenDirectory& directory) {
  std::vector<fs::path> folders;  // from the outermost in
  if (const auto complete = directory.folder(complete_name))
    for (const auto& entry : fs::recursive_directory_iterator(complete->path()))
      if (fs::is_directory(entry.symlink_status()))
        folders.push_back(complete_name / entry.path().lexically_relative(complete->path()));
  for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) directory.remove_if_empty(*folder);
  directory.remove(fs::path(complete_name) / lock_of_staging);
  directory.remove_if_empty(complete_name);
}

/// Moves complete files to their places, with the lock held. A kill at any point leaves what the next call
/// needs.
/// @param names  files of `complete` that take their places, the manifest last
void take_places(const OpenDirectory& directory, const OpenDirectory& complete,
                 const std::vector<std::string>& names, const FileList& results) {
  const Uninterrupted until_all_are_in_place;
  remove_earlier(directory, read_manifest(directory).value_or(FileList()), results);
  std::set<std::string> folders{""};
  for (const auto& name : names) {
    folders.insert(fs::path(name).parent_path().generic_string());
    if (name == manifest_name)
      for (const auto& folder : folders) bring_to_disk(directory.make_folder(folder).path());
    complete.move(name, directory, name);
  }
  bring_to_disk(directory.path());
  remove_emptied(directory);
}

/// What waits to take its place is believed if it is a folder of this user with a manifest and no file that
/// this does not list. With the lock held.
void exchange(const OpenDirectory& directory) {
  const auto status = directory.look(complete_name);
  if (!status) return;
  const std::string why = "is not what a run of this program has left there complete";
  const auto complete = directory.folder(complete_name);
  if (!complete || status->st_uid != geteuid()) refuse(directory, complete_name, why, "");
  const auto names = files_below(*complete);
  if (names.empty()) return remove_emptied(directory);  // without the manifest all are in their places
  const auto results = read_manifest(*complete);
  if (!results) refuse(directory, complete_name, why, "");
  const auto earlier = read_manifest(directory).value_or(FileList());
  for (const auto& name : names) {
    const auto listed = results->find(name);
    if (name != manifest_name && (listed == results->end() || !is_as_listed(*complete, name, listed->second)))
      refuse(directory, complete_name / fs::path(name), why, "");
    if (const auto foreign = why_foreign(directory, name, {&earlier, &*results}); !foreign.empty())
      refuse(directory, name, foreign, "");
  }
  take_places(directory, *complete, names, *results);
}

/// The directories on the way to one that are missing, the innermost first.
std::vector<fs::path> missing_directories(fs::path directory) {
  std::vector<fs::path> missing;
  std::error_code none;
  for (; !directory.empty() && !fs::exists(fs::symlink_status(directory, none));
       directory = directory.parent_path())
    missing.push_back(directory);
  return missing;
}

OpenDirectory looked_at(const fs::path& name, const OutputNames& names, const std::string& option) {
  require_replaceable(name / manifest_name, option);
  auto directory = OpenDirectory::at(name);
  finish_exchange(name);
  remove_abandoned_in(directory, "", names);
  require_own_outputs(directory, names, option);
  return directory;
}

/// Another process may have written there since these results were begun.
/// @param found, held  what the manifest said then, and says now
void require_no_newcomer(const fs::path& directory, const std::string& option,
                         const std::optional<Variant>& variant, const std::optional<ResultsOf>& found,
                         const std::optional<ResultsOf>& held) {
  if (!variant || !held || held == found) return;
  if (const auto other = held_of_another(directory, *held, *variant); !other.empty())
    throw OptionError(option + ' ' + directory.string() + ": holds " + other +
                      " by now, which came while this was computed; run it again with another directory");
}

/// What the manifest says from now on. A sweep stays beside other results of its scene.
std::optional<ResultsOf> results_of(const fs::path& directory, const std::optional<Variant>& variant,
                                    const std::optional<ResultsOf>& held) {
  if (!variant) return held;
  auto of = variant->in(directory);
  if (!of.sweep && held && held->scene == of.scene && held->settings == of.settings) of.sweep = held->sweep;
  return of;
}

}  // namespace

void require_own_outputs(const OpenDirectory& directory, const OutputNames& names,
                         const std::string& option) {
  const auto list = read_manifest(directory);
  if (!list)
    if (const auto why = why_foreign(directory, manifest_name, {}); !why.empty())
      refuse(directory, manifest_name, why, option);
  require_own_in(directory, "", names, list.value_or(FileList()), option);
}

void require_own_outputs(const fs::path& name, const OutputNames& names, const std::string& option) {
  require_replaceable(name / manifest_name, option);
  finish_exchange(name);
  if (const auto directory = OpenDirectory::existing(name)) require_own_outputs(*directory, names, option);
}

StagedResults::StagedResults(fs::path directory, OutputNames names, std::string option,
                             std::optional<Variant> variant)
    : name_(std::move(directory)),
      missing_{missing_directories(name_)},
      names_(std::move(names)),
      option_(std::move(option)),
      variant_(std::move(variant)),
      directory_(looked_at(name_, names_, option_)),
      found_(read_results_of(directory_)),
      staging_(directory_) {}

void StagedResults::publish() {
  const auto written = staging_.complete_files();
  const DirectoryLock lock(directory_);
  directory_.require_at(name_);
  exchange(directory_);
  const auto earlier = read_manifest(directory_).value_or(FileList());
  FileList results;
  for (const auto& [name, listed] : earlier)
    if (!names_.has(name)) results[name] = listed;
  std::vector<std::string> moved;
  for (const auto& [name, bytes] : written) {
    if (const auto why = why_foreign(directory_, name, {&earlier}); !why.empty())
      refuse(directory_, name, why, option_);
    results[name] = listed_now(staging_.folder(), name);
    moved.push_back(name);
  }
  if (const auto why = why_foreign(directory_, manifest_name, {}); !why.empty())
    refuse(directory_, manifest_name, why, option_);
  const auto held = read_results_of(directory_);
  require_no_newcomer(name_, option_, variant_, found_, held);
  write_text_file(folder() / manifest_name, manifest_text(results, results_of(name_, variant_, held)));
  moved.emplace_back(manifest_name);
  std::set<std::string> folders{""};
  for (const auto& name : moved) {
    bring_to_disk(folder() / name);
    folders.insert(fs::path(name).parent_path().generic_string());
  }
  for (const auto& inside : folders) bring_to_disk(folder() / inside);
  staging_.become(complete_name);
  bring_to_disk(directory_.path());
  take_places(directory_, staging_.folder(), moved, results);
}

StagedResults::MissingDirectories::~MissingDirectories() {
  std::error_code not_empty;
  for (const auto& name : names) fs::remove(name, not_empty);
}

void publish_html_report(const fs::path& directory, const fs::path& accuracy, const std::string& option) {
  if (read_run_record(directory / run_record_name).is_report_alone)
    throw OptionError(directory.string() +
                      ": holds the report alone, which cannot be made anew without the results; run " +
                      "the scene with keep = \"results\" in [results]");
  const auto page = html_report(directory, accuracy);
  StagedResults staged(directory, names_of({"report.html"}), option);
  write_text_file(staged.folder() / "report.html", page);
  staged.publish();
}

void finish_exchange(const fs::path& name) {
  const auto directory = OpenDirectory::existing(name);
  if (!directory || !directory->look(complete_name)) return;
  const DirectoryLock lock(*directory);
  exchange(*directory);
}

}  // namespace pipelines

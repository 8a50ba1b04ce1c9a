#include "pipelines/base/files/replaceable.h"

#include <algorithm>
#include <mutex>
#include <vector>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/disk/open_directory.h"
#include "pipelines/base/files/content_hash.h"

namespace pipelines {
namespace {

namespace fs = std::filesystem;

/// The one list of the process: whoever writes has to heed it, whichever stage has read.
struct Inputs {
  std::mutex mutex;
  std::vector<NotedInput> files;
};

Inputs& inputs() {
  static Inputs all;
  return all;
}

bool is_input(const fs::path& file) {
  std::error_code ignored;
  const std::lock_guard<std::mutex> lock(inputs().mutex);
  return std::any_of(inputs().files.begin(), inputs().files.end(),
                     [&](const NotedInput& input) { return fs::equivalent(input.file, file, ignored); });
}

/// Hash of a regular file; empty for others. From a pipe nothing is read: what was taken from it would be
/// missing later.
std::string hash_or_nothing(const fs::path& file) {
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return "";
  try {
    return content_hash(file);
  } catch (const FileError&) {
    return "";
  }
}

std::string kind_of_file(fs::file_type type) {
  switch (type) {
    case fs::file_type::symlink:
      return "is a symbolic link";
    case fs::file_type::fifo:
      return "is a pipe";
    case fs::file_type::block:
    case fs::file_type::character:
      return "is a device";
    case fs::file_type::socket:
      return "is a socket";
    case fs::file_type::directory:
      return "is a directory";
    default:
      return "is no regular file";
  }
}

/// Why a folder can neither be there nor be made; empty if it can.
std::string why_no_folder(const fs::path& folder) {
  if (folder.empty()) return "";
  std::error_code none;
  const auto link = fs::symlink_status(folder, none), target = fs::status(folder, none);
  if (fs::is_directory(target)) return "";
  if (fs::exists(target)) return "lies in " + folder.string() + ", which is no directory";
  if (fs::is_symlink(link)) return "lies in " + folder.string() + ", a symbolic link to nothing";
  return folder == folder.parent_path() ? "" : why_no_folder(folder.parent_path());
}

}  // namespace

void note_input(const fs::path& file) {
  std::error_code unknown;
  auto whole = fs::absolute(file, unknown);
  if (unknown) whole = file;
  const std::lock_guard<std::mutex> lock(inputs().mutex);
  auto& files = inputs().files;
  if (std::any_of(files.begin(), files.end(), [&](const NotedInput& input) { return input.file == whole; }))
    return;
  auto hash = hash_or_nothing(whole);
  files.push_back({std::move(whole), std::move(hash)});
}

std::vector<NotedInput> noted_inputs() {
  const std::lock_guard<std::mutex> lock(inputs().mutex);
  return inputs().files;
}

bool are_as_noted(const std::vector<NotedInput>& inputs) {
  return std::all_of(inputs.begin(), inputs.end(), [](const NotedInput& input) {
    return !input.hash.empty() && hash_or_nothing(input.file) == input.hash;
  });
}

std::string why_not_replaceable(const fs::path& file) {
  std::error_code none;
  const auto status = fs::symlink_status(file, none);
  if (status.type() == fs::file_type::not_found) return why_no_folder(file.parent_path());
  if (status.type() != fs::file_type::regular)
    return kind_of_file(status.type()) + ", and only a regular file is replaced";
  return is_input(file) ? "is an input of this run, and is not replaced" : "";
}

void require_replaceable(const fs::path& file, const std::string& option) {
  const auto why = why_not_replaceable(file);
  if (why.empty()) return;
  throw OptionError((option.empty() ? "" : option + ' ') + shown(file) + ": " + why +
                    (option.empty() ? "; choose another output with -o, or move it away"
                                    : "; give " + option + " a new name, or move it away"));
}

}  // namespace pipelines

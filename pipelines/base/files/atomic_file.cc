#include "pipelines/base/files/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/disk/staging.h"
#include "pipelines/base/files/replaceable.h"

namespace pipelines {
namespace {

std::filesystem::path directory_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

bool ends_with(const std::filesystem::path& file, std::string_view end) {
  std::error_code none;
  const auto size = std::filesystem::file_size(file, none);
  if (none || size < end.size()) return false;
  std::string text(end.size(), '\0');
  std::ifstream in(file, std::ios::binary);
  in.seekg(std::streamoff(size - end.size()));
  in.read(text.data(), std::streamsize(text.size()));
  return in && text == end;
}

}  // namespace

void bring_to_disk(const std::filesystem::path& file_or_directory) {
  const int file = open(file_or_directory.c_str(), O_RDONLY | O_CLOEXEC);
  const bool failed = file < 0 || (fsync(file) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS);
  const std::string why = failed ? std::generic_category().message(errno) : "";
  if (file >= 0) close(file);
  if (failed)
    throw FileError(shown(file_or_directory) + ": cannot be brought to the disk: " + why +
                    "; check the directory and the free space");
}

void require_own(const std::filesystem::path& file, const IsOwnFile& is_own, const std::string& option) {
  require_replaceable(file, option);
  std::error_code none;
  const auto size = std::filesystem::file_size(file, none);
  if (none || size == 0 || !is_own || is_own(file)) return;
  throw OptionError((option.empty() ? "" : option + ' ') + shown(file) +
                    ": is there already, and is no such file that this program has written; " +
                    (option.empty() ? "choose another output with -o, or move it away"
                                    : "give " + option + " a new name, or move it away"));
}

AtomicFile::AtomicFile(std::filesystem::path target, IsOwnFile is_own)
    : target_(std::move(target)), temporary_(target_), is_own_(std::move(is_own)) {
  const auto directory = OpenDirectory::at(directory_of(target_));
  if (Staging::of(target_) != nullptr) return;
  staging_ = std::make_unique<Staging>(directory);
  temporary_ = staging_->folder().path() / target_.filename();
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (committed_ || staging_) return;
  std::filesystem::remove(temporary_, ignored);
  if (auto* staging = Staging::of(target_)) staging->forget(target_);
}

void AtomicFile::commit(std::string_view end) {
  if (!end.empty() && !ends_with(temporary_, end))
    throw FileError(shown(target_) + ": cannot be written completely; check the free space");
  if (!staging_) {
    Staging::of(target_)->record(target_);
    committed_ = true;
    return;
  }
  const auto& directory = staging_->directory();
  directory.require_at(directory_of(target_));
  require_own(directory.path() / target_.filename(), is_own_);
  if (std::filesystem::exists(temporary_)) bring_to_disk(temporary_);
  staging_->folder().move(target_.filename(), directory, target_.filename());
  committed_ = true;
  bring_to_disk(directory.path());
}

void write_text_file(const std::filesystem::path& path, std::string_view content, const IsOwnFile& is_own) {
  AtomicFile file(path, is_own);
  std::ofstream out(file.temporary(), std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) throw FileError(shown(path) + ": cannot be written; check the directory and the free space");
  file.commit();
}

}  // namespace pipelines

#include "pipelines/respond/responses/iteration_memory.h"

#include <fstream>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/several_ranks.h"
#include "pipelines/base/disk/open_directory.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/kept_file.h"

namespace pipelines {

namespace {

std::filesystem::path file_in(const std::filesystem::path& directory) {
  return directory / "iteration_gave_up.txt";
}

}  // namespace

bool iteration_gave_up_before(const std::filesystem::path& directory, const std::string& key,
                              const Tell& tell) {
  if (key.empty()) return false;
  const auto state = checked_on_first_rank(file_in(directory), key);
  if (state == KeptFile::damaged && tell) tell(damaged_file_text(file_in(directory)));
  return state == KeptFile::whole;
}

void remember_iteration(const std::filesystem::path& directory, const std::string& key, bool gave_up) {
  if (!is_first_rank()) return;
  const auto path = file_in(directory);
  if (!gave_up) {
    if (is_own_kept_file(path)) OpenDirectory::at(directory).remove(path.filename());
    return;
  }
  AtomicFile file(path, is_own_kept_file);
  std::ofstream out(file.temporary(), std::ios::binary);
  out << key;
  out.close();
  if (!out) throw FileError(shown(path) + ": cannot be written; check the directory and the free space");
  append_checksum(file.temporary(), key);
  file.commit();
}

}  // namespace pipelines

#include "pipelines/responses/iteration_memory.h"

#include <fstream>
#include <iterator>
#include <system_error>

#include "pipelines/files/atomic_file.h"

namespace pipelines {

namespace {

std::filesystem::path file_in(const std::filesystem::path& directory) {
  return directory / "iteration_gave_up.txt";
}

}  // namespace

bool iteration_gave_up_before(const std::filesystem::path& directory, const std::string& key) {
  std::ifstream file(file_in(directory), std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {}) == key && !key.empty();
}

void remember_iteration(const std::filesystem::path& directory, const std::string& key, bool gave_up) {
  std::error_code none;
  if (gave_up)
    write_text_file(file_in(directory), key);
  else
    std::filesystem::remove(file_in(directory), none);
}

}  // namespace pipelines

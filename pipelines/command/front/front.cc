/// The program as it is started. It tells its version at once; for all else it becomes the program that does
/// the work, which takes a third of a second to load its libraries.
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "commit.h"

namespace {

/// Where that program is, from this one's place: in a build, or installed.
constexpr const char* workers[] = {"millstress-run", "../libexec/millstress/millstress-run"};

constexpr int output_failed = 3;

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "--version") == 0 &&
      std::puts("millstress " MILLSTRESS_VERSION MILLSTRESS_COMMIT) >= 0 && std::fflush(stdout) == 0)
    return 0;
  std::error_code none;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
  for (const auto* worker : workers) execv((folder / worker).c_str(), argv);
  std::fprintf(stderr,
               "millstress: millstress-run, which belongs to it, cannot be started: %s; install both anew\n",
               std::strerror(errno));
  return output_failed;
}

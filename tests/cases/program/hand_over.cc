/// Stands for the program in a command of the shell: has it started by the one that waits
/// (tests/cases/program/waiting_program.cc) and ends as that start does. Where none waits, the program itself
/// starts.
///
///     hand_over PROGRAM ARGUMENTS...
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/cases/program/start_request.h"

namespace {

void append(std::vector<std::string>& words, char** strings) {
  const auto at = words.size();
  words.emplace_back();
  for (; *strings != nullptr; ++strings)
    if (std::string(*strings).rfind(start_request::socket_variable, 0) != 0) words.emplace_back(*strings);
  words[at] = std::to_string(words.size() - at - 1);
}

/// @return whether a program waits; its status, if it ended
bool start_waiting(int socket, char** arguments, int& status) {
  std::vector<std::string> words{std::filesystem::current_path().string()};
  append(words, arguments);
  append(words, environ);
  int told[2];
  if (pipe(told) != 0) return false;
  const bool taken = start_request::send(socket, words, {0, 1, 2, told[1]});
  close(told[1]);
  if (taken && read(told[0], &status, sizeof status) != sizeof status)
    status = start_request::cannot_start << 8;
  return taken;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return start_request::cannot_start;
  int status = 0;
  const char* socket = std::getenv(start_request::socket_variable);
  if (socket == nullptr || !start_waiting(std::atoi(socket), argv + 1, status)) {
    unsetenv(start_request::socket_variable);
    execv(argv[1], argv + 1);
    return start_request::cannot_start;
  }
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  signal(WTERMSIG(status), SIG_DFL);
  raise(WTERMSIG(status));
  return start_request::cannot_start;
}

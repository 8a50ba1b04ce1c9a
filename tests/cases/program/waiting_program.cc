/// The program waiting to be started, for tests that start it often. Preloaded into it, this keeps it from
/// its main once its libraries are loaded and initialised, a third of a second of a core for 250 of them. For
/// each request of tests/cases/program/hand_over.cc a fork of it goes on into main, with the arguments,
/// environment, folder and streams of who asked.
///
/// WAITING_PROGRAM: the number of its end of a socket. It ends when all other ends are closed.
#include <dlfcn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "tests/cases/program/start_request.h"

namespace {

using Main = int(int, char**, char**);
Main* program = nullptr;

/// Becomes who asked. Its arguments.
std::vector<char*> take_over(const start_request::Received& request) {
  // The program reads them until it ends, and libraries after that: they are never freed.
  auto& words = *new std::vector<std::string>(request.words);
  std::size_t next = 0;
  if (chdir(words[next++].c_str()) != 0) _exit(start_request::cannot_start);
  const auto take = [&] {
    std::vector<char*> strings;
    for (auto n = std::stoul(words[next++]); n > 0; --n) strings.push_back(words[next++].data());
    strings.push_back(nullptr);
    return strings;
  };
  auto arguments = take();
  environ = (new std::vector<char*>(take()))->data();
  for (int stream = 0; stream < 3; ++stream)
    if (dup2(request.files[std::size_t(stream)], stream) < 0) _exit(start_request::cannot_start);
  return arguments;
}

/// Starts one fork and tells how it ended. A process of its own waits for it: others may be asked for
/// meanwhile.
/// @return in that fork alone: its arguments
std::vector<char*> start(const start_request::Received& request) {
  const auto waits = fork();
  if (waits != 0) return {};
  const auto started = fork();
  if (started == 0) {
    auto arguments = take_over(request);
    request.close_files();
    return arguments;
  }
  int status = start_request::cannot_start << 8;
  if (started > 0) waitpid(started, &status, 0);
  if (write(request.files[3], &status, sizeof status) != sizeof status) _exit(1);
  _exit(0);
}

int wait_for_starts(int argc, char** argv, char** environment) {
  const char* socket = std::getenv(start_request::socket_variable);
  if (socket == nullptr) return program(argc, argv, environment);
  const int requests = std::atoi(socket);
  for (start_request::Received request; start_request::receive(requests, request); request.close_files()) {
    auto arguments = start(request);
    if (arguments.empty()) {
      while (waitpid(-1, nullptr, WNOHANG) > 0) {
      }
      continue;
    }
    close(requests);
    return program(int(arguments.size()) - 1, arguments.data(), environ);
  }
  while (wait(nullptr) > 0) {
  }
  _exit(0);
}

}  // namespace

// NOLINTNEXTLINE(bugprone-reserved-identifier): the C library's
extern "C" int __libc_start_main(Main* main, int argc, char** argv, void (*init)(), void (*fini)(),
                                 void (*rtld_fini)(), void* stack_end) {
  program = main;
  const auto begin = reinterpret_cast<decltype(&__libc_start_main)>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return begin(wait_for_starts, argc, argv, init, fini, rtld_fini, stack_end);
}

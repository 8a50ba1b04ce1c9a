/// What the tests ask of a waiting program (tests/cases/program/waiting_program.cc).
#pragma once

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

namespace start_request {

inline constexpr auto socket_variable = "WAITING_PROGRAM";
inline constexpr int cannot_start = 126;           ///< the shell's exit code for the same
inline constexpr std::size_t most_bytes = 150000;  ///< a message as a whole

/// Standard input, output and error, and the end of a pipe that takes the status as waitpid gives it.
using Files = std::array<int, 4>;

struct Received {
  /// The folder; the number of arguments, those; the number of settings of the environment, those.
  std::vector<std::string> words;
  Files files{};

  void close_files() const {
    for (const int file : files)
      if (file > STDERR_FILENO) close(file);
  }
};

/// A message's header for one buffer and four files.
struct Message {
  iovec part{};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(Files))> control{};
  msghdr header{};

  Message(char* bytes, std::size_t n) {
    part = {bytes, n};
    header.msg_iov = &part;
    header.msg_iovlen = 1;
    header.msg_control = control.data();
    header.msg_controllen = control.size();
  }
  Message(const Message&) = delete;
  Message& operator=(const Message&) = delete;
};

/// @return whether it was taken
inline bool send(int socket, const std::vector<std::string>& words, const Files& files) {
  std::string bytes;
  for (const auto& word : words) bytes += word + '\0';
  if (bytes.size() > most_bytes) return false;
  Message message(bytes.data(), bytes.size());
  auto* control = CMSG_FIRSTHDR(&message.header);
  control->cmsg_level = SOL_SOCKET;
  control->cmsg_type = SCM_RIGHTS;
  control->cmsg_len = CMSG_LEN(sizeof files);
  std::memcpy(CMSG_DATA(control), files.data(), sizeof files);
  return sendmsg(socket, &message.header, MSG_NOSIGNAL) == ssize_t(bytes.size());
}

/// @return whether there was one: not when all other ends are closed
inline bool receive(int socket, Received& request) {
  std::string bytes(most_bytes, '\0');
  Message message(bytes.data(), bytes.size());
  const auto n = recvmsg(socket, &message.header, MSG_CMSG_CLOEXEC);
  const auto* control = CMSG_FIRSTHDR(&message.header);
  if (n <= 0 || control == nullptr || control->cmsg_len != CMSG_LEN(sizeof(Files))) return false;
  std::memcpy(request.files.data(), CMSG_DATA(control), sizeof(Files));
  request.words.clear();
  for (std::size_t at = 0; at < std::size_t(n); at += request.words.back().size() + 1)
    request.words.emplace_back(bytes.data() + at);
  return true;
}

}  // namespace start_request

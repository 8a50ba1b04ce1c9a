#include "fem/ranks/message.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace fem {

namespace {
constexpr int message_tag = 1;
constexpr std::size_t piece = std::size_t(1) << 30;  // MPI counts in int
constexpr std::size_t piece_of_growth = std::size_t(1) << 20;
}  // namespace

void Message::put(const void* from, std::size_t n_bytes) {
  const auto* first = static_cast<const char*>(from);
  if (n_bytes > piece_of_growth) bytes_.reserve(bytes_.size() + n_bytes);  // not twice of it
  bytes_.insert(bytes_.end(), first, first + n_bytes);
}

void Message::get(void* to, std::size_t n_bytes) {
  if (bytes_.size() - read_ < n_bytes) throw std::logic_error("a message between ranks is too short");
  if (n_bytes > 0) std::memcpy(to, bytes_.data() + read_, n_bytes);
  read_ += n_bytes;
}

void Message::send(int to, MPI_Comm communicator) const {
  const std::size_t size = bytes_.size();
  MPI_Send(&size, sizeof size, MPI_BYTE, to, message_tag, communicator);
  for (std::size_t at = 0; at < size; at += piece)
    MPI_Send(bytes_.data() + at, static_cast<int>(std::min(piece, size - at)), MPI_BYTE, to, message_tag,
             communicator);
}

Message Message::receive(int from, MPI_Comm communicator) {
  std::size_t size = 0;
  MPI_Recv(&size, sizeof size, MPI_BYTE, from, message_tag, communicator, MPI_STATUS_IGNORE);
  Message message;
  message.bytes_.resize(size);
  for (std::size_t at = 0; at < size; at += piece)
    MPI_Recv(message.bytes_.data() + at, static_cast<int>(std::min(piece, size - at)), MPI_BYTE, from,
             message_tag, communicator, MPI_STATUS_IGNORE);
  return message;
}

}  // namespace fem

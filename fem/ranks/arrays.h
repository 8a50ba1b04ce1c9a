/// Arrays of numbers from one MPI rank to another. Internal to fem.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <type_traits>

namespace fem {

inline constexpr int array_tag = 1;
inline constexpr std::size_t array_bytes_at_once = std::size_t(1) << 30;  // MPI counts in int

/// @param values  a vector of the standard library or of Eigen
template <typename Array>
void send_array(const Array& values, int to, MPI_Comm communicator) {
  static_assert(std::is_trivially_copyable_v<std::decay_t<decltype(*values.data())>>);
  const std::size_t n_bytes = std::size_t(values.size()) * sizeof(*values.data());
  MPI_Send(&n_bytes, sizeof n_bytes, MPI_BYTE, to, array_tag, communicator);
  const char* from = reinterpret_cast<const char*>(values.data());
  for (std::size_t at = 0; at < n_bytes; at += array_bytes_at_once)
    MPI_Send(from + at, int(std::min(array_bytes_at_once, n_bytes - at)), MPI_BYTE, to, array_tag,
             communicator);
}

template <typename Array>
void receive_array(Array& values, int from, MPI_Comm communicator) {
  std::size_t n_bytes = 0;
  MPI_Recv(&n_bytes, sizeof n_bytes, MPI_BYTE, from, array_tag, communicator, MPI_STATUS_IGNORE);
  values.resize(n_bytes / sizeof(*values.data()));
  char* to = reinterpret_cast<char*>(values.data());
  for (std::size_t at = 0; at < n_bytes; at += array_bytes_at_once)
    MPI_Recv(to + at, int(std::min(array_bytes_at_once, n_bytes - at)), MPI_BYTE, from, array_tag,
             communicator, MPI_STATUS_IGNORE);
}

}  // namespace fem

#include "fem/mesh/ranks/ranks.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <thread>

#include "fem/base/common/memory.h"

namespace fem {

namespace {

bool mpi_runs() {
  int started = 0, ended = 0;
  MPI_Initialized(&started);
  MPI_Finalized(&ended);
  return started != 0 && ended == 0;
}

}  // namespace

int n_ranks(MPI_Comm communicator) {
  int n = 1;
  if (mpi_runs()) MPI_Comm_size(communicator, &n);
  return n;
}

int this_rank(MPI_Comm communicator) {
  int rank = 0;
  if (mpi_runs()) MPI_Comm_rank(communicator, &rank);
  return rank;
}

void agree(MPI_Comm communicator, const std::function<void()>& step) {
  const int n = n_ranks(communicator);
  if (n == 1) return step();
  int mine = n, first = n;
  std::string message;
  try {
    step();
  } catch (const std::exception& error) {
    mine = this_rank(communicator);
    message = error.what();
  }
  MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, communicator);
  if (first == n) return;
  int length = static_cast<int>(message.size());
  MPI_Bcast(&length, 1, MPI_INT, first, communicator);
  message.resize(length);
  MPI_Bcast(message.data(), length, MPI_CHAR, first, communicator);
  throw FailedTogether(message);
}

void wait_for_all(MPI_Comm communicator) {
  if (n_ranks(communicator) == 1) return;
  MPI_Request request;
  MPI_Ibarrier(communicator, &request);
  for (int done = 0; done == 0;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done == 0) std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

void on_first_rank(MPI_Comm communicator, const std::function<void()>& step) {
  std::exception_ptr thrown;
  try {
    agree(communicator, [&] {
      if (this_rank(communicator) == 0) try {
          step();
        } catch (...) {
          thrown = std::current_exception();
          wait_for_all(communicator);
          throw;
        }
      wait_for_all(communicator);
    });
  } catch (const FailedTogether&) {
    if (thrown) std::rethrow_exception(thrown);
    throw;
  }
}

void sum_over_ranks(MPI_Comm communicator, double* values, std::size_t n) {
  const int n_of_ranks = n_ranks(communicator);
  if (n_of_ranks == 1) return;
  std::vector<double> all(n * std::size_t(n_of_ranks));
  MPI_Allgather(values, int(n), MPI_DOUBLE, all.data(), int(n), MPI_DOUBLE, communicator);
  for (std::size_t i = 0; i < n; ++i) {
    values[i] = all[i];
    for (std::size_t r = 1; r < std::size_t(n_of_ranks); ++r) values[i] += all[r * n + i];
  }
}

namespace {

/// MPI counts in 31 bits.
constexpr std::size_t most_at_once = std::size_t(1) << 27;

template <typename T>
void complete(MPI_Comm communicator, T* values, std::size_t n, MPI_Datatype type) {
  if (n_ranks(communicator) == 1) return;
  for (std::size_t first = 0; first < n; first += most_at_once)
    MPI_Allreduce(MPI_IN_PLACE, values + first, int(std::min(most_at_once, n - first)), type, MPI_SUM,
                  communicator);
}

}  // namespace

void complete(MPI_Comm communicator, double* values, std::size_t n) {
  complete(communicator, values, n, MPI_DOUBLE);
}
void complete(MPI_Comm communicator, float* values, std::size_t n) {
  complete(communicator, values, n, MPI_FLOAT);
}
void complete(MPI_Comm communicator, std::int32_t* values, std::size_t n) {
  complete(communicator, values, n, MPI_INT32_T);
}

void add_on_first(MPI_Comm communicator, double* values, std::size_t n) {
  const bool first_rank = this_rank(communicator) == 0;
  for (std::size_t first = 0; first < n; first += most_at_once)
    MPI_Reduce(first_rank ? MPI_IN_PLACE : values + first, values + first,
               int(std::min(most_at_once, n - first)), MPI_DOUBLE, MPI_SUM, 0, communicator);
}

void take_from_first(MPI_Comm communicator, void* values, std::size_t n_bytes) {
  if (n_ranks(communicator) == 1) return;
  for (std::size_t first = 0; first < n_bytes; first += most_at_once)
    MPI_Bcast(static_cast<char*>(values) + first, int(std::min(most_at_once, n_bytes - first)), MPI_BYTE, 0,
              communicator);
}

std::vector<RankWork> gather_work(MPI_Comm communicator, const RankWork& mine) {
  std::vector<RankWork> all(n_ranks(communicator));
  MPI_Allgather(&mine, sizeof mine, MPI_BYTE, all.data(), sizeof mine, MPI_BYTE, communicator);
  return all;
}

double memory_of_all_machines(MPI_Comm communicator) {
  if (n_ranks(communicator) == 1) return physical_memory();
  MPI_Comm machine;
  MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  const double mine = this_rank(machine) == 0 ? physical_memory() : 0;
  MPI_Comm_free(&machine);
  double sum = 0;
  MPI_Allreduce(&mine, &sum, 1, MPI_DOUBLE, MPI_SUM, communicator);
  return sum;
}

double free_memory_of_rank(MPI_Comm communicator) {
  if (n_ranks(communicator) == 1) return free_memory();
  MPI_Comm machine;
  MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  const int n = n_ranks(machine);
  MPI_Comm_free(&machine);
  return free_memory() / n;
}

}  // namespace fem

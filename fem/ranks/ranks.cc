#include "fem/ranks/ranks.h"

#include <iostream>

#include "fem/common/memory.h"

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

void together(MPI_Comm communicator, const std::function<void()>& work) {
  try {
    work();
  } catch (const FailedTogether&) {
    throw;
  } catch (const std::exception& error) {
    std::cerr << "rank " << this_rank(communicator) << ": " << error.what() << std::endl;
    MPI_Abort(communicator, 3);
  }
}

Eigen::ArrayXd sum_over_ranks(MPI_Comm communicator, const Eigen::ArrayXd& mine) {
  const int n = n_ranks(communicator), size = static_cast<int>(mine.size());
  Eigen::ArrayXXd all(size, n);
  MPI_Allgather(mine.data(), size, MPI_DOUBLE, all.data(), size, MPI_DOUBLE, communicator);
  Eigen::ArrayXd sum = all.col(0);
  for (int r = 1; r < n; ++r) sum += all.col(r);
  return sum;
}

std::vector<RankWork> gather_work(MPI_Comm communicator, const RankWork& mine) {
  std::vector<RankWork> all(n_ranks(communicator));
  MPI_Allgather(&mine, sizeof mine, MPI_BYTE, all.data(), sizeof mine, MPI_BYTE, communicator);
  return all;
}

double memory_of_all_machines(MPI_Comm communicator) {
  MPI_Comm machine;
  MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  const double mine = this_rank(machine) == 0 ? physical_memory() : 0;
  MPI_Comm_free(&machine);
  double sum = 0;
  MPI_Allreduce(&mine, &sum, 1, MPI_DOUBLE, MPI_SUM, communicator);
  return sum;
}

}  // namespace fem

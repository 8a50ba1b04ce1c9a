#include "fem/ranks/helper_ranks.h"

#include <chrono>
#include <thread>

#include "fem/ranks/ranks.h"

namespace fem {

namespace {

constexpr int task_tag = 4;
bool others_work = false;  // on rank 0

void tell(const HelperCall& call, MPI_Comm communicator) {
  for (int r = 1; r < n_ranks(communicator); ++r)
    MPI_Send(&call, sizeof call, MPI_BYTE, r, task_tag, communicator);
}

}  // namespace

HelperCall wait_for_call(MPI_Comm communicator) {
  int is_there = 0;
  while (true) {
    MPI_Iprobe(0, task_tag, communicator, &is_there, MPI_STATUS_IGNORE);
    if (is_there != 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  HelperCall call;
  MPI_Recv(&call, sizeof call, MPI_BYTE, 0, task_tag, communicator, MPI_STATUS_IGNORE);
  return call;
}

void let_others_work(MPI_Comm communicator) {
  others_work = true;
  tell({Task::own_work, 0}, communicator);
}

void others_have_worked() {
  others_work = false;
}

void dismiss_helpers(int exit_code, MPI_Comm communicator) {
  if (others_work) MPI_Abort(communicator, exit_code);
  tell({Task::end, exit_code}, communicator);
}

void call_helpers(Task task, MPI_Comm communicator) {
  tell({task, 0}, communicator);
}

}  // namespace fem

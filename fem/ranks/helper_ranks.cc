#include "fem/ranks/helper_ranks.h"

#include <array>
#include <chrono>
#include <thread>

#include "fem/ranks/ranks.h"

namespace fem {

namespace {

constexpr int task_tag = 4;
using Call = std::array<int, 2>;  // task, exit code
bool others_work = false;         // on rank 0

void tell(const Call& call, MPI_Comm communicator) {
  for (int r = 1; r < n_ranks(communicator); ++r)
    MPI_Send(call.data(), 2, MPI_INT, r, task_tag, communicator);
}

}  // namespace

HelperCall wait_for_call(MPI_Comm communicator) {
  int is_there = 0;
  while (true) {
    MPI_Iprobe(0, task_tag, communicator, &is_there, MPI_STATUS_IGNORE);
    if (is_there != 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  Call call{};
  MPI_Recv(call.data(), 2, MPI_INT, 0, task_tag, communicator, MPI_STATUS_IGNORE);
  return {Task(call[0]), call[1]};
}

void let_others_work(MPI_Comm communicator) {
  others_work = true;
  tell({int(Task::own_work), 0}, communicator);
}

void others_have_worked() {
  others_work = false;
}

void dismiss_helpers(int exit_code, MPI_Comm communicator) {
  if (others_work) MPI_Abort(communicator, exit_code);
  tell({int(Task::end), exit_code}, communicator);
}

void call_helpers(Task task, MPI_Comm communicator) {
  tell({int(task), 0}, communicator);
}

}  // namespace fem

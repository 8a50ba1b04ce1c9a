#include "fem/ranks/helper_ranks.h"

#include <array>
#include <chrono>
#include <thread>

#include "fem/solvers/direct_on_ranks.h"
#include "fem/solvers/iterative_on_ranks.h"
#include "fem/ranks/ranks.h"
#include "fem/stress/recovery_on_ranks.h"

namespace fem {

namespace {

constexpr int tag = 4;
using Call = std::array<int, 2>;  // task, exit code

/// Sleeps meanwhile: rank 0 may be long in meshing or superposing, and needs the processor.
Call wait_for_call(MPI_Comm communicator) {
  int is_there = 0;
  while (true) {
    MPI_Iprobe(0, tag, communicator, &is_there, MPI_STATUS_IGNORE);
    if (is_there != 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  Call call{};
  MPI_Recv(call.data(), 2, MPI_INT, 0, tag, communicator, MPI_STATUS_IGNORE);
  return call;
}

void tell(const Call& call, MPI_Comm communicator) {
  for (int r = 1; r < n_ranks(communicator); ++r) MPI_Send(call.data(), 2, MPI_INT, r, tag, communicator);
}

void help(Task task, MPI_Comm communicator) {
  if (task == Task::tell_memory) memory_of_all_machines(communicator);
  if (task == Task::solve_directly) help_to_solve_directly(communicator);
  if (task == Task::solve_iteratively) help_to_solve_iteratively(communicator);
  if (task == Task::recover_stress) help_to_recover_stress(communicator);
}

}  // namespace

int help_first_rank(MPI_Comm communicator) {
  while (true) {
    const auto [task, exit_code] = wait_for_call(communicator);
    if (Task(task) == Task::end) return exit_code;
    const auto asked = Task(task);
    try {
      together(communicator, [&] { help(asked, communicator); });
    } catch (const FailedTogether&) {
      continue;  // rank 0 knows, and says what comes next
    }
  }
}

void dismiss_helpers(int exit_code, MPI_Comm communicator) {
  tell({int(Task::end), exit_code}, communicator);
}

void call_helpers(Task task, MPI_Comm communicator) {
  tell({int(task), 0}, communicator);
}

}  // namespace fem

/// What the ranks beside the first one do: they wait for its calls and take part in its tasks.
#include "fem/ranks/helper_ranks.h"
#include "fem/ranks/ranks.h"
#include "fem/recovery/recovery_on_ranks.h"
#include "fem/solvers/direct_on_ranks.h"
#include "fem/solvers/iterative_on_ranks.h"

namespace fem {

namespace {

void help(Task task, MPI_Comm communicator, const std::function<void()>& own_work) {
  if (task == Task::own_work) own_work();
  if (task == Task::tell_memory) memory_of_all_machines(communicator);
  if (task == Task::solve_directly) help_to_solve_directly(communicator);
  if (task == Task::solve_iteratively) help_to_solve_iteratively(communicator);
  if (task == Task::recover_stress) help_to_recover_stress(communicator);
}

}  // namespace

int help_first_rank(MPI_Comm communicator, const std::function<void()>& own_work) {
  while (true) {
    const auto [task, exit_code] = wait_for_call(communicator);
    if (task == Task::end) return exit_code;
    const Task asked = task;  // structured bindings cannot be captured
    try {
      together(communicator, [&] { help(asked, communicator, own_work); });
    } catch (const FailedTogether&) {
      continue;  // rank 0 knows, and says what comes next
    }
  }
}

}  // namespace fem

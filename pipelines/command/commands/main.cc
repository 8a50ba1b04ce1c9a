#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "fem/base/common/blas_kernels.h"
#include "fem/mesh/ranks/ranks.h"
#include "fem/models/solid/model.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/failure.h"
#include "pipelines/base/common/process_limits.h"
#include "pipelines/base/common/several_ranks.h"
#include "pipelines/base/common/version.h"
#include "pipelines/command/options/command_line.h"
#include "pipelines/command/options/commands.h"

namespace {

/// Runs a command and turns what it throws into a message and an exit code.
template <typename Command>
int guarded(Command&& command) {
  try {
    command();
    return pipelines::done;
  } catch (...) {
    const auto failure = pipelines::failure_in_flight();
    std::cerr << failure.message << '\n';
    return failure.code;
  }
}

/// Whether stdout is a pipe whose reader has gone, as `head` does once it has its lines.
bool reader_of_stdout_has_gone() {
  pollfd out{STDOUT_FILENO, POLLOUT, 0};
  return poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0;
}

/// What was printed may wait in buffers until now: a full disk behind stdout shows here at the latest. Where
/// its reader has gone, the process ends by SIGPIPE, as others in a pipeline do, but after its work.
void require_written_stdout() {
  std::cout.flush();
  if (std::cout) return;
  if (reader_of_stdout_has_gone() && !pipelines::interruption::closed_pipes_are_ignored) {
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
  }
  throw pipelines::FileError("standard output cannot be written; is it closed, or the disk full behind it?");
}

/// A value that a script forgot must not mean the default, and the shell's word for stdout no file of that
/// name.
void refuse_forgotten_values(CLI::App& app) {
  for (auto* command : app.get_subcommands([](CLI::App*) { return true; }))
    for (auto* option : command->get_options())
      if (option->get_type_size() > 0)
        option->check([remedy = option->get_required() ? "" : ", or leave it out"](const std::string& value) {
          if (value == "-")
            return std::string("is -, which would be a file of that name; give another") + remedy;
          return value.empty() ? std::string("is empty; give a value") + remedy : "";
        });
}

std::vector<pipelines::CommandNames> names_of_commands(const CLI::App& app) {
  std::vector<pipelines::CommandNames> commands;
  for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back({command->get_name(), {}});
    for (const auto* option : command->get_options()) {
      for (const auto& name : option->get_lnames()) commands.back().options.push_back("--" + name);
      for (const auto& name : option->get_snames()) commands.back().options.push_back("-" + name);
    }
  }
  return commands;
}

/// Prints what is wrong with a command line.
/// @param arguments  without the program's name
/// @return 0 for --help and --version
int refuse(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& arguments) {
  const bool asks_for_text = error.get_exit_code() == 0;
  const auto unknown =
      asks_for_text ? std::string() : pipelines::unknown_name(arguments, names_of_commands(app));
  if (unknown.empty()) return app.exit(error);
  std::cerr << unknown << '\n';
  return pipelines::scene_is_wrong;
}

/// Ranks that all fail alike say so once, by the first of them. One that fails by itself leaves the others
/// waiting in what they do together: it says so, and ends them all.
class CommonEnd {
public:
  CommonEnd() { MPI_Comm_dup(MPI_COMM_WORLD, &communicator_); }  // what ranks do together has the other one

  /// @param failure  failure of this rank; its code is done if there is none
  /// @param is_told  that has been printed
  /// @return what the program ends with
  int end(const pipelines::Failure& failure, bool is_told) const {
    constexpr std::chrono::seconds patience(3);
    MPI_Request all_are_here;
    MPI_Ibarrier(communicator_, &all_are_here);
    const auto start = std::chrono::steady_clock::now();
    for (int are_here = 0; MPI_Test(&all_are_here, &are_here, MPI_STATUS_IGNORE), are_here == 0;) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (failure.code == pipelines::done || std::chrono::steady_clock::now() - start < patience) continue;
      if (!is_told) tell(failure);
      MPI_Abort(MPI_COMM_WORLD, failure.code);
    }
    int code = failure.code, of_first = code;
    MPI_Bcast(&of_first, 1, MPI_INT, 0, communicator_);
    if (of_first == pipelines::done && code != pipelines::done && !is_told) tell(failure);
    MPI_Allreduce(MPI_IN_PLACE, &code, 1, MPI_INT, MPI_MAX, communicator_);
    return of_first == pipelines::done ? code : of_first;
  }

private:
  static void tell(const pipelines::Failure& failure) {
    std::cerr << "rank " << fem::this_rank(MPI_COMM_WORLD) << ": " << failure.message << std::endl;
  }

  MPI_Comm communicator_ = MPI_COMM_NULL;
};

/// The program on one of several ranks: the first does what the arguments say, the others their part of it.
int run_on_ranks(const pipelines::ChosenCommand& chosen) {
  const CommonEnd common;
  if (fem::this_rank(MPI_COMM_WORLD) == 0) {
    if (!chosen.on_other_ranks) pipelines::work_on_bodies_alone();
    pipelines::Failure failure{pipelines::done, ""};
    failure.code = pipelines::ExitCode(guarded([&] {
      chosen.run(std::cout);
      require_written_stdout();
    }));
    return common.end(failure, true);
  }
  auto* const terminal = std::cerr.rdbuf(nullptr);  // the first one tells
  pipelines::Failure failure{pipelines::done, ""};
  try {
    const fem::Environment threads(chosen.n_threads);
    if (chosen.on_other_ranks) chosen.on_other_ranks();
  } catch (...) {
    failure = pipelines::failure_in_flight();
  }
  std::cerr.rdbuf(terminal);
  return common.end(failure, false);
}

/// Reads the arguments and does what they say.
int run(int argc, char** argv) {
  const bool first = fem::this_rank(MPI_COMM_WORLD) == 0;
  CLI::App app{
      "From the kinetics of a mill to stress zones in its shaft and chamber.\n"
      "`millstress SCENE.toml` runs the scene; `millstress help COMMAND` lists a command's options."};
  app.set_version_flag("--version", std::string("millstress ") + pipelines::version);
  app.require_subcommand(1);
  pipelines::ChosenCommand chosen;
  for (const auto add :
       {pipelines::add_run_command,       pipelines::add_loads_command,    pipelines::add_effects_command,
        pipelines::add_torsion_command,   pipelines::add_springs_command,  pipelines::add_extremes_command,
        pipelines::add_free_body_command, pipelines::add_history_command,  pipelines::add_sweep_command,
        pipelines::add_optimise_command,  pipelines::add_accuracy_command, pipelines::add_ports_command,
        pipelines::add_calculix_command,  pipelines::add_report_command,   pipelines::add_compare_command,
        pipelines::add_check_command,     pipelines::add_init_command,     pipelines::add_materials_command,
        pipelines::add_manual_command,    pipelines::add_cache_command})
    add(app, chosen);
  refuse_forgotten_values(app);

  const auto arguments = pipelines::with_command(
      std::vector<std::string>(argv + std::min(argc, 1), argv + argc), names_of_commands(app));
  try {
    app.name(argc > 0 ? argv[0] : "");
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ParseError& error) {
    if (!first) return pipelines::done;
    if (refuse(app, error, arguments) != 0) return pipelines::scene_is_wrong;
    return guarded(require_written_stdout);
  }
  if (fem::n_ranks(MPI_COMM_WORLD) > 1) return run_on_ranks(chosen);
  return guarded([&] {
    chosen.run(std::cout);
    require_written_stdout();
  });
}

}  // namespace

int main(int argc, char** argv) {
  fem::restart_with_wide_blas(argv);
  // Else what was printed waits in the C library, whose failures PETSc meets at its end, tells and forgets.
  std::ios::sync_with_stdio(false);
  if (const int fault = guarded(pipelines::require_usable_stack)) return fault;
  std::optional<fem::Environment> ranks;
  if (pipelines::started_on_several_ranks()) try {
      ranks.emplace(0);
    } catch (...) {
      const auto failure = pipelines::failure_in_flight();
      std::cerr << "rank " << pipelines::number_from_launcher() << ": " << failure.message << std::endl;
      std::_Exit(failure.code);  // mpirun ends the others
    }
  const int code = run(argc, argv);
  if (code == pipelines::mesh_or_solve_failed && !ranks && pipelines::memory_is_limited()) {
    std::cout.flush();
    std::fflush(nullptr);
    std::_Exit(code);
  }
  return code;
}

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <optional>

#include "fem/model/model.h"
#include "fem/ranks/helper_ranks.h"
#include "pipelines/commands/commands.h"
#include "pipelines/common/errors.h"
#include "pipelines/common/failure.h"
#include "pipelines/common/several_ranks.h"
#include "pipelines/common/version.h"

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

/// What was printed may wait in buffers until now: a full disk behind stdout shows here at the latest.
void require_written_stdout() {
  std::cout.flush();
  if (std::cout && std::fflush(stdout) == 0) return;
  throw pipelines::FileError("standard output cannot be written; is the disk full behind it?");
}

/// The program on this rank: rank 0 does what the arguments say, any other one helps it to solve or works
/// beside it.
int run(int argc, char** argv) {
  const bool first = fem::this_rank(MPI_COMM_WORLD) == 0;
  CLI::App app{"From the kinetics of a mill to stress zones in its shaft and chamber."};
  app.set_version_flag("--version", std::string("millstress ") + pipelines::version);
  app.require_subcommand(1);
  pipelines::ChosenCommand chosen;
  for (const auto add :
       {pipelines::add_run_command, pipelines::add_loads_command, pipelines::add_effects_command,
        pipelines::add_torsion_command, pipelines::add_springs_command, pipelines::add_extremes_command,
        pipelines::add_free_body_command, pipelines::add_history_command, pipelines::add_sweep_command,
        pipelines::add_accuracy_command, pipelines::add_ports_command, pipelines::add_calculix_command,
        pipelines::add_report_command, pipelines::add_check_command, pipelines::add_init_command})
    add(app, chosen);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (first) {
      if (app.exit(error) != 0) return pipelines::scene_is_wrong;
      return guarded(require_written_stdout);
    }
  }
  if (!first) {
    const fem::Environment threads(chosen.n_threads);
    return fem::help_first_rank(MPI_COMM_WORLD, chosen.beside_first_rank);
  }
  return guarded([&] {
    chosen.run(std::cout);
    require_written_stdout();
  });
}

}  // namespace

int main(int argc, char** argv) {
  std::optional<fem::Environment> ranks;
  if (pipelines::started_on_several_ranks()) ranks.emplace(0);
  const int code = run(argc, argv);
  if (ranks && fem::this_rank(MPI_COMM_WORLD) == 0) fem::dismiss_helpers(code);
  return code;
}

#include <CLI/CLI.hpp>
#include <iostream>
#include <optional>

#include "fem/model/model.h"
#include "fem/ranks/helper_ranks.h"
#include "pipelines/commands/commands.h"
#include "pipelines/common/failure.h"
#include "pipelines/common/fem_environment.h"
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

/// The program on this rank: rank 0 does what the arguments say, any other one helps it to solve.
int run(int argc, char** argv) {
  const bool first = fem::this_rank(MPI_COMM_WORLD) == 0;
  CLI::App app{"From the kinetics of a mill to stress zones in its shaft."};
  app.set_version_flag("--version", std::string("millstress ") + pipelines::version);
  app.require_subcommand(1);
  pipelines::CommandOptions options;
  bool quiet = false, verbose = false;

  const auto add = [&](const char* name, const char* description) {
    auto* command = app.add_subcommand(name, description);
    command->add_option("scene", options.scene, "scene file (TOML)")->required();
    command->add_flag("-q,--quiet", quiet, "no progress");
    command->add_flag("-v,--verbose", verbose, "more progress");
    return command;
  };
  auto* run = add("run", "everything: loads, mesh, stresses, zones, results");
  run->add_option("-o,--output", options.output, "result directory (default: results/<scene>)");
  run->add_option("--threads", options.n_threads, "threads to use (default: all cores)")
      ->check(CLI::Range(1, 1024));
  run->add_option("--tolerance", options.tolerance,
                  "refine until the stress is known this well, like \"2 %\" (default: the scene's)");
  run->add_option("--time-limit", options.time_limit,
                  "stop refining in time, like \"60 s\" (default: the scene's)");
  run->add_option("--method", options.method,
                  "model of every body: auto, beam, axisymmetric or solid (default: the scene's)");
  run->add_flag("--fresh", options.fresh, "reuse nothing of an earlier run");
  run->add_flag("--json", options.json, "print summary.json instead of the table");
  auto* loads = add("loads", "the load stage alone");
  loads->add_option("-o,--output", options.output, "write the load history to this HDF5 file");
  loads->add_option("--csv", options.csv, "write the load history to this CSV file");
  loads->add_option("--statistics", options.statistics,
                    "write extremes, harmonics, polar plots and load spectra to this directory");
  loads->add_option("--calculix", options.calculix,
                    "write PREFIX_amplitudes.inp and PREFIX_loads.inp for CalculiX");
  loads->add_flag("--json", options.json, "print the summary as JSON instead of the table");
  auto* effects =
      add("effects", "each effect's share of the loads, what leaving it out changes, what it costs");
  effects->add_option(
      "--threshold", options.threshold,
      "what may change when effects are left out (default: \"1 %\"; with effects = \"auto\" a tenth "
      "of the tolerance)");
  effects->add_flag("--json", options.json, "print JSON instead of the table");
  auto* torsion = add("torsion", "natural frequencies, forced response and resonances of a drive train");
  torsion->add_option("-o,--output", options.output,
                      "write modes, response, Campbell table to this directory");
  torsion->add_flag("--json", options.json, "print JSON instead of the tables");
  auto* springs = add("springs", "the stiffness that loads a vibratory mill's bearings least");
  springs->add_flag("--json", options.json, "print JSON instead of the table");
  auto* extremes = add("extremes", "a vibratory mill's loads over all angles of drive and charge");
  extremes->add_flag("--json", options.json, "print JSON instead of the table");
  auto* accuracy = add("accuracy", "what accuracy costs in time: error against seconds, as table and chart");
  accuracy->add_option("-o,--output", options.output, "result directory (default: results/<scene>)");
  accuracy->add_option("--body", options.body, "this body alone, like shaft");
  accuracy->add_option("--tolerance", options.tolerance,
                       "what a run is chosen for (default: the scene's, or \"5 %\")");
  accuracy->add_option("--time-limit", options.time_limit, "for each body (default: \"600 s\")");
  accuracy->add_option("--reference", options.reference,
                       "a known stress, like \"104.8 MPa\" (default: an overkill run)");
  accuracy->add_flag("--gci", options.grid_convergence,
                     "three systematic meshes too: observed order and grid convergence index");
  accuracy->add_option("--repeats", options.n_repeats, "of every run, for the spread of its seconds")
      ->check(CLI::Range(1, 100));
  accuracy->add_option("--threads", options.n_threads, "threads to use (default: all cores)")
      ->check(CLI::Range(1, 1024));
  auto* ports = add("ports", "pictures of the bodies with their ports coloured and named");
  ports->add_option("-o,--output", options.output, "result directory (default: results/<scene>)");
  auto* calculix = add("calculix", "the bodies' meshes and unit loads as input files of CalculiX");
  calculix->add_option("-o,--output", options.output,
                       "directory of the <body>.inp (default: results/<scene>)");
  auto* report = app.add_subcommand("report", "report.html of a result directory, anew from its files");
  report->add_option("directory", options.output, "result directory of a run")->required();
  auto* check =
      add("check",
          "validate the scene, list effects, defaults, ports and channels, estimate the cost; solve nothing");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (first) return app.exit(error) == 0 ? pipelines::done : pipelines::scene_is_wrong;
  }
  if (!first) {
    const pipelines::FemEnvironment threads(options.n_threads);
    return fem::help_first_rank();
  }
  using pipelines::Verbosity;
  options.verbosity = quiet ? Verbosity::quiet : verbose ? Verbosity::verbose : Verbosity::normal;

  return guarded([&] {
    if (run->parsed()) {
      pipelines::run_command(options, std::cout);
    } else if (loads->parsed()) {
      pipelines::loads_command(options, std::cout);
    } else if (effects->parsed()) {
      pipelines::effects_command(options, std::cout);
    } else if (torsion->parsed()) {
      pipelines::torsion_command(options, std::cout);
    } else if (springs->parsed()) {
      pipelines::springs_command(options, std::cout);
    } else if (extremes->parsed()) {
      pipelines::extremes_command(options, std::cout);
    } else if (accuracy->parsed()) {
      pipelines::accuracy_command(options, std::cout);
    } else if (ports->parsed()) {
      pipelines::ports_command(options, std::cout);
    } else if (calculix->parsed()) {
      pipelines::calculix_command(options, std::cout);
    } else if (report->parsed()) {
      pipelines::report_command(options, std::cout);
    } else if (check->parsed()) {
      pipelines::check_command(options, std::cout);
    }
  });
}

}  // namespace

int main(int argc, char** argv) {
  std::optional<fem::Environment> ranks;
  if (pipelines::started_on_several_ranks()) ranks.emplace(argc, argv, 0);
  const int code = run(argc, argv);
  if (ranks && fem::this_rank(MPI_COMM_WORLD) == 0) fem::dismiss_helpers(code);
  return code;
}

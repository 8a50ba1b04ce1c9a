/// The commands of the program: each is registered and carried out in a file of its own, <name>_command.cc.
/// Results go to the stream that a command is given, progress to stderr. Commands throw what went wrong; the
/// program turns that into a message and an exit code.
#pragma once

#include <functional>
#include <iosfwd>
#include <memory>

namespace CLI {
class App;
}

namespace pipelines {

/// The command that the arguments ask for, told by its callback. It runs after they are parsed, so that what
/// it throws is no mistake of the command line.
struct ChosenCommand {
  std::function<void(std::ostream& out)> run;
  /// What the MPI ranks beside the first one do meanwhile; empty: nothing, and the first one works alone.
  std::function<void()> on_other_ranks;
  int n_threads = 0;  ///< 0: all cores
};

/// The callback of a command: it is chosen, and will be carried out with its options.
/// @param carry_out  called with the options and the stream for results
template <typename Options, typename CarryOut>
std::function<void()> to_choose(ChosenCommand& chosen, std::shared_ptr<Options> options, CarryOut carry_out) {
  return [&chosen, options, carry_out] {
    chosen.run = [options, carry_out](std::ostream& out) { carry_out(*options, out); };
  };
}

/// `millstress run`: everything. The directory defaults to results/<scene's name>.
void add_run_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress loads`: the load stage alone.
void add_loads_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress manual`: the manual page, and scripts by which shells complete.
void add_manual_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress effects`: what each effect of the scene is worth in the loads, and what it costs.
void add_effects_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress torsion`: a drive train's natural frequencies, forced response and resonances. -o: a directory
/// of CSV files.
void add_torsion_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress springs`: the stiffness that loads a vibratory mill's bearings least.
void add_springs_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress extremes`: a vibratory mill's loads over all angles of drive and charge.
void add_extremes_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress free-body`: all forces on a vibratory mill's chamber, at an angle and over the turn.
void add_free_body_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress history`: stress over the cycle at chosen points, after a run. The directory defaults to
/// results/<scene's name>_history.
void add_history_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress sweep`: many operating points as one table. The directory defaults to
/// results/<scene's name>_sweep.
void add_sweep_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress optimise`: keys by which a figure is least or largest within bounds. The directory defaults to
/// results/<scene's name>_optimum.
void add_optimise_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress accuracy`: error against seconds on every model, from beam to solid, as table, CSV, HDF5
/// and chart. The directory defaults to results/<scene's name>; files go into its folder accuracy.
void add_accuracy_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress ports`: every body's surface with its ports marked, as VTU and as a picture. The directory
/// defaults to results/<scene's name>. Meshes the bodies, solves nothing.
void add_ports_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress calculix`: every body's mesh and unit loads as <body>.inp for CalculiX. The directory defaults
/// to results/<scene's name>. Solves nothing.
void add_calculix_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress compare`: result directories and scenes side by side. -o: a directory of files.
void add_compare_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress report`: report.html of a result directory, anew.
void add_report_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress init`: a commented scene that runs, for the user to change. Replaces nothing.
void add_init_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress check`: validates; prints effects, defaults, ports, channels and the size of the model; solves
/// nothing.
void add_check_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress cache`: what the user's cache holds; empties it.
void add_cache_command(CLI::App& app, ChosenCommand& chosen);

/// `millstress materials`: the library of materials that scenes name.
void add_materials_command(CLI::App& app, ChosenCommand& chosen);

}  // namespace pipelines

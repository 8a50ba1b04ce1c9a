/// The commands of the program, one function each. Results on `out`, progress on stderr. They throw what went
/// wrong; the program turns that into a message and an exit code.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "pipelines/common/progress.h"

namespace pipelines {

struct CommandOptions {
  std::filesystem::path scene;
  std::filesystem::path
      output;  ///< run, ports, calculix: directory; loads: .h5 file; empty: the default or none (loads)
  std::filesystem::path csv;         ///< loads only; empty: none
  std::filesystem::path calculix;    ///< loads only: prefix of the files of cards; empty: none
  std::filesystem::path statistics;  ///< loads only: directory of statistics; empty: none
  std::string threshold;             ///< effects only: what may change when effects are left out; empty: 1 %,
                                     ///< for a scene with effects = "auto" what it allows
  std::string tolerance, time_limit;  ///< run, accuracy: override the scene's; empty: the scene's
  std::string method;                 ///< run only: overrides the scene's; empty: the scene's
  std::string body, reference;        ///< accuracy: of this body alone; a known stress; empty: all, none
  bool grid_convergence = false;      ///< accuracy: systematic meshes too
  int n_repeats = 1;                  ///< accuracy: of each run
  int n_threads = 0;                  ///< 0: all cores
  bool fresh = false;
  bool json = false;  ///< the summary as JSON instead of the table
  Verbosity verbosity = Verbosity::normal;
};

/// `millstress run`: everything. The directory defaults to results/<scene's name>.
void run_command(const CommandOptions& options, std::ostream& out);

/// `millstress loads`: the load stage alone.
void loads_command(const CommandOptions& options, std::ostream& out);

/// `millstress effects`: what each effect of the scene is worth in the loads, and what it costs.
void effects_command(const CommandOptions& options, std::ostream& out);

/// `millstress torsion`: a drive train's natural frequencies, forced response and resonances. -o: a directory
/// of CSV files.
void torsion_command(const CommandOptions& options, std::ostream& out);

/// `millstress springs`: the stiffness that loads a vibratory mill's bearings least.
void springs_command(const CommandOptions& options, std::ostream& out);

/// `millstress extremes`: a vibratory mill's loads over all angles of drive and charge.
void extremes_command(const CommandOptions& options, std::ostream& out);

/// `millstress accuracy`: error against seconds on every model, from beam to solid, as table, CSV, HDF5
/// and chart. The directory defaults to results/<scene's name>; files go into its folder accuracy.
void accuracy_command(const CommandOptions& options, std::ostream& out);

/// `millstress ports`: every body's surface with its ports marked, as VTU and as a picture. The directory
/// defaults to results/<scene's name>. Meshes the bodies, solves nothing.
void ports_command(const CommandOptions& options, std::ostream& out);

/// `millstress calculix`: every body's mesh and unit loads as <body>.inp for CalculiX. The directory defaults
/// to results/<scene's name>. Solves nothing.
void calculix_command(const CommandOptions& options, std::ostream& out);

/// `millstress report`: report.html of a result directory (`output`), anew.
void report_command(const CommandOptions& options, std::ostream& out);

/// `millstress check`: validates; prints effects, defaults, ports, channels and the size of the model; solves
/// nothing.
void check_command(const CommandOptions& options, std::ostream& out);

}  // namespace pipelines

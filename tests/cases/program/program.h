/// Running the program on an edited scene, and reading what it leaves.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/pipelines/examples/results_directory.h"

namespace cases {

namespace fs = std::filesystem;
using Edits = std::vector<std::pair<std::string, std::string>>;

fs::path shipped(const std::string& name);

/// A text with edits, each of which must fit exactly one place.
std::string with_edits(std::string text, const Edits& edits);

/// The text of a shipped scene with edits.
std::string edited(const std::string& scene, const Edits& edits);

/// The text of a shipped scene without what stands from one line to another, the second of which stays.
std::string without(const std::string& scene, const std::string& from, const std::string& to);

/// The default scene with its shaft alone, or its chamber alone, and edits.
std::string shaft_alone(const Edits& edits);
std::string chamber_alone(const Edits& edits);

/// The chamber of the specification, whose stress is known by hand: longer, half as thick, with lower webs.
Edits specified_chamber();

/// The default scene on the coarsest mesh that still has fillets: about 67 k unknowns, seconds instead of a
/// minute, and without pictures. Its stresses are off by a third; what is tested on it does not depend on
/// that.
Edits coarse();

Edits operator+(Edits a, const Edits& b);

/// The material table of a body: C45 as normalised, beginning and ending with a line break.
std::string steel_of(const std::string& body);

fs::path write(const fs::path& file, const std::string& text);

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

/// Arguments of `run` or `history` with `--tolerance none` where neither they nor the scene ask for a
/// tolerance or a time: what is tested is what becomes of one mesh.
std::string on_its_own_mesh(const fs::path& directory, const std::string& arguments);

/// For runs that must not share what a process begins with, such as the places of its memory.
inline const std::string as_a_new_process = ":";

/// Runs `millstress ARGUMENTS` in `directory` on the scene's own mesh, unless they ask for more; what
/// libraries cache stays in there. Stresses are computed on one thread unless the arguments say
/// otherwise: tests run two at a time, and the threads of BLAS wait for each other by yielding, which beside
/// another program costs many times the seconds.
///
/// To load the program takes a third of a second, more than most of what is tested takes then. So a process
/// of it waits behind its loading, and a run is a fork of that: the same program from main on, with its own
/// arguments, environment, folder and streams (waiting_program.cc). Where something else comes before, such
/// as a limit or a setting that counts while it is loaded, the program is loaded anew.
/// @param before  a command of the shell that sets the stage; as_a_new_process: nothing, but loaded anew
Outcome millstress(const fs::path& directory, const std::string& arguments,
                   const std::string& before = "true");

/// The same as the arguments stand: `run` searches by default.
Outcome as_a_user(const fs::path& directory, const std::string& arguments,
                  const std::string& before = "true");

/// How the program is started, for tests that do it themselves: at the same time as others, or to end it.
struct Start {
  fs::path directory;
  std::string arguments;
  std::string before = "true";
  std::string launcher{};  ///< what stands before the program, such as "mpirun -n 2"
  std::string name{};  ///< begins the names of the files that take what it prints: one for each of several
};

/// The launcher for two ranks. mpirun refuses root and more ranks than cores unless told.
std::string two_ranks();

/// One line of the shell; one thread as in as_a_user.
std::string shell_command(const Start& start);

/// What it printed, and its exit code. -1: a signal ended the shell.
/// @param status  as waitpid and std::system give it
Outcome outcome_of(const Start& start, int status);

/// Every file below a directory with its bytes; summary.json, run.json and report.html without their timing,
/// manifest.json without the checksums of that.
std::map<std::string, std::string> contents(const fs::path& directory);

nlohmann::json summary(const fs::path& results);

/// The file of a body's unit responses in the cache of a test.
/// @param directory  the test's, where the program was started
fs::path cached_responses(const fs::path& directory, const std::string& results,
                          const std::string& body = "shaft");

/// What a command prints for machines: its arguments have `--json`.
nlohmann::json json_of(const fs::path& directory, const std::string& arguments);

/// The columns of a CSV file by the names in its header, without the units.
std::map<std::string, std::vector<double>> csv(const fs::path& file);

/// The same in SI, by the units in the header.
std::map<std::string, std::vector<double>> csv_in_si(const fs::path& file);

}  // namespace cases

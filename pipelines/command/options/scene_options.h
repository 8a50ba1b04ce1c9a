/// What all commands on a scene have in common on the command line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/base/common/progress.h"
#include "pipelines/command/options/commands.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// The options of a command begin with these.
struct SceneOptions {
  std::filesystem::path scene;
  std::vector<std::string> settings;    ///< --set KEY=VALUE, each
  bool quiet = false, verbose = false;  ///< quiet wins
  bool force = false;                   ///< --force of commands that write a directory (result_place.h)

  Verbosity verbosity() const;
};

constexpr int all_cores = 0;  ///< threads of a command without --threads

/// The folder of the scenes that come with the program; empty: they are not where they should be.
std::filesystem::path shipped_scenes();

/// A name without a folder and an ending that is no file here may be a scene that comes with the program.
std::string file_of_scene(const std::string& scene);

/// A subcommand with the scene, --set, -q and -v.
CLI::App* add_scene_command(CLI::App& app, const char* name, const char* description, SceneOptions& options);

/// An option that takes one text each time it is given.
void add_repeated_option(CLI::App& command, const char* name, std::vector<std::string>& values,
                         const char* description);

/// --threads of a command and of the helper ranks.
void add_threads_option(CLI::App& command, int& n_threads, ChosenCommand& chosen);

/// -o of the commands that write into results/<scene's name> unless told otherwise.
void add_results_option(CLI::App& command, std::filesystem::path& output);

}  // namespace pipelines

#include "pipelines/command/options/scene_options.h"

#include <CLI/CLI.hpp>

namespace pipelines {
namespace {

namespace fs = std::filesystem;

/// Where scenes that come with the program lie, from the program's own place: installed, or in its build.
constexpr const char* scene_folders[] = {"../../share/millstress/scenes", "../pipelines/scenes"};

}  // namespace

std::string file_of_scene(const std::string& scene) {
  std::error_code none;
  fs::path name(scene);
  if (name.has_parent_path() || name.has_extension() || name.empty() ||
      fs::exists(fs::symlink_status(name, none)))
    return scene;
  name += ".toml";
  const auto file = shipped_scenes() / name;
  return fs::is_regular_file(file, none) ? file.string() : scene;
}

fs::path shipped_scenes() {
  std::error_code none;
  const auto program = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const auto* folder : scene_folders)
    if (auto scenes = (program / folder).lexically_normal(); fs::is_directory(scenes, none)) return scenes;
  return {};
}

Verbosity SceneOptions::verbosity() const {
  return quiet ? Verbosity::quiet : verbose ? Verbosity::verbose : Verbosity::normal;
}

CLI::App* add_scene_command(CLI::App& app, const char* name, const char* description, SceneOptions& options) {
  auto* command = app.add_subcommand(name, description);
  command
      ->add_option("scene", options.scene,
                   "scene file (TOML), or the name of one that comes with the program")
      ->required()
      ->transform(CLI::Validator(
          [](std::string& scene) {
            scene = file_of_scene(scene);
            return std::string();
          },
          ""));
  add_repeated_option(*command, "--set", options.settings,
                      "KEY=VALUE: a key of the scene as if the file said so; may be repeated");
  command->add_flag("-q,--quiet", options.quiet, "no progress");
  command->add_flag("-v,--verbose", options.verbose, "more progress");
  return command;
}

void add_repeated_option(CLI::App& command, const char* name, std::vector<std::string>& values,
                         const char* description) {
  command.add_option(name, values, description)->allow_extra_args(false);
}

void add_threads_option(CLI::App& command, int& n_threads, ChosenCommand& chosen) {
  const auto keep = [&](const int& given) { n_threads = chosen.n_threads = given; };
  command.add_option_function<int>("--threads", keep, "threads to use (default: all cores)")
      ->check(CLI::Range(1, 1024));
}

void add_results_option(CLI::App& command, std::filesystem::path& output) {
  command.add_option(
      "-o,--output", output,
      "result directory (default: results/<scene>, or <scene>-2 ... beside results of another --set)");
}

}  // namespace pipelines

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "pipelines/base/common/errors.h"
#include "pipelines/command/options/commands.h"
#include "pipelines/command/options/manual.h"
#include "pipelines/command/options/scene_options.h"
#include "pipelines/scene/reader/scene_schema.h"
#include "pipelines/scene/reader/scene_tree.h"

namespace pipelines {
namespace {

struct ManualOptions {
  const CLI::App* app = nullptr;
  std::string form = "man";
};

/// A load table's body is `shaft` or `part`, whatever its shape comes from: the scene with the other name.
TomlNode with_other_body_name(TomlNode tree) {
  for (auto& entry : tree.entries.own())
    if (entry.key == "shaft" || entry.key == "part") entry.key = entry.key == "part" ? "shaft" : "part";
  return tree;
}

/// All shipped scenes together have every table.
std::string schema_of_shipped() {
  const auto folder = shipped_scenes();
  if (folder.empty())
    throw FileError("manual schema: the scenes that come with the program are not there; install it anew");
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<KeyForms> forms;
  for (const auto& file : files) {
    const auto tree = read_scene_tree(file);
    const auto scene = read_scene(file, tree, {});
    std::vector<std::string> settings;  // that have the reader ask for what it else only knows
    for (const auto& body : scene.bodies) {
      settings.push_back(body.name + ".natural_frequencies=3");
      if (body.name == "shaft")
        for (const char* key : {"shaft.critical_speeds=3", "shaft.bearing_stiffness=1e8"})
          settings.emplace_back(key);
    }
    forms.push_back(read_scene(file, tree, settings).key_forms);
    if (std::holds_alternative<kinetics::LoadTable>(scene.machine) && !scene.bodies.empty())
      forms.push_back(read_scene(file, with_other_body_name(tree), {}).key_forms);
  }
  return scene_schema(forms);
}

void show_manual(const ManualOptions& options, std::ostream& out) {
  out << (options.form == "man"      ? manual_page(*options.app)
          : options.form == "schema" ? schema_of_shipped()
                                     : completion_script(*options.app, options.form));
}

}  // namespace

void add_manual_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<ManualOptions>();
  options->app = &app;
  auto* command = app.add_subcommand(
      "manual", "the manual page for man, what a shell completes by, or the schema of scenes for editors");
  command->add_option("form", options->form, "man, bash, zsh, fish or schema (JSON)")
      ->check(CLI::IsMember({"man", "bash", "zsh", "fish", "schema"}));
  command->callback(to_choose(chosen, options, show_manual));
}

}  // namespace pipelines

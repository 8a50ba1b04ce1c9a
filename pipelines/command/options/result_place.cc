#include "pipelines/command/options/result_place.h"

#include <CLI/CLI.hpp>
#include <iostream>

#include "pipelines/base/common/errors.h"

namespace pipelines {

void add_force_option(CLI::App& command, SceneOptions& options) {
  command.add_flag("--force", options.force,
                   "replace what the directory holds of another scene, sweep or --set");
}

std::filesystem::path default_directory(const SceneOptions& options, const std::string& ending) {
  return std::filesystem::path("results") / (options.scene.stem().string() + ending);
}

Variant variant_of(const SceneOptions& options) {
  return {options.scene, options.settings, options.force};
}

std::filesystem::path results_directory(const std::filesystem::path& given,
                                        const std::filesystem::path& by_default, const Variant& variant) {
  if (!given.empty()) return given;
  auto chosen = directory_for(by_default, variant);
  if (chosen != by_default)
    std::cerr << "millstress: " << by_default.string() << " holds " << held_of_another(by_default, variant)
              << "; this goes to " << chosen.string() << " (--force replaces)\n";
  return chosen;
}

void require_own_variant(const std::filesystem::path& directory, const Variant& variant,
                         const std::string& option) {
  if (const auto held = held_of_another(directory, variant); !held.empty())
    throw OptionError(option + ' ' + directory.string() + ": holds " + held +
                      "; add --force to replace it, or choose another directory with " + option);
}

std::filesystem::path own_directory(const std::filesystem::path& given,
                                    const std::filesystem::path& by_default, const Variant& variant) {
  auto directory = results_directory(given, by_default, variant);
  if (!given.empty()) require_own_variant(directory, variant);
  return directory;
}

}  // namespace pipelines

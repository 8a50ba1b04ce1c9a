/// Where a command's results go, so that they replace none of another scene, sweep or --set.
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/command/options/scene_options.h"
#include "pipelines/write/files/variant.h"

namespace pipelines {

/// --force of a command that writes a directory.
void add_force_option(CLI::App& command, SceneOptions& options);

/// The default directory: "results/mill" of mill.toml.
std::filesystem::path default_directory(const SceneOptions& options, const std::string& ending = "");

/// What the scene and --set make; with --force it replaces others.
Variant variant_of(const SceneOptions& options);

/// The directory that was given, or else the first of `by_default`, `by_default`-2 ... that holds nothing of
/// another variant. Says so on std::cerr where it is not the first.
/// @param given  empty: not given
std::filesystem::path results_directory(const std::filesystem::path& given,
                                        const std::filesystem::path& by_default, const Variant& variant);

/// @param option  that names the directory
/// @throws OptionError with the remedy where a directory holds results of another variant
void require_own_variant(const std::filesystem::path& directory, const Variant& variant,
                         const std::string& option = "-o");

/// results_directory, which holds nothing of another variant.
/// @throws as require_own_variant
std::filesystem::path own_directory(const std::filesystem::path& given,
                                    const std::filesystem::path& by_default, const Variant& variant);

}  // namespace pipelines

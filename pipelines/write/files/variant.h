/// Which results a directory holds: of which scene, under which settings, and of which sweep. Results of one
/// variant of a scene are not replaced by those of another unless that is asked for. A scene that was edited
/// is the same scene, and how its results are computed (method, tolerance) makes no other variant.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/write/files/manifest.h"

namespace pipelines {

struct Variant {
  std::filesystem::path scene;        ///< its file
  std::vector<std::string> settings;  ///< --set, in any order
  bool replaces_others = false;       ///< --force: no other variant stands in its way
  /// What the command line says that a sweep varies, as on it; nothing: the command is no sweep.
  std::optional<std::vector<std::string>> sweep{};
  /// Whether all that a sweep with other options has computed is part of this one; empty: never.
  std::function<bool(const std::vector<std::string>& sweep)> has_all_of{};

  /// The results as the manifest of a directory has them. A directory that is moved together with its scene
  /// stays the same.
  ResultsOf in(const std::filesystem::path& directory) const;
};

/// What a directory, or its folder accuracy, holds of another variant: "results of this scene with --set
/// a=1"; empty: it holds nothing, or this variant, or this one replaces all others. A manifest of an earlier
/// version does not say of which variant its files are; then the scene's name and settings in summary.json
/// count.
std::string held_of_another(const std::filesystem::path& directory, const Variant& variant);

/// The same of what a manifest says, by held_of_another in the words of `directory`.
/// @param held  what the manifest of the directory holds
std::string held_of_another(const std::filesystem::path& directory, const ResultsOf& held,
                            const Variant& variant);

/// The first of DIRECTORY, DIRECTORY-2, DIRECTORY-3 ... that holds nothing of another variant.
std::filesystem::path directory_for(const std::filesystem::path& directory, const Variant& variant);

}  // namespace pipelines

#include "pipelines/write/files/variant.h"

#include <algorithm>

#include "pipelines/write/files/staged_results.h"

namespace pipelines {
namespace {

namespace fs = std::filesystem;

fs::path whole_path(const fs::path& path) {
  std::error_code unknown;
  const auto whole = fs::weakly_canonical(fs::absolute(path), unknown);
  return unknown ? fs::absolute(path).lexically_normal() : whole;
}

/// KEY=VALUE without the spaces that mean nothing.
std::string without_outer_spaces(const std::string& setting) {
  const auto trimmed = [](const std::string& text) {
    const auto first = text.find_first_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
  };
  const auto equals = setting.find('=');
  if (equals == std::string::npos) return trimmed(setting);
  return trimmed(setting.substr(0, equals)) + '=' + trimmed(setting.substr(equals + 1));
}

std::vector<std::string> in_fixed_order(std::vector<std::string> settings) {
  for (auto& setting : settings) setting = without_outer_spaces(setting);
  std::sort(settings.begin(), settings.end());
  return settings;
}

std::string with_settings(const std::vector<std::string>& settings) {
  std::string text;
  for (const auto& setting : settings) text += " --set '" + setting + "'";
  return text.empty() ? "without --set" : "with" + text;
}

std::string held_in(const fs::path& directory, const Variant& variant) {
  std::error_code none;
  if (variant.replaces_others || !fs::is_directory(directory, none)) return "";
  finish_exchange(directory);
  const auto opened = OpenDirectory::existing(directory);
  if (!opened || !opened->look(manifest_name)) return "";
  const auto held = read_results_of(*opened);
  return held ? held_of_another(directory, *held, variant) : "";
}

}  // namespace

ResultsOf Variant::in(const fs::path& directory) const {
  ResultsOf of;
  of.scene = whole_path(scene).lexically_relative(whole_path(directory)).generic_string();
  of.settings = in_fixed_order(settings);
  of.sweep = sweep;
  return as_json_has_it(std::move(of));
}

std::string held_of_another(const fs::path& directory, const ResultsOf& held, const Variant& variant) {
  if (variant.replaces_others) return "";
  const auto own = variant.in(directory);
  if (held.scene != own.scene)
    return "results of another scene, " + (directory / held.scene).lexically_normal().string();
  if (held.settings != own.settings) return "results of this scene " + with_settings(held.settings);
  if (!held.sweep || !own.sweep || *held.sweep == *own.sweep) return "";
  if (variant.has_all_of && variant.has_all_of(*held.sweep)) return "";
  std::string options;
  for (const auto& option : *held.sweep) options += ' ' + option;
  return "another sweep of this scene," + (options.empty() ? " that of its file" : options);
}

std::string held_of_another(const fs::path& directory, const Variant& variant) {
  const auto held = held_in(directory, variant);
  return held.empty() ? held_in(directory / "accuracy", variant) : held;
}

fs::path directory_for(const fs::path& directory, const Variant& variant) {
  auto chosen = directory;
  for (int number = 2; !held_of_another(chosen, variant).empty(); ++number)
    chosen = directory.string() + '-' + std::to_string(number);
  return chosen;
}

}  // namespace pipelines

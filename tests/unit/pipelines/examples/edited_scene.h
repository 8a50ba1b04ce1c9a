/// Shipped scenes with a few lines changed, read from a directory of their own.
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pipelines/scene/whole/scene.h"
#include "tests/unit/pipelines/examples/results_directory.h"

namespace edited {

/// Each edit's first text occurs exactly once.
using Edits = std::vector<std::pair<std::string, std::string>>;

inline pipelines::Scene scene(const std::string& name, const Edits& edits) {
  const results_test::Directory at;
  const auto scenes = std::filesystem::path(SOURCE_DIR) / "pipelines/scenes";
  std::filesystem::copy(scenes / "belt_pull.csv", at / "belt_pull.csv");
  std::string text = results_test::bytes(scenes / (name + ".toml"));
  for (const auto& [from, to] : edits) {
    const auto place = text.find(from);
    if (place == std::string::npos || text.find(from, place + 1) != std::string::npos)
      throw std::runtime_error("not exactly one place for: " + from);
    text.replace(place, from.size(), to);
  }
  std::ofstream(at / "scene.toml", std::ios::binary) << text;
  return pipelines::read_scene(at / "scene.toml");
}

inline bool has_default(const pipelines::Scene& scene, const std::string& key, const std::string& value) {
  for (const auto& d : scene.defaults)
    if (d.key == key && d.value == value && !d.reason.empty()) return true;
  return false;
}

}  // namespace edited

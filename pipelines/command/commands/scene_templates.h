/// The scenes that `millstress init` writes: files of pipelines/scenes, compiled into the program.
#pragma once

#include <string>
#include <vector>

namespace pipelines {

struct TemplateFile {
  std::string name;  ///< "shaft.toml"
  std::string text;
};

/// A scene that runs, and what it reads.
struct SceneTemplate {
  std::string kind;  ///< as on the command line
  TemplateFile scene;
  std::vector<TemplateFile> inputs;  ///< files that the scene names, to lie beside it
};

/// Templates in the order in which they are offered.
const std::vector<SceneTemplate>& scene_templates();

}  // namespace pipelines

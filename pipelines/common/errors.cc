#include "pipelines/common/errors.h"

#include <utility>

namespace pipelines {
namespace {

std::string all_texts(const std::vector<SceneFinding>& findings) {
  std::string text;
  for (const SceneFinding& finding : findings) text += (text.empty() ? "" : "\n") + finding.text();
  return text;
}

}  // namespace

std::string SceneFinding::text() const {
  std::string text = file + ":";
  if (line > 0) text += std::to_string(line) + ":" + std::to_string(column) + ":";
  if (!key.empty()) text += " " + key + (value.empty() ? "" : " = " + value) + ":";
  return text + " " + remedy;
}

SceneError::SceneError(std::vector<SceneFinding> findings)
    : std::runtime_error(all_texts(findings)), findings_(std::move(findings)) {}

}  // namespace pipelines

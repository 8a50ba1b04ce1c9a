#include "pipelines/base/common/errors.h"

#include <utility>

namespace pipelines {
namespace {

constexpr std::size_t most_findings_told = 20;  // a person corrects no more before the next try

/// What is written, shortened to about a line on a screen; never cut within a character of UTF-8.
std::string shortened(const std::string& written) {
  constexpr std::size_t longest = 100;
  if (written.size() <= longest) return written;
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(written[end]) & 0xC0) == 0x80) --end;
  return written.substr(0, end) + " ...";
}

std::string all_texts(const std::vector<SceneFinding>& findings) {
  std::string text;
  for (std::size_t i = 0; i < findings.size() && i < most_findings_told; ++i)
    text += (i == 0 ? "" : "\n") + findings[i].text();
  if (findings.size() > most_findings_told)
    text += "\nand " + std::to_string(findings.size() - most_findings_told) + " more of " +
            std::to_string(findings.size()) + " in all: correct these first";
  return text;
}

}  // namespace

std::string SceneFinding::text() const {
  std::string text = file + ":";
  if (line > 0) text += std::to_string(line) + ":" + std::to_string(column) + ":";
  if (!key.empty()) text += " " + shortened(key) + (value.empty() ? "" : " = " + shortened(value)) + ":";
  return text + " " + remedy;
}

SceneError::SceneError(std::vector<SceneFinding> findings)
    : std::runtime_error(all_texts(findings)), findings_(std::move(findings)) {}

}  // namespace pipelines

#include "kinetics/values/wrong_input.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "kinetics/values/edit_distance.h"
#include "kinetics/values/machine_refused.h"

namespace kinetics {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

std::string rounded(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

void refuse(const std::string& parameter, double value, const std::string& remedy) {
  throw MachineRefused(parameter + " = " + number(value) + ": " + remedy);
}

void require_finite(const std::string& parameter, double value) {
  if (!std::isfinite(value)) refuse(parameter, value, "must be a finite number; check where it comes from");
}

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
  const auto best = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return edit_distance(word, a) < edit_distance(word, b);
  });
  return best == known.end() ? std::string{} : *best;
}

std::string listed(const std::vector<std::string>& words) {
  std::string line;
  for (const auto& word : words) line += (line.empty() ? "" : ", ") + word;
  return line;
}

}  // namespace kinetics

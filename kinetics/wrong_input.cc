#include "kinetics/wrong_input.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "kinetics/machine_refused.h"

namespace kinetics {
namespace {

/// Levenshtein distance, row by row.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

}  // namespace

std::string number(double value) {
  std::ostringstream text;
  text.precision(12);
  text << value;
  return text.str();
}

void refuse(const std::string& parameter, double value, const std::string& remedy) {
  throw MachineRefused(parameter + " = " + number(value) + ": " + remedy);
}

void require_finite(const std::string& parameter, double value) {
  if (!std::isfinite(value)) refuse(parameter, value, "must be a finite number; check where it comes from");
}

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
  const auto best = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return distance(word, a) < distance(word, b);
  });
  return best == known.end() ? std::string{} : *best;
}

std::string listed(const std::vector<std::string>& words) {
  std::string line;
  for (const auto& word : words) line += (line.empty() ? "" : ", ") + word;
  return line;
}

}  // namespace kinetics

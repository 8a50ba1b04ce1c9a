#include "pipelines/base/fatigue/fatigue_input.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace pipelines {
namespace {

std::string digits_of_input(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

}  // namespace

void refuse_fatigue_input(const std::string& name, double value, const std::string& remedy) {
  throw std::invalid_argument(name + " = " + digits_of_input(value) + ": " + remedy);
}

void require_finite_input(const std::string& name, double value) {
  if (!std::isfinite(value)) refuse_fatigue_input(name, value, "must be a finite number");
}

void require_positive_input(const std::string& name, double value) {
  require_finite_input(name, value);
  if (value <= 0) refuse_fatigue_input(name, value, "must be greater than zero");
}

void require_non_negative_input(const std::string& name, double value) {
  require_finite_input(name, value);
  if (value < 0) refuse_fatigue_input(name, value, "must not be negative");
}

void require_input_between(const std::string& name, double value, double least, double most) {
  require_finite_input(name, value);
  if (value < least || value > most)
    refuse_fatigue_input(name, value,
                         "must lie between " + digits_of_input(least) + " and " + digits_of_input(most));
}

}  // namespace pipelines

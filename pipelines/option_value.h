/// Quantities given as options of the command line.
#pragma once

#include <stdexcept>
#include <string>

#include "pipelines/units.h"

namespace pipelines {

/// @throws std::invalid_argument naming the option
inline double option_in_si(const char* option, const std::string& text, const std::string& unit) {
  try {
    return to_si(text, unit);
  } catch (const UnitError& error) {
    throw std::invalid_argument(std::string(option) + ' ' + text + ": " + error.what());
  }
}

}  // namespace pipelines

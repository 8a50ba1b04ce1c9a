/// Quantities given as options of the command line.
#pragma once

#include <string>

#include "pipelines/errors.h"
#include "pipelines/units.h"

namespace pipelines {

/// @throws OptionError naming the option
inline double option_in_si(const char* option, const std::string& text, const std::string& unit) {
  try {
    return to_si(text, unit);
  } catch (const UnitError& error) {
    throw OptionError(std::string(option) + ' ' + text + ": " + error.what());
  }
}

}  // namespace pipelines

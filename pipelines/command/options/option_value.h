/// Values of options of the command line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/scene/values/requested_accuracy.h"

namespace pipelines {

/// A quantity. Shares are written with their unit, since a bare 0.5 may mean 0.5 % or 50 %; a bare time is in
/// seconds, any other bare number is refused.
/// @param unit  unit of the result, SI; "1" for a share
/// @throws OptionError naming option, value and remedy
double option_in_si(const char* option, const std::string& text, const std::string& unit);

/// --tolerance, within the limits that a scene's has.
/// @param or_else  end of the remedy: what else the option may be
/// @throws OptionError naming option, value and remedy
double tolerance_option(const std::string& text, const std::string& or_else = "");

/// --time-limit, which is positive [s].
/// @throws OptionError naming option, value and remedy
double time_limit_option(const std::string& text);

/// What a run is asked for: --tolerance and --time-limit before the scene's own. "--tolerance none" solves
/// once, on the scene's mesh; a time limit alone takes a scene's "none" back.
/// @param tolerance, time_limit  as given; empty: not given
/// @throws OptionError for what is no tolerance or limit, and for a limit beside "none"
RequestedAccuracy requested_search(const std::string& tolerance, const std::string& time_limit,
                                   RequestedAccuracy scene);

/// @throws OptionError if the file's name promises another format than the option writes
/// @param remedy  what to do instead
void require_extension(const char* option, const std::filesystem::path& file,
                       const std::vector<std::string>& extensions, const std::string& remedy);

}  // namespace pipelines

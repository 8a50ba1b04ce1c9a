/// What the command line offers, written for `man` and for the completion of shells: from the same tables as
/// --help.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace pipelines {

/// The manual page in the language of man(7): all commands with their options, exit codes.
std::string manual_page(const CLI::App& app);

/// A script that completes commands and options.
/// @param shell  "bash", "zsh" or "fish"
std::string completion_script(const CLI::App& app, const std::string& shell);

}  // namespace pipelines

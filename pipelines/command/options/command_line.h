/// The command line as people type it: what stands for a command, and what a slip may have meant.
#pragma once

#include <string>
#include <vector>

namespace pipelines {

/// A command with its options as they are written: "--tolerance", "-o".
struct CommandNames {
  std::string name;
  std::vector<std::string> options;
};

/// The arguments with a command in front: `help` and `help COMMAND` ask for --help, a scene (SCENE.toml, or
/// the name of any file that is there) is run. What is no command stays in front.
/// @param arguments  without the program's name
std::vector<std::string> with_command(std::vector<std::string> arguments,
                                      const std::vector<CommandNames>& commands);

/// What is wrong with the first argument, if it is no command, or else with the first option that the command
/// does not have: one line with the nearest name; empty if none of this is wrong.
/// @param arguments  arguments of with_command, which the parser has refused
std::string unknown_name(const std::vector<std::string>& arguments,
                         const std::vector<CommandNames>& commands);

}  // namespace pipelines

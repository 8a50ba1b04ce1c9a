#include "pipelines/command/options/command_line.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/nearest_name.h"

namespace pipelines {
namespace {

namespace fs = std::filesystem;

const CommandNames* find_command(const std::vector<CommandNames>& commands, const std::string& name) {
  const auto found = std::find_if(commands.begin(), commands.end(),
                                  [&](const auto& command) { return command.name == name; });
  return found == commands.end() ? nullptr : &*found;
}

bool is_scene_file(const std::string& argument) {
  if (argument.empty() || argument[0] == '-') return false;
  std::error_code none;
  return fs::path(argument).extension() == ".toml" || fs::is_regular_file(argument, none);
}

/// "; did you mean "--tolerance"?", or nothing.
std::string did_you_mean(const std::string& nearest) {
  return nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?";
}

/// The option that an argument names, without a value behind it; empty if it is none.
std::string option_in(const std::string& argument) {
  if (argument.size() < 2 || argument[0] != '-') return "";
  if (argument[1] == '-') return argument.substr(0, argument.find('='));
  if (std::isalpha(static_cast<unsigned char>(argument[1])) == 0) return "";  // a negative number
  return argument;
}

/// Whether the parser finds an option in what option_in has found: of a short one its letter counts.
bool is_option_of(const CommandNames& command, const std::string& option) {
  return contains(command.options, option[1] == '-' ? option : option.substr(0, 2));
}

/// @param option  that the command does not have
std::string nearest_option(const CommandNames& command, const std::string& option) {
  std::vector<std::string> names;
  for (const auto& known : command.options)
    if (known.size() > 2) names.push_back(known.substr(2));
  const auto nearest = nearest_name(option.substr(option.find_first_not_of('-')), names);
  return nearest.empty() ? "" : "--" + nearest;
}

std::string unknown_option(const CommandNames& command, const std::string& option,
                           const std::vector<CommandNames>& commands) {
  std::string text = "millstress: " + option + ": is no option of " + command.name;
  const auto nearest = nearest_option(command, option);
  std::vector<std::string> others;
  for (const auto& other : commands)
    if (is_option_of(other, option)) others.push_back(other.name);
  text += did_you_mean(nearest);
  if (nearest.empty() && !others.empty()) text += ", but of " + listed(others);
  return text + "; " + command.name + " --help lists them";
}

std::string unknown_command(const std::string& name, const std::vector<CommandNames>& commands) {
  std::vector<std::string> names{"help"};
  for (const auto& command : commands) names.push_back(command.name);
  return "millstress: " + name + ": is no command" + did_you_mean(nearest_name(name, names)) +
         "; --help lists them";
}

}  // namespace

std::vector<std::string> with_command(std::vector<std::string> arguments,
                                      const std::vector<CommandNames>& commands) {
  if (arguments.empty() || find_command(commands, arguments[0]) != nullptr) return arguments;
  if (arguments[0] == "help") {
    const bool names_command = arguments.size() > 1 && arguments[1][0] != '-' && arguments[1] != "help";
    if (!names_command) return {"--help"};
    if (find_command(commands, arguments[1]) == nullptr) return {arguments[1]};
    return {arguments[1], "--help"};
  }
  if (is_scene_file(arguments[0])) arguments.insert(arguments.begin(), "run");
  return arguments;
}

std::string unknown_name(const std::vector<std::string>& arguments,
                         const std::vector<CommandNames>& commands) {
  if (arguments.empty() || arguments[0].empty() || arguments[0][0] == '-') return "";
  const auto* command = find_command(commands, arguments[0]);
  if (command == nullptr) return unknown_command(arguments[0], commands);
  for (std::size_t i = 1; i < arguments.size() && arguments[i] != "--"; ++i)
    if (const auto option = option_in(arguments[i]); !option.empty() && !is_option_of(*command, option))
      return unknown_option(*command, option, commands);
  return "";
}

}  // namespace pipelines

#include "pipelines/command/options/manual.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "pipelines/base/common/version.h"

namespace pipelines {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// Text of a manual page: no sign of it is a request to the formatter.
std::string escaped(const std::string& text) {
  std::string result;
  bool begins_line = true;
  for (const char c : text) {
    if (begins_line && (c == '.' || c == '\'')) result += "\\&";
    begins_line = c == '\n';
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  return result;
}

/// "--output, -o" or the name of an argument without dashes.
std::string names_of(const CLI::Option& option) {
  std::string names;
  for (const auto& name : option.get_lnames()) names += (names.empty() ? "--" : ", --") + name;
  for (const auto& name : option.get_snames()) names += (names.empty() ? "-" : ", -") + name;
  return names.empty() ? option.get_name(true) : names;
}

std::string synopsis(const CLI::App& command) {
  std::string line = command.get_name();
  for (const auto* option : command.get_options())
    if (option->get_positional()) {
      const auto name = option->get_name(true);
      line += option->get_required() ? " " + name : " [" + name + "]";
    }
  return line;
}

constexpr auto end_of_page = R"(.SH EXIT STATUS
.TP
0
done
.TP
2
the scene, an option or a file is wrong; the message names place, value and remedy
.TP
3
the mesh, the solve or an output failed
.TP
4
the tolerance or the limit of time was not met, or bounds of optimise cannot be kept
.TP
5
with \-\-strict: the verdict is not OK
.SH SCENES
A scene is a TOML file. A name such as vibratory_mill, without a folder and an ending, that is no file means the
scene of that name that comes with the program.
)";

/// A word list for a shell: no option needs quotes.
std::string options_of(const CLI::App& command) {
  std::string words;
  for (const auto* option : command.get_options()) {
    for (const auto& name : option->get_lnames()) words += " --" + name;
    for (const auto& name : option->get_snames()) words += " -" + name;
  }
  return words.empty() ? words : words.substr(1);
}

std::string names_of_commands(const CLI::App& app) {
  std::string names;
  for (const auto* command : commands_of(app)) names += (names.empty() ? "" : " ") + command->get_name();
  return names;
}

/// The cases of `case` in a shell of Bourne's kind.
std::string cases(const CLI::App& app) {
  std::string text;
  for (const auto* command : commands_of(app))
    text += fmt::format("    {}) options='{}' ;;\n", command->get_name(), options_of(*command));
  return text;
}

std::string for_bash(const CLI::App& app) {
  return fmt::format(R"(_millstress() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} options=
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W '{}' -- "$word"))
    return
  fi
  case ${{COMP_WORDS[1]}} in
{}  esac
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  fi
}}
complete -o default -F _millstress millstress
)",
                     names_of_commands(app), cases(app));
}

std::string for_zsh(const CLI::App& app) {
  return fmt::format(R"(#compdef millstress
_millstress() {{
  local options=
  if (( CURRENT == 2 )); then
    compadd -- {}
    _files
    return
  fi
  case $words[2] in
{}  esac
  if [[ $PREFIX == -* ]]; then
    compadd -- ${{=options}}
  else
    _files
  fi
}}
_millstress "$@"
)",
                     names_of_commands(app), cases(app));
}

std::string quoted_for_fish(const std::string& text) {
  std::string word = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') word += '\\';
    word += c;
  }
  return word + "'";
}

std::string for_fish(const CLI::App& app) {
  std::string text;
  for (const auto* command : commands_of(app)) {
    text += fmt::format("complete -c millstress -n __fish_use_subcommand -a {} -d {}\n", command->get_name(),
                        quoted_for_fish(command->get_description()));
    for (const auto* option : command->get_options()) {
      if (option->get_positional()) continue;
      text += fmt::format("complete -c millstress -n '__fish_seen_subcommand_from {}'", command->get_name());
      for (const auto& name : option->get_lnames()) text += " -l " + name;
      for (const auto& name : option->get_snames()) text += " -s " + name;
      text += " -d " + quoted_for_fish(option->get_description()) + "\n";
    }
  }
  return text;
}

}  // namespace

std::string manual_page(const CLI::App& app) {
  std::string page = fmt::format(
      ".TH MILLSTRESS 1 \"\" \"millstress {}\" \"User Commands\"\n"
      ".SH NAME\nmillstress \\- stress zones of grinding mills from their kinetics\n"
      ".SH SYNOPSIS\n.B millstress\n.I COMMAND\n[\\fIoptions\\fR]\n.SH DESCRIPTION\n{}\n.SH COMMANDS\n",
      version, escaped(app.get_description()));
  for (const auto* command : commands_of(app)) {
    page += ".SS " + escaped(synopsis(*command)) + "\n" + escaped(command->get_description()) + "\n";
    for (const auto* option : command->get_options())
      page += ".TP\n\\fB" + escaped(names_of(*option)) + "\\fR\n" + escaped(option->get_description()) + "\n";
  }
  return page + end_of_page;
}

std::string completion_script(const CLI::App& app, const std::string& shell) {
  return shell == "bash" ? for_bash(app) : shell == "zsh" ? for_zsh(app) : for_fish(app);
}

}  // namespace pipelines

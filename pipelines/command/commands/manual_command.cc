#include <CLI/CLI.hpp>

#include <memory>
#include <ostream>
#include <string>

#include "pipelines/command/options/commands.h"
#include "pipelines/command/options/manual.h"

namespace pipelines {
namespace {

struct ManualOptions {
  const CLI::App* app = nullptr;
  std::string form = "man";
};

void show_manual(const ManualOptions& options, std::ostream& out) {
  out << (options.form == "man" ? manual_page(*options.app) : completion_script(*options.app, options.form));
}

}  // namespace

void add_manual_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<ManualOptions>();
  options->app = &app;
  auto* command = app.add_subcommand("manual", "the manual page for man, or what a shell completes by");
  command->add_option("form", options->form, "man, bash, zsh or fish")
      ->check(CLI::IsMember({"man", "bash", "zsh", "fish"}));
  command->callback(to_choose(chosen, options, show_manual));
}

}  // namespace pipelines

#include <CLI/CLI.hpp>
#include <filesystem>
#include <ostream>

#include "pipelines/commands/commands.h"
#include "pipelines/report/html_report.h"

namespace pipelines {
namespace {

void report(const std::filesystem::path& directory, std::ostream& out) {
  write_html_report(directory);
  out << (directory / "report.html").string() << '\n';
}

}  // namespace

void add_report_command(CLI::App& app, ChosenCommand& chosen) {
  auto directory = std::make_shared<std::filesystem::path>();
  auto* command = app.add_subcommand("report", "report.html of a result directory, anew from its files");
  command->add_option("directory", *directory, "result directory of a run")->required();
  command->callback(to_choose(chosen, directory, report));
}

}  // namespace pipelines

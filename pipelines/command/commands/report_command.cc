#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <ostream>

#include "pipelines/base/common/errors.h"
#include "pipelines/command/options/commands.h"
#include "pipelines/write/files/manifest.h"
#include "pipelines/write/files/staged_results.h"

namespace pipelines {
namespace {

void report(const std::filesystem::path& directory, std::ostream& out) {
  finish_exchange(directory);
  const auto check = check_manifest(directory);
  if (check.is_mixed())
    throw OptionError(check.text(directory) +
                      ": the files are not of one run, or were changed since; run the scene again");
  for (const auto& name : check.missing)
    std::cerr << "millstress: " << (directory / name).string()
              << ": is gone, of the files that the run wrote\n";
  publish_html_report(directory, directory / "accuracy", "report");
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

#include "pipelines/command/options/output_files.h"

#include <iostream>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/process_limits.h"

namespace pipelines {
namespace {

namespace fs = std::filesystem;

fs::path resolved(const fs::path& file) {
  std::error_code unknown;
  const auto folder = fs::weakly_canonical(fs::absolute(file), unknown);
  return unknown ? file.lexically_normal() : folder;
}

}  // namespace

std::vector<OutputFile> output_files(const std::string& option, const fs::path& directory,
                                     const std::vector<std::string>& names) {
  std::vector<OutputFile> files;
  if (directory.empty()) return files;
  for (const auto& name : names) files.push_back({option, directory / name});
  return files;
}

void require_different(const std::vector<OutputFile>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (resolved(outputs[i].file) == resolved(outputs[j].file))
        throw OptionError(outputs[i].option + ' ' + outputs[i].file.string() + ": is the file that " +
                          outputs[j].option +
                          " writes too, and one would replace the other; give them different names");
}

void say_if_nothing_draws(const std::vector<std::string>& charts, bool can_draw) {
  if (charts.empty() && !can_draw)  // where there is nothing to draw, nothing is missing
    std::cerr << "no charts: " << why_nothing_draws() << "; the tables have the figures\n";
}

void print_files(std::ostream& out, const std::filesystem::path& directory,
                 const std::vector<std::string>& names) {
  if (names.empty()) return;
  out << "\n  ";
  for (std::size_t i = 0; i < names.size(); ++i) out << (i > 0 ? ", " : "") << names[i];
  out << " in " << directory.string() << '\n';
}

}  // namespace pipelines

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <ostream>

#include "pipelines/base/disk/cache.h"
#include "pipelines/command/options/commands.h"

namespace pipelines {
namespace {

struct CacheOptions {
  bool clear = false;
};

void show_cache(const CacheOptions& options, std::ostream& out) {
  if (options.clear) keep_cache_within(0);
  double bytes = 0;
  const auto files = cached_files();
  for (const auto& file : files) bytes += double(file.bytes);
  out << fmt::format("{}: {} unit responses, {:.2f} GB of at most {:.4g} GB (MILLSTRESS_CACHE_LIMIT)\n",
                     cache_directory().string(), files.size(), bytes / 1e9, double(cache_limit()) / 1e9);
}

}  // namespace

void add_cache_command(CLI::App& app, ChosenCommand& chosen) {
  auto options = std::make_shared<CacheOptions>();
  auto* command = app.add_subcommand("cache", "what is kept of earlier runs for later ones: place and size");
  command->add_flag("--clear", options->clear, "remove all of it");
  command->callback(to_choose(chosen, options, show_cache));
}

}  // namespace pipelines

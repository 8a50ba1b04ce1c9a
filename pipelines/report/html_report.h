/// report.html: a run's results on one page, made from its result directory alone.
#pragma once

#include <filesystem>

namespace pipelines {

/// Reads summary.json, the bodies' pictures and, where `accuracy` has left them, its tables and charts;
/// writes report.html beside the summary, with the pictures inside it. The same files give the same bytes.
/// @param accuracy  the directory of those tables and charts
/// @throws OptionError naming the file and the remedy if summary.json is missing or is not one
/// @throws FileError if the page cannot be written
void write_html_report(const std::filesystem::path& directory, const std::filesystem::path& accuracy);

}  // namespace pipelines

/// report.html: a run's results on one page, made from its result directory alone.
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/write/living/living_page.h"

namespace pipelines {

/// The page, of summary.json, the bodies' pictures and, where `accuracy` has left them, its tables and
/// charts; the pictures are inside it. What puts the stress together anew is in living_data_name. The
/// same files give the same bytes.
/// @param accuracy  the directory of those tables and charts
/// @throws OptionError naming the file and the remedy if summary.json is missing or is not one
std::string html_report(const std::filesystem::path& directory, const std::filesystem::path& accuracy);

/// Writes it beside the summary, and what puts the stress together anew beside it.
/// @param living  of the run
/// @throws as html_report; FileError if the page cannot be written
void write_html_report(const std::filesystem::path& directory, const std::filesystem::path& accuracy,
                       const LivingPage& living = {});

}  // namespace pipelines

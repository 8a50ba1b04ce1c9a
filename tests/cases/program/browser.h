/// A browser without a screen that opens pages from the disk.
#pragma once

#include <string>

#include "tests/cases/program/program.h"
#include "tests/unit/pipelines/examples/tools.h"

namespace cases {

/// Its window has 1280 x 800 points. WebGL 2 is drawn by the processor (SwiftShader).
/// @return its exit code
int start_browser(const fs::path& directory, const std::string& arguments);

/// What it prints.
std::string browse(const fs::path& directory, const std::string& arguments);

/// The page's elements after its scripts have run for so many of the page's own seconds, which pass faster.
std::string elements_after(const fs::path& directory, const std::string& page, int seconds);

/// Whether it starts in this system: not everywhere where it is installed.
bool has_browser(const fs::path& directory);

}  // namespace cases

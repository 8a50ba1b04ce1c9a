/// An accuracy study as a picture: error against seconds, both logarithmic.
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/study/accuracy/accuracy.h"

namespace pipelines {

/// What lies below the reference's own error is hatched: it is not told, and the frontier ends there.
///
/// One curve per model: discs at the true errors, a bar from each up or down to its estimate; the efficient
/// frontier as a broad grey line, a ring around the chosen run, the tolerance as a horizontal line. The
/// reference, whose true error is not known, is a square at its own estimate.
/// @return false if the machine offers no EGL
/// @throws FileError naming the file if it cannot be written
/// @throws std::invalid_argument if no run has a positive error and time
bool write_accuracy_chart(const AccuracyStudy& study, const std::string& title,
                          const std::filesystem::path& png);

}  // namespace pipelines

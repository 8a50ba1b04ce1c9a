/// Progress on stderr: on a terminal one bar with the seconds so far, of those that the run is expected to
/// take, and the present stage; elsewhere a line for each step of a search; nothing when quiet.
#pragma once

#include "pipelines/base/common/stage_clock.h"

namespace pipelines {

enum class Verbosity { quiet, normal, verbose };

/// @param verbosity   verbose: a line remains for each stage and step
/// @param expected_s  seconds that the run will take, nearly; 0: not known, and the bar shows the share of
///                    the present stage
ProgressListener progress_on_stderr(Verbosity verbosity, double expected_s = 0);

/// Whether a bar is drawn at all.
bool has_progress_bar(Verbosity verbosity);

}  // namespace pipelines

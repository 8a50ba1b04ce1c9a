/// Progress on stderr: on a terminal one bar with the seconds so far, of those that the run may take, and the
/// present stage; elsewhere a line for each step of a search; nothing when quiet.
#pragma once

#include "pipelines/common/stage_clock.h"

namespace pipelines {

enum class Verbosity { quiet, normal, verbose };

/// @param verbosity  verbose: a line remains for each stage and step
/// @param limit_s    of the run; 0: not known, and the bar shows the share of the present stage
ProgressListener progress_on_stderr(Verbosity verbosity, double limit_s = 0);

}  // namespace pipelines

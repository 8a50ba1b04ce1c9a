/// Progress on stderr: one bar that moves on a terminal, one line per finished stage elsewhere, nothing when
/// quiet.
#pragma once

#include "pipelines/common/stage_clock.h"

namespace pipelines {

enum class Verbosity { quiet, normal, verbose };

/// @param verbose  on a terminal too a line remains for each stage and step
ProgressListener progress_on_stderr(Verbosity verbosity);

}  // namespace pipelines

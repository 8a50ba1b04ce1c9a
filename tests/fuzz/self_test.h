/// Whether faults are seen: cases that do what no case may do.
#pragma once

#include "tests/fuzz/batch.h"

namespace fuzz {

/// @return whether each of them, and none beside them, has counted as a fault
bool faults_are_seen(Batch batch, const Place& place);

}  // namespace fuzz

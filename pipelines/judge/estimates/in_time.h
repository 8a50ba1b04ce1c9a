/// Work that ends early once the time is up.
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "fem/base/common/deadline.h"
#include "pipelines/base/common/several_ranks.h"

namespace pipelines {

/// Search::ended of a search that its limit of time has ended.
inline const std::string time_is_up = "the time is up";

/// Does work that asks for the time while it is at work (fem/base/common/deadline.h). Ranks that share a body
/// have to do all of it: one that left it would leave the others waiting.
/// @param seconds  that it may take; infinite: no limit
/// @return false if the time was up before the work had ended
/// @throws anything else that the work throws
template <typename Work>
bool in_time(double seconds, Work&& work) {
  if (std::isinf(seconds) || n_ranks_of_a_body() > 1) {
    std::forward<Work>(work)();
    return true;
  }
  try {
    const fem::Deadline deadline(seconds);
    std::forward<Work>(work)();
    return true;
  } catch (const fem::OutOfTime&) {
    return false;
  }
}

}  // namespace pipelines

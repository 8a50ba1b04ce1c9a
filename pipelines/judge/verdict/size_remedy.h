/// Radius or thickness that would bring a body's stress down, in words.
#pragma once

#include <string>

#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

/// ", or the fillet have a radius of about 4.5 mm in place of 2.5 mm": of the governing stress of running.
/// @param factor  by which it has to come down, above 1
/// @return empty: no size is known that does it, or none fits
std::string size_remedy(const Judged& analysis, double factor);

/// The same of what a place or a weld toe goes through over the cycle.
/// @param is_of_running  else over operating blocks, whose loads may be mixed in other ways: on the safe side
std::string size_remedy_of_fatigue(const Judged& analysis, const std::string& place, double factor,
                                   bool is_of_running);

}  // namespace pipelines

/// What changes of a stress from section to section leave open. Internal to the runs on harmonics.
#pragma once

#include <vector>

namespace pipelines {

/// Where the largest stress of a place lies.
enum class Surroundings {
  any,           ///< the end of a load, a seam or a sharp edge may be near: first order
  inside_fillet  ///< on an arc, away from its ends: third order, with little of first order in it
};

/// What is missing of the last of a place's values, when every section has the cells of the one before cut in
/// four: the rest of the geometric series that the last two changes begin, times a safety. Not less than a
/// share of the change before the last, which may be small by chance, and of the value. From two sections
/// alone the change and a share of the value count.
/// @param values_Pa  one per section, the coarsest first
/// @return [Pa]; of one section the value itself
double missing_Pa(const std::vector<double>& values_Pa, Surroundings where);

}  // namespace pipelines

#include "pipelines/base/names/nearest_name.h"

#include <algorithm>
#include <cstddef>

#include "kinetics/values/edit_distance.h"

namespace pipelines {

std::string nearest_name(const std::string& name, const std::vector<std::string>& known) {
  constexpr std::size_t longest = 80;  // longest name worth comparing: keeps the table small for garbage
  std::string nearest;
  if (name.size() > longest) return nearest;
  std::size_t fewest = 0;
  for (const std::string& candidate : known) {
    const std::size_t edits = kinetics::edit_distance(name, candidate);
    const std::size_t allowed =
        std::min(std::max<std::size_t>(2, candidate.size() / 3), candidate.size() - 1);
    if (edits > allowed || (!nearest.empty() && edits >= fewest)) continue;
    nearest = candidate;
    fewest = edits;
  }
  return nearest;
}

}  // namespace pipelines

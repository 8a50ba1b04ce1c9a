/// Whether a list of names has one, and a list without some.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace pipelines {

inline bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The names in their order, but for those that are off.
inline std::vector<std::string> names_without(const std::vector<std::string>& names,
                                              const std::vector<std::string>& off) {
  std::vector<std::string> left;
  for (const auto& name : names)
    if (!contains(off, name)) left.push_back(name);
  return left;
}

}  // namespace pipelines

/// The models that a body may be run with.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pipelines {

enum class Method {
  automatic,     ///< the cheapest that meets the tolerance
  beam,          ///< Timoshenko beam with published fillet factors
  axisymmetric,  ///< Fourier harmonics around the axis
  solid,         ///< three-dimensional cells
};

/// "auto", "beam", "axisymmetric", "solid"
std::string to_string(Method method);
std::optional<Method> method_of(const std::string& text);
std::vector<std::string> method_names();

}  // namespace pipelines

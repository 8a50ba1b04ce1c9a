#include "pipelines/scene/values/method.h"

#include <algorithm>

namespace pipelines {

std::vector<std::string> method_names() {
  return {"auto", "beam", "axisymmetric", "solid"};
}

std::string to_string(Method method) {
  return method_names().at(std::size_t(method));
}

std::optional<Method> method_of(const std::string& text) {
  const auto names = method_names();
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) return std::nullopt;
  return Method(found - names.begin());
}

}  // namespace pipelines

#include "pipelines/scene/values/known_forces.h"

namespace pipelines {

std::vector<std::string> known_forces(const kinetics::LoadHistory& loads) {
  std::vector<std::string> names;
  for (const auto& resultant : loads.resultants) names.push_back(resultant.role);
  for (const auto& quantity : loads.quantities)
    if (quantity.unit == "N") names.push_back(quantity.name);
  return names;
}

std::optional<Eigen::ArrayXd> force_of(const std::string& load, const kinetics::LoadHistory& loads) {
  if (loads.has_resultant(load))
    return loads.resultant(load).total.topRows<2>().matrix().colwise().norm().transpose();
  for (const auto& quantity : loads.quantities)
    if (quantity.name == load && quantity.unit == "N") return quantity.values.abs();
  return std::nullopt;
}

}  // namespace pipelines

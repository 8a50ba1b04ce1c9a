/// The series of a load stage that headline numbers are made of.
#pragma once

#include <string>
#include <tuple>

#include "kinetics/load_history.h"
#include "pipelines/scene/machine_kind.h"

namespace pipelines {

/// Components of a resultant that are not zero throughout: use(name, unit, series).
template <typename Use>
void for_each_component(const kinetics::LoadHistory& loads, const Use& use) {
  for (const auto& resultant : loads.resultants)
    for (const auto& [row, component, unit] :
         {std::tuple{0, ".fx", "N"}, {1, ".fy", "N"}, {2, ".torque", "N m"}}) {
      const Eigen::ArrayXd series = resultant.total.row(row);
      if ((series != 0).any()) use(resultant.role + component, std::string(unit), series);
    }
}

/// Quantities that have statistics; of machines whose loads are samples, what is given at their ports too.
template <typename Use>
void for_each_load(const MachineKind& kind, const kinetics::LoadHistory& loads, const Use& use) {
  for (const auto& quantity : loads.quantities)
    if (quantity.has_statistics) use(quantity.name, quantity.unit, quantity.values);
  if (kind.has_samples()) for_each_component(loads, use);
}

}  // namespace pipelines

#include "pipelines/scene/whole/machine.h"

#include "pipelines/scene/whole/machine_kind.h"

namespace pipelines {

std::vector<kinetics::EffectInfo> effects_of(const Machine& machine) {
  return kind_of(machine).effects(machine);
}

kinetics::LoadHistory compute_loads(const Machine& machine, const std::vector<std::string>& effects,
                                    const kinetics::TimeGrid& grid) {
  return std::visit([&](const auto& m) { return kinetics::compute_loads(m, effects, grid); }, machine);
}

std::vector<kinetics::ResamplingError> resampling_errors(const Machine& machine,
                                                         const kinetics::TimeGrid& grid) {
  return kind_of(machine).resampling_errors(machine, grid);
}

}  // namespace pipelines

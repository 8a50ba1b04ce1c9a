#include "pipelines/scene/machine.h"

namespace pipelines {
namespace {

struct EffectsOf {
  std::vector<kinetics::EffectInfo> operator()(const kinetics::VibratoryMill& mill) const {
    return kinetics::vibratory_mill_effects(mill.convention);
  }
  std::vector<kinetics::EffectInfo> operator()(const kinetics::PlanetaryMill& mill) const {
    return kinetics::planetary_mill_effects(mill.convention);
  }
  std::vector<kinetics::EffectInfo> operator()(const kinetics::DriveTrain& train) const {
    return kinetics::drive_train_effects(train);
  }
  std::vector<kinetics::EffectInfo> operator()(const kinetics::LoadTable& table) const {
    return kinetics::load_table_effects(table);
  }
};

}  // namespace

std::vector<kinetics::EffectInfo> effects_of(const Machine& machine) {
  return std::visit(EffectsOf{}, machine);
}

kinetics::LoadHistory compute_loads(const Machine& machine, const std::vector<std::string>& effects,
                                    const kinetics::TimeGrid& grid) {
  return std::visit([&](const auto& m) { return kinetics::compute_loads(m, effects, grid); }, machine);
}

std::vector<kinetics::ResamplingError> resampling_errors(const Machine& machine,
                                                         const kinetics::TimeGrid& grid) {
  const auto* table = std::get_if<kinetics::LoadTable>(&machine);
  return table ? kinetics::resampling_errors(*table, grid) : std::vector<kinetics::ResamplingError>{};
}

}  // namespace pipelines

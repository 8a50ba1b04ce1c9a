#include "pipelines/scene/body_effects.h"

#include <algorithm>

#include "pipelines/scene/scene.h"

namespace pipelines {
namespace {

using kinetics::EffectInfo;
using kinetics::EffectNeed;

/// A torque that is not the same at every instant, so that the train vibrates.
bool varies(const kinetics::TrainExcitation& excitation) {
  const auto& samples = excitation.table.torque_Nm;
  return std::any_of(excitation.harmonics.begin(), excitation.harmonics.end(),
                     [](const auto& harmonic) { return harmonic.amplitude_Nm != 0; }) ||
         std::any_of(samples.begin(), samples.end(), [&](double torque) { return torque != samples[0]; });
}

/// What the balance T_34 - T_45 - D phi' = J phi'' of a train's shaft needs.
void add_shaft_needs(const kinetics::DriveTrain& train, std::vector<EffectInfo>& table) {
  const EffectNeed inertia{
      "shaft_inertia", "its torque accelerates the shaft, and nothing but the shaft's inertia balances that",
      "coupling 6, T_34 - T_45 - D_4 phi_4' = J_4 phi_4''"};
  for (const auto& excitation : train.excitations)
    for (EffectInfo& info : table)
      if (info.name == excitation.name && varies(excitation)) info.needs.push_back(inertia);
}

}  // namespace

const std::vector<EffectInfo>& own_effect_table(BodyRole role) {
  static const std::vector<EffectInfo> none, drum{{"drum_spin",
                                                   "Centrifugal field of the drum's own spin, without a "
                                                   "resultant; from its mesh.",
                                                   "coupling 4"}};
  static const std::vector<EffectInfo> vibratory_shaft{
      {"gravity_shaft", "Weight of the shaft itself, from its mesh.", "coupling 2"},
      {"shaft_inertia", "Centrifugal field and angular inertia of the shaft itself, from its mesh.",
       "coupling 2"}};
  static const std::vector<EffectInfo> stub_axle{
      {"axle_gravity", "Weight of the stub itself, from its mesh.", "coupling 5"},
      {"axle_transport", "Centrifugal field of the stub that the carrier takes round, from its mesh.",
       "coupling 5"}};
  static const std::vector<EffectInfo> train_shaft{
      {"shaft_inertia", "Angular inertia of the shaft itself, -J phi'', from its mesh.", "coupling 6"}};
  switch (role) {
    case BodyRole::vibratory_shaft:
      return vibratory_shaft;
    case BodyRole::drum:
      return drum;
    case BodyRole::stub_axle:
      return stub_axle;
    case BodyRole::train_shaft:
      return train_shaft;
    case BodyRole::chamber:
    case BodyRole::table_body:
      return none;
  }
  return none;
}

std::vector<std::string> own_effects(BodyRole role) {
  std::vector<std::string> names;
  for (const auto& effect : own_effect_table(role)) names.push_back(effect.name);
  return names;
}

std::vector<EffectInfo> force_effect_table(const TrainShaftOptions& shaft) {
  std::vector<EffectInfo> table;
  for (const auto& force : shaft.forces)
    if (std::none_of(table.begin(), table.end(), [&](const auto& info) { return info.name == force.effect; }))
      table.push_back({force.effect, "Force on the shaft beside the train's torques.", "the user's"});
  return table;
}

std::vector<EffectInfo> body_effect_table(const BodyScene& body) {
  std::vector<EffectInfo> table = own_effect_table(body.role);
  for (auto& force : force_effect_table(body.train)) table.push_back(std::move(force));
  return table;
}

std::vector<EffectInfo> effect_table(const Machine& machine, const std::vector<BodyScene>& bodies) {
  std::vector<EffectInfo> table = effects_of(machine);
  for (const auto& body : bodies) {
    if (body.role == BodyRole::train_shaft) add_shaft_needs(std::get<kinetics::DriveTrain>(machine), table);
    for (auto& info : body_effect_table(body)) table.push_back(std::move(info));
  }
  return table;
}

std::vector<EffectInfo> effect_table(const Scene& scene) {
  return effect_table(scene.machine, scene.bodies);
}

}  // namespace pipelines

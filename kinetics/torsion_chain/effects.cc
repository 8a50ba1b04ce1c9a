#include "kinetics/torsion_chain/effects.h"

#include <algorithm>
#include <functional>

#include "kinetics/torsion_chain/checks.h"

namespace kinetics::torsion {
namespace {

struct DampingKind {
  EffectInfo info;
  std::function<bool(const DriveTrain&)> present;
  std::function<void(DriveTrain&)> take_out;
};

template <class Member>
bool any(const std::vector<Member>& members, double Member::*value) {
  return std::any_of(members.begin(), members.end(), [&](const Member& m) { return m.*value != 0; });
}

template <class Member>
void clear(std::vector<Member>& members, double Member::*value) {
  for (Member& member : members) member.*value = 0;
}

const std::vector<DampingKind>& kinds() {
  static const std::vector<DampingKind> list = {
      {{"inertia_damping", "Viscous damping of inertias against the ground (bearings, air).", "D in (9)"},
       [](const DriveTrain& t) { return any(t.inertias, &TrainInertia::damping_N_m_s); },
       [](DriveTrain& t) { clear(t.inertias, &TrainInertia::damping_N_m_s); }},
      {{"element_damping", "Viscous damping within shafts, belts and gears.", "D in (9)"},
       [](const DriveTrain& t) { return any(t.elements, &TrainElement::damping_N_m_s); },
       [](DriveTrain& t) { clear(t.elements, &TrainElement::damping_N_m_s); }},
      {{"structural_damping", "Structural damping of shafts, belts and gears, by their loss factors.",
        "ours"},
       [](const DriveTrain& t) { return any(t.elements, &TrainElement::loss_factor); },
       [](DriveTrain& t) { clear(t.elements, &TrainElement::loss_factor); }},
      {{"modal_damping", "One damping ratio for every elastic mode of the undamped train.", "ours"},
       [](const DriveTrain& t) { return t.modal_damping_ratio != 0; },
       [](DriveTrain& t) { t.modal_damping_ratio = 0; }},
  };
  return list;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

const std::vector<EffectInfo>& damping_effects() {
  static const std::vector<EffectInfo> infos = [] {
    std::vector<EffectInfo> list;
    for (const DampingKind& kind : kinds()) list.push_back(kind.info);
    return list;
  }();
  return infos;
}

}  // namespace kinetics::torsion

namespace kinetics {

std::vector<EffectInfo> drive_train_effects(const DriveTrain& train) {
  torsion::check_excitations(train);
  std::vector<EffectInfo> infos;
  for (const TrainExcitation& x : train.excitations)
    infos.push_back({x.name, "Torque on " + x.inertia + ".", "M in (16)"});
  for (const torsion::DampingKind& kind : torsion::kinds())
    if (kind.present(train)) infos.push_back(kind.info);
  return infos;
}

DriveTrain with_effects(const DriveTrain& train, const std::vector<std::string>& effects) {
  DriveTrain left = train;
  left.excitations.clear();
  for (const TrainExcitation& excitation : train.excitations)
    if (torsion::contains(effects, excitation.name)) left.excitations.push_back(excitation);
  for (const torsion::DampingKind& kind : torsion::kinds())
    if (!torsion::contains(effects, kind.info.name)) kind.take_out(left);
  return left;
}

}  // namespace kinetics

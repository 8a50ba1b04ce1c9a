#include "kinetics/vibratory/table.h"

#include <algorithm>

#include "kinetics/vibratory_effects/springs.h"

namespace kinetics::vibratory {
namespace {

std::vector<EffectInfo> infos(Convention convention) {
  std::vector<EffectInfo> list;
  for (const EffectRow& row : effect_table())
    if (convention == Convention::published ? row.published : row.consistent) list.push_back(row.info);
  return list;
}

}  // namespace

const std::vector<EffectRow>& effect_table() {
  static const std::vector<EffectRow> table = {
      {{"gravity_structure", "Weight of the moving structure (chamber), at its centre of mass.",
        "(43), (59)"},
       gravity_structure,
       gravity_structure},
      {{"gravity_exciter", "Weight of the exciter housing, at the eccentric's axis.", "(43)"},
       gravity_exciter,
       gravity_exciter},
      {{"gravity_charge", "Weight of the grinding charge, at its centre of mass.", "(43), (59)"},
       gravity_charge,
       gravity_charge},
      {{"gravity_debalance", "Weight of the debalances, on the shaft.", "(43), (59)"},
       gravity_debalance,
       gravity_debalance},
      {{"structure_inertia", "Inertia of the chamber that the eccentric carries round.",
        "ours; missing in (28), (42)"},
       structure_inertia,
       nullptr},
      {{"exciter_inertia", "Inertia of the exciter housing that the eccentric carries round.",
        "ours; missing in (28), (42)"},
       exciter_inertia,
       nullptr},
      {{"charge_translation", "Inertia of the charge against the chamber's translation.", "(35)"},
       charge_translation,
       charge_translation},
      {{"charge_centripetal",
        "Centrifugal force of the charge, for its distance from the chamber's centre turning with "
        "the drive.",
        "omega_e x (omega_e x r) of (14), dropped in (15)"},
       charge_centripetal,
       nullptr},
      {{"charge_coriolis", "Coriolis force of the charge that circulates relative to the drive.", "(39)"},
       charge_coriolis,
       charge_coriolis},
      {{"charge_relative", "Centrifugal force of the charge's circulation relative to the drive.", "(37)"},
       charge_relative,
       charge_relative},
      {{"charge_lag",
        "The charge's translation trails the chamber by a loss angle: what grinding takes from the drive. "
        "Holds the difference to charge_translation.",
        "ours",
        {{"charge_translation", "the lag delays the force of charge_translation", "ours"}}},
       charge_lag,
       nullptr},
      {{"springs", "Preload and elastic force of the spring supports, each at its foot.",
        "ours; replaces (31)"},
       springs,
       nullptr},
      {{"springs", "Vertical elastic force of all springs together.", "(31); from the moments (59)"},
       nullptr,
       published_springs},
      {{"spring_damping", "Viscous force of the spring supports, each at its foot.", "ours"},
       spring_damping,
       nullptr},
      {{"debalance_inertia", "Centrifugal force of the debalances, on the shaft.", "(33)"},
       debalance_inertia,
       debalance_inertia},
      {{"pitch",
        "Frees the chamber's small pitch about the eccentric and adds its inertia.",
        "ours; replaces (59)",
        {{"springs", "nothing but the springs holds the attitude of a chamber that pitches", "ours"}}},
       pitch,
       nullptr},
      {{"charge_follows_pitch",
        "The charge is carried along by the pitch of the chamber.",
        "ours",
        {{"pitch", "the charge can follow the pitch only of a chamber that pitches", "ours"}}},
       charge_follows_pitch,
       nullptr},
  };
  return table;
}

std::vector<std::string> effect_names(Convention convention) {
  std::vector<std::string> names;
  for (const EffectInfo& info : vibratory_mill_effects(convention)) names.push_back(info.name);
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool contains(const std::vector<NamedEffect>& effects, const std::string& name) {
  return std::any_of(effects.begin(), effects.end(), [&](const NamedEffect& e) { return e.name == name; });
}

std::vector<NamedEffect> make_effects(const VibratoryMill& mill, const std::vector<std::string>& names) {
  const bool published = mill.convention == Convention::published;
  VibratoryMill supported = mill;
  if (!published && contains(names, "springs")) supported.springs = with_preloads(mill, names);
  std::vector<NamedEffect> effects;
  for (const EffectRow& row : effect_table())
    if (const Maker make = published ? row.published : row.consistent; make && contains(names, row.info.name))
      effects.push_back({row.info.name, make(supported)});
  return effects;
}

Eigen::Array2Xd position(const VibratoryMill& mill, const PlacedForce& force, const Instants& at) {
  const Eigen::Index n = at.size();
  switch (force.place) {
    case Place::structure_centre:
      return constant(mill.structure_centre_m, n);
    case Place::chamber_centre:
      return constant(mill.chamber_centre_m, n);
    case Place::charge_centre:
      return constant(mill.chamber_centre_m, n) + mill.charge_offset_m * at.along_chi;  // (4), from E'
    case Place::spring_foot:
      return constant(mill.springs[force.foot].position_m, n);
    case Place::debalance:
      return mill.debalance_offset_m * at.along_phi;
    case Place::pivot:
      break;
  }
  return Eigen::Array2Xd::Zero(2, n);
}

}  // namespace kinetics::vibratory

namespace kinetics {

const std::vector<EffectInfo>& vibratory_mill_effects(Convention convention) {
  static const std::vector<EffectInfo> consistent = vibratory::infos(Convention::consistent);
  static const std::vector<EffectInfo> published = vibratory::infos(Convention::published);
  return convention == Convention::published ? published : consistent;
}

}  // namespace kinetics

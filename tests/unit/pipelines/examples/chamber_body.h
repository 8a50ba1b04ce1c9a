/// The laboratory mill's chamber, its ports and masses written by hand: what weighs is exactly what the load
/// stage has.
#pragma once

#include <string>
#include <vector>

#include "kinetics/vibratory_mill.h"
#include "pipelines/loads/bodies/chamber.h"
#include "tests/unit/pipelines/examples/bodies.h"
#include "tests/unit/pipelines/examples/laboratory.h"

namespace chamber {

inline kinetics::VibratoryMill mill() {
  return laboratory::scene().vibratory_mill();
}

/// All effects of the mill but those named.
inline std::vector<std::string> effects_without(const std::vector<std::string>& without) {
  std::vector<std::string> names;
  for (const auto& effect : kinetics::vibratory_mill_effects(kinetics::Convention::consistent))
    if (std::find(without.begin(), without.end(), effect.name) == without.end()) names.push_back(effect.name);
  return names;
}

/// Those of the specification's figures: neither the optional lag, nor the charge following the pitch.
inline std::vector<std::string> spec_effects(std::vector<std::string> without = {}) {
  without.insert(without.end(), {"charge_lag", "charge_follows_pitch"});
  return effects_without(without);
}

/// Volume groups 11 and 12. Masses lopsided along z, so that mx and my have work to do.
inline pipelines::LoadedBody body() {
  using Kind = meshes::Port::Kind;
  const auto m = mill();
  const auto& c = m.chamber_centre_m;
  fem::MassProperties structure, exciter;
  structure.mass_kg = m.structure_mass_kg;
  structure.first_moment_kg_m = {m.structure_mass_kg * m.structure_centre_m.x(),
                                 m.structure_mass_kg * m.structure_centre_m.y(), 0.05};
  exciter.mass_kg = m.exciter_mass_kg;
  exciter.second_moments_kg_m2 = {0.009, 0.009, 0.02, 0, 0, 0};
  structure.second_moments_kg_m2 = {2.6, m.pitch_inertia_kg_m2 - 2.6 - 0.018, 0.4, 0.1, 0.02, -0.03};
  pipelines::LoadedBody body{
      "chamber",
      {bodies::port("housing_bore", Kind::bore, 1, {-0.0525, 0.0525}, 0.0475),
       bodies::port("inner_wall", Kind::bore, 2, {-0.105, 0.105}, 0.13, {c.x(), c.y()}),
       bodies::port("covers", Kind::face, 3, {-0.105, 0.105}, 0.186, {c.x(), c.y()})},
      {{"structure", {11}, structure}, {"exciter", {12}, exciter}},
      {}};
  for (std::size_t i = 0; i < m.springs.size(); ++i) {
    const auto& p = m.springs[i].position_m;
    body.ports.push_back(bodies::port("spring_foot_" + std::to_string(i + 1), Kind::face, 4 + int(i),
                                      {-0.09, 0.09}, 0, {p.x(), p.y()}));
  }
  return body;
}

/// The machine's loads over its whole period, on that body.
struct Loaded {
  kinetics::LoadHistory history;
  pipelines::BodyLoads loads;
  pipelines::Closure closure;
};

inline Loaded distribute(const std::vector<std::string>& effects,
                         const pipelines::LoadedBody& loaded = body(),
                         pipelines::PitchGuide guide = pipelines::PitchGuide::body) {
  Loaded result;
  result.history = kinetics::compute_loads(mill(), effects, {20, 360});
  result.loads = pipelines::distribute_chamber(result.history, mill(), loaded, {effects, {}, {}, guide});
  result.closure = bodies::closure_of(result.loads, loaded.regions);
  return result;
}

/// Largest force and moment about z that is left over [N], [N m].
inline double open_force(const Loaded& result, const pipelines::LoadedBody& loaded) {
  const auto rest = bodies::residual(result.loads, loaded.regions);
  return rest.topRows<2>().square().colwise().sum().sqrt().maxCoeff();
}
inline double open_couple(const Loaded& result, const pipelines::LoadedBody& loaded) {
  return bodies::largest(bodies::residual(result.loads, loaded.regions).row(5));
}

}  // namespace chamber

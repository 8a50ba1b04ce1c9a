/// The laboratory mill and the ports of its shaft, as small values that tests may change.
#pragma once

#include <filesystem>
#include <vector>

#include "fem/base/values/body.h"
#include "kinetics/vibratory_mill.h"
#include "meshes/values/body_mesh.h"
#include "pipelines/loads/channels/load_collector.h"
#include "pipelines/scene/whole/scene.h"

namespace laboratory {

inline pipelines::Scene scene() {
  return pipelines::read_scene(std::filesystem::path(SOURCE_DIR) / "pipelines/scenes/vibratory_mill.toml");
}

/// The spec's laboratory mill to the letter: no charge lag (the shipped scene adds it), the pitch without the
/// charge.
inline kinetics::LoadHistory spec_loads(int instants_per_turn = 72) {
  auto machine = scene().vibratory_mill();
  std::vector<std::string> effects;
  for (const auto& effect : scene().kinetics_effects())
    if (effect != "charge_lag" && effect != "charge_follows_pitch") effects.push_back(effect);
  return kinetics::compute_loads(machine, effects, {20, instants_per_turn});
}

inline meshes::Port seat(const std::string& name, int id, double begin_m, double end_m, double diameter_m,
                         double offset_m = 0) {
  return {name, meshes::Port::Kind::seat, id, begin_m, end_m, diameter_m / 2, offset_m, 0};
}

/// Seats of the default shaft, with the loaded zones inside the fillets.
inline std::vector<meshes::Port> ports() {
  return {seat("coupling", 1, -0.2715, -0.2285, 0.025),
          seat("debalance_1", 2, -0.2265, -0.1925, 0.030),
          seat("main_bearing_1", 3, -0.1905, -0.1695, 0.035),
          seat("eccentric_seat", 4, -0.030, 0.030, 0.060, 0.004),
          seat("main_bearing_2", 5, 0.1695, 0.1905, 0.035),
          seat("debalance_2", 6, 0.1925, 0.2265, 0.030)};
}

/// Mass figures of the default shaft (5.265 kg, 5.33e-3 kg m), its second moments only in size.
inline fem::MassProperties masses() {
  fem::MassProperties m;
  m.mass_kg = 5.265;
  m.first_moment_kg_m = {5.33e-3, 0, -0.04};
  m.second_moments_kg_m2 = {6e-4, 6e-4, 0.08, 0, 0, 1e-5};
  return m;
}

/// The default shaft as distribution sees it, every seat's pressure to the fourth harmonic.
inline pipelines::LoadedBody shaft() {
  return {"shaft", ports(), {{"", {}, masses()}}, {}};
}

}  // namespace laboratory

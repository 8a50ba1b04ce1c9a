/// Unit responses of two cells, for tests of the files that keep them.
#pragma once

#include <limits>
#include <random>

#include "tests/unit/pipelines/examples/results_bar.h"

namespace results_test {

/// Every field filled with numbers of its own, among them some that only exact storage keeps.
inline fem::UnitResponses example_responses() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  fem::UnitResponses r;
  r.channels = {"main_bearing_1.fx", "pulley.mz"};
  r.nodes = mapped_cube(2, 1, 3, quadratic_map);
  r.displacement_m.resize(r.nodes.n * 2 * 3);
  r.stress_Pa.resize(r.nodes.n * 2 * 6);
  for (auto* values : {&r.displacement_m, &r.stress_Pa})
    for (double& value : *values) value = number(random);
  r.displacement_m[0] = 5e-324;
  r.displacement_m[1] = -0.0;
  r.stress_Pa[0] = std::numeric_limits<double>::quiet_NaN();
  const auto fill = [&](auto& entries) {
    for (double& entry : entries) entry = number(random);
  };
  r.resultants.resize(2);
  for (auto& resultant : r.resultants) fill(resultant);
  r.planes = {{0.1, 0.05, 0.001, -0.002}, {0.2, 0.06, 0.003, -0.004}, {0.3, 0.07, 0.005, -0.006}};
  r.plane_area_m2 = {0.1, 0.2, 0.3};
  r.sections.resize(3 * 2);
  for (auto& section : r.sections) {
    fill(section.resultant);
    fill(section.mean_rim_shear_Pa);
    fill(section.translation_m);
    fill(section.rotation_rad);
  }
  r.rings = {{0.15, 0.05, 11}, {0.25, 0.06, 12}};
  r.ring_shear_Pa.resize(2 * 2);
  for (auto& ring : r.ring_shear_Pa) fill(ring);
  r.nodes.cell_volume_id.resize(r.nodes.n_cells());
  for (auto& volume : r.nodes.cell_volume_id) volume = std::int32_t(random() % 5);
  r.energy_error.norm_sqrtJ.resize(2);
  r.energy_error.energy.resize(4);
  r.energy_error.error.resize(4);
  r.energy_error.of_cells.resize(r.nodes.n_cells() * 2);
  fill(r.energy_error.norm_sqrtJ);
  fill(r.energy_error.energy);
  fill(r.energy_error.error);
  fill(r.energy_error.of_cells);
  for (std::size_t i = 0; i < r.nodes.n; ++i) r.images.node.push_back(std::int32_t(r.nodes.n - 1 - i));
  for (std::size_t c = 0; c < r.nodes.n_cells(); ++c)
    r.images.cell.push_back(std::int32_t(r.nodes.n_cells() - 1 - c));
  r.support_reaction = 1e-13;
  r.residual = 1. / 3e12;
  r.n_dofs = 634047;
  r.factor_gigabytes = 2.7;
  r.solver.reason = "stalled";
  r.solver.used_bytes = 3e9;
  r.solver.predicted_direct.bytes = 2e9;
  return r;
}

}  // namespace results_test

#include "tests/verification/calculix/calculix_comparison.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "fem/stress/cells/cell_stress_at_node.h"
#include "fem/stress/cells/region_volume.h"
#include "pipelines/command/calculix/calculix_model.h"
#include "pipelines/loads/channels/rigid_part.h"
#include "pipelines/superpose/envelope/superposition.h"

namespace pipelines {
namespace {

/// Nodes of the surfaces that both codes have.
std::vector<std::size_t> nodes_on(const fem::Nodes& nodes, const std::vector<int>& boundary_ids,
                                  const Serendipity& kept) {
  std::vector<std::size_t> result;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f)
    if (std::find(boundary_ids.begin(), boundary_ids.end(), nodes.face_boundary_id[f]) != boundary_ids.end())
      for (const auto node : nodes.face(f))
        if (kept.keeps(std::size_t(node))) result.push_back(std::size_t(node));
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  if (result.empty())
    throw std::invalid_argument("compare_with_calculix: no node lies on the surfaces asked for");
  return result;
}

/// One load of ours, n x 3.
std::vector<double> displacement_of(const fem::UnitResponses& responses, std::size_t load) {
  std::vector<double> result(3 * responses.nodes.n);
  for (std::size_t i = 0; i < responses.nodes.n; ++i)
    std::copy_n(responses.unit_displacement_m(i) + 3 * load, 3, &result[3 * i]);
  return result;
}

double von_mises_at(const std::vector<double>& stress_Pa, std::size_t row) {
  Stress stress{};
  std::copy_n(&stress_Pa[row * 6], 6, stress.begin());
  return von_mises_Pa(stress);
}

/// CalculiX's fields in the form of ours: of one load, on the geometry and with the displacement of 20 nodes
/// at all 27.
fem::UnitResponses as_responses(const fem::Nodes& nodes, const Serendipity& kept,
                                std::vector<double> displacement_m) {
  fem::UnitResponses result;
  result.channels = {"calculix"};
  result.nodes = nodes;
  kept.extend(result.nodes.xyz_m.data(), 3);
  result.displacement_m = std::move(displacement_m);
  return result;
}

/// Largest distance of the cells' von Mises stress from the nodal one.
double cells_apart_Pa(const fem::UnitResponses& responses, const fem::Material& material, std::size_t node,
                      std::size_t load, double nodal_Pa) {
  double apart = 0;
  for (const auto& cell : fem::cell_stress_at_node_Pa(responses, material, node))
    apart = std::max(apart, std::abs(von_mises_Pa(cell[load]) - nodal_Pa));
  return apart;
}

}  // namespace

std::vector<CalculixAgreement> compare_with_calculix(const fem::UnitResponses& ours,
                                                     const fem::NodalLoads& loads,
                                                     const CalculixResults& calculix,
                                                     const fem::Material& material,
                                                     const std::vector<int>& boundary_ids) {
  const std::size_t n = ours.nodes.n, n_loads = ours.channels.size();
  if (calculix.n_steps != n_loads || calculix.stress_Pa.size() != n_loads * n * 6 || loads.nodes.n != n ||
      loads.force_N.size() != n_loads * n * 3)
    throw std::invalid_argument("compare_with_calculix: " + std::to_string(calculix.n_steps) +
                                " steps of CalculiX beside " + std::to_string(n_loads) +
                                " loads: they have to be those of one model");
  const Serendipity kept(ours.nodes);
  const auto forces = calculix_forces(loads, kept);
  const RigidPart rigid(ours.nodes, fem::nodal_volumes_m3(ours.nodes));
  const auto surface = nodes_on(ours.nodes, boundary_ids, kept);
  std::vector<CalculixAgreement> result(n_loads);
  for (std::size_t k = 0; k < n_loads; ++k) {
    auto& at = result[k];
    at.channel = ours.channels[k];
    const auto own = displacement_of(ours, k);
    std::vector<double> other(&calculix.displacement_m[k * n * 3],
                              &calculix.displacement_m[k * n * 3] + 3 * n);
    at.compliance_J = std::inner_product(own.begin(), own.end(), &loads.force_N[k * n * 3], 0.0);
    at.calculix_compliance_J =
        std::inner_product(other.begin(), other.end(), &forces.force_N[k * n * 3], 0.0);
    kept.extend(other.data(), 3);

    auto difference = other;
    for (std::size_t i = 0; i < 3 * n; ++i) difference[i] -= own[i];
    rigid.remove_motion(difference.data());
    at.displacement_difference = rigid.norm(difference.data()) / rigid.norm(own.data());

    at.node = *std::max_element(surface.begin(), surface.end(), [&](std::size_t a, std::size_t b) {
      return von_mises_at(ours.stress_Pa, a * n_loads + k) < von_mises_at(ours.stress_Pa, b * n_loads + k);
    });
    at.ours.von_mises_Pa = von_mises_at(ours.stress_Pa, at.node * n_loads + k);
    at.ours.error_Pa = cells_apart_Pa(ours, material, at.node, k, at.ours.von_mises_Pa);
    at.calculix.von_mises_Pa = von_mises_at(calculix.stress_Pa, k * n + at.node);
    at.calculix.error_Pa = cells_apart_Pa(as_responses(ours.nodes, kept, std::move(other)), material, at.node,
                                          0, at.calculix.von_mises_Pa);
  }
  return result;
}

}  // namespace pipelines

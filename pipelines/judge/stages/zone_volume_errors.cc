#include "pipelines/judge/stages/zone_volume_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "fem/base/values/vtk_order.h"
#include "fem/stress/cells/cell_stress_at_node.h"
#include "fem/stress/cells/region_volume.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/estimates/fitted.h"
#include "pipelines/judge/stages/place_errors.h"
#include "pipelines/superpose/envelope/disjoint_sets.h"

namespace pipelines {
namespace {

/// Share of the zones' level: a node below it is not doubted by its cells.
constexpr double worth_a_look = 0.2;

/// Shares of error of the features that are judged. Far below the largest stress a place's error is the
/// stress itself, and tells nothing.
std::map<std::int32_t, double> shares_of_features(const Judged& analysis) {
  std::map<std::int32_t, double> shares;
  const auto& names = analysis.places.feature_names;
  for (const auto& place : analysis.place_stresses) {
    const auto name = std::find(names.begin(), names.end(), place.feature);
    if (name == names.end() || !(place.value_Pa > 0) || !(place.error_Pa < place.value_Pa)) continue;
    shares[std::int32_t(name - names.begin())] = place.error_Pa / place.value_Pa;
  }
  return shares;
}

/// At every node the largest share of those that its cells have.
std::vector<double> shares_of_nodes(const Judged& analysis) {
  const auto& nodes = analysis.responses.nodes;
  const auto of_feature = shares_of_features(analysis);
  std::vector<double> shares(nodes.n, 0.0);
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    double largest = 0;
    for (const auto node : nodes.cell(c))
      if (const auto known = of_feature.find(analysis.places.feature[std::size_t(node)]);
          known != of_feature.end())
        largest = std::max(largest, known->second);
    if (largest == 0) continue;
    for (const auto node : nodes.cell(c))
      shares[std::size_t(node)] = std::max(shares[std::size_t(node)], largest);
  }
  return shares;
}

std::vector<double> doubts_of_cells_Pa(const Judged& analysis) {
  const auto& responses = analysis.responses;
  const auto& maximum = analysis.envelope.von_mises;
  const auto& loads = analysis.loads.history.values;
  std::vector<const double*> factors(responses.nodes.n, nullptr);
  for (std::size_t i = 0; i < factors.size(); ++i)
    if (maximum.value_Pa[i] >= worth_a_look * analysis.zones.level_Pa && !analysis.places.excluded[i])
      factors[i] = loads.col(maximum.instant[i]).data();
  return fem::largest_cell_differences_Pa(responses, analysis.scene.material, factors);
}

/// The share of the peak's error that single cells and places do not tell.
double share_of_the_rest(const Peak& peak) {
  const double rest_Pa =
      peak.errors.numerical_Pa() - peak.errors.of("discretisation") - peak.errors.of("other_places");
  return peak.value_Pa > 0 ? std::max(0.0, rest_Pa) / peak.value_Pa : 0;
}

/// What the cells of each zone measure otherwise where the stress runs straight between nodes, or curved.
std::vector<double> between_nodes_m3(const Judged& analysis) {
  const auto& nodes = analysis.responses.nodes;
  const auto& value_Pa = analysis.envelope.von_mises.value_Pa;
  const auto& zones = analysis.zones;
  const auto& excluded = analysis.places.excluded;
  const auto straight = fem::cell_volumes_above_m3(nodes, value_Pa, zones.level_Pa, excluded),
             curved = fem::curved_cell_volumes_above_m3(nodes, value_Pa, zones.level_Pa, excluded);
  std::vector<double> sums(zones.zones.size(), 0.0);
  for (std::size_t c = 0; c < nodes.n_cells(); ++c)
    for (const auto node : nodes.cell(c))
      if (const auto zone = zones.zone_of_node[std::size_t(node)]; zone > 0) {
        sums[std::size_t(zone - 1)] += std::abs(curved[c] - straight[c]);
        break;
      }
  return sums;
}

/// Whether two nodes of a cell are neighbours in it: in hexahedra of degree 2 those of one of its eight
/// boxes, in other cells all.
bool are_neighbours(const fem::Nodes& nodes, std::size_t a, std::size_t b) {
  if (nodes.shape().is_tetrahedron() || nodes.degree != 2) return true;
  static const auto place = [] {
    std::array<std::array<int, 3>, 27> of{};
    for (int v = 0; v < 27; ++v)
      of[std::size_t(v)] = {fem::vtk_hexahedron_from_lexicographic[std::size_t(v)] % 3,
                            fem::vtk_hexahedron_from_lexicographic[std::size_t(v)] / 3 % 3,
                            fem::vtk_hexahedron_from_lexicographic[std::size_t(v)] / 9};
    return of;
  }();
  for (std::size_t d = 0; d < 3; ++d)
    if (std::abs(place[a][d] - place[b][d]) > 1) return false;
  return true;
}

/// Volumes of the regions above the zones' level that hold these nodes, joined only where neighbouring nodes
/// are: zones join across a whole cell, and cells may be wider than what lies between two zones. A cell of
/// several regions is shared out by their nodes.
std::vector<double> least_volumes_m3(const Judged& analysis, const std::vector<double>& value_Pa,
                                     const std::vector<std::size_t>& held) {
  const auto& nodes = analysis.responses.nodes;
  const double level_Pa = analysis.zones.level_Pa;
  const auto& excluded = analysis.places.excluded;
  const auto inside = [&](std::size_t i) { return is_in_zone(value_Pa[i], level_Pa, excluded[i] != 0); };
  DisjointSets sets(nodes.n);
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    for (std::size_t a = 1; a < cell.size(); ++a)
      for (std::size_t b = 0; b < a && inside(std::size_t(cell[a])); ++b)
        if (inside(std::size_t(cell[b])) && are_neighbours(nodes, a, b))
          sets.join(std::size_t(cell[a]), std::size_t(cell[b]));
  }
  const auto of_cells_m3 = fem::cell_volumes_above_m3(nodes, value_Pa, level_Pa, excluded);
  std::map<std::size_t, double> volume_m3;  // by root
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    if (of_cells_m3[c] == 0) continue;
    std::vector<std::size_t> roots;
    for (const auto node : nodes.cell(c))
      if (inside(std::size_t(node))) roots.push_back(sets.find(std::size_t(node)));
    for (const auto root : roots) volume_m3[root] += of_cells_m3[c] / double(roots.size());
  }
  std::vector<double> result;
  for (const auto node : held) result.push_back(inside(node) ? volume_m3[sets.find(node)] : 0);
  return result;
}

}  // namespace

std::vector<double> envelope_errors_Pa(const Judged& analysis) {
  const auto& responses = analysis.responses;
  const auto& value_Pa = analysis.envelope.von_mises.value_Pa;
  std::vector<double> errors(responses.nodes.n, 0.0);
  auto shares = shares_of_nodes(analysis);
  const double rest = share_of_the_rest(analysis.peak);
  std::vector<double> doubts_Pa(responses.nodes.n, 0.0);
  if (responses.nodes.shape().is_tetrahedron()) {
    double largest = 0;
    for (const auto& zone : analysis.zones.zones)
      if (zone.error_Pa) largest = std::max(largest, *zone.error_Pa / zone.peak_Pa);
    for (double& share : shares) share = std::max(share, largest);
  } else if (!responses.energy_error.norm_sqrtJ.empty()) {
    doubts_Pa = doubts_of_cells_Pa(analysis);
  }
  for (std::size_t i = 0; i < errors.size(); ++i)
    errors[i] += std::max(doubts_Pa[i], shares[i] * value_Pa[i]) + rest * value_Pa[i];
  if (analysis.method == Method::axisymmetric)
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (value_Pa[i] < worth_a_look * analysis.zones.level_Pa) continue;
      const double* x = &responses.nodes.xyz_m[3 * i];
      errors[i] += error_Pa(analysis, PlaceStress{"", i, value_Pa[i], 0, {x[0], x[1], x[2]}});
    }
  return errors;
}

void estimate_volume_errors(Judged& analysis) {
  if (analysis.method == Method::beam || analysis.zones.zones.empty()) return;
  const auto& nodes = analysis.responses.nodes;
  auto high_Pa = analysis.envelope.von_mises.value_Pa, low_Pa = high_Pa;
  const auto errors_Pa = envelope_errors_Pa(analysis);
  for (std::size_t i = 0; i < errors_Pa.size(); ++i) {
    high_Pa[i] += errors_Pa[i];
    low_Pa[i] -= errors_Pa[i];
  }
  std::vector<std::size_t> peaks;
  for (const auto& zone : analysis.zones.zones) peaks.push_back(zone.peak_node);
  const auto most_m3 = region_volumes_m3(nodes, high_Pa, analysis.places, analysis.zones.level_Pa, peaks),
             least_m3 = least_volumes_m3(analysis, low_Pa, peaks);
  const auto between_m3 = between_nodes_m3(analysis);
  for (std::size_t z = 0; z < peaks.size(); ++z) {
    auto& zone = analysis.zones.zones[z];
    zone.volume_error_m3 = std::max(most_m3[z] - zone.volume_m3, zone.volume_m3 - least_m3[z]) +
                           fitted::safety_between_nodes * between_m3[z];
  }
}

}  // namespace pipelines

#include "pipelines/search/refinement/solid_refinement.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "pipelines/judge/estimates/fineness.h"
#include "pipelines/judge/estimates/tetrahedra_estimate.h"
#include "pipelines/search/cheap_models/fitted.h"

namespace pipelines {
namespace {

constexpr double shrinkage = 0.6, radius_cells = 1.5;
/// Balls overlap: the next one begins at this share of a ball's radius from its centre.
constexpr double spacing = 0.5;
/// A place that knows less than this of its stress does not make the whole body fine at once.
constexpr double largest_relative_error = 0.2;

/// Mean edge of the cells around each node; 0 where there is none.
std::vector<double> cell_sizes_m(const fem::Nodes& nodes) {
  std::vector<double> sum_m(nodes.n, 0.0), n(nodes.n, 0.0);
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    double edges_m = 0;
    for (std::size_t i = 0; i < 4; ++i)  // corners of a tetrahedron
      for (std::size_t j = 0; j < i; ++j) {
        const double *a = &nodes.xyz_m[3 * std::size_t(cell[i])], *b = &nodes.xyz_m[3 * std::size_t(cell[j])];
        edges_m += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) / 6;
      }
    for (const auto node : cell) {
      sum_m[std::size_t(node)] += edges_m;
      n[std::size_t(node)] += 1;
    }
  }
  for (std::size_t i = 0; i < nodes.n; ++i)
    if (n[i] > 0) sum_m[i] /= n[i];
  return sum_m;
}

/// What the nodes along a place may be wrong by, against its largest: its own error is that of one node,
/// which is among the least wrong, and cells around one node agree by chance.
constexpr double scatter_safety = 1.5;
double error_of_nodes_Pa(const Superposed& analysis, const PlaceStress& place) {
  const auto instant = analysis.envelope.von_mises.instant[place.node];
  const Eigen::ArrayXd factors = analysis.loads.history.values.col(instant);
  const auto scatter = tetrahedra_estimate({{{place.node, 1.0}}, instant}, analysis.responses,
                                           analysis.scene.material, {factors.begin(), factors.end()});
  return std::max(place.error_Pa, scatter_safety * scatter.value_Pa);
}

/// The least stress of each place, by its name, that may be the largest of the body.
std::map<std::string, double> least_leading_Pa(const Superposed& analysis,
                                               const std::vector<PlaceStress>& judged) {
  const double largest_Pa = judged[judge(judged).governing].value_Pa;
  std::map<std::string, double> least;
  for (const auto& place : judged)
    if (place.value_Pa > 0 && place.value_Pa + place.error_Pa >= largest_Pa)
      least[place.feature] = largest_Pa / (1 + std::min(error_of_nodes_Pa(analysis, place) / place.value_Pa,
                                                        largest_relative_error));
  return least;
}

/// The nodes of all places that may lead, by falling stress; the largest of each place among them.
std::vector<std::size_t> leading_nodes(const Superposed& analysis, const std::vector<PlaceStress>& judged,
                                       std::vector<std::string>& features) {
  const auto least = least_leading_Pa(analysis, judged);
  const auto& nodes = analysis.responses.nodes;
  const auto& stress_Pa = analysis.envelope.von_mises.value_Pa;
  std::vector<char> leads(nodes.n, 0);
  for (const auto& place : judged)
    if (const auto found = least.find(place.feature); found != least.end()) {
      features.push_back(place.feature);
      leads[place.node] = 1;
    }
  std::map<int, double> least_of_boundary;
  for (const auto& feature : analysis.mesh.features)
    if (const auto found = least.find(feature.name); found != least.end())
      least_of_boundary[feature.boundary_id] = found->second;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto found = least_of_boundary.find(nodes.face_boundary_id[f]);
    if (found == least_of_boundary.end()) continue;
    for (const auto node : nodes.face(f))
      if (!analysis.places.excluded[std::size_t(node)] && stress_Pa[std::size_t(node)] >= found->second)
        leads[std::size_t(node)] = 1;
  }
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < nodes.n; ++i)
    if (leads[i]) chosen.push_back(i);
  std::stable_sort(chosen.begin(), chosen.end(),
                   [&](std::size_t a, std::size_t b) { return stress_Pa[a] > stress_Pa[b]; });
  return chosen;
}

}  // namespace

double seconds_of_tetrahedra(double n_dofs) {
  return fitted::s_per_dof * n_dofs + fitted::s_per_dof_of_factor * std::pow(n_dofs, growth_of_seconds);
}

LeadingSurface leading_surface(const Superposed& analysis, const std::vector<PlaceStress>& judged) {
  LeadingSurface result;
  const auto& nodes = analysis.responses.nodes;
  const auto sizes_m = cell_sizes_m(nodes);
  for (const auto node : leading_nodes(analysis, judged, result.features)) {
    const double* x = &nodes.xyz_m[3 * node];
    const bool is_covered = std::any_of(result.spots.begin(), result.spots.end(), [&](const auto& spot) {
      const auto& y = spot.centre_m;
      return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]) < spacing * spot.radius_m;
    });
    if (is_covered || sizes_m[node] == 0) continue;
    result.spots.push_back({{x[0], x[1], x[2]}, radius_cells * sizes_m[node], shrinkage * sizes_m[node]});
  }
  if (!result.spots.empty()) result.ratio = 1 / shrinkage;
  return result;
}

}  // namespace pipelines

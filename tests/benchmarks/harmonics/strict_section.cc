#include "tests/benchmarks/harmonics/strict_section.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "fem/models/axisymmetric/axisymmetric_responses.h"
#include "pipelines/base/common/constants.h"
#include "pipelines/judge/analysis/exclusion_border.h"
#include "pipelines/judge/figures/diagrams.h"
#include "pipelines/search/cheap_models/axisymmetric_body.h"
#include "pipelines/superpose/envelope/superposition.h"

namespace harmonics {
namespace {

using namespace pipelines;

constexpr double at_fillet = 0.02;  // of its radius
constexpr double at_seat = 0.004;   // of the radius, at the ends of loaded seats
constexpr double at_peak = 0.004;   // of the radius
constexpr double at_border = 0.03;  // of the distance left out

int highest_harmonic(const BodyLoads& loads) {
  int highest = 1;
  for (const auto& load : loads.unit_loads)
    if (const auto* pressure = std::get_if<fem::SeatPressure>(&load.shape))
      highest = std::max(highest, pressure->harmonic);
  return highest;
}

std::vector<fem::FineCircle> fine_circles(const fem::MeridianBody& section, const meshes::BodyMesh& mesh,
                                          const std::vector<std::array<double, 2>>& peaks_m) {
  std::vector<fem::FineCircle> circles;
  double outside_m = 0;
  for (const auto& p : section.points_m) outside_m = std::max(outside_m, p[1]);
  for (const auto& torus : section.tori)
    for (const auto& edge : section.edges)
      if (edge.boundary_id == torus.boundary_id)
        for (const int end : edge.ends) {
          const auto& p = section.points_m[std::size_t(end)];
          circles.push_back({p[0], p[1], at_fillet * torus.radius_m});
        }
  for (const auto& port : mesh.ports)
    for (const auto& edge : section.edges)
      if (edge.boundary_id == port.boundary_id)
        for (const int end : edge.ends) {
          const auto& p = section.points_m[std::size_t(end)];
          if (std::abs(p[0] - port.begin_m) < 1e-9 || std::abs(p[0] - port.end_m) < 1e-9)
            circles.push_back({p[0], p[1], at_seat * p[1]});
        }
  for (const auto& edge : mesh.sharp_edges) {
    if (edge.pieces.empty()) continue;
    const auto& p = edge.pieces.front().front();
    circles.push_back({p[2], std::hypot(p[0], p[1]), at_border * edge.distance_m});
  }
  for (const auto& [z, r] : peaks_m) circles.push_back({z, r, at_peak * (r > 0 ? r : outside_m)});
  return circles;
}

/// The largest value of the trigonometric polynomial through equidistant values of which it is the square, as
/// a root.
double largest_root(const std::vector<double>& values) {
  const std::size_t n = values.size();
  std::vector<std::complex<double>> lines(n / 2);
  for (std::size_t k = 0; k < lines.size(); ++k)
    for (std::size_t j = 0; j < n; ++j)
      lines[k] += (k == 0 ? 1.0 : 2.0) / double(n) * values[j] * values[j] *
                  std::polar(1.0, -2 * pi * double(k * j) / double(n));
  double largest = 0;
  constexpr int n_angles = 7200;
  for (int i = 0; i < n_angles; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < lines.size(); ++k)
      sum += std::real(lines[k] * std::polar(1.0, 2 * pi * double(k) * i / n_angles));
    largest = std::max(largest, sum);
  }
  return std::sqrt(largest);
}

/// On the circle of the node, at its instant.
double largest_around_Pa(const fem::UnitResponses& responses, const ChannelHistory& history, std::size_t node,
                         std::int32_t instant, int n_angles) {
  const double* p = &responses.nodes.xyz_m[3 * node];
  if (std::hypot(p[0], p[1]) == 0) return von_mises_Pa(stress_at(responses, history, node, instant));
  const auto j =
      std::size_t((std::lround(std::atan2(p[1], p[0]) / (2 * pi / n_angles)) + n_angles) % n_angles);
  std::vector<double> values;
  for (std::size_t i = 0; i < std::size_t(n_angles); ++i)
    values.push_back(von_mises_Pa(stress_at(responses, history, node - j + i, instant)));
  return largest_root(values);
}

/// Without what the harmonics above one bring.
ChannelHistory up_to(const BodyLoads& loads, int highest) {
  ChannelHistory history = loads.history;
  for (std::size_t k = 0; k < loads.unit_loads.size(); ++k)
    if (const auto* pressure = std::get_if<fem::SeatPressure>(&loads.unit_loads[k].shape))
      if (pressure->harmonic > highest) {
        history.values.row(Eigen::Index(k)).setZero();
        for (auto& effect : history.by_effect) effect.row(Eigen::Index(k)).setZero();
      }
  return history;
}

}  // namespace

StrictStresses strict_stresses(const Scene& scene, const std::set<int>& highest,
                               const std::vector<std::array<double, 2>>& peaks_m, double growth) {
  const auto& body = scene.bodies.front();
  StageClock clock;
  const auto loaded = load_bodies(scene, {describe_revolved(body)}, clock);
  const auto& loads = loaded.body_loads.front();
  const auto& mesh = loaded.meshed.front().mesh;
  auto section = meridian_body(with_coarse_blocks(body), mesh);
  section.masses_of_loads = loaded.meshed.front().masses;
  section.degree = 4;
  section.n_cuts = 1;
  section.n_angles = std::max(48, 4 * highest_harmonic(loads) + 4);
  section.fine_circles = fine_circles(section, mesh, peaks_m);
  section.fine_growth = growth;
  const auto responses = fem::axisymmetric_responses(section, loads.unit_loads, {});
  const auto places = locate_nodes(responses.nodes, mesh.features, mesh.ports, mesh.sharp_edges);
  StrictStresses result;
  result.n_dofs = responses.n_dofs;
  const auto stresses_under = [&](const ChannelHistory& history) {
    const auto maximum = envelope(history, responses, 1).von_mises;
    std::map<std::string, StrictStress> stresses;
    for (const auto& place : largest_by_feature(responses.nodes, maximum.value_Pa, mesh.features, places)) {
      double value_Pa =
          largest_around_Pa(responses, history, place.node, maximum.instant[place.node], section.n_angles);
      value_Pa =
          std::max(value_Pa, place.value_Pa +
                                 rise_to_border_Pa({responses.nodes, maximum.value_Pa, places, mesh}, place));
      const auto& p = place.position_m;
      stresses[place.feature] = {value_Pa, {p[2], std::hypot(p[0], p[1])}};
    }
    return stresses;
  };
  result.places = stresses_under(loads.history);
  for (const int last : highest)
    for (const auto& [feature, stress] : stresses_under(up_to(loads, last)))
      result.truncated_Pa[last][feature] = stress.value_Pa;
  for (const auto& ring : torsion_rings(loads, responses, mesh))
    result.torsion_Pa = std::max(result.torsion_Pa, ring.max_Pa);
  return result;
}

}  // namespace harmonics

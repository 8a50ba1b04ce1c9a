#include "pipelines/judge/analysis/load_edge.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "pipelines/base/common/constants.h"

namespace pipelines {
namespace {

using Eigen::ArrayXd;

/// The larger end of a seat's axial profile, over its mean.
double end_over_mean(const std::vector<double>& profile) {
  if (profile.size() < 2) return 1;
  const double ends = (profile.front() + profile.back()) / 2;
  const double mean =
      (std::accumulate(profile.begin(), profile.end(), 0.0) - ends) / double(profile.size() - 1);
  return mean > 0 ? std::max(profile.front(), profile.back()) / mean : 1;
}

/// What one unit of a load brings to the pressure at the end of its seat, at the angle where it is largest.
struct EndPressure {
  const fem::LoadSurface* surface = nullptr;
  int harmonic = -1;  ///< of the angle; tilting pressures count apart
  double per_unit_Pa = 0;
};

constexpr int tilting = 0x10000;

EndPressure end_pressure(const fem::UnitLoad& load) {
  using Component = fem::SurfaceResultant::Component;
  if (const auto* pressure = std::get_if<fem::SeatPressure>(&load.shape)) {
    const auto& seat = pressure->surface;
    return {&seat, pressure->harmonic,
            pressure->coefficient * end_over_mean(seat.axial_profile) / (pi * seat.radius_m * seat.length_m)};
  }
  const auto* resultant = std::get_if<fem::SurfaceResultant>(&load.shape);
  if (resultant == nullptr || resultant->surface.kind != fem::LoadSurface::Kind::seat) return {};
  const auto& seat = resultant->surface;
  const double of_force = 1 / (pi * seat.radius_m * seat.length_m);
  switch (resultant->component) {
    case Component::fx:
    case Component::fy:
      return {&seat, 1, end_over_mean(seat.axial_profile) * of_force};
    case Component::mx:
    case Component::my:  // p = 12 m z / (pi R b^3) at z = b / 2
      return {&seat, tilting, 6 * of_force / seat.length_m};
    default:
      return {};
  }
}

/// Largest pressure at the ends of every loaded seat, by boundary group.
std::map<int, double> end_pressures_Pa(const BodyLoads& loads) {
  std::vector<std::pair<std::pair<int, int>, ArrayXd>> parts;  // by group and harmonic, over the instants
  double size_Pa = 0;
  for (std::size_t k = 0; k < loads.unit_loads.size(); ++k) {
    const auto end = end_pressure(loads.unit_loads[k]);
    if (end.surface == nullptr || end.per_unit_Pa == 0) continue;
    parts.push_back({{end.surface->boundary_id, end.harmonic},
                     end.per_unit_Pa * loads.history.values.row(Eigen::Index(k)).transpose()});
    size_Pa = std::max(size_Pa, parts.back().second.abs().maxCoeff());
  }
  if (size_Pa == 0) return {};
  std::map<std::pair<int, int>, ArrayXd> squares;
  for (const auto& [key, part] :
       parts)  // squares of very small and large pressures leave the range of numbers
    squares.try_emplace(key, ArrayXd::Zero(part.size())).first->second += (part / size_Pa).square();
  std::map<int, ArrayXd> sums;
  for (const auto& [key, square] : squares)
    sums.try_emplace(key.first, ArrayXd::Zero(square.size())).first->second += square.sqrt();
  std::map<int, double> largest;
  for (const auto& [group, sum] : sums) largest[group] = size_Pa * sum.maxCoeff();
  return largest;
}

Eigen::Vector3d normal_of(const fem::Nodes& nodes, std::size_t face) {
  const auto corners = nodes.face(face);
  const auto at = [&](int i) {
    return Eigen::Map<const Eigen::Vector3d>(&nodes.xyz_m[3 * std::size_t(corners[std::size_t(i)])]);
  };
  return (at(1) - at(0)).cross(at(2) - at(0)).normalized();
}

/// Nodes where a group's faces meet others that go on smoothly.
std::vector<std::int32_t> smooth_border(const fem::Nodes& nodes, int group) {
  constexpr double smooth = 0.5;  // cosine of the angle between the normals
  std::map<std::int32_t, Eigen::Vector3d> normals;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f)
    if (nodes.face_boundary_id[f] == group)
      for (const auto node : nodes.face(f)) normals[node] = normal_of(nodes, f);
  std::vector<std::int32_t> border;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    if (nodes.face_boundary_id[f] == group) continue;
    std::vector<std::int32_t> common;
    for (const auto node : nodes.face(f))
      if (normals.count(node) > 0) common.push_back(node);
    if (common.size() < 2 || normal_of(nodes, f).dot(normals.at(common.front())) < smooth) continue;
    border.insert(border.end(), common.begin(), common.end());
  }
  return border;
}

}  // namespace

void add_load_edge_error(Judged& analysis) {
  const auto& nodes = analysis.responses.nodes;
  const auto& value_Pa = analysis.envelope.von_mises.value_Pa;
  double beyond_Pa = 0;
  for (const auto& [group, pressure_Pa] : end_pressures_Pa(analysis.loads)) {
    const double more_Pa = share_at_load_edge * pressure_Pa;
    if (more_Pa <= 0) continue;
    for (const auto node : smooth_border(nodes, group))
      if (!analysis.places.excluded[std::size_t(node)])
        beyond_Pa = std::max(beyond_Pa, std::max(value_Pa[std::size_t(node)], share_of_a_node * pressure_Pa) +
                                            more_Pa - analysis.peak.value_Pa);
  }
  if (beyond_Pa > 0)
    analysis.peak.errors.set_model(
        {"load_edges", "stress below the end of a seat's pressure, which depends on how it ends", beyond_Pa});
}

}  // namespace pipelines

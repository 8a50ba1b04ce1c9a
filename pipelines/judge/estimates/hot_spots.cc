#include "pipelines/judge/estimates/hot_spots.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fem/stress/cells/surface_stress.h"
#include "pipelines/base/names/nearest_name.h"

namespace pipelines {
namespace {

using Eigen::ArrayXXd;

/// Weight of the nearer point: 1.67 at 0.4 and 1.0 plate thicknesses, as the recommendations print it. Where
/// a vertex of the mesh is a little off, the weight of the straight line through both. The farther point has
/// the rest of 1.
double near_weight(const meshes::HotSpot& spot) {
  const auto from_toe_m = [&](const std::array<double, 3>& p) {
    return std::hypot(p[0] - spot.toe_m[0], p[1] - spot.toe_m[1], p[2] - spot.toe_m[2]);
  };
  constexpr double printed = 1.67, rounding = 0.01;  // it is 5/3; chords are off by less, too
  const double near_m = from_toe_m(spot.near_m), far_m = from_toe_m(spot.far_m);
  const double weight = far_m / (far_m - near_m);
  return std::abs(weight - printed) < rounding ? printed : weight;
}

/// Largest distance of the meshed surface from the drawn one, in plate thicknesses: chords under arcs.
constexpr double off_surface = 0.02;

/// The node at p, for models without faces (plated_tube_responses), whose points are nodes; empty: there is
/// none.
fem::PointOnBoundary node_at(const fem::Nodes& nodes, const std::array<double, 3>& p) {
  for (std::size_t i = 0; i < nodes.n; ++i)
    if (std::equal(p.begin(), p.end(), &nodes.xyz_m[3 * i])) return {0, {{i, 1.0}}};
  return {};
}

fem::PointOnBoundary point_at(const fem::Nodes& nodes, const std::array<double, 3>& p,
                              const meshes::HotSpot& spot) {
  if (nodes.faces.empty()) {
    auto own = node_at(nodes, p);
    if (!own.shares.empty()) return own;
  }
  auto point = fem::point_on_boundary(nodes, p, off_surface * spot.thickness_m);
  if (!point.shares.empty()) return point;
  throw std::runtime_error("hot spot \"" + spot.name + "\": no face of the mesh holds its points");
}

Eigen::Vector3d vector_of(const std::array<double, 3>& x_m) {
  return Eigen::Vector3d(x_m.data());
}

/// Direction from the toe to the points of the hot spot.
Eigen::Vector3d across(const meshes::HotSpot& spot) {
  return (vector_of(spot.near_m) - vector_of(spot.toe_m)).normalized();
}

/// Length across the toe of a face that reaches from there to beyond the nearer point; 0 if it begins farther
/// out.
double face_at_toe_m(const fem::Nodes& nodes, std::size_t face, const meshes::HotSpot& spot) {
  const double near_m = (vector_of(spot.near_m) - vector_of(spot.toe_m)).norm();
  double least_m = near_m, most_m = near_m;
  for (const auto i : nodes.face(face)) {
    const Eigen::Map<const Eigen::Vector3d> at_m(&nodes.xyz_m[3 * std::size_t(i)]);
    const double from_toe_m = across(spot).dot(at_m - vector_of(spot.toe_m));
    least_m = std::min(least_m, from_toe_m);
    most_m = std::max(most_m, from_toe_m);
  }
  return least_m < 0.5 * near_m ? most_m - least_m : 0;
}

void add(const std::vector<fem::NodeShare>& shares, double weight, std::vector<StressPoint::Part>& parts) {
  for (const auto& share : shares) {
    const auto known =
        std::find_if(parts.begin(), parts.end(), [&](auto& part) { return part.node == share.node; });
    if (known != parts.end())
      known->weight += weight * share.weight;
    else
      parts.push_back({share.node, weight * share.weight});
  }
}

}  // namespace

StressPoint stress_point(const HotSpotStress& spot) {
  return {spot.parts, spot.instant, spot.resolved};
}

void take_course(const meshes::HotSpot& drawing, const std::vector<std::array<double, 6>>& unit_Pa,
                 const ChannelHistory& loads, HotSpotStress& spot) {
  const Eigen::Map<const Eigen::MatrixXd> unit(unit_Pa.front().data(), 6, Eigen::Index(unit_Pa.size()));
  const ArrayXXd stress = (unit * loads.values.matrix()).array();
  const Eigen::Vector3d n = across(drawing);
  spot.von_mises_Pa = 0;
  for (Eigen::Index i = 0; i < stress.cols(); ++i) {
    Stress s;
    for (std::size_t c = 0; c < 6; ++c) s[c] = stress(Eigen::Index(c), i);
    const double normal = s[0] * n[0] * n[0] + s[1] * n[1] * n[1] + s[2] * n[2] * n[2] +
                          2 * (s[3] * n[0] * n[1] + s[4] * n[1] * n[2] + s[5] * n[0] * n[2]);
    spot.max_normal_Pa = i == 0 ? normal : std::max(spot.max_normal_Pa, normal);
    spot.min_normal_Pa = i == 0 ? normal : std::min(spot.min_normal_Pa, normal);
    if (const double v = von_mises_Pa(s); v > spot.von_mises_Pa) {
      spot.von_mises_Pa = v;
      spot.instant = std::int32_t(i);
    }
  }
}

void sort_by_stress(std::vector<HotSpotStress>& spots) {
  std::stable_sort(spots.begin(), spots.end(),
                   [](const auto& a, const auto& b) { return a.von_mises_Pa > b.von_mises_Pa; });
}

std::vector<HotSpotStress> hot_spot_stresses(const std::vector<meshes::HotSpot>& spots,
                                             const fem::UnitResponses& responses,
                                             const ChannelHistory& loads) {
  std::vector<HotSpotStress> results;
  for (const auto& spot : spots) {
    HotSpotStress result;
    const auto near = point_at(responses.nodes, spot.near_m, spot);
    add(near.shares, near_weight(spot), result.parts);
    add(point_at(responses.nodes, spot.far_m, spot).shares, 1 - near_weight(spot), result.parts);
    const auto less = [](const auto& a, const auto& b) { return a.weight < b.weight; };
    result.near_node = std::max_element(near.shares.begin(), near.shares.end(), less)->node;
    if (!responses.nodes.faces.empty())
      result.face_walls = face_at_toe_m(responses.nodes, near.face, spot) / spot.thickness_m;
    result.name = spot.name;
    result.toe_m = spot.toe_m;
    take_course(spot, unit_stress_at(responses, stress_point(result)), loads, result);
    results.push_back(result);
  }
  sort_by_stress(results);
  return results;
}

std::vector<HotSpotStress> hot_spots_under(const std::vector<meshes::HotSpot>& drawings,
                                           const fem::UnitResponses& responses, const ChannelHistory& loads,
                                           std::vector<HotSpotStress> spots) {
  for (auto& spot : spots) {
    const auto drawing = std::find_if(drawings.begin(), drawings.end(),
                                      [&](const auto& drawn) { return drawn.name == spot.name; });
    if (drawing == drawings.end()) throw std::logic_error("hot spot \"" + spot.name + "\": is not drawn");
    take_course(*drawing, unit_stress_at(responses, stress_point(spot)), loads, spot);
  }
  sort_by_stress(spots);
  return spots;
}

std::string warning_of_covered(const std::string& body, const meshes::BodyMesh& mesh) {
  if (mesh.covered_toes.empty()) return {};
  return body + ": no hot-spot stress is read at " + listed(mesh.covered_toes) +
         ", where another plate or a flange is closer than 1.4 walls to the toe: what these weld toes bear "
         "is "
         "not part of the results; leave more room to judge them";
}

}  // namespace pipelines

#include "pipelines/analysis/hot_spots.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fem/stress/surface_stress.h"

namespace pipelines {
namespace {

using Eigen::ArrayXXd;

constexpr double near_weight = 1.67, far_weight = -0.67;

/// Of the meshed surface from the drawn one, in plate thicknesses: chords under arcs.
constexpr double off_surface = 0.02;

std::vector<fem::NodeShare> shares_at(const fem::Nodes& nodes, const std::array<double, 3>& p,
                                      const meshes::HotSpot& spot) {
  auto shares = fem::point_on_boundary(nodes, p, off_surface * spot.thickness_m);
  if (!shares.empty()) return shares;
  throw std::runtime_error("hot spot \"" + spot.name + "\": no face of the mesh holds its points");
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
  Eigen::Vector3d across;
  for (int d = 0; d < 3; ++d) across[d] = drawing.near_m[std::size_t(d)] - drawing.toe_m[std::size_t(d)];
  across.normalize();
  spot.von_mises_Pa = 0;
  for (Eigen::Index i = 0; i < stress.cols(); ++i) {
    Stress s;
    for (std::size_t c = 0; c < 6; ++c) s[c] = stress(Eigen::Index(c), i);
    const auto& n = across;
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
    const auto near = shares_at(responses.nodes, spot.near_m, spot),
               far = shares_at(responses.nodes, spot.far_m, spot);
    add(near, near_weight, result.parts);
    add(far, far_weight, result.parts);
    result.near_node = std::max_element(near.begin(), near.end(), [](auto& x, auto& y) {
                         return x.weight < y.weight;
                       })->node;
    result.name = spot.name;
    result.toe_m = spot.toe_m;
    take_course(spot, unit_stress_at(responses, stress_point(result)), loads, result);
    results.push_back(result);
  }
  sort_by_stress(results);
  return results;
}

}  // namespace pipelines

#include <algorithm>
#include <cmath>

#include "pipelines/base/common/errors.h"
#include "pipelines/loads/channels/load_collector.h"

namespace pipelines {

using Eigen::Array2Xd;
using Eigen::Index;

namespace {

/// Moments about a point instead of the origin.
Wrench about(const Wrench& load, const Eigen::Vector3d& p) {
  Wrench moved = load;
  moved.row(3) -= p[1] * load.row(2) - p[2] * load.row(1);
  moved.row(4) -= p[2] * load.row(0) - p[0] * load.row(2);
  moved.row(5) -= p[0] * load.row(1) - p[1] * load.row(0);
  return moved;
}

double radius_of_gyration_m(const std::vector<RegionMass>& regions) {
  double mass_kg = 0, second_kg_m2 = 0;
  Eigen::Vector3d first_kg_m = Eigen::Vector3d::Zero();
  for (const auto& region : regions) {
    const auto& m = region.masses;
    mass_kg += m.mass_kg;
    first_kg_m += Eigen::Map<const Eigen::Vector3d>(m.first_moment_kg_m.data());
    for (std::size_t c = 0; c < 3; ++c) second_kg_m2 += m.second_moments_kg_m2[c];
  }
  return mass_kg > 0 ? std::sqrt(std::max(0.0, second_kg_m2 / mass_kg - (first_kg_m / mass_kg).squaredNorm()))
                     : 0;
}

}  // namespace

void LoadCollector::react(const std::string& first, const std::string& second,
                          const std::map<std::size_t, Array2Xd>& resultant) {
  const auto pressed_at = [&](const std::string& name) {
    const auto& port = find(name);
    return Eigen::Vector3d(centre_of(port) + pressed_beside_m(port) * Eigen::Vector3d::UnitZ());
  };
  const Eigen::Vector3d a = pressed_at(first);
  const double span_m = pressed_at(second)[2] - a[2];
  // Middles of faces that are meant to lie at one z differ by rounding, or by their meshes: with such a span
  // the smallest moment would ask for huge forces.
  constexpr double least_span = 1e-3;
  if (!(std::abs(span_m) > least_span * radius_of_gyration_m(body_.regions)))
    throw StageRefused(
        "bearings \"" + first + "\" and \"" + second +
        "\" lie at the same place along z: they carry no tilting moment; name two that lie apart, "
        "or where one port holds the body of a load table that port alone, as clamp = \"" +
        first + "\"");
  std::map<std::size_t, Wrench> loads = sums_;
  for (const auto& [effect, sum] : resultant) loads.try_emplace(effect, Wrench::Zero(6, n_instants_));
  for (const auto& [effect, load] : loads) {
    const Wrench moved = about(load, a);
    Array2Xd on_second(2, n_instants_);
    on_second.row(0) = -moved.row(4) / span_m;
    on_second.row(1) = moved.row(3) / span_m;
    const auto given = resultant.find(effect);
    const Array2Xd sum = given != resultant.end() ? given->second : Array2Xd(-load.topRows<2>());
    force(first, effect, sum - on_second);
    force(second, effect, on_second);
  }
}

void LoadCollector::react_force(const std::string& port) {
  for (const auto& [effect, load] : std::map<std::size_t, Wrench>(sums_))
    force(port, effect, -load.topRows<2>());
}

void LoadCollector::react_axial(const std::string& port) {
  for (const auto& [effect, load] : std::map<std::size_t, Wrench>(sums_))
    axial_force(port, effect, -load.row(2).transpose());
}

void LoadCollector::react_torque(const std::string& port) {
  const Eigen::Vector3d p = centre_of(find(port));
  for (const auto& [effect, load] : std::map<std::size_t, Wrench>(sums_))
    torque(port, effect, -about(load, p).row(5).transpose());
}

void LoadCollector::react_tilt(const std::string& port) {
  const Eigen::Vector3d p = centre_of(find(port));
  for (const auto& [effect, load] : std::map<std::size_t, Wrench>(sums_))
    tilt(port, effect, -about(load, p).middleRows<2>(3));
}

}  // namespace pipelines

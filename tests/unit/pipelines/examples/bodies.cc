#include "tests/unit/pipelines/examples/bodies.h"

#include <algorithm>
#include <stdexcept>

namespace bodies {

Eigen::Index row(const pipelines::BodyLoads& loads, const std::string& channel) {
  for (std::size_t k = 0; k < loads.history.channels.size(); ++k)
    if (loads.history.channels[k].name == channel) return Eigen::Index(k);
  throw std::out_of_range(channel);
}

bool has(const pipelines::BodyLoads& loads, const std::string& channel) {
  const auto& all = loads.history.channels;
  return std::any_of(all.begin(), all.end(), [&](const auto& c) { return c.name == channel; });
}

Eigen::ArrayXd course(const pipelines::BodyLoads& loads, const std::string& channel) {
  if (!has(loads, channel)) return Eigen::ArrayXd::Zero(loads.history.values.cols());
  return loads.history.values.row(row(loads, channel)).transpose();
}

Eigen::ArrayXd part(const pipelines::BodyLoads& loads, const std::string& effect,
                    const std::string& channel) {
  const auto& effects = loads.history.effects;
  const auto found = std::find(effects.begin(), effects.end(), effect);
  if (found == effects.end() || !has(loads, channel))
    return Eigen::ArrayXd::Zero(loads.history.values.cols());
  return loads.history.by_effect[std::size_t(found - effects.begin())].row(row(loads, channel)).transpose();
}

Eigen::Array2Xd force(const pipelines::BodyLoads& loads, const std::string& port) {
  Eigen::Array2Xd f(2, loads.history.values.cols());
  f.row(0) = course(loads, port + ".fx").transpose();
  f.row(1) = course(loads, port + ".fy").transpose();
  return f;
}

Eigen::ArrayXd magnitude(const Eigen::Array2Xd& force) {
  return force.square().colwise().sum().sqrt().transpose();
}

double largest(const Eigen::ArrayXXd& values) {
  return values.size() > 0 ? values.abs().maxCoeff() : 0;
}

pipelines::Closure closure_of(const pipelines::BodyLoads& loads,
                              const std::vector<pipelines::RegionMass>& regions) {
  std::vector<std::array<double, 6>> resultants;
  for (const auto& load : loads.unit_loads) resultants.push_back(pipelines::wanted_resultant(load, regions));
  return pipelines::check_closure(loads, resultants, regions);
}

pipelines::Wrench residual(const pipelines::BodyLoads& loads,
                           const std::vector<pipelines::RegionMass>& regions) {
  pipelines::Wrench sum = pipelines::Wrench::Zero(6, loads.history.values.cols());
  for (std::size_t k = 0; k < loads.unit_loads.size(); ++k) {
    const auto unit = pipelines::wanted_resultant(loads.unit_loads[k], regions);
    for (Eigen::Index c = 0; c < 6; ++c)
      sum.row(c) += unit[std::size_t(c)] * loads.history.values.row(Eigen::Index(k));
  }
  return sum;
}

meshes::Port port(const std::string& name, meshes::Port::Kind kind, int id, std::array<double, 2> range_m,
                  double radius_m, std::array<double, 2> axis_m) {
  return {name, kind, id, range_m[0], range_m[1], radius_m, axis_m[0], axis_m[1]};
}

}  // namespace bodies

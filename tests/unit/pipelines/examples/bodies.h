/// What tests of distribution ask of a body's loads.
#pragma once

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipelines/loads/channels/closure.h"
#include "pipelines/loads/channels/load_collector.h"

namespace bodies {

/// Sums of some ten terms of the same size: round-off is 1e-15 of the scale; 1e-13 leaves two digits.
constexpr double round_off = 1e-13;

Eigen::Index row(const pipelines::BodyLoads& loads, const std::string& channel);

bool has(const pipelines::BodyLoads& loads, const std::string& channel);

/// A channel over the instants; zero where no effect feeds it.
Eigen::ArrayXd course(const pipelines::BodyLoads& loads, const std::string& channel);

/// The part of one effect in a channel; zero where it has none.
Eigen::ArrayXd part(const pipelines::BodyLoads& loads, const std::string& effect, const std::string& channel);

/// fx, fy of a port.
Eigen::Array2Xd force(const pipelines::BodyLoads& loads, const std::string& port);

Eigen::ArrayXd magnitude(const Eigen::Array2Xd& force);

double largest(const Eigen::ArrayXXd& values);

/// Closure with the resultants that a perfect mesh would give.
pipelines::Closure closure_of(const pipelines::BodyLoads& loads,
                              const std::vector<pipelines::RegionMass>& regions);

/// Sum of all loads about the origin, rows fx, fy, fz [N], mx, my, mz [N m]: what does not close.
pipelines::Wrench residual(const pipelines::BodyLoads& loads,
                           const std::vector<pipelines::RegionMass>& regions);

meshes::Port port(const std::string& name, meshes::Port::Kind kind, int id, std::array<double, 2> range_m,
                  double radius_m, std::array<double, 2> axis_m = {0, 0});

}  // namespace bodies

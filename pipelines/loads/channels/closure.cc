#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "pipelines/loads/channels/closure.h"

namespace pipelines {
namespace {

using Resultant6 = std::array<double, 6>;

/// Masses of the cells that a body force acts on.
const fem::MassProperties& masses_of(const std::vector<RegionMass>& regions,
                                     const std::vector<int>& volume_ids) {
  for (const auto& region : regions)
    if (region.volume_ids == volume_ids) return region.masses;
  throw std::invalid_argument("check_closure: a body force acts on cells whose mass is not known");
}

struct WantedResultant {
  const std::vector<RegionMass>& regions;

  Resultant6 operator()(const fem::SurfaceResultant& load) const {
    Resultant6 r{};
    const auto component =
        std::size_t(load.component);  // fx, fy, fz, mx, my, torque: the order of Resultant6
    r[component] = 1;
    const auto& c = load.surface.centre_m;
    r[3] += c[1] * r[2] - c[2] * r[1];
    r[4] += c[2] * r[0] - c[0] * r[2];
    r[5] += c[0] * r[1] - c[1] * r[0];
    return r;
  }
  Resultant6 operator()(const fem::SeatPressure&) const { return {}; }
  Resultant6 operator()(const fem::BodyForce& load) const {
    const auto& masses = masses_of(regions, load.volume_ids);
    const double m = masses.mass_kg;
    const auto& s = masses.first_moment_kg_m;
    const auto& [xx, yy, zz, xy, yz, xz] = masses.second_moments_kg_m2;
    using Field = fem::BodyForce::Field;
    switch (load.field) {  // force: integral of rho a; moment: integral of rho r x a
      case Field::translation_x:
        return {m, 0, 0, 0, s[2], -s[1]};
      case Field::translation_y:
        return {0, m, 0, -s[2], 0, s[0]};
      case Field::translation_z:
        return {0, 0, m, s[1], -s[0], 0};
      case Field::rotation:
        return {-s[1], s[0], 0, -xz, -yz, xx + yy};
      case Field::spin:
        return {s[0], s[1], 0, -yz, xz, 0};
    }
    throw std::logic_error("unknown body force");
  }
};

/// Sizes against which a unit load's resultant is judged: what it carries, or would carry if nothing
/// cancelled.
struct Scale {
  double force = 0, moment = 0;
};

struct ScaleOf {
  const std::vector<RegionMass>& regions;

  /// How far the body reaches from the origin: the radius of gyration.
  double size_m() const {
    double mass = 0, second = 0;
    for (const auto& region : regions) {
      const auto& m = region.masses.second_moments_kg_m2;
      mass += region.masses.mass_kg;
      second += m[0] + m[1] + m[2];
    }
    return mass > 0 ? std::sqrt(second / mass) : 0;
  }
  /// The largest arm of the surface about the origin. The extent of a face is not known, and its middle may
  /// be the origin itself: the body's size stands for it.
  double arm(const fem::LoadSurface& surface) const {
    const auto& c = surface.centre_m;
    return std::hypot(surface.radius_m > 0 ? surface.radius_m : size_m(), std::hypot(c[0], c[1], c[2]));
  }
  Scale operator()(const fem::SurfaceResultant& load) const {
    using Component = fem::SurfaceResultant::Component;
    const bool is_force = load.component <= Component::fz;
    const double radius = load.surface.radius_m > 0 ? load.surface.radius_m : arm(load.surface);
    return is_force ? Scale{1, arm(load.surface)}
                    : Scale{1 / radius, std::max(1.0, arm(load.surface) / radius)};
  }
  Scale operator()(const fem::SeatPressure& load) const { return {1, arm(load.surface)}; }
  Scale operator()(const fem::BodyForce& load) const {
    const auto& masses = masses_of(regions, load.volume_ids);
    const auto& m = masses.second_moments_kg_m2;
    const double second = m[0] + m[1] + m[2], first = std::sqrt(masses.mass_kg * second);
    const bool uniform = load.field <= fem::BodyForce::Field::translation_z;
    return uniform ? Scale{masses.mass_kg, first} : Scale{first, second};
  }
};

/// What spin leaves of a body that is balanced but for its mesh, or grinding, is nothing that bearings carry:
/// 1e-5 of the radius of gyration off the axis is balance grade G 0.5 at 50 m/s; tetrahedra leave up to 6e-7.
constexpr double balanced = 1e-5;

/// Resultants of spin over the instants (6 x n) if all of them are those of a balanced body, else zero.
Eigen::MatrixXd balanced_spin(const BodyLoads& loads,
                              const Eigen::Matrix<double, 6, Eigen::Dynamic>& resultants,
                              const std::vector<RegionMass>& regions) {
  const auto& values = loads.history.values;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(6, values.cols()), most = sum;
  for (Eigen::Index k = 0; k < values.rows(); ++k) {
    const auto* load = std::get_if<fem::BodyForce>(&loads.unit_loads[std::size_t(k)].shape);
    if (!load || load->field != fem::BodyForce::Field::spin) continue;
    const auto& masses = masses_of(regions, load->volume_ids);
    const auto& m = masses.second_moments_kg_m2;
    const double force = std::sqrt(masses.mass_kg * (m[0] + m[1])), moment = std::sqrt(m[2] * (m[0] + m[1]));
    Eigen::Matrix<double, 6, 1> size;
    size << force, force, force, moment, moment, moment;
    sum += resultants.col(k) * values.row(k).matrix();
    most += balanced * size * values.row(k).abs().matrix();
  }
  if ((sum.array().abs() > most.array()).any()) sum.setZero();
  return sum;
}

}  // namespace

std::array<double, 6> wanted_resultant(const fem::UnitLoad& load, const std::vector<RegionMass>& regions) {
  return std::visit(WantedResultant{regions}, load.shape);
}

bool Closure::holds() const {
  return worst_force() <= limit && worst_moment() <= limit && channel_resultant <= limit;
}
double Closure::worst_force() const {
  return *std::max_element(force.begin(), force.end());
}
double Closure::worst_moment() const {
  return *std::max_element(moment.begin(), moment.end());
}

Closure check_closure(const BodyLoads& loads, const std::vector<std::array<double, 6>>& mesh_resultants,
                      const std::vector<RegionMass>& regions) {
  if (mesh_resultants.size() != loads.unit_loads.size())
    throw std::invalid_argument("check_closure: " + std::to_string(mesh_resultants.size()) +
                                " mesh resultants for " + std::to_string(loads.unit_loads.size()) +
                                " channels");
  Closure closure;
  const auto& values = loads.history.values;
  const auto n_channels = Eigen::Index(mesh_resultants.size());
  const Eigen::MatrixXd value_sizes = values.abs();
  Eigen::MatrixXd effect_sizes = Eigen::MatrixXd::Zero(values.rows(), values.cols());
  for (const auto& effect : loads.history.by_effect) effect_sizes.array() += effect.abs();
  Eigen::Matrix<double, 6, Eigen::Dynamic> resultants(6, n_channels);
  double force_made_of_N = 0, moment_made_of_Nm = 0;
  for (Eigen::Index k = 0; k < n_channels; ++k) {
    const auto& channel = loads.unit_loads[std::size_t(k)];
    const auto& on_mesh = mesh_resultants[std::size_t(k)];
    const auto wanted = wanted_resultant(channel, regions);
    const Scale scale = std::visit(ScaleOf{regions}, channel.shape);
    if (values.cols() > 0) {
      force_made_of_N = std::max(force_made_of_N, value_sizes.row(k).maxCoeff() * scale.force);
      moment_made_of_Nm = std::max(moment_made_of_Nm, value_sizes.row(k).maxCoeff() * scale.moment);
    }
    for (std::size_t c = 0; c < 6; ++c) {
      resultants(Eigen::Index(c), k) = on_mesh[c];
      const double error = std::abs(on_mesh[c] - wanted[c]) / (c < 3 ? scale.force : scale.moment);
      closure.channel_resultant = std::max(closure.channel_resultant, error);
    }
  }
  const Eigen::Matrix<double, 6, Eigen::Dynamic> sums = resultants * values.matrix(),
                                                 sizes = resultants.cwiseAbs() * value_sizes,
                                                 sizes_of_effects = resultants.cwiseAbs() * effect_sizes;
  // Bearings carry what a mesh leaves of spin where there are any, nothing where there are none.
  const Eigen::MatrixXd unsupported = sums - balanced_spin(loads, resultants, regions);
  const auto largest = [](const auto& all, std::size_t c) { return all.row(Eigen::Index(c)).maxCoeff(); };
  // The components of one kind share a scale: a component that carries nothing has no size of its own to be
  // judged by.
  double force_size = 0, moment_size = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (values.cols() == 0) break;
    closure.force_scale_N[c] = largest(sizes, c);
    closure.moment_scale_Nm[c] = largest(sizes, c + 3);
    force_size = std::max(force_size, closure.force_scale_N[c]);
    moment_size = std::max(moment_size, closure.moment_scale_Nm[c]);
  }
  // Under torques alone forces are round-off: they are judged by what the torques are made of.
  double arm_m = 0;
  for (const auto& load : loads.unit_loads)
    if (const auto* resultant = std::get_if<fem::SurfaceResultant>(&load.shape))
      arm_m = std::max(arm_m, ScaleOf{regions}.arm(resultant->surface));
  if (arm_m > 0) force_size = std::max(force_size, moment_size / arm_m);
  // A load that balances itself (spin) leaves nothing but round-off: of what it is made of.
  constexpr double round_off = 1e-9;
  if (force_size < round_off * force_made_of_N) force_size = force_made_of_N;
  if (moment_size < round_off * moment_made_of_Nm) moment_size = moment_made_of_Nm;
  const auto residual = [&](std::size_t c) {
    return std::min(largest(sums.cwiseAbs(), c), largest(unsupported.cwiseAbs(), c));
  };
  for (std::size_t c = 0; c < 3 && values.cols() > 0; ++c) {
    // Effects that cancel each other leave the rounding of what they are by themselves, and a load that
    // nearly balances itself (spin on a mesh that is not quite round) that of what it is made of.
    const auto relative = [](double left, double own, double common, double made_of) {
      if (left == 0) return 0.0;
      const double error = left / (own > 1e-6 * common ? own : common);
      // Source: bodies of 2,000 nodes leave up to 88 roundings; sums over n nodes are off by sqrt(n) of them.
      constexpr double rounding = 1024 * std::numeric_limits<double>::epsilon();
      const bool is_rounding = left <= rounding * made_of;
      return error > Closure::limit && is_rounding ? left / made_of : error;
    };
    closure.force[c] = relative(residual(c), closure.force_scale_N[c], force_size,
                                std::max(largest(sizes_of_effects, c), force_made_of_N));
    closure.moment[c] = relative(residual(c + 3), closure.moment_scale_Nm[c], moment_size,
                                 std::max(largest(sizes_of_effects, c + 3), moment_made_of_Nm));
  }
  return closure;
}

}  // namespace pipelines

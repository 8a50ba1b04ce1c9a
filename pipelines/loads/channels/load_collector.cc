#include "pipelines/loads/channels/load_collector.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/scene/values/contact_arc.h"

namespace pipelines {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;
using Component = fem::SurfaceResultant::Component;

namespace {

constexpr double negligible =
    1e-13;  // round-off: a force along e(phi) has no moment about E, but to the last bit

double largest(const ArrayXd& values) {
  return values.size() > 0 ? values.abs().maxCoeff() : 0;
}

/// The half angle that a clearance leaves under the largest force; without a clearance, or a force, the model
/// as it is.
PressureModel in_contact(PressureModel model, const meshes::Port& port, double plane_modulus_Pa,
                         double force_N) {
  if (!model.clearance_m || !(force_N > 0)) return model;
  model.pattern.half_angle_rad = half_arc_rad(
      {port.radius_m, *model.clearance_m, force_N / (port.end_m - port.begin_m), plane_modulus_Pa});
  model.half_angles = half_angles_around(model.pattern);
  return model;
}

}  // namespace

Array2Xd turned(const Array2Xd& force, const ArrayXd& alpha_rad) {
  const auto c = alpha_rad.cos().transpose().eval(), s = alpha_rad.sin().transpose().eval();
  Array2Xd result(2, force.cols());
  result.row(0) = c * force.row(0) + s * force.row(1);
  result.row(1) = c * force.row(1) - s * force.row(0);
  return result;
}

Eigen::Vector3d centre_of(const meshes::Port& port) {
  return {port.axis_x_m, port.axis_y_m, 0.5 * (port.begin_m + port.end_m)};
}

const RegionMass& LoadedBody::region(const std::string& region_name) const {
  for (const auto& region : regions)
    if (region.name == region_name) return region;
  throw std::out_of_range("the " + name + " has no region \"" + region_name + "\"");
}

LoadCollector::LoadCollector(const LoadedBody& body, std::vector<std::string> effects, Index n_instants,
                             double force_scale_N)
    : body_(body),
      effects_(std::move(effects)),
      n_instants_(n_instants),
      force_scale_N_(force_scale_N),
      length_scale_m_(0) {
  for (const auto& port : body.ports) {
    const double size = port.radius_m > 0 ? port.radius_m : std::hypot(port.axis_x_m, port.axis_y_m);
    if (length_scale_m_ == 0 || (size > 0 && size < length_scale_m_)) length_scale_m_ = size;
  }
}

const meshes::Port& LoadCollector::find(const std::string& port_name) const {
  std::vector<std::string> names;
  for (const auto& port : body_.ports) {
    if (port.name == port_name) return port;
    names.push_back(port.name);
  }
  throw StageRefused("port \"" + port_name + "\" is missing on the " + body_.name +
                     ": load enters there; it has " + listed(names));
}

fem::LoadSurface LoadCollector::surface_of(const meshes::Port& port) const {
  fem::LoadSurface surface;
  surface.boundary_id = port.boundary_id;
  const Eigen::Vector3d centre = centre_of(port);
  surface.centre_m = {centre[0], centre[1], centre[2]};
  if (port.kind == meshes::Port::Kind::face) {
    surface.kind = fem::LoadSurface::Kind::face;
    return surface;
  }
  surface.kind = fem::LoadSurface::Kind::seat;
  surface.radius_m = port.radius_m;
  surface.length_m = port.end_m - port.begin_m;
  if (const auto model = body_.pressures.find(port.name); model != body_.pressures.end())
    surface.axial_profile = model->second.axial_profile;
  return surface;
}

std::size_t LoadCollector::effect(const std::string& name) {
  const auto found = std::find(effects_.begin(), effects_.end(), name);
  if (found != effects_.end()) return std::size_t(found - effects_.begin());
  effects_.push_back(name);
  return effects_.size() - 1;
}

void LoadCollector::add(const fem::UnitLoad& load, const std::string& unit, std::size_t effect,
                        const ArrayXd& values, double scale) {
  if (values.size() == 0 || largest(values) <= negligible * scale) return;
  const auto [position, is_new] = index_.try_emplace(load.channel, channels_.size());
  if (is_new) channels_.push_back({load, unit, {}});
  const auto [part, is_first] = channels_[position->second].parts.try_emplace(effect, values);
  if (is_first) return;
  const double summed = std::max(largest(part->second), largest(values));
  part->second += values;
  // A load where it is carried: what is left of both is rounding, which would be solved and judged as a load.
  if (largest(part->second) <= negligible * summed) part->second.setZero();
}

void LoadCollector::count(const std::string& place, std::size_t effect, const Eigen::Vector3d& p,
                          const Wrench& load) {
  Wrench about_origin = load;
  about_origin.row(3) += p[1] * load.row(2) - p[2] * load.row(1);
  about_origin.row(4) += p[2] * load.row(0) - p[0] * load.row(2);
  about_origin.row(5) += p[0] * load.row(1) - p[1] * load.row(0);
  auto& moments = moments_Nm_.try_emplace(place, Array3Xd::Zero(3, n_instants_)).first->second;
  moments.row(0) += p[0] * load.row(1);
  moments.row(1) += p[1] * load.row(0);
  moments.row(2) += load.row(5);
  const auto [sum, is_first] = sums_.try_emplace(effect, about_origin);
  if (!is_first) sum->second += about_origin;
}

void LoadCollector::enter(const meshes::Port& port, const char* component, Component which,
                          std::size_t effect, const ArrayXd& values) {
  const bool is_force = which <= Component::fz;
  add({port.name + "." + component, fem::SurfaceResultant{surface_of(port), which}}, is_force ? "N" : "N m",
      effect, values, is_force ? force_scale_N_ : force_scale_N_ * length_scale_m_);
  Wrench load = Wrench::Zero(6, n_instants_);
  load.row(Index(which)) = values.transpose();
  count(port.name, effect, centre_of(port), load);
}

/// Distance along z from the middle of the port to where the resultant of its pressure acts.
double LoadCollector::pressed_beside_m(const meshes::Port& port) const {
  const auto model = body_.pressures.find(port.name);
  if (port.kind == meshes::Port::Kind::face || model == body_.pressures.end()) return 0;
  return middle_of(model->second.axial_profile) * (port.end_m - port.begin_m) / 2;
}

void LoadCollector::force(const std::string& port_name, std::size_t effect, const Array2Xd& force_N) {
  const auto& port = find(port_name);
  enter(port, "fx", Component::fx, effect, force_N.row(0).transpose());
  enter(port, "fy", Component::fy, effect, force_N.row(1).transpose());
  if (const double z_m = pressed_beside_m(port); z_m != 0) {
    Array2Xd couple(2, n_instants_);
    couple.row(0) = -z_m * force_N.row(1);
    couple.row(1) = z_m * force_N.row(0);
    tilt(port_name, effect, couple);
  }
  const auto [known, is_first] = forces_[port_name].try_emplace(effect, force_N);
  if (!is_first) known->second += force_N;
}

void LoadCollector::axial_force(const std::string& port, std::size_t effect, const ArrayXd& force_N) {
  enter(find(port), "fz", Component::fz, effect, force_N);
}

void LoadCollector::torque(const std::string& port, std::size_t effect, const ArrayXd& moment_Nm) {
  enter(find(port), "torque", Component::torque, effect, moment_Nm);
}

void LoadCollector::tilt(const std::string& port_name, std::size_t effect, const Array2Xd& moment_Nm) {
  const auto& port = find(port_name);
  enter(port, "mx", Component::mx, effect, moment_Nm.row(0).transpose());
  enter(port, "my", Component::my, effect, moment_Nm.row(1).transpose());
}

void LoadCollector::pressure(const std::string& port_name) {
  const auto& port = find(port_name);
  const auto forces = forces_.find(port_name);
  if (forces == forces_.end() || port.kind == meshes::Port::Kind::face) return;
  const auto found = body_.pressures.find(port_name);
  Array2Xd total = Array2Xd::Zero(2, n_instants_);
  for (const auto& [effect, force] : forces->second) total += force;
  pressing_force_N_[port_name] = total;
  // beta is where the pressure is centred: opposite the force on an outer seat, along it inside a bore.
  ArrayXd beta(n_instants_);
  Array2Xd direction = Array2Xd::Zero(2, n_instants_);
  const double turn = port.kind == meshes::Port::Kind::seat ? pi : 0;
  for (Index i = 0; i < n_instants_; ++i) {
    beta[i] = std::atan2(total(1, i), total(0, i)) + turn;
    const double magnitude = std::hypot(total(0, i), total(1, i));
    if (magnitude > 0) direction.col(i) = total.col(i) / magnitude;
  }
  const PressureModel& model = pressures_[port_name] =
      in_contact(found != body_.pressures.end() ? found->second : PressureModel{}, port,
                 body_.plane_modulus_Pa, largest(total.matrix().colwise().norm().transpose().array()));
  using Phase = fem::SeatPressure::Phase;
  const auto surface = surface_of(port);
  for (const auto& [effect, force] : forces->second) {
    const ArrayXd share = (force * direction).colwise().sum().transpose();
    for (int n = 0; n <= highest_solved(model); ++n) {
      const double c = solved_coefficient(model, n);
      if (c == 0) continue;
      // A half angle that follows from the forces is another one at each operating point: unit loads are not.
      const double unit = model.clearance_m ? 1 : c, factor = c / unit;
      const std::string channel = port_name + ".p" + std::to_string(n);
      add({channel + "c", fem::SeatPressure{surface, n, unit, Phase::cosine}}, "N", effect,
          factor * share * (n * beta).cos(), factor * force_scale_N_);
      if (n > 0)
        add({channel + "s", fem::SeatPressure{surface, n, unit, Phase::sine}}, "N", effect,
            factor * share * (n * beta).sin(), factor * force_scale_N_);
    }
  }
}

void LoadCollector::accelerate(const RegionMass& region, std::size_t effect, const AccelerationField& field) {
  using Field = fem::BodyForce::Field;
  const std::string prefix = region.name.empty() ? "volume." : "volume." + region.name + ".";
  const double mass = region.masses.mass_kg;
  const auto& s = region.masses.first_moment_kg_m;
  const auto& [xx, yy, zz, xy, yz, xz] = region.masses.second_moments_kg_m2;
  const double polar = xx + yy;
  Wrench load = Wrench::Zero(6, n_instants_);
  const auto enter_field = [&](const char* component, Field which, const char* unit, const ArrayXd& a,
                               const std::array<double, 6>& per_unit) {
    if (a.size() == 0) return;
    // What the field's forces add up to where none cancels the other; for spin and rotation at most, by
    // Cauchy and Schwarz. The resultant is no measure: that of a body that spins about its axis is round-off.
    const bool is_uniform = which <= Field::translation_z;
    const double lever = is_uniform ? mass : std::sqrt(mass * polar);
    add({prefix + component, fem::BodyForce{which, region.volume_ids}}, unit, effect, a,
        lever > 0 ? force_scale_N_ / lever * 1e-3 : 0);
    for (Index c = 0; c < 6; ++c) load.row(c) += per_unit[std::size_t(c)] * a.transpose();
  };
  if (field.translation_m_s2.cols() > 0) {
    enter_field("ax", Field::translation_x, "m/s2", field.translation_m_s2.row(0).transpose(),
                {mass, 0, 0, 0, s[2], -s[1]});
    enter_field("ay", Field::translation_y, "m/s2", field.translation_m_s2.row(1).transpose(),
                {0, mass, 0, -s[2], 0, s[0]});
    enter_field("az_axial", Field::translation_z, "m/s2", field.translation_m_s2.row(2).transpose(),
                {0, 0, mass, s[1], -s[0], 0});
  }
  enter_field("spin", Field::spin, "rad2/s2", field.spin_rad2_s2, {s[0], s[1], 0, -yz, xz, 0});
  enter_field("az", Field::rotation, "rad/s2", field.angular_rad_s2, {-s[1], s[0], 0, -xz, -yz, xx + yy});
  count(prefix, effect, Eigen::Vector3d::Zero(), load);
}

void LoadCollector::accelerate(const AttachedMass& mass, std::size_t effect, const AccelerationField& field) {
  const auto& s = mass.first_moment_kg_m;
  Array3Xd force = Array3Xd::Zero(3, n_instants_);
  ArrayXd moment = ArrayXd::Zero(n_instants_);  // about the origin
  if (field.translation_m_s2.cols() > 0) {
    force += mass.mass_kg * field.translation_m_s2;
    moment += (s[0] * field.translation_m_s2.row(1) - s[1] * field.translation_m_s2.row(0)).transpose();
  }
  if (field.angular_rad_s2.size() > 0) {
    force.row(0) -= s[1] * field.angular_rad_s2.transpose();
    force.row(1) += s[0] * field.angular_rad_s2.transpose();
    moment += mass.polar_inertia_kg_m2 * field.angular_rad_s2;
  }
  if (field.spin_rad2_s2.size() > 0)
    for (Index d = 0; d < 2; ++d) force.row(d) += s[std::size_t(d)] * field.spin_rad2_s2.transpose();
  const Eigen::Vector3d p = centre_of(find(mass.port));
  // An added mass is no seat pressure: it clings to the whole surface, so it makes no harmonics.
  const auto& port = find(mass.port);
  enter(port, "fx", Component::fx, effect, force.row(0).transpose());
  enter(port, "fy", Component::fy, effect, force.row(1).transpose());
  if (largest(force.row(2).transpose()) > 0) {
    enter(port, "fz", Component::fz, effect, force.row(2).transpose());
    // Tilting moment of an axial force through the mass centre, off the port's point.
    Eigen::Array2Xd tilting(2, n_instants_);
    tilting.row(0) = (s[1] - mass.mass_kg * p[1]) * field.translation_m_s2.row(2);
    tilting.row(1) = -(s[0] - mass.mass_kg * p[0]) * field.translation_m_s2.row(2);
    tilt(mass.port, effect, tilting);
  }
  torque(mass.port, effect, moment - (p[0] * force.row(1) - p[1] * force.row(0)).transpose());
}

Wrench LoadCollector::sum(std::size_t effect) const {
  const auto found = sums_.find(effect);
  return found != sums_.end() ? found->second : Wrench::Zero(6, n_instants_);
}

Wrench LoadCollector::sum() const {
  Wrench total = Wrench::Zero(6, n_instants_);
  for (const auto& [effect, part] : sums_) total += part;
  return total;
}

double LoadCollector::moment_scale_Nm() const {
  ArrayXd sizes = ArrayXd::Zero(n_instants_);
  for (const auto& [place, moments] : moments_Nm_) sizes += moments.abs().colwise().sum().transpose();
  return largest(sizes);
}

BodyLoads LoadCollector::finish() const {
  BodyLoads result;
  std::vector<const Entry*> loading;
  for (const auto& channel : channels_)
    if (std::any_of(channel.parts.begin(), channel.parts.end(),
                    [](const auto& part) { return largest(part.second) > 0; }))
      loading.push_back(&channel);
  const auto n_channels = Index(loading.size());
  result.history.body = body_.name;
  result.history.effects = effects_;
  result.pressures = pressures_;
  result.pressing_force_N = pressing_force_N_;
  result.history.by_effect.assign(effects_.size(), Eigen::ArrayXXd::Zero(n_channels, n_instants_));
  result.history.values = Eigen::ArrayXXd::Zero(n_channels, n_instants_);
  for (Index k = 0; k < n_channels; ++k) {
    const auto& channel = *loading[std::size_t(k)];
    result.history.channels.push_back({channel.load.channel, channel.unit});
    result.unit_loads.push_back(channel.load);
    for (const auto& [effect, values] : channel.parts) {
      result.history.by_effect[effect].row(k) = values.transpose();
      result.history.values.row(k) += values.transpose();
    }
  }
  return result;
}

}  // namespace pipelines

#include "pipelines/distribute.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace pipelines {
namespace {

using Eigen::Array;
using Eigen::Array2Xd;
using Eigen::ArrayXd;
using Eigen::Index;
using Phase = fem::SeatPressure::Phase;

const meshes::Port& find_port(const std::vector<meshes::Port>& ports, const std::string& name) {
  for (const auto& port : ports)
    if (port.name == name) return port;
  throw std::invalid_argument("port \"" + name +
                              "\" is missing on the shaft: the vibratory mill loads it; give a segment "
                              "of that name with port = true");
}

fem::LoadSurface surface_of(const meshes::Port& port) {
  fem::LoadSurface surface;
  surface.kind =
      port.kind == meshes::Port::Kind::seat ? fem::LoadSurface::Kind::seat : fem::LoadSurface::Kind::face;
  surface.boundary_id = port.boundary_id;
  surface.centre_m = {port.axis_x_m, port.axis_y_m, 0.5 * (port.begin_m + port.end_m)};
  surface.radius_m = port.radius_m;
  surface.length_m = port.end_m - port.begin_m;
  return surface;
}

/// Collects channels effect by effect and drops those that nothing feeds.
class ChannelBuilder {
public:
  ChannelBuilder(std::vector<std::string> effects, Index n_instants)
      : effects_(std::move(effects)), n_instants_(n_instants) {}

  /// Adds what `effect` brings to a channel. Values that are round-off against `scale` count as nothing: a
  /// force along e(phi) has no moment about E, although its products do not cancel to the last bit.
  void add(const fem::UnitLoad& load, const std::string& unit, const std::string& effect,
           const ArrayXd& values, double scale) {
    if (values.size() == 0 || values.abs().maxCoeff() <= 1e-13 * scale) return;
    auto [position, is_new] = index_.try_emplace(load.channel, channels_.size());
    if (is_new) channels_.push_back({load, unit, {}});
    auto& parts = channels_[position->second].parts;
    const auto found = std::find(effects_.begin(), effects_.end(), effect);
    const auto e = std::size_t(found - effects_.begin());
    if (parts.count(e))
      parts[e] += values;
    else
      parts[e] = values;
  }

  BodyLoads finish(const std::string& body) const {
    BodyLoads result;
    const auto n_channels = Index(channels_.size());
    result.history.body = body;
    result.history.effects = effects_;
    result.history.by_effect.assign(effects_.size(), Eigen::ArrayXXd::Zero(n_channels, n_instants_));
    result.history.values = Eigen::ArrayXXd::Zero(n_channels, n_instants_);
    for (Index k = 0; k < n_channels; ++k) {
      const auto& channel = channels_[std::size_t(k)];
      result.history.channels.push_back({channel.load.channel, channel.unit});
      result.unit_loads.push_back(channel.load);
      for (const auto& [effect, values] : channel.parts) {
        result.history.by_effect[effect].row(k) = values.transpose();
        result.history.values.row(k) += values.transpose();
      }
    }
    return result;
  }

private:
  struct Entry {
    fem::UnitLoad load;
    std::string unit;
    std::map<std::size_t, ArrayXd> parts;  // by effect
  };
  std::vector<std::string> effects_;
  Index n_instants_;
  std::vector<Entry> channels_;
  std::map<std::string, std::size_t> index_;
};

/// A force on the body by effect, in the body's frame.
using ForceByEffect = std::map<std::string, Array2Xd>;

Array2Xd sum(const ForceByEffect& forces, Index n) {
  Array2Xd total = Array2Xd::Zero(2, n);
  for (const auto& [effect, force] : forces) total += force;
  return total;
}

/// Resolves a force of the fixed frame along the axes that turn clockwise with phi.
Array2Xd turn(const Array2Xd& force, const ArrayXd& phi) {
  const auto c = phi.cos().transpose().eval(), s = phi.sin().transpose().eval();
  Array2Xd turned(2, force.cols());
  turned.row(0) = c * force.row(0) - s * force.row(1);
  turned.row(1) = s * force.row(0) + c * force.row(1);
  return turned;
}

fem::UnitLoad resultant_load(const meshes::Port& port, const std::string& component,
                             fem::SurfaceResultant::Component which) {
  return {port.name + "." + component, fem::SurfaceResultant{surface_of(port), which}};
}

void add_force(ChannelBuilder& builder, const meshes::Port& port, const std::string& effect,
               const Array2Xd& force, double scale) {
  using Component = fem::SurfaceResultant::Component;
  builder.add(resultant_load(port, "fx", Component::fx), "N", effect, force.row(0).transpose(), scale);
  builder.add(resultant_load(port, "fy", Component::fy), "N", effect, force.row(1).transpose(), scale);
}

/// The harmonics n = 0, 2, 4 ... that make the pressure of a seat one-sided. They carry |F| cos(n beta),
/// which is not linear in the effects; effect e gets the share (F_e . F/|F|), so that the shares add up
/// exactly (the share rule).
void add_pressure(ChannelBuilder& builder, const meshes::Port& port, const ForceByEffect& forces, int highest,
                  double scale) {
  if (forces.empty()) return;
  const Index n_instants = forces.begin()->second.cols();
  const Array2Xd total = sum(forces, n_instants);
  const ArrayXd magnitude = total.matrix().colwise().norm().transpose();
  // beta = arg F + pi on an outer seat; n is even, so n beta = n arg F.
  ArrayXd angle(n_instants);
  Array2Xd direction = Array2Xd::Zero(2, n_instants);
  for (Index i = 0; i < n_instants; ++i) {
    angle[i] = std::atan2(total(1, i), total(0, i));
    if (magnitude[i] > 0) direction.col(i) = total.col(i) / magnitude[i];
  }
  for (const auto& [effect, force] : forces) {
    const ArrayXd share = (force * direction).colwise().sum().transpose();
    for (int n = 0; n <= highest; n += 2) {
      const std::string name = port.name + ".p" + std::to_string(n);
      builder.add({name + "c", fem::SeatPressure{surface_of(port), n, Phase::cosine}}, "N", effect,
                  share * (n * angle).cos(), scale);
      if (n > 0)
        builder.add({name + "s", fem::SeatPressure{surface_of(port), n, Phase::sine}}, "N", effect,
                    share * (n * angle).sin(), scale);
    }
  }
}

fem::UnitLoad volume_load(const std::string& component, fem::BodyForce::Field field) {
  return {"volume." + component, fem::BodyForce{field}};
}

/// What the loads other than the bearings' bring: force and first moment along z, per effect (body frame).
struct AxialSum {
  Array2Xd force;         // sum of F
  Array2Xd first_moment;  // sum of F (z - z_A); body loads: integral of (z - z_A) dF
};

}  // namespace

BodyLoads distribute_shaft(const kinetics::LoadHistory& loads, const std::vector<meshes::Port>& ports,
                           const fem::MassProperties& masses, const ShaftDistribution& options) {
  if (!loads.has_resultant("eccentric") || !loads.has_resultant("drive"))
    throw std::invalid_argument("the load history of convention \"" + loads.convention +
                                "\" has no closed loads for a shaft: analyse bodies under \"consistent\"");
  const auto& seat = find_port(ports, "eccentric_seat");
  const auto& coupling = find_port(ports, "coupling");
  const std::array<const meshes::Port*, 2> bearings{&find_port(ports, "main_bearing_1"),
                                                    &find_port(ports, "main_bearing_2")};
  const std::array<const meshes::Port*, 2> debalances{&find_port(ports, "debalance_1"),
                                                      &find_port(ports, "debalance_2")};
  const auto centre_z = [](const meshes::Port& port) { return 0.5 * (port.begin_m + port.end_m); };

  const Index n_instants = loads.n_instants();
  const ArrayXd& phi = loads.phi_rad;
  const double z_a = centre_z(*bearings[0]), z_b = centre_z(*bearings[1]);
  auto effects = loads.effects;
  if (options.own_weight) effects.push_back("gravity_shaft");
  if (options.own_inertia) effects.push_back("shaft_inertia");
  ChannelBuilder builder(effects, n_instants);

  std::map<std::string, AxialSum> axial;
  const auto count = [&](const std::string& effect, const Array2Xd& force, const Array2Xd& first_moment) {
    auto [entry, is_new] =
        axial.try_emplace(effect, AxialSum{Array2Xd::Zero(2, n_instants), Array2Xd::Zero(2, n_instants)});
    entry->second.force += force;
    entry->second.first_moment += first_moment;
  };
  const auto at = [&](const Array2Xd& force, double z) -> Array2Xd { return force * (z - z_a); };
  const auto& frame = loads.resultant("frame_bearings");
  const double force_scale = frame.total.topRows<2>().abs().maxCoeff();
  const double torque_scale = force_scale * seat.radius_m;

  // Eccentric seat: -B through the seat's own axis, no torque.
  ForceByEffect on_seat;
  for (const auto& part : loads.resultant("eccentric").contributions)
    on_seat[part.effect] = turn(part.load.topRows<2>(), phi);
  for (const auto& [effect, force] : on_seat) {
    add_force(builder, seat, effect, force, force_scale);
    count(effect, force, at(force, centre_z(seat)));
  }
  add_pressure(builder, seat, on_seat, options.pressure_harmonics, force_scale);

  // Debalances: their share of force, and of its moment about E, which the seat (concentric) takes as a
  // torque.
  if (loads.has_resultant("debalance"))
    for (const auto& part : loads.resultant("debalance").contributions)
      for (std::size_t i = 0; i < 2; ++i) {
        const Array2Xd force = options.debalance_shares[i] * turn(part.load.topRows<2>(), phi);
        add_force(builder, *debalances[i], part.effect, force, force_scale);
        builder.add(resultant_load(*debalances[i], "torque", fem::SurfaceResultant::Component::torque), "N m",
                    part.effect, options.debalance_shares[i] * part.load.row(2).transpose(), torque_scale);
        count(part.effect, force, at(force, centre_z(*debalances[i])));
      }

  // The body's own weight and inertia: d'Alembert accelerations; resultants and moments from the mesh.
  const double mass = masses.mass_kg;
  const auto& first = masses.first_moment_kg_m;
  const double m_xz = masses.second_moments_kg_m2[5], m_yz = masses.second_moments_kg_m2[4];
  const double polar = masses.second_moments_kg_m2[0] + masses.second_moments_kg_m2[1];
  ArrayXd own_torque = ArrayXd::Zero(n_instants);  // counter-clockwise about E, of the body's own loads
  std::map<std::string, ArrayXd> own_torque_by_effect;
  if (options.own_weight) {
    Array2Xd fixed = Array2Xd::Zero(2, n_instants);
    fixed.row(1) = -options.gravity_m_s2;
    const Array2Xd a = turn(fixed, phi);
    using Field = fem::BodyForce::Field;
    builder.add(volume_load("ax", Field::translation_x), "m/s2", "gravity_shaft", a.row(0).transpose(),
                options.gravity_m_s2);
    builder.add(volume_load("ay", Field::translation_y), "m/s2", "gravity_shaft", a.row(1).transpose(),
                options.gravity_m_s2);
    count("gravity_shaft", mass * a, (first[2] - mass * z_a) * a);
    own_torque_by_effect["gravity_shaft"] = (first[0] * a.row(1) - first[1] * a.row(0)).transpose();
  }
  if (options.own_inertia) {
    const ArrayXd spin = loads.speed_rad_s.square(), alpha = loads.acceleration_rad_s2;
    using Field = fem::BodyForce::Field;
    builder.add(volume_load("spin", Field::spin), "rad2/s2", "shaft_inertia", spin, spin.maxCoeff());
    builder.add(volume_load("az", Field::rotation), "rad/s2", "shaft_inertia", alpha, spin.maxCoeff());
    Array2Xd force(2, n_instants), moment(2, n_instants);
    force.row(0) = (first[0] * spin - first[1] * alpha).transpose();
    force.row(1) = (first[1] * spin + first[0] * alpha).transpose();
    moment.row(0) = (m_xz * spin - m_yz * alpha).transpose() - z_a * force.row(0);
    moment.row(1) = (m_yz * spin + m_xz * alpha).transpose() - z_a * force.row(1);
    count("shaft_inertia", force, moment);
    own_torque_by_effect["shaft_inertia"] = polar * alpha;
  }

  // Bearings: the resultant reaction is the load stage's R_E less the body's own loads; where it acts follows
  // from the moments about bearing 1. The closure of forces then remains a check of the load stage, not an
  // assumption.
  std::map<std::string, Array2Xd> reaction;
  for (const auto& part : frame.contributions) reaction[part.effect] = turn(part.load.topRows<2>(), phi);
  for (const char* own : {"gravity_shaft", "shaft_inertia"})
    if (axial.count(own)) reaction[own] = -axial.at(own).force;
  ForceByEffect on_bearing_1, on_bearing_2;
  for (const auto& [effect, resultant] : reaction) {
    on_bearing_2[effect] = axial.count(effect) ? Array2Xd(-axial.at(effect).first_moment / (z_b - z_a))
                                               : Array2Xd(Array2Xd::Zero(2, n_instants));
    on_bearing_1[effect] = resultant - on_bearing_2[effect];
  }
  for (const auto& [port, forces] : {std::pair{bearings[0], &on_bearing_1}, {bearings[1], &on_bearing_2}}) {
    for (const auto& [effect, force] : *forces) add_force(builder, *port, effect, force, force_scale);
    add_pressure(builder, *port, *forces, options.pressure_harmonics, force_scale);
  }

  // Coupling: the drive torque, and the moment of the body's own loads about E.
  const auto torque_load = resultant_load(coupling, "torque", fem::SurfaceResultant::Component::torque);
  const auto& drive = loads.resultant("drive");
  for (const auto& part : drive.contributions)
    builder.add(torque_load, "N m", part.effect, part.load.row(2).transpose(), torque_scale);
  for (const auto& [effect, torque] : own_torque_by_effect) {
    builder.add(torque_load, "N m", effect, -torque, torque_scale);
    own_torque += torque;
  }

  auto result = builder.finish("shaft");
  Array2Xd own_force = Array2Xd::Zero(2, n_instants);
  for (const char* own : {"gravity_shaft", "shaft_inertia"})
    if (axial.count(own)) own_force += turn(axial.at(own).force, -phi);
  result.frame_bearing_force_N = frame.total.topRows<2>() - own_force;
  result.drive_torque_Nm = -drive.total.row(2).transpose() + own_torque;
  return result;
}

}  // namespace pipelines

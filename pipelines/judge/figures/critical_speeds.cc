#include "pipelines/judge/figures/critical_speeds.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "kinetics/series/harmonics.h"
#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/judge/figures/vibration.h"
#include "pipelines/loads/stage/load_maker.h"
#include "pipelines/scene/whole/body_reader.h"

namespace pipelines {
namespace {

constexpr double least_share = 0.01, governing_share = 0.05;  // of the largest force on the shaft
constexpr double highest_order = 20;
constexpr std::size_t most_orders = 8;
constexpr int n_campbell = 31;

double middle_of_port(const meshes::BodyMesh& mesh, const std::string& name) {
  for (const auto& port : mesh.ports)
    if (port.name == name) return (port.begin_m + port.end_m) / 2;
  throw StageRefused("port \"" + name + "\" is missing on the mesh");
}

fem::Rotor rotor_of(const BodyScene& body, const MeshedBody& meshed) {
  fem::Rotor rotor;
  rotor.segments = beam_segments(body.shaft()->geometry);
  rotor.material = body.material;
  for (const auto& added : attached_to(body, meshed.mesh))
    rotor.discs.push_back(
        {added.surface.centre_m[2], added.mass_kg, added.inertia_kg_m2[2], added.inertia_kg_m2[0]});
  for (const auto& name : reader_of(body).supporting_ports(body)) {
    fem::RotorBearing bearing{middle_of_port(meshed.mesh, name)};
    if (!body.bearing_stiffness_N_m.empty())
      bearing.stiffness_N_m = body.bearing_stiffness_N_m[rotor.bearings.size()];
    rotor.bearings.push_back(bearing);
  }
  return rotor;
}

/// Two discretisations of a shaft, and where it operates.
class WhirlingShaft {
public:
  WhirlingShaft(fem::Rotor coarse, double speed_rad_s)
      : coarse_(std::move(coarse)), fine_(coarse_), speed_rad_s_(speed_rad_s) {
    fine_.n_elements = 2 * coarse_.n_elements;
    at_speed_ = fem::whirl_frequencies(fine_, speed_rad_s_);
  }

  /// The slowest that an order meets, at most `most` of them.
  std::vector<CriticalSpeed> met_by(double order, std::size_t most) const {
    const auto fine = fem::critical_speeds_rad_s(fine_, order),
               coarse = fem::critical_speeds_rad_s(coarse_, order);
    const auto& whirl = order > 0 ? at_speed_.forward_rad_s : at_speed_.backward_rad_s;
    std::vector<CriticalSpeed> met;
    for (std::size_t i = 0; i < std::min({most, fine.size(), coarse.size()}); ++i)
      met.push_back({order, int(i) + 1, fine[i], std::abs(coarse[i] - fine[i]), whirl[i],
                     speed_rad_s_ / fine[i] - 1, 0});
    return met;
  }

  double lowest_at_rest_Hz() const {
    return fem::whirl_frequencies(fine_, 0).forward_rad_s.front() / (2 * pi);
  }

  void add_campbell(double fastest_rad_s, std::size_t n_modes, CriticalSpeeds& to) const {
    for (int i = 0; i < n_campbell; ++i) {
      const double speed_rad_s = fastest_rad_s * i / (n_campbell - 1);
      auto whirl = fem::whirl_frequencies(coarse_, speed_rad_s);
      for (auto* list : {&whirl.forward_rad_s, &whirl.backward_rad_s})
        list->resize(std::min(n_modes, list->size()));
      to.campbell_rad_s.push_back(speed_rad_s);
      to.campbell_whirl.push_back(std::move(whirl));
    }
  }

private:
  fem::Rotor coarse_, fine_;
  double speed_rad_s_;
  fem::WhirlFrequencies at_speed_;
};

/// A force across the shaft at a port, or on the whole shaft.
struct AcrossForce {
  Eigen::ArrayXd x_N, y_N;
};

std::vector<AcrossForce> forces_across(const ChannelHistory& channels, double mass_kg) {
  std::map<std::string, AcrossForce> forces;
  for (std::size_t c = 0; c < channels.channels.size(); ++c) {
    const auto& name = channels.channels[c].name;
    const auto dot = name.rfind('.');
    const auto component = name.substr(dot + 1);
    const bool is_x = component == "fx" || component == "ax", is_y = component == "fy" || component == "ay";
    if (!is_x && !is_y) continue;
    auto& force = forces[name.substr(0, dot)];
    if (force.x_N.size() == 0) force.x_N = force.y_N = Eigen::ArrayXd::Zero(channels.values.cols());
    (is_x ? force.x_N : force.y_N) =
        (component[0] == 'a' ? mass_kg : 1) * channels.values.row(Eigen::Index(c)).transpose();
  }
  std::vector<AcrossForce> list;
  for (auto& [port, force] : forces) list.push_back(std::move(force));
  return list;
}

/// Parts of x + i y that go round counter-clockwise (order above 0) and clockwise, in the axes of x and y.
/// @param highest  order of the drive
std::vector<TurningLoad> rotating_parts(const AcrossForce& force, int turns, double highest) {
  const int n_lines = int(std::min<double>(double(force.x_N.size() / 2), std::ceil(highest * turns)));
  const auto x = kinetics::line_spectrum(force.x_N, turns, n_lines),
             y = kinetics::line_spectrum(force.y_N, turns, n_lines);
  std::vector<TurningLoad> parts{{0, std::hypot(x.mean, y.mean)}};
  for (std::size_t k = 0; k < x.lines.size(); ++k) {
    const auto cosine = [](const kinetics::Harmonic& h) { return h.amplitude * std::cos(h.phase_rad); };
    const auto sine = [](const kinetics::Harmonic& h) { return h.amplitude * std::sin(h.phase_rad); };
    const double xc = cosine(x.lines[k]), xs = sine(x.lines[k]), yc = cosine(y.lines[k]),
                 ys = sine(y.lines[k]);
    parts.push_back({x.lines[k].order, std::hypot(xc + ys, yc - xs) / 2});
    parts.push_back({-x.lines[k].order, std::hypot(xc - ys, yc + xs) / 2});
  }
  return parts;
}

}  // namespace

std::vector<TurningLoad> turning_loads(const ChannelHistory& channels, int turns, double spin, int turning,
                                       bool may_stand, double mass_kg) {
  const auto forces = forces_across(channels, mass_kg);
  double largest_N = 0;
  for (const auto& force : forces)
    largest_N = std::max(largest_N, (force.x_N.square() + force.y_N.square()).sqrt().maxCoeff());
  std::map<double, double> shares{{1, 0}};
  const auto enter = [&](double order, double share) {
    constexpr double same = 1e-6;
    const double rounded = std::round(order / same) * same;
    if (share < least_share || rounded == 0 || std::abs(rounded) > highest_order) return;
    shares[rounded] = std::max(shares[rounded], share);
  };
  for (const auto& force : forces)
    for (const auto& part : rotating_parts(force, turns, (highest_order + 1) * spin)) {
      const double order = part.order / spin, share = largest_N > 0 ? part.share / largest_N : 0;
      if (turning >= 0) enter(1 + order, share);
      if (turning <= 0) enter(1 - order, share);
      if (may_stand)
        for (const double either_way : {order, -order}) enter(either_way, share);
    }
  std::vector<TurningLoad> loads;
  for (const auto& [order, share] : shares) loads.push_back({order, share});
  std::stable_sort(loads.begin(), loads.end(), [](const auto& a, const auto& b) {
    return std::pair(a.order == 1, a.share) > std::pair(b.order == 1, b.share);
  });
  loads.resize(std::min(loads.size(), most_orders));
  return loads;
}

std::vector<fem::BeamSegment> beam_segments(const meshes::Shaft& shaft) {
  std::vector<fem::BeamSegment> segments;
  for (const auto& s : shaft.segments)
    segments.push_back({s.begin_m, s.end_m, s.diameter_m / 2, s.bore_m / 2,
                        s.eccentricity_m * std::cos(s.eccentricity_angle_rad),
                        s.eccentricity_m * std::sin(s.eccentricity_angle_rad)});
  return segments;
}

CriticalSpeeds critical_speeds(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                               const kinetics::LoadHistory& loads, const ChannelHistory& channels,
                               std::optional<double> solid_Hz) {
  const auto spins_Hz = load_maker_of(body).spins_Hz(scene, body, loads);
  CriticalSpeeds result;
  result.speed_rad_s = 2 * pi * spins_Hz.back();
  result.held = held_text(body);
  const WhirlingShaft shaft(rotor_of(body, meshed), result.speed_rad_s);
  const auto n_modes = std::size_t(body.critical_speeds);
  for (const double order : {1.0, -1.0})
    for (const auto& one : shaft.met_by(order, n_modes)) result.modes.push_back(one);
  if (solid_Hz) result.model_error = std::abs(shaft.lowest_at_rest_Hz() / *solid_Hz - 1);
  const double turn_Hz = 1 / ((loads.time_s[1] - loads.time_s[0]) * scene.sampling.instants_per_turn);
  if (spins_Hz.back() > 0)
    for (const auto& load : turning_loads(channels, scene.sampling.turns, spins_Hz.back() / turn_Hz,
                                          load_maker_of(body).turning(scene, body), spins_Hz.front() == 0,
                                          meshed.masses.mass_kg)) {
      auto met = shaft.met_by(load.order, most_orders);
      if (met.empty()) continue;
      result.loads.push_back(*std::min_element(met.begin(), met.end(), [](const auto& a, const auto& b) {
        return std::abs(a.margin) < std::abs(b.margin);
      }));
      result.loads.back().share = load.share;
    }
  std::stable_sort(result.loads.begin(), result.loads.end(),
                   [](const auto& a, const auto& b) { return std::abs(a.margin) < std::abs(b.margin); });
  const double first_rad_s = result.modes.empty() ? 0 : result.modes.front().speed_rad_s;
  shaft.add_campbell(std::max(2 * result.speed_rad_s, 1.25 * first_rad_s), n_modes, result);
  return result;
}

std::optional<CriticalSpeed> governing_load(const CriticalSpeeds& speeds) {
  for (const auto& load : speeds.loads)
    if (load.order == 1 || load.share >= governing_share) return load;
  return std::nullopt;
}

std::string model_error_text(const CriticalSpeeds& speeds) {
  return speeds.model_error
             ? fmt::format("the beam is {:.2g} % off the solid at rest", 100 * *speeds.model_error)
             : "by the beam, whose own error natural_frequencies = 2 tells";
}

std::string load_name(double order) {
  if (order == 1) return "imbalance";
  return fmt::format("load of order {:.4g}{}", std::abs(order), order < 0 ? " backward" : "");
}

}  // namespace pipelines

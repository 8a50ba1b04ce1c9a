#include "pipelines/analysis/vibration.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fem/model/model.h"
#include "kinetics/harmonics.h"
#include "pipelines/common/errors.h"
#include "pipelines/common/several_ranks.h"
#include "pipelines/scene/body_kind.h"
#include "pipelines/superposition/superposition.h"

namespace pipelines {
namespace {

constexpr double significant = 0.01;  // of the static peak
constexpr double round_off = 1e-9;    // likewise; its sum over a few thousand lines stays far below the limit

/// Far stiffer than any body of this material around the seat, whose own stiffness is of size E d.
constexpr double rigid = 1e6;

const meshes::Port& find(const std::vector<meshes::Port>& ports, const std::string& name) {
  const auto found = std::find_if(ports.begin(), ports.end(), [&](const auto& p) { return p.name == name; });
  if (found == ports.end()) throw StageRefused("port \"" + name + "\" is missing on the mesh");
  return *found;
}

fem::LoadSurface surface_of(const meshes::Port& port) {
  fem::LoadSurface surface;
  surface.kind =
      port.kind == meshes::Port::Kind::face ? fem::LoadSurface::Kind::face : fem::LoadSurface::Kind::seat;
  surface.boundary_id = port.boundary_id;
  surface.centre_m = {port.axis_x_m, port.axis_y_m, 0.5 * (port.begin_m + port.end_m)};
  if (surface.kind == fem::LoadSurface::Kind::seat) {
    surface.radius_m = port.radius_m;
    surface.length_m = port.end_m - port.begin_m;
  }
  return surface;
}

/// Added masses as discs across z: their inertia about x and y is half of the polar one.
std::vector<fem::AttachedMass> attached_to(const BodyScene& scene, const meshes::BodyMesh& mesh) {
  std::vector<fem::AttachedMass> result;
  for (const auto& added : scene.added_masses) {
    const double polar = added.polar_inertia_kg_m2;
    result.push_back({surface_of(find(mesh.ports, added.port)),
                      added.mass_kg,
                      {added.centre_m[0], added.centre_m[1], 0},
                      {polar / 2, polar / 2, polar}});
  }
  return result;
}

double amplification_at(double frequency_Hz, double natural_Hz) {
  const double ratio = frequency_Hz / natural_Hz, rest = std::abs(1 - ratio * ratio);
  return std::min(1 / rest, resonance_peak);
}

/// By the frequency that changes most: which of the shapes a harmonic brings is not looked at.
double amplification_at(double frequency_Hz, const std::vector<double>& natural_Hz) {
  double most = 1;
  for (const double natural : natural_Hz) {
    const double own = amplification_at(frequency_Hz, natural);
    if (std::abs(own - 1) > std::abs(most - 1)) most = own;
  }
  return most;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

DynamicAmplification dynamic_amplification(const Eigen::ArrayXXd& stress_Pa, int turns, double turn_Hz,
                                           double spin_Hz, const std::vector<double>& natural_Hz) {
  if (natural_Hz.empty()) throw std::invalid_argument("no natural frequency is given");
  for (const double natural : natural_Hz)
    if (!(natural > 0))
      throw std::invalid_argument(fmt::format("natural frequency {} Hz: must be positive", natural));
  double peak = 0;
  for (Eigen::Index i = 0; i < stress_Pa.cols(); ++i) {
    Stress s;
    for (Eigen::Index c = 0; c < 6; ++c) s[std::size_t(c)] = stress_Pa(c, i);
    peak = std::max(peak, von_mises_Pa(s));
  }
  DynamicAmplification result;
  if (peak == 0) return result;
  const int n_lines = int(stress_Pa.cols() / 2);
  std::vector<Stress> cosine(std::size_t(n_lines) + 1), sine(std::size_t(n_lines) + 1);
  for (Eigen::Index c = 0; c < 6; ++c) {
    const auto spectrum = kinetics::line_spectrum(stress_Pa.row(c).transpose() / peak, turns, n_lines);
    cosine[0][std::size_t(c)] = spectrum.mean;
    for (std::size_t k = 1; k < cosine.size(); ++k) {
      const auto& line = spectrum.lines[k - 1];
      cosine[k][std::size_t(c)] = line.amplitude * std::cos(line.phase_rad);
      sine[k][std::size_t(c)] = line.amplitude * std::sin(line.phase_rad);
    }
  }
  for (std::size_t k = 0; k < cosine.size(); ++k) {
    StressHarmonic line;
    line.order = double(k) / turns;
    line.frequency_Hz = line.order * turn_Hz + spin_Hz;
    line.share = std::hypot(von_mises_Pa(cosine[k]), von_mises_Pa(sine[k]));
    line.amplification = amplification_at(line.frequency_Hz, natural_Hz);
    if (line.share > round_off) result.factor += line.share * std::abs(line.amplification - 1);
    if (line.share > significant) result.highest = line;
  }
  return result;
}

fem::Body held_body(const BodyScene& scene, const MeshedBody& meshed) {
  fem::Body body = meshed.body;
  body.elastic_supports.clear();
  const BodyKind& kind = kind_of(scene);
  for (const auto& name : kind.supporting_ports(scene)) {
    const auto& port = find(meshed.mesh.ports, name);
    if (kind.is_clamped()) {
      body.clamps.push_back({port.boundary_id, {true, true, true}});
      continue;
    }
    const double size_m = port.radius_m > 0 ? 2 * port.radius_m : std::cbrt(meshed.masses.volume_m3);
    const double across_N_m = rigid * scene.material.youngs_modulus_Pa * size_m;
    body.elastic_supports.push_back({surface_of(port), {across_N_m, across_N_m, 0}});
  }
  return body;
}

Vibration vibration(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                    const kinetics::LoadHistory& loads, const Eigen::ArrayXXd& peak_stress_Pa,
                    const Eigen::ArrayXXd& hot_spot_stress_Pa) {
  Vibration result;
  const auto held = held_body(body, meshed);
  for (const auto& mode : fem::Model(held, ranks_of_a_body())
                              .natural_frequencies(body.natural_frequencies, attached_to(body, meshed.mesh)))
    result.natural_frequencies_Hz.push_back(mode.frequency_Hz);
  const BodyKind& kind = kind_of(body);
  const auto ports = kind.supporting_ports(body);
  result.held = ports.empty() ? "free" : (kind.is_clamped() ? "held at " : "pinned at ") + joined(ports);
  const double period_s = (loads.time_s[1] - loads.time_s[0]) * scene.sampling.instants_per_turn;
  const auto amplification = [&](const Eigen::ArrayXXd& stress_Pa) {
    return dynamic_amplification(stress_Pa, scene.sampling.turns, 1 / period_s,
                                 kind.spin_Hz(scene, body, loads), result.natural_frequencies_Hz);
  };
  result.amplification = amplification(peak_stress_Pa);
  if (hot_spot_stress_Pa.size() > 0) result.at_hot_spot = amplification(hot_spot_stress_Pa);
  return result;
}

std::string warning_of(const BodyScene& body, const Vibration& vibration) {
  const bool is_toe = vibration.at_hot_spot.factor > vibration.amplification.factor;
  const auto& dynamic = is_toe ? vibration.at_hot_spot : vibration.amplification;
  const auto& natural_Hz = vibration.natural_frequencies_Hz;
  const bool is_beyond = dynamic.highest.frequency_Hz > natural_Hz.back();
  if (!(dynamic.factor > amplification_limit) && !is_beyond) return {};
  return fmt::format(
      "the {}'s lowest natural frequency is {:.4g} Hz ({}): resonance adds about {:.2g} % to its {} "
      "stress, which is computed without; the highest harmonic of weight is at {:.4g} Hz{}",
      body.name, natural_Hz.front(), vibration.held, 100 * (dynamic.factor - 1), is_toe ? "hot-spot" : "peak",
      dynamic.highest.frequency_Hz,
      is_beyond ? fmt::format(", above the {} lowest natural frequencies: ask for more, which it may meet",
                              natural_Hz.size())
                : "");
}

}  // namespace pipelines

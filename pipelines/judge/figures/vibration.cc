#include "pipelines/judge/figures/vibration.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "fem/models/solid/model.h"
#include "kinetics/series/harmonics.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/several_ranks.h"
#include "pipelines/loads/stage/load_maker.h"
#include "pipelines/scene/whole/body_reader.h"
#include "pipelines/superpose/envelope/superposition.h"

namespace pipelines {
namespace {

constexpr double significant = 0.01;  // share of the static peak from which a harmonic counts
// Share of the static peak that is rounding; its sum over a few thousand lines stays far below the limit.
constexpr double round_off = 1e-9;

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

double amplification_at(double frequency_Hz, double natural_Hz) {
  if (frequency_Hz == 0) return 1;
  const double ratio = frequency_Hz / natural_Hz, rest = std::abs(1 - ratio * ratio);
  return std::min(1 / rest, resonance_peak);
}

/// Amplification at the one of all possible natural frequencies that changes most: where it may meet the load
/// that is resonance, elsewhere one of its bounds, since |amplification - 1| has no other maximum.
double amplification_at(double frequency_Hz, const NaturalFrequency& natural) {
  const double least_Hz = natural.least_Hz();
  if (least_Hz <= frequency_Hz && frequency_Hz <= natural.value_Hz && frequency_Hz > 0) return resonance_peak;
  const double high = amplification_at(frequency_Hz, natural.value_Hz),
               low = amplification_at(frequency_Hz, least_Hz);
  return std::abs(low - 1) > std::abs(high - 1) ? low : high;
}

/// The harmonic as amplified by the natural frequency, and at the frequency in axes at rest, that change
/// most: which of the shapes a harmonic brings, and which way it turns, is not looked at.
/// @param f_Hz  frequency in the body's axes
StressHarmonic amplified(double f_Hz, double share, const std::vector<double>& spins_Hz,
                         const std::vector<NaturalFrequency>& natural) {
  StressHarmonic line;
  line.frequency_Hz = f_Hz + spins_Hz.back();
  line.share = share;
  for (const double spin : spins_Hz)
    for (const double frequency : {f_Hz + spin, std::abs(f_Hz - spin)})
      for (const auto& one : natural) {
        const double own = amplification_at(frequency, one);
        if (std::abs(own - 1) > std::abs(line.amplification - 1)) {
          line.amplification = own;
          line.frequency_Hz = frequency;
        }
      }
  return line;
}

double added_share(const StressHarmonic& line) {
  return line.share > round_off ? line.share * std::abs(line.amplification - 1) : 0;
}

Stress stress_of(const Eigen::Matrix<double, 6, 1>& column) {
  Stress s;
  for (Eigen::Index c = 0; c < 6; ++c) s[std::size_t(c)] = column[c];
  return s;
}

/// What resonance adds to the first place and to the others.
Vibration::Added added(const std::vector<ShakenPlace>& places,
                       const std::vector<DynamicAmplification>& dynamic) {
  Vibration::Added result;
  for (std::size_t i = 0; i < places.size() && places[0].value_Pa > 0; ++i) {
    const double share = dynamic[i].factor * (places[i].value_Pa / places[0].value_Pa) - 1;
    if (share > result.share) result = {share, i == 0 ? "" : places[i].name};
  }
  return result;
}

/// Whether a channel loads the body across its axis. Torques, forces along it, spin and pressure without a
/// resultant make no difference between axes that turn and such that do not, or hardly any.
bool is_across(const std::string& channel) {
  const auto component = channel.substr(channel.rfind('.') + 1);
  return component == "fx" || component == "fy" || component == "mx" || component == "my" ||
         component == "ax" || component == "ay";
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// Two digits, without an exponent.
std::string in_percent(double share) {
  return fmt::format(100 * share < 10 ? "{:.2g}" : "{:.0f}", 100 * share);
}

std::string or_lower(const NaturalFrequency& natural) {
  const auto value = fmt::format("{:.4g}", natural.value_Hz),
             least = fmt::format("{:.4g}", natural.least_Hz());
  return value == least ? "" : ", or down to " + least + " Hz on a finer mesh";
}

}  // namespace

double NaturalFrequency::least_Hz() const {
  return std::max(value_Hz - error_Hz, 0.0);
}

LoadLines::LoadLines(const Eigen::ArrayXXd& factors, const std::vector<bool>& across, int turns,
                     double turn_Hz, std::vector<double> spins_Hz)
    : across_(across), turns_(turns), turn_Hz_(turn_Hz), spins_Hz_(std::move(spins_Hz)) {
  const int n_lines = int(factors.cols() / 2);
  cosine_ = sine_ = Eigen::MatrixXd::Zero(factors.rows(), n_lines + 1);
  for (Eigen::Index c = 0; c < factors.rows(); ++c) {
    const auto spectrum = kinetics::line_spectrum(factors.row(c).transpose(), turns, n_lines);
    cosine_(c, 0) = spectrum.mean;
    for (Eigen::Index k = 1; k <= n_lines; ++k) {
      const auto& line = spectrum.lines[std::size_t(k - 1)];
      cosine_(c, k) = line.amplitude * std::cos(line.phase_rad);
      sine_(c, k) = line.amplitude * std::sin(line.phase_rad);
    }
  }
}

DynamicAmplification LoadLines::amplification(const UnitStress& unit_Pa, double peak_Pa,
                                              const std::vector<NaturalFrequency>& natural) const {
  if (natural.empty()) throw std::invalid_argument("no natural frequency is given");
  for (const auto& one : natural) {
    if (!(one.value_Hz > 0))
      throw std::invalid_argument(fmt::format("natural frequency {} Hz: must be positive", one.value_Hz));
    if (!(one.error_Hz >= 0))
      throw std::invalid_argument(
          fmt::format("error of a natural frequency {} Hz: must not be negative", one.error_Hz));
  }
  DynamicAmplification result;
  if (peak_Pa == 0) return result;
  const UnitStress unit = unit_Pa / peak_Pa;
  UnitStress across = unit, along = unit;
  for (Eigen::Index c = 0; c < unit.cols(); ++c) (across_[std::size_t(c)] ? along : across).col(c).setZero();
  const std::array<UnitStress, 2> cosine{across * cosine_, along * cosine_},
      sine{across * sine_, along * sine_};
  const auto share = [](const auto& a, const auto& b) {
    return std::hypot(von_mises_Pa(stress_of(a)), von_mises_Pa(stress_of(b)));
  };
  for (Eigen::Index k = 0; k < cosine_.cols(); ++k) {
    const double order = double(k) / turns_, f_Hz = order * turn_Hz_;
    const auto shaking = amplified(f_Hz, share(cosine[0].col(k), sine[0].col(k)), spins_Hz_, natural),
               turning = amplified(f_Hz, share(cosine[1].col(k), sine[1].col(k)), {0}, natural);
    result.factor += added_share(shaking) + added_share(turning);
    const double together = share(cosine[0].col(k) + cosine[1].col(k), sine[0].col(k) + sine[1].col(k));
    if (!(together > significant)) continue;
    const bool shakes_more = added_share(shaking) > added_share(turning) ||
                             (added_share(turning) == 0 && shaking.share > round_off);
    result.highest = shakes_more ? shaking : turning;
    result.highest.order = order;
    result.highest.share = together;
    result.highest_Hz = f_Hz + (shaking.share > significant ? spins_Hz_.back() : 0);
  }
  return result;
}

DynamicAmplification dynamic_amplification(const Eigen::ArrayXXd& stress_Pa, int turns, double turn_Hz,
                                           double spin_Hz, const std::vector<NaturalFrequency>& natural) {
  double peak_Pa = 0;
  for (Eigen::Index i = 0; i < stress_Pa.cols(); ++i)
    peak_Pa = std::max(peak_Pa, von_mises_Pa(stress_of(stress_Pa.col(i).matrix())));
  // Scaled: numbers of any size.
  const Eigen::ArrayXXd shares = peak_Pa > 0 ? Eigen::ArrayXXd(stress_Pa / peak_Pa) : stress_Pa;
  return LoadLines(shares, std::vector<bool>(6, true), turns, turn_Hz, {spin_Hz})
      .amplification(Eigen::Matrix<double, 6, 6>::Identity(), peak_Pa > 0 ? 1 : 0, natural);
}

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

fem::Body held_body(const BodyScene& scene, const MeshedBody& meshed) {
  fem::Body body = meshed.body;
  body.elastic_supports.clear();
  const BodyReader& reader = reader_of(scene);
  for (const auto& name : reader.supporting_ports(scene)) {
    const auto& port = find(meshed.mesh.ports, name);
    if (reader.is_clamped(scene)) {
      body.clamps.push_back({port.boundary_id, {true, true, true}});
      continue;
    }
    const double size_m = port.radius_m > 0 ? 2 * port.radius_m : std::cbrt(meshed.masses.volume_m3);
    const double across_N_m = scene.bearing_stiffness_N_m.empty()
                                  ? rigid * scene.material.youngs_modulus_Pa * size_m
                                  : scene.bearing_stiffness_N_m[body.elastic_supports.size()];
    body.elastic_supports.push_back({surface_of(port), {across_N_m, across_N_m, 0}});
  }
  return body;
}

std::string held_text(const BodyScene& body) {
  const BodyReader& reader = reader_of(body);
  const auto ports = reader.supporting_ports(body);
  if (ports.empty()) return "free";
  if (reader.is_clamped(body)) return "held at " + joined(ports);
  if (body.bearing_stiffness_N_m.empty()) return "pinned at " + joined(ports);
  std::string text = "pinned at ";
  for (std::size_t i = 0; i < ports.size(); ++i)
    text += fmt::format("{}{} with {:.4g} N/um", i > 0 ? ", " : "", ports[i],
                        body.bearing_stiffness_N_m[i] / 1e6);
  return text;
}

Vibration vibration(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                    const kinetics::LoadHistory& loads, const ChannelHistory& channels,
                    const std::vector<ShakenPlace>& places, const std::vector<ShakenPlace>& toes) {
  Vibration result;
  const auto held = held_body(body, meshed);
  for (const auto& mode : fem::Model(held, ranks_of_a_body())
                              .natural_frequencies(body.natural_frequencies, attached_to(body, meshed.mesh)))
    result.natural_frequencies.push_back({mode.frequency_Hz, mode.error * mode.frequency_Hz});
  result.held = held_text(body);
  const double period_s = (loads.time_s[1] - loads.time_s[0]) * scene.sampling.instants_per_turn;
  std::vector<bool> across;
  for (const auto& channel : channels.channels) across.push_back(is_across(channel.name));
  const LoadLines lines(channels.values, across, scene.sampling.turns, 1 / period_s,
                        load_maker_of(body).spins_Hz(scene, body, loads));
  const auto resonance = [&](const std::vector<ShakenPlace>& all) {
    std::vector<DynamicAmplification> dynamic;
    for (const auto& place : all)
      dynamic.push_back(lines.amplification(place.unit_Pa, place.value_Pa, result.natural_frequencies));
    return dynamic;
  };
  const auto at_places = resonance(places), at_toes = resonance(toes);
  if (!places.empty()) result.amplification = at_places.front();
  if (!toes.empty()) result.at_hot_spot = at_toes.front();
  result.to_peak = added(places, at_places);
  result.to_hot_spot = added(toes, at_toes);
  return result;
}

std::string warning_of(const BodyScene& body, const Vibration& vibration) {
  const bool is_toe = vibration.to_hot_spot.share > vibration.to_peak.share;
  const auto& dynamic = is_toe ? vibration.at_hot_spot : vibration.amplification;
  const auto& added = is_toe ? vibration.to_hot_spot : vibration.to_peak;
  const auto& natural = vibration.natural_frequencies;
  // The next one, which is not known, is at least as high as the last.
  const bool is_beyond = dynamic.highest_Hz > natural.back().least_Hz();
  if (!(1 + added.share > amplification_limit) && !is_beyond) return {};
  return fmt::format(
      "the {}'s lowest natural frequency is {:.4g} Hz{} ({}): resonance adds up to {} % to its {} "
      "stress{}, which is computed without; the highest harmonic of weight is at {:.4g} Hz{}",
      body.name, natural.front().value_Hz, or_lower(natural.front()), vibration.held, in_percent(added.share),
      is_toe ? "hot-spot" : "peak", added.place.empty() ? "" : ", at another place: " + added.place,
      dynamic.highest_Hz,
      is_beyond ? fmt::format(", above the {} lowest natural frequencies: ask for more, which it may meet",
                              natural.size())
                : "");
}

std::string warning_of_frequencies(const BodyScene& body, const Vibration& vibration) {
  for (std::size_t i = 0; i < vibration.natural_frequencies.size(); ++i) {
    const auto& [f_Hz, error_Hz] = vibration.natural_frequencies[i];
    if (error_Hz > frequency_error_limit * f_Hz)
      return fmt::format(
          "the {}'s natural frequency {}, {:.4g} Hz, may be lower by {} %, and others may be missing: "
          "the mesh "
          "was made for the stress; ask for more by a finer [{}.mesh] and --tolerance none",
          body.name, i + 1, f_Hz, in_percent(error_Hz / f_Hz), body.name);
  }
  return {};
}

}  // namespace pipelines

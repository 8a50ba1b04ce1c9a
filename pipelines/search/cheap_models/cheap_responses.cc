#include "pipelines/search/cheap_models/cheap_responses.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "fem/models/axisymmetric/axisymmetric_responses.h"
#include "fem/models/beam/beam_responses.h"
#include "fem/models/beam/near_loads.h"
#include "pipelines/base/common/constants.h"
#include "pipelines/judge/figures/critical_speeds.h"
#include "pipelines/search/cheap_models/axisymmetric_body.h"
#include "pipelines/search/cheap_models/fitted.h"

namespace pipelines {
namespace {

/// The segment whose cylinder a feature of the surface is part of.
std::size_t segment_at(const meshes::Shaft& shaft, double z_m) {
  for (std::size_t i = 0; i < shaft.segments.size(); ++i)
    if (z_m < shaft.segments[i].end_m) return i;
  return shaft.segments.size() - 1;
}

/// The beam's own estimate knows nothing of loads beside a fillet.
constexpr double beam_safety = 3;

}  // namespace

std::optional<fem::BeamShaft> beam_shaft(const BodyScene& body, const meshes::BodyMesh& mesh) {
  const ShaftShape* shape = body.shaft();
  if (shape == nullptr || !shape->keyways.empty()) return std::nullopt;
  const auto& shaft = shape->geometry;
  fem::BeamShaft beam;
  beam.material = body.material;
  beam.segments = beam_segments(shaft);
  std::size_t torus = 0;  // one per fillet that has a step, in the order of the junctions
  for (std::size_t i = 0; i + 1 < shaft.segments.size(); ++i)
    if (shaft.fillets_m[i] > 0 && shaft.segments[i].diameter_m != shaft.segments[i + 1].diameter_m)
      beam.fillets.push_back({i, shaft.fillets_m[i], mesh.tori.at(torus++).boundary_id});
  using Kind = meshes::Feature::Kind;
  for (const auto& feature : mesh.features)
    if (feature.kind == Kind::seat || feature.kind == Kind::surface)
      beam.pieces.push_back({segment_at(shaft, (feature.begin_m + feature.end_m) / 2), feature.begin_m,
                             feature.end_m, feature.boundary_id});
  return beam;
}

std::optional<fem::UnitResponses> beam_responses(const BodyScene& body, const meshes::BodyMesh& mesh,
                                                 const std::vector<fem::UnitLoad>& loads) {
  const auto beam = beam_shaft(body, mesh);
  if (!beam) return std::nullopt;
  return fem::beam_responses(*beam, loads);
}

double ring_stress_Pa(const fem::BeamShaft& shaft, const BodyLoads& loads) {
  struct Harmonic {
    double per_N = 0;  // hoop stress
    Eigen::ArrayXd squares;
  };
  std::map<int, std::map<int, Harmonic>> seats;  // by boundary and order
  for (std::size_t k = 0; k < loads.unit_loads.size(); ++k) {
    const auto* pressure = std::get_if<fem::SeatPressure>(&loads.unit_loads[k].shape);
    if (pressure == nullptr || pressure->harmonic == 1) continue;
    const auto& surface = pressure->surface;
    const auto segment = std::find_if(shaft.segments.begin(), shaft.segments.end(),
                                      [&](const auto& s) { return surface.centre_m[2] < s.end_m; });
    if (segment == shaft.segments.end() || segment->bore_radius_m == 0) continue;
    const double wall_m = segment->radius_m - segment->bore_radius_m;
    const double mean_m = (segment->radius_m + segment->bore_radius_m) / 2;
    const int n = pressure->harmonic;
    const double ring =
        n == 0 ? surface.radius_m / wall_m : 6 * surface.radius_m * mean_m / ((n * n - 1) * wall_m * wall_m);
    auto& harmonic = seats[surface.boundary_id][n];
    harmonic.per_N = ring * std::abs(pressure->coefficient) / (pi * surface.radius_m * surface.length_m);
    const Eigen::ArrayXd values = loads.history.values.row(Eigen::Index(k)).transpose();
    if (harmonic.squares.size() == 0) harmonic.squares = Eigen::ArrayXd::Zero(values.size());
    harmonic.squares += values.square();  // cosine and sine
  }
  double largest_Pa = 0;
  for (const auto& [boundary, harmonics] : seats) {
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(loads.history.values.cols());
    for (const auto& [n, harmonic] : harmonics) sum += harmonic.per_N * harmonic.squares.sqrt();
    if (sum.size() > 0) largest_Pa = std::max(largest_Pa, sum.maxCoeff());
  }
  return largest_Pa;
}

double spin_stress_Pa(const fem::BeamShaft& shaft, const fem::Material& material, const BodyLoads& loads) {
  const double nu = material.poisson_ratio / (1 - material.poisson_ratio);
  double per_rad2_s2 = 0;
  for (const auto& s : shaft.segments) {
    const double a = s.bore_radius_m, b = s.radius_m;
    const double squares = a > 0 ? ((3 + nu) * b * b + (1 - nu) * a * a) / 4 : (3 + nu) * b * b / 8;
    per_rad2_s2 = std::max(per_rad2_s2, material.density_kg_m3 * squares);
  }
  double largest_rad2_s2 = 0;
  for (std::size_t k = 0; k < loads.unit_loads.size(); ++k) {
    const auto* force = std::get_if<fem::BodyForce>(&loads.unit_loads[k].shape);
    if (force == nullptr || force->field != fem::BodyForce::Field::spin) continue;
    largest_rad2_s2 = std::max(largest_rad2_s2, loads.history.values.row(Eigen::Index(k)).maxCoeff());
  }
  return per_rad2_s2 * largest_rad2_s2;
}

namespace {

/// By how much the largest stress of any circle with what it may be wrong by near loads exceeds the peak; not
/// negative. At excluded nodes the beam has no singular stress: what it says there holds up to their border.
double near_load_stress_Pa(const fem::BeamShaft& shaft, const BodyLoads& loads, const fem::Nodes& nodes,
                           const std::vector<double>& von_mises_Pa, const std::vector<char>& excluded,
                           double peak_Pa) {
  double beyond_Pa = 0;
  std::map<double, double> largest_Pa;  // by the circles' z
  for (std::size_t i = 0; i < nodes.n; ++i)
    if (excluded[i])
      beyond_Pa = std::max(beyond_Pa, von_mises_Pa[i] - peak_Pa);
    else {
      auto& largest = largest_Pa[nodes.xyz_m[3 * i + 2]];
      largest = std::max(largest, von_mises_Pa[i]);
    }
  std::vector<double> z_m;
  for (const auto& circle : largest_Pa) z_m.push_back(circle.first);
  std::vector<std::vector<double>> factors;
  for (const auto& row : loads.history.values.rowwise()) factors.emplace_back(row.begin(), row.end());
  const auto errors_Pa = fem::near_load_error_Pa(shaft, loads.unit_loads, factors, z_m);
  const auto tractions = fem::seat_tractions(loads.unit_loads, factors, z_m);
  for (std::size_t c = 0; c < z_m.size(); ++c) {
    const double with_tractions_Pa =
        std::hypot(largest_Pa[z_m[c]] + tractions[c].pressure_Pa,
                   fitted::traction_safety * std::sqrt(3.0) * tractions[c].shear_Pa);
    beyond_Pa = std::max(beyond_Pa, with_tractions_Pa + errors_Pa[c] - peak_Pa);
  }
  return beyond_Pa;
}

}  // namespace

std::vector<ErrorEntry> beam_model_entries(const fem::BeamShaft& shaft, const BodyLoads& loads,
                                           const fem::Nodes& nodes, const std::vector<double>& von_mises_Pa,
                                           const std::vector<char>& excluded, double peak_Pa) {
  std::vector<ErrorEntry> entries{
      {"beam_model", "beam: spread of the fillets' published factors and eccentric shoulders, times 3",
       beam_safety * fem::beam_model_error(shaft) * peak_Pa}};
  const auto add = [&](const char* source, const char* method, double value_Pa) {
    if (value_Pa > 0) entries.push_back({source, method, value_Pa});
  };
  add("near_loads",
      "tractions on seats; axial loads that enter, loads that bend, within a diameter, times 2.5",
      near_load_stress_Pa(shaft, loads, nodes, von_mises_Pa, excluded, peak_Pa));
  add("ovalisation", "bored seats as rings, twice as much at a fillet",
      fitted::fillet_of_oval_section * ring_stress_Pa(shaft, loads));
  add("spin", "segments as long cylinders that turn, times 1.25 for shoulders",
      fitted::spin_at_shoulders * spin_stress_Pa(shaft, shaft.material, loads));
  return entries;
}

std::optional<AxisymmetricModel> axisymmetric_responses(const BodyScene& body, const meshes::BodyMesh& mesh,
                                                        const std::vector<fem::UnitLoad>& loads) {
  const auto beam = beam_shaft(body, mesh);
  if (!beam) return std::nullopt;
  return AxisymmetricModel{fem::axisymmetric_responses(meridian_body(body, mesh), loads),
                           fem::eccentricity_error(*beam)};
}

}  // namespace pipelines

#include "pipelines/judge/figures/diagrams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/judge/estimates/time_sampling.h"
#include "pipelines/loads/channels/statics.h"
#include "pipelines/superpose/envelope/zones.h"

namespace pipelines {
namespace {

using Eigen::Array2Xd;
using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

/// Rows of `unit` (one column per channel) times the channels over time.
ArrayXXd over_the_cycle(const ArrayXXd& unit, const ChannelHistory& loads) {
  return (unit.matrix() * loads.values.matrix()).array();
}

/// Axis of the shaft over the cycle at the planes: displacement, and rotation of the sections as slope.
struct ElasticLine {
  std::vector<double> z_m;
  std::vector<Array2Xd> displacement_m, slope_rad;

  /// Deflection and slope at z. Between planes the displacement is cubic (Hermite) and the slope linear: not
  /// the cubic's derivative, since shear inclines the axis against its sections, and more than bending where
  /// a seat is short. Beyond the last plane the shaft is straight.
  std::pair<Array2Xd, Array2Xd> at(double z) const {
    if (z <= z_m.front() || z >= z_m.back()) {
      const std::size_t end = z <= z_m.front() ? 0 : z_m.size() - 1;
      return {displacement_m[end] + (z - z_m[end]) * slope_rad[end], slope_rad[end]};
    }
    const auto i = std::size_t(std::upper_bound(z_m.begin(), z_m.end(), z) - z_m.begin());
    const double h = z_m[i] - z_m[i - 1], t = (z - z_m[i - 1]) / h;
    const auto &u0 = displacement_m[i - 1], &u1 = displacement_m[i], &s0 = slope_rad[i - 1],
               &s1 = slope_rad[i];
    return {(1 + 2 * t) * (1 - t) * (1 - t) * u0 + t * (1 - t) * (1 - t) * h * s0 + t * t * (3 - 2 * t) * u1 +
                t * t * (t - 1) * h * s1,
            (1 - t) * s0 + t * s1};
  }
};

double largest(const ArrayXXd& values) {
  return values.size() == 0 ? 0.0 : values.abs().maxCoeff();
}

const meshes::Port& find_port(const meshes::BodyMesh& mesh, const std::string& name) {
  for (const auto& port : mesh.ports)
    if (port.name == name) return port;
  throw StageRefused("section diagrams: port \"" + name + "\" is missing");
}

double centre_z(const meshes::Port& port) {
  return 0.5 * (port.begin_m + port.end_m);
}

/// Subtracts the straight line through the axis at two places, or its tangent at one.
void refer_to(ElasticLine& line, const std::vector<double>& z_m) {
  if (z_m.empty()) return;
  const double z_a = z_m.front();
  const auto [u_a, slope_a] = line.at(z_a);
  const Array2Xd incline =
      z_m.size() < 2 ? slope_a : Array2Xd((line.at(z_m[1]).first - u_a) / (z_m[1] - z_a));
  for (std::size_t i = 0; i < line.z_m.size(); ++i) {
    line.displacement_m[i] -= u_a + incline * (line.z_m[i] - z_a);
    line.slope_rad[i] -= incline;
  }
}

/// Distance of a ring to the nearest border of what is left out; negative within.
double beyond_m(const TorsionRing& ring, const std::vector<meshes::SharpEdge>& edges) {
  double least_m = std::numeric_limits<double>::max();
  for (const auto& edge : edges)
    least_m = std::min(least_m, distance_m({ring.radius_m, 0, ring.z_m}, edge) - edge.distance_m);
  return least_m;
}

/// Nodes at that distance are kept, as those of the envelope.
bool is_left_out(const TorsionRing& ring, const std::vector<meshes::SharpEdge>& edges) {
  constexpr double within = 1 - 2e-3;
  return std::any_of(edges.begin(), edges.end(), [&](const auto& edge) {
    return distance_m({ring.radius_m, 0, ring.z_m}, edge) <= within * edge.distance_m;
  });
}

/// The nearest to a ring of those that are left out, or of those that are not; their number: there is none.
std::size_t nearest_ring(const std::vector<TorsionRing>& rings, const TorsionRing& ring,
                         const std::vector<char>& left_out, bool wanted) {
  std::size_t nearest = rings.size();
  double least_m = std::numeric_limits<double>::max();
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const double away_m = std::hypot(rings[r].z_m - ring.z_m, rings[r].radius_m - ring.radius_m);
    if ((left_out[r] != 0) != wanted || away_m >= least_m) continue;
    least_m = away_m;
    nearest = r;
  }
  return nearest;
}

/// Takes the stress of the rings beside sharp edges from them, and enters what it says of those next to them.
void leave_out(const std::vector<meshes::SharpEdge>& edges, std::vector<TorsionRing>& rings) {
  std::vector<char> left_out;
  for (const auto& ring : rings) left_out.push_back(is_left_out(ring, edges));
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (!left_out[r]) continue;
    const auto outside = nearest_ring(rings, rings[r], left_out, false);
    if (outside == rings.size()) break;
    auto& ring = rings[outside];
    if (nearest_ring(rings, ring, left_out, true) != r) continue;
    const double from_m = std::max(0.0, beyond_m(ring, edges)),
                 to_m = std::min(0.0, beyond_m(rings[r], edges));
    if (from_m > to_m) ring.rise_Pa = std::max(0.0, rings[r].max_Pa - ring.max_Pa) * from_m / (from_m - to_m);
  }
  for (std::size_t r = 0; r < rings.size(); ++r)
    if (left_out[r]) {
      rings[r].max_Pa = 0;
      rings[r].instant = 0;
      rings[r].denser_instant = -1;
    }
}

}  // namespace

SectionHistory statics_over_the_cycle(const std::vector<fem::UnitLoad>& unit_loads,
                                      const ChannelHistory& loads, const meshes::Shaft& geometry,
                                      double density_kg_m3, double z_m) {
  ArrayXXd unit(6, Index(unit_loads.size()));
  for (std::size_t k = 0; k < unit_loads.size(); ++k) {
    const auto resultant = internal_resultant(unit_loads[k], geometry, density_kg_m3, z_m);
    for (std::size_t c = 0; c < 6; ++c) unit(Index(c), Index(k)) = resultant[c];
  }
  return over_the_cycle(unit, loads);
}

Array2Xd ring_shear_Pa(const ChannelHistory& loads, const fem::UnitResponses& responses, std::size_t ring) {
  return ring_shear_Pa(loads.values, responses, ring);
}

Array2Xd ring_shear_Pa(const ArrayXXd& values, const fem::UnitResponses& responses, std::size_t ring) {
  const std::size_t n_channels = responses.channels.size();
  ArrayXXd unit(2, Index(n_channels));
  for (std::size_t k = 0; k < n_channels; ++k)
    for (std::size_t c = 0; c < 2; ++c)
      unit(Index(c), Index(k)) = responses.ring_shear_Pa[ring * n_channels + k][c];
  return (unit.matrix() * values.matrix()).array();
}

std::vector<TorsionRing> torsion_rings(const BodyLoads& loads, const fem::UnitResponses& responses,
                                       const meshes::BodyMesh& mesh) {
  std::vector<TorsionRing> rings;
  const bool is_whole = is_whole_course(loads.history);
  const auto shear_of = [&](const ArrayXXd& values, std::size_t r) -> ArrayXd {
    return ring_shear_Pa(values, responses, r).matrix().colwise().stableNorm().transpose();
  };
  for (std::size_t r = 0; r < responses.rings.size(); ++r) {
    TorsionRing ring;
    ring.z_m = responses.rings[r].z_m;
    ring.radius_m = responses.rings[r].radius_m;
    ring.max_Pa = shear_of(loads.history.values, r).maxCoeff(&ring.instant);
    if (is_whole) ring.max_Pa = shear_of(loads.history.passed_over, r).maxCoeff(&ring.denser_instant);
    for (const auto& feature : mesh.features)
      if (feature.boundary_id == responses.rings[r].boundary_id) ring.feature = feature.name;
    rings.push_back(ring);
  }
  if (!mesh.sharp_edges.empty()) leave_out(mesh.sharp_edges, rings);
  return rings;
}

Diagrams section_diagrams(const BodyLoads& loads, const fem::UnitResponses& responses,
                          const meshes::BodyMesh& mesh, const meshes::Shaft& geometry, double density_kg_m3,
                          const std::vector<std::string>& references) {
  const std::size_t n_channels = responses.channels.size();
  if (mesh.sections.size() != responses.planes.size() || mesh.sections.size() < 2)
    throw std::invalid_argument(
        "section diagrams: the planes of mesh and responses differ, or there are fewer than two");

  Diagrams diagrams;
  ElasticLine line;
  double force_scale = 0, bending_scale = 0, torque_scale = 0, force_error = 0, bending_error = 0,
         torque_error = 0;
  for (std::size_t p = 0; p < mesh.sections.size(); ++p) {
    const auto& plane = mesh.sections[p];
    ArrayXXd by_stress(6, n_channels), rim(1, n_channels), motion(6, n_channels);
    for (std::size_t k = 0; k < n_channels; ++k) {
      const auto& response = responses.sections[p * n_channels + k];
      for (std::size_t c = 0; c < 6; ++c) {
        by_stress(Index(c), Index(k)) = response.resultant[c];
        motion(Index(c), Index(k)) = c < 3 ? response.translation_m[c] : response.rotation_rad[c - 3];
      }
      rim(0, Index(k)) = response.mean_rim_shear_Pa[1];
    }
    SectionResult section;
    section.plane = plane;
    section.by_stress = over_the_cycle(by_stress, loads.history);
    section.by_statics =
        statics_over_the_cycle(loads.unit_loads, loads.history, geometry, density_kg_m3, plane.z_m);
    section.torsion_Pa = over_the_cycle(rim, loads.history).row(0).transpose();
    const double r = plane.radius_m, r_i = plane.inner_radius_m;
    const ArrayXd own_torque = (section.by_statics.row(5) - (plane.axis_x_m * section.by_statics.row(1) -
                                                             plane.axis_y_m * section.by_statics.row(0)))
                                   .transpose();
    section.beam_torsion_Pa = own_torque * (2 * r / (pi * (std::pow(r, 4) - std::pow(r_i, 4))));

    const ArrayXXd moved = over_the_cycle(motion, loads.history);
    line.z_m.push_back(plane.z_m);
    line.displacement_m.push_back(moved.topRows<2>());
    Array2Xd slope(2, moved.cols());
    slope.row(0) = moved.row(4);   // rotation about +y moves larger z towards +x
    slope.row(1) = -moved.row(3);  // rotation about +x moves larger z towards -y
    line.slope_rad.push_back(slope);

    const ArrayXXd error = section.by_stress - section.by_statics;
    force_scale = std::max(force_scale, largest(section.by_statics.topRows<3>()));
    bending_scale = std::max(bending_scale, largest(section.by_statics.middleRows<2>(3)));
    torque_scale = std::max(torque_scale, largest(section.by_statics.row(5)));
    force_error = std::max(force_error, largest(error.topRows<3>()));
    bending_error = std::max(bending_error, largest(error.middleRows<2>(3)));
    torque_error = std::max(torque_error, largest(error.row(5)));
    diagrams.sections.push_back(std::move(section));
  }
  const auto share = [](double error, double scale) { return scale > 0 ? error / scale : error; };
  diagrams.force_mismatch = share(force_error, force_scale);
  diagrams.bending_mismatch = share(bending_error, bending_scale);
  diagrams.torque_mismatch = share(torque_error, torque_scale);

  std::vector<double> references_m;
  for (const auto& name : references) references_m.push_back(centre_z(find_port(mesh, name)));
  refer_to(line, references_m);
  for (std::size_t p = 0; p < diagrams.sections.size(); ++p) {
    diagrams.sections[p].deflection_m = line.displacement_m[p];
    diagrams.sections[p].slope_rad = line.slope_rad[p];
  }
  for (const auto& port : mesh.ports) {
    if (port.kind != meshes::Port::Kind::seat) continue;
    const auto [displacement, slope] = line.at(centre_z(port));
    diagrams.seats.push_back({port.name, centre_z(port),
                              displacement.matrix().colwise().stableNorm().maxCoeff(),
                              slope.matrix().colwise().stableNorm().maxCoeff()});
  }
  diagrams.rings = torsion_rings(loads, responses, mesh);
  return diagrams;
}

const TorsionRing* largest_torsion_ring(const Diagrams& diagrams) {
  const auto largest = std::max_element(diagrams.rings.begin(), diagrams.rings.end(),
                                        [](const auto& a, const auto& b) { return a.max_Pa < b.max_Pa; });
  return largest == diagrams.rings.end() ? nullptr : &*largest;
}

double plain_torsion_mismatch(const Diagrams& diagrams) {
  double error = 0, scale = 0;
  for (const auto& section : diagrams.sections) {
    if (!section.plane.plain) continue;
    error = std::max(error, (section.torsion_Pa - section.beam_torsion_Pa).abs().maxCoeff());
    scale = std::max(scale, section.beam_torsion_Pa.abs().maxCoeff());
  }
  return scale > 0 ? error / scale : 0.0;
}

}  // namespace pipelines

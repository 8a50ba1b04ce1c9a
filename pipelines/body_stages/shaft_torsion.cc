#include "pipelines/body_stages/shaft_torsion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipelines/common/constants.h"
#include "pipelines/estimates/time_sampling.h"
#include "pipelines/scene/body_kind.h"

namespace pipelines {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double same_place =
    1e-9;  // of the shaft's length: planes and ends of ports that are meant to agree

const meshes::Port* port_of(const meshes::BodyMesh& mesh, const std::string& name) {
  for (const auto& port : mesh.ports)
    if (port.name == name) return &port;
  return nullptr;
}

/// Torque of the stress field in the last section before a place, or the first one after it; zero beyond the
/// shaft's end.
ArrayXd torque_beside(const std::vector<SectionResult>& sections, double z_m, bool before) {
  const double tolerance_m = same_place * (sections.back().plane.z_m - sections.front().plane.z_m);
  const SectionResult* found = nullptr;
  for (const auto& section : sections) {
    const double z = section.plane.z_m;
    if (before && z <= z_m + tolerance_m) found = &section;
    if (!before && found == nullptr && z >= z_m - tolerance_m) found = &section;
  }
  if (found == nullptr) return ArrayXd::Zero(sections.front().by_stress.cols());
  return found->by_stress.row(5).transpose();
}

/// Of the segments that a place lies in: at a shoulder there are two.
double least_modulus_m3(const meshes::Shaft& shaft, double z_m) {
  const double tolerance_m = same_place * (shaft.segments.back().end_m - shaft.segments.front().begin_m);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& segment : shaft.segments)
    if (z_m >= segment.begin_m - tolerance_m && z_m <= segment.end_m + tolerance_m)
      least = std::min(least, polar_modulus_m3(segment.diameter_m, segment.bore_m));
  return least;
}

const SectionResult& nearest_section(const std::vector<SectionResult>& sections, double z_m) {
  return *std::min_element(sections.begin(), sections.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.plane.z_m - z_m) < std::abs(b.plane.z_m - z_m);
  });
}

RingTorsion ring_torsion(const BodyAnalysis& analysis, std::size_t index) {
  const auto& diagrams = *analysis.diagrams;
  RingTorsion result;
  result.ring = diagrams.rings[index];
  result.stress_Pa = signed_ring_stress_Pa(ring_shear_Pa(analysis.loads.history, analysis.responses, index));
  const double z = result.ring.z_m;
  const ArrayXd torque_Nm = nearest_section(diagrams.sections, z).by_statics.row(5).transpose();
  result.nominal_Pa =
      torque_Nm.abs() / least_modulus_m3(analysis.scene.shaft()->geometry, z) * result.stress_Pa.sign();
  const double nominal = std::abs(result.nominal_Pa[result.ring.instant]);
  if (nominal > 0) result.factor = result.ring.max_Pa / nominal;
  return result;
}

/// Of the rings that are nearer to the middle of this port than to that of any other, the one stressed most.
std::optional<RingTorsion> largest_near(const BodyAnalysis& analysis, const std::vector<double>& middles_m,
                                        std::size_t port) {
  const auto& rings = analysis.diagrams->rings;
  const auto nearest = [&](double z) {
    return std::min_element(middles_m.begin(), middles_m.end(),
                            [&](double a, double b) { return std::abs(a - z) < std::abs(b - z); }) -
           middles_m.begin();
  };
  std::size_t largest = rings.size();
  for (std::size_t r = 0; r < rings.size(); ++r)
    if (std::size_t(nearest(rings[r].z_m)) == port &&
        (largest == rings.size() || rings[r].max_Pa > rings[largest].max_Pa))
      largest = r;
  if (largest == rings.size()) return std::nullopt;
  return ring_torsion(analysis, largest);
}

/// Nodes of a feature's faces at a ring's height.
std::vector<std::size_t> nodes_at(const BodyAnalysis& analysis, const TorsionRing& ring) {
  const auto& nodes = analysis.responses.nodes;
  const double near_m = same_place * (analysis.scene.shaft()->geometry.segments.back().end_m -
                                      analysis.scene.shaft()->geometry.segments.front().begin_m);
  std::vector<std::size_t> found;
  for (const auto& feature : analysis.mesh.features) {
    if (feature.name != ring.feature) continue;
    for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
      if (nodes.face_boundary_id[f] != feature.boundary_id) continue;
      for (const auto node : nodes.face(f))
        if (std::abs(nodes.xyz_m[3 * std::size_t(node) + 2] - ring.z_m) <= near_m)
          found.push_back(std::size_t(node));
    }
  }
  return found;
}

/// Mean shear of a ring under each channel, an entry for each: r theta, theta z [Pa]; null: it has none.
const std::array<double, 2>* shear_of(const fem::UnitResponses& responses, const TorsionRing& ring) {
  const auto found = std::find_if(responses.rings.begin(), responses.rings.end(), [&](const auto& other) {
    return other.z_m == ring.z_m && other.radius_m == ring.radius_m;
  });
  if (found == responses.rings.end()) return nullptr;
  return &responses.ring_shear_Pa[std::size_t(found - responses.rings.begin()) * responses.channels.size()];
}

/// What the largest stress of the ring between the instants may exceed that at them by.
double sampling_error_of_Pa(const BodyAnalysis& analysis, const TorsionRing& ring) {
  const auto* shear_Pa = shear_of(analysis.responses, ring);
  if (shear_Pa == nullptr) return 0;
  std::vector<std::array<double, 6>> unit;
  for (std::size_t k = 0; k < analysis.responses.channels.size(); ++k)
    unit.push_back({0, 0, 0, shear_Pa[k][0], shear_Pa[k][1], 0});
  return sampling_error_Pa(unit, analysis.loads.history) / std::sqrt(3);
}

/// At the node of the ring's height that twist stresses most.
std::optional<double> error_of_twist_Pa(const BodyAnalysis& analysis, const TorsionRing& ring) {
  constexpr double least_share = 0.05;  // of a channel's stress: all shear by torsion has 0.58, bending 0.00
  const auto& responses = analysis.responses;
  const auto n_channels = responses.channels.size();
  const auto nodes = nodes_at(analysis, ring);
  const auto* shear_Pa = shear_of(responses, ring);
  if (shear_Pa == nullptr || nodes.empty()) return std::nullopt;
  ArrayXd factors = analysis.loads.history.values.col(ring.instant);
  std::vector<std::vector<std::array<double, 6>>> unit_Pa;
  for (const auto node : nodes) unit_Pa.push_back(unit_stress_at(responses, {{{node, 1.0}}, 0}));
  for (std::size_t k = 0; k < n_channels; ++k) {
    double largest_Pa = 0;
    for (const auto& unit : unit_Pa) largest_Pa = std::max(largest_Pa, von_mises_Pa(unit[k]));
    if (std::hypot(shear_Pa[k][0], shear_Pa[k][1]) < least_share * largest_Pa) factors[Index(k)] = 0;
  }
  std::size_t most = 0;
  for (std::size_t i = 1; i < nodes.size(); ++i)
    if (von_mises_of(unit_Pa[i], factors) > von_mises_of(unit_Pa[most], factors)) most = i;
  ChannelHistory twist;
  twist.values = factors;
  const auto estimate = discretisation_estimate({{{nodes[most], 1.0}}, 0}, responses, twist,
                                                analysis.scene.material, analysis.places.excluded);
  if (!estimate) return std::nullopt;
  return estimate->value_Pa / std::sqrt(3);
}

/// What is left of bending in a mean over a ring: a shaft without torque had 2.5e-9 of its largest stress.
double rounding_Pa(const BodyAnalysis& analysis) {
  constexpr double share = 2.5e-8;
  return share * analysis.peak.value_Pa;
}

/// For want of a finer mesh.
double mesh_error_Pa(const BodyAnalysis& analysis, const TorsionRing& ring) {
  const auto& other = analysis.diagrams->by_harmonics;
  const double infinite = std::numeric_limits<double>::infinity();
  if (analysis.method == Method::axisymmetric) return other ? other->error_Pa : infinite;
  double rise_Pa = 0;
  for (const auto& any : analysis.diagrams->rings)
    rise_Pa = std::max(rise_Pa, any.max_Pa + any.rise_Pa - ring.max_Pa);
  auto own_Pa = error_of_twist_Pa(analysis, ring);
  if (own_Pa) *own_Pa += rise_Pa;
  if (!other) return own_Pa.value_or(infinite);
  const double difference_Pa = std::abs(ring.max_Pa - other->value_Pa),
               most_Pa = difference_Pa + other->error_Pa;
  const bool agree = own_Pa && difference_Pa <= *own_Pa + other->error_Pa;
  return agree ? std::min(*own_Pa, most_Pa) : most_Pa;
}

}  // namespace

double ring_error_Pa(const BodyAnalysis& analysis, const TorsionRing& ring) {
  return mesh_error_Pa(analysis, ring) + sampling_error_of_Pa(analysis, ring) + rounding_Pa(analysis);
}

bool is_rounding(const BodyAnalysis& analysis, const TorsionRing& ring) {
  return ring.max_Pa <= rounding_Pa(analysis);
}

void take_torsion_by_harmonics(const BodyAnalysis& before, BodyAnalysis& after) {
  if (!before.diagrams || !before.diagrams->by_harmonics || !after.diagrams) return;
  const auto *ring_before = largest_torsion_ring(*before.diagrams),
             *ring_after = largest_torsion_ring(*after.diagrams);
  if (ring_before == nullptr || ring_after == nullptr || !(ring_before->max_Pa > 0) ||
      ring_before->feature != ring_after->feature)
    return;
  const double ratio = ring_after->max_Pa / ring_before->max_Pa;
  const auto& known = *before.diagrams->by_harmonics;
  after.diagrams->by_harmonics = LargestTorsion{ratio * known.value_Pa, ratio * known.error_Pa};
}

Course course_of(const ArrayXd& values) {
  if (values.size() == 0) return {};
  return {values.mean(), (values.maxCoeff() - values.minCoeff()) / 2, values.abs().maxCoeff()};
}

double polar_modulus_m3(double diameter_m, double bore_m) {
  return pi * (std::pow(diameter_m, 4) - std::pow(bore_m, 4)) / (16 * diameter_m);
}

ArrayXd signed_ring_stress_Pa(const Eigen::Array2Xd& shear_Pa) {
  Index largest = 0;
  const double most = shear_Pa.matrix().colwise().stableNorm().maxCoeff(&largest);
  if (!(most > 0)) return ArrayXd::Zero(shear_Pa.cols());
  const Eigen::Array2d direction = shear_Pa.col(largest) / most;
  return (shear_Pa.colwise() * direction).colwise().sum().transpose();
}

std::vector<ElementTorsion> element_torsion(const BodyAnalysis& analysis,
                                            const kinetics::LoadHistory& loads) {
  std::vector<ElementTorsion> elements;
  const auto* shaft = analysis.scene.shaft();
  if (!analysis.diagrams || shaft == nullptr) return elements;
  const auto ports = kind_of(analysis.scene).element_ports(analysis.scene);
  std::vector<double> middles_m;
  for (const auto& at : ports) {
    const auto* port = port_of(analysis.mesh, at.port);
    middles_m.push_back(port != nullptr ? (port->begin_m + port->end_m) / 2 : 0);
  }
  for (std::size_t e = 0; e < ports.size(); ++e) {
    const auto* port = port_of(analysis.mesh, ports[e].port);
    if (port == nullptr) continue;
    ElementTorsion element{ports[e].element, ports[e].port, {}, {}, 0, {}, {}};
    element.torque_Nm = loads.resultant(ports[e].role).total.row(2).transpose();
    const auto& sections = analysis.diagrams->sections;
    element.by_stress_Nm =
        torque_beside(sections, port->begin_m, true) - torque_beside(sections, port->end_m, false);
    element.largest_difference_Nm = (element.by_stress_Nm - element.torque_Nm).abs().maxCoeff();
    element.nominal_Pa =
        element.torque_Nm / least_modulus_m3(shaft->geometry, (port->begin_m + port->end_m) / 2);
    element.largest = largest_near(analysis, middles_m, e);
    elements.push_back(std::move(element));
  }
  return elements;
}

}  // namespace pipelines

#include "pipelines/judge/stages/shaft_torsion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipelines/base/common/constants.h"
#include "pipelines/judge/estimates/time_sampling.h"
#include "pipelines/loads/channels/load_figures.h"
#include "pipelines/loads/stage/load_maker.h"

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

/// The last section before a place, or the first one after it; none beyond the shaft's end.
std::optional<std::size_t> section_beside(const std::vector<SectionResult>& sections, double z_m,
                                          bool before) {
  const double tolerance_m = same_place * (sections.back().plane.z_m - sections.front().plane.z_m);
  std::optional<std::size_t> found;
  for (std::size_t s = 0; s < sections.size(); ++s) {
    const double z = sections[s].plane.z_m;
    if (before && z <= z_m + tolerance_m) found = s;
    if (!before && !found && z >= z_m - tolerance_m) found = s;
  }
  return found;
}

/// Torque of the stress field by which it changes from one side of a port to the other, under values of the
/// channels.
ArrayXd torque_by_stress_Nm(const Judged& analysis, const meshes::Port& port, const Eigen::ArrayXXd& values) {
  const auto& responses = analysis.responses;
  const auto& sections = analysis.diagrams->sections;
  const auto n_channels = responses.channels.size();
  Eigen::RowVectorXd unit = Eigen::RowVectorXd::Zero(Index(n_channels));
  const auto add = [&](const std::optional<std::size_t>& section, double sign) {
    if (!section) return;
    for (std::size_t k = 0; k < n_channels; ++k)
      unit[Index(k)] += sign * responses.sections[*section * n_channels + k].resultant[5];
  };
  add(section_beside(sections, port.begin_m, true), 1);
  add(section_beside(sections, port.end_m, false), -1);
  return (unit * values.matrix()).transpose().array();
}

Course torque_course(const kinetics::CourseFigures& of) {
  return {of.mean, (of.largest - of.least) / 2, std::max(of.largest, -of.least)};
}

/// The least section modulus of the segments that a place lies in: at a shoulder there are two.
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

RingTorsion ring_torsion(const Judged& analysis, std::size_t index, const BetweenInstants& between) {
  const auto& diagrams = *analysis.diagrams;
  RingTorsion result;
  result.ring = diagrams.rings[index];
  const auto& history = analysis.loads.history;
  const double z = result.ring.z_m;
  const auto& geometry = analysis.scene.shaft()->geometry;
  const double modulus_m3 = least_modulus_m3(geometry, z);
  const auto& section = nearest_section(diagrams.sections, z);
  // One direction for the instants and all between them.
  const Index n = history.values.cols(), m = between.values.cols();
  Eigen::Array2Xd shear_Pa(2, n + m);
  shear_Pa.leftCols(n) = ring_shear_Pa(history, analysis.responses, index);
  ArrayXd torque_Nm(n + m);
  torque_Nm.head(n) = section.by_statics.row(5).transpose();
  if (m > 0) {
    shear_Pa.rightCols(m) = ring_shear_Pa(between.values, analysis.responses, index);
    ChannelHistory denser;
    denser.channels = history.channels;
    denser.values = between.values;
    torque_Nm.tail(m) = statics_over_the_cycle(analysis.loads.unit_loads, denser, geometry,
                                               analysis.scene.material.density_kg_m3, section.plane.z_m)
                            .row(5)
                            .transpose();
  }
  const ArrayXd stress_Pa = signed_ring_stress_Pa(shear_Pa);
  const ArrayXd nominal_Pa = torque_Nm.abs() / modulus_m3 * stress_Pa.sign();
  result.stress_Pa = stress_Pa.head(n);
  result.nominal_Pa = nominal_Pa.head(n);
  result.stress = course_of(result.stress_Pa, stress_Pa.tail(m), between.is_whole);
  result.nominal = course_of(result.nominal_Pa, nominal_Pa.tail(m), between.is_whole);
  Index largest = 0;
  const double most_Pa = stress_Pa.abs().maxCoeff(&largest), nominal = std::abs(nominal_Pa[largest]);
  if (nominal > 0) result.factor = most_Pa / nominal;
  return result;
}

/// The ring stressed most of those that are nearer to the middle of this port than to that of any other.
std::optional<RingTorsion> largest_near(const Judged& analysis, const std::vector<double>& middles_m,
                                        std::size_t port, const BetweenInstants& between) {
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
  return ring_torsion(analysis, largest, between);
}

/// Nodes of a feature's faces at a ring's height.
std::vector<std::size_t> nodes_at(const Responded& analysis, const TorsionRing& ring) {
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

/// What the largest stress of the ring between the instants may exceed max_Pa by.
double sampling_error_of_Pa(const Responded& analysis, const TorsionRing& ring) {
  const auto* shear_Pa = shear_of(analysis.responses, ring);
  if (shear_Pa == nullptr) return 0;
  std::vector<std::array<double, 6>> unit;
  for (std::size_t k = 0; k < analysis.responses.channels.size(); ++k)
    unit.push_back({0, 0, 0, shear_Pa[k][0], shear_Pa[k][1], 0});
  const auto& history = analysis.loads.history;
  const double error_Pa = ring.denser_instant >= 0 ? time_sampling(unit, history.passed_over).error_Pa()
                                                   : sampling_error_Pa(unit, history);
  return error_Pa / std::sqrt(3);
}

/// At the node of the ring's height that twist stresses most.
std::optional<double> error_of_twist_Pa(const Superposed& analysis, const TorsionRing& ring) {
  constexpr double least_share = 0.05;  // of a channel's stress: all shear by torsion has 0.58, bending 0.00
  const auto& responses = analysis.responses;
  const auto n_channels = responses.channels.size();
  const auto nodes = nodes_at(analysis, ring);
  const auto* shear_Pa = shear_of(responses, ring);
  if (shear_Pa == nullptr || nodes.empty()) return std::nullopt;
  const auto& history = analysis.loads.history;
  ArrayXd factors = ring.denser_instant >= 0 ? history.passed_over.col(ring.denser_instant)
                                             : history.values.col(ring.instant);
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
double rounding_Pa(const Judged& analysis) {
  constexpr double share = 2.5e-8;
  return share * analysis.peak.value_Pa;
}

/// For want of a finer mesh.
double mesh_error_Pa(const Judged& analysis, const TorsionRing& ring) {
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

double ring_error_Pa(const Judged& analysis, const TorsionRing& ring) {
  return mesh_error_Pa(analysis, ring) + sampling_error_of_Pa(analysis, ring) + rounding_Pa(analysis);
}

std::optional<LargestTorsion> largest_torsion(const Judged& analysis) {
  const auto* ring = analysis.diagrams ? largest_torsion_ring(*analysis.diagrams) : nullptr;
  if (ring == nullptr) return std::nullopt;
  return LargestTorsion{ring->max_Pa, ring_error_Pa(analysis, *ring)};
}

bool is_rounding(const Judged& analysis, const TorsionRing& ring) {
  return ring.max_Pa <= rounding_Pa(analysis);
}

void take_torsion_by_harmonics(const Judged& before, Judged& after) {
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

Course course_of(const ArrayXd& values, const ArrayXd& between, bool is_whole) {
  if (between.size() == 0) return course_of(values);
  if (is_whole) return course_of(between);
  ArrayXd both(values.size() + between.size());
  both << values, between;
  Course course = course_of(both);
  course.mean = values.size() > 0 ? values.mean() : 0;
  return course;
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

std::vector<ElementTorsion> element_torsion(const Judged& analysis, const kinetics::LoadHistory& loads,
                                            const std::vector<kinetics::CourseFigures>& course) {
  std::vector<ElementTorsion> elements;
  const auto* shaft = analysis.scene.shaft();
  if (!analysis.diagrams || shaft == nullptr) return elements;
  const auto ports = load_maker_of(analysis.scene).element_ports(analysis.scene);
  if (ports.empty()) return elements;
  const auto between = between_instants(analysis.loads.history);
  std::vector<double> middles_m;
  for (const auto& at : ports) {
    const auto* port = port_of(analysis.mesh, at.port);
    middles_m.push_back(port != nullptr ? (port->begin_m + port->end_m) / 2 : 0);
  }
  for (std::size_t e = 0; e < ports.size(); ++e) {
    const auto* port = port_of(analysis.mesh, ports[e].port);
    if (port == nullptr) continue;
    ElementTorsion element;
    element.element = ports[e].element;
    element.port = ports[e].port;
    element.torque_Nm = loads.resultant(ports[e].role).total.row(2).transpose();
    element.by_stress_Nm = torque_by_stress_Nm(analysis, *port, analysis.loads.history.values);
    element.largest_difference_Nm = (element.by_stress_Nm - element.torque_Nm).abs().maxCoeff();
    const double modulus_m3 = least_modulus_m3(shaft->geometry, (port->begin_m + port->end_m) / 2);
    element.nominal_Pa = element.torque_Nm / modulus_m3;
    element.torque = course_of(element.torque_Nm);
    if (const auto* of = find_course(course, ports[e].role + ".torque")) element.torque = torque_course(*of);
    element.by_stress = course_of(element.by_stress_Nm, torque_by_stress_Nm(analysis, *port, between.values),
                                  between.is_whole);
    element.nominal = {element.torque.mean / modulus_m3, element.torque.amplitude / modulus_m3,
                       element.torque.largest / modulus_m3};
    element.largest = largest_near(analysis, middles_m, e, between);
    elements.push_back(std::move(element));
  }
  return elements;
}

}  // namespace pipelines

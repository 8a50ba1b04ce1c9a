#include "pipelines/analysis/shaft_torsion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipelines/common/constants.h"
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

}  // namespace

double ring_error_Pa(const BodyAnalysis& analysis, const TorsionRing& ring) {
  for (const auto& place : analysis.place_stresses)
    if (place.feature == ring.feature) return place.error_Pa / std::sqrt(3);
  return std::numeric_limits<double>::infinity();
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

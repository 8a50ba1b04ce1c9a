#include "pipelines/judge/stages/start_up_stress.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipelines/judge/stages/place_errors.h"
#include "pipelines/judge/stages/shaft_torsion.h"
#include "pipelines/loads/stage/load_maker.h"
#include "pipelines/superpose/envelope/finite_stress.h"
#include "pipelines/superpose/envelope/stress_shares.h"

namespace pipelines {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

void add_peak(const Judged& analysis, const BodyLoads& loads, int n_threads, StartUpStress& result) {
  const auto envelope = pipelines::envelope(loads.history, analysis.responses, n_threads);
  require_finite(analysis.scene.name, envelope);
  const auto node = peak_node(envelope.von_mises.value_Pa, analysis.places);
  const auto& maximum = envelope.von_mises;
  result.von_mises = {maximum.value_Pa[node], result.time_s[maximum.instant[node]], analysis.peak.value_Pa};
  result.feature = feature_at(analysis.responses.nodes, analysis.places, node);
  result.place = analysis.places.place[node];
  std::copy_n(&analysis.responses.nodes.xyz_m[3 * node], 3, result.position_m.begin());
  result.safety = analysis.scene.yield_strength_Pa / result.von_mises.largest;
  result.error_share = error_share_at(analysis, result.feature, node, loads.history, maximum.instant[node]);
  result.effects = loads.history.effects;
  result.effect_share =
      shares_of_stress(unit_stresses_at(analysis.responses, node), loads.history, maximum.instant[node])
          .effects;
}

std::optional<StartUpRing> largest_ring(const Judged& analysis, const BodyLoads& loads,
                                        const ArrayXd& time_s) {
  if (!analysis.diagrams) return std::nullopt;
  const auto rings = torsion_rings(loads, analysis.responses, analysis.mesh);
  const auto largest = std::max_element(rings.begin(), rings.end(),
                                        [](const auto& a, const auto& b) { return a.max_Pa < b.max_Pa; });
  if (largest == rings.end() || !(largest->max_Pa > 0)) return std::nullopt;
  StartUpRing ring{largest->feature, largest->z_m, {}, {}};
  ring.stress_Pa = signed_ring_stress_Pa(
      ring_shear_Pa(loads.history, analysis.responses, std::size_t(largest - rings.begin())));
  const auto* steady = largest_torsion_ring(*analysis.diagrams);
  ring.stress = {largest->max_Pa, time_s[largest->instant], steady != nullptr ? steady->max_Pa : 0};
  return ring;
}

}  // namespace

double StartUpFigure::factor() const {
  return steady > 0 ? std::abs(largest) / steady : 0;
}

StartUpStress start_up_stress(const Judged& analysis, const StartUp& start,
                              const kinetics::LoadHistory& steady, int n_threads) {
  const auto& loads = *std::find_if(start.bodies.begin(), start.bodies.end(), [&](const auto& body) {
    return body.history.body == analysis.scene.name;
  });
  StartUpStress result;
  result.time_s = start.loads.time_s;
  result.drive_angle_rad = start.loads.phi_rad;
  result.drive_speed_rad_s = start.loads.speed_rad_s;
  add_peak(analysis, loads, n_threads, result);
  result.ring = largest_ring(analysis, loads, result.time_s);
  for (const auto& at : load_maker_of(analysis.scene).element_ports(analysis.scene)) {
    StartUpElement element{at.element, at.port, start.loads.resultant(at.role).total.row(2).transpose(), {}};
    Index largest = 0;
    element.torque_Nm.abs().maxCoeff(&largest);
    element.torque = {element.torque_Nm[largest], result.time_s[largest],
                      steady.resultant(at.role).total.row(2).abs().maxCoeff()};
    result.elements.push_back(std::move(element));
  }
  return result;
}

}  // namespace pipelines

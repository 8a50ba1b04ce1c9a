#include "pipelines/judge/stages/place_errors.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/base/common/deadline.h"
#include "fem/refine/submodel/submodel.h"
#include "pipelines/base/common/constants.h"
#include "pipelines/judge/analysis/exclusion_border.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/analysis/load_patch.h"
#include "pipelines/judge/estimates/fineness.h"
#include "pipelines/judge/estimates/fitted.h"
#include "pipelines/judge/estimates/solved_pressure.h"
#include "pipelines/judge/estimates/submodels.h"

namespace pipelines {
namespace {

bool is_bore(const meshes::BodyMesh& mesh, const std::string& feature) {
  return std::any_of(mesh.features.begin(), mesh.features.end(), [&](const auto& known) {
    return known.name == feature && known.kind == meshes::Feature::Kind::bore;
  });
}

bool is_of_blocks(const Responded& analysis) {
  return analysis.scene.shaft() != nullptr && !analysis.responses.nodes.shape().is_tetrahedron();
}

/// Relative error of a fillet's stress with so many cells on its quarter. Cells that were cut amid larger
/// ones say less than an even mesh.
double for_want_of_cells(const Responded& analysis, int cells) {
  if (cells < 4) return fitted::below_4_cells;
  if (cells >= 6) return fitted::from_6_cells;
  return analysis.scene.refinements.empty() ? fitted::below_6_cells : fitted::below_6_cells_refined;
}

/// Relative error of the stress on the border of what is left out around a sharp edge, by cells_to_border:
/// cells that touch the edge disturb those beside them.
double for_want_of_cells_to_border(double cells, bool of_tetrahedra) {
  const double decay = std::pow(cells, fitted::border_order);
  return of_tetrahedra
             ? std::min(fitted::border_within_first_tetrahedron, fitted::border_of_one_tetrahedron / decay)
             : fitted::border_of_one_block / decay;
}

double geometry_share_at(const StressPoint& point, const Responded& analysis) {
  const auto& nodes = analysis.responses.nodes;
  return geometry_share(analysis.geometry_error, nodes, point) +
         straight_edge_share(analysis.mesh.straight_edges, nodes, point);
}

double own_error_Pa(const Superposed& analysis, const StressPoint& point) {
  const auto entry = discretisation_estimate(point, analysis.responses, analysis.loads.history,
                                             analysis.scene.material, analysis.places.excluded);
  return entry ? entry->value_Pa : 0;
}

/// Bodies of tetrahedra: every place that, as far as single cells tell, may exceed the largest value is
/// looked at by a submodel, as long as there is time. Beside a spring or a clamp, which holds the submodel's
/// displacement, single cells have the word.
void ask_submodels(const Superposed& analysis, double largest_Pa, double seconds,
                   std::vector<PlaceStress>& places) {
  const auto& responses = analysis.responses;
  if (seconds == 0 || responses.nodes.n_cells() == 0 || !responses.nodes.shape().is_tetrahedron()) return;
  const auto body = to_fem_body(analysis.mesh, analysis.scene.material);
  std::vector<PlaceStress*> may_lead;
  const auto left_out = [&](const std::array<double, 3>& point_m, int boundary_id) {
    return is_left_out(point_m, boundary_id, analysis.mesh.sharp_edges);
  };
  for (auto& place : places)
    if (place.value_Pa + place.error_Pa >= largest_Pa &&
        !fem::is_beside_support(responses, body, {{place.node}}))
      may_lead.push_back(&place);
  std::stable_sort(may_lead.begin(), may_lead.end(), [](const auto* a, const auto* b) {
    return a->value_Pa + a->error_Pa > b->value_Pa + b->error_Pa;
  });
  const fem::Deadline deadline(seconds);
  auto next = may_lead.begin();
  try {
    for (; next != may_lead.end(); ++next) {
      auto& place = **next;
      const double error_Pa =
          submodel_error_Pa({{{place.node, 1.0}}, analysis.envelope.von_mises.instant[place.node]}, responses,
                            body, analysis.loads, left_out);
      place.error_Pa = std::max(error_Pa, place.least_error_Pa);
      place.is_resolved = true;
    }
  } catch (const fem::OutOfTime&) {
    std::for_each(next, may_lead.end(), [](auto* place) { place->error_Pa *= fitted::unasked_safety; });
  }
}

/// What single cells tell of the error of a stress at a node of a feature [Pa], and what few cells on its
/// fillet's quarter, or through the wall of its bore, leave open; none where no cells were solved.
/// @param instant  column of `loads`
std::optional<double> error_by_cells_Pa(const Superposed& analysis, const std::string& feature,
                                        std::size_t node, const ChannelHistory& loads, std::int32_t instant) {
  const StressPoint point{{{node, 1.0}}, instant};
  const auto entry = discretisation_estimate(point, analysis.responses, loads, analysis.scene.material,
                                             analysis.places.excluded);
  if (!entry) return std::nullopt;
  const double safety =
      is_of_blocks(analysis) && is_bore(analysis.mesh, feature) ? fitted::safety_of_few_rows : 1;
  const int cells = cells_on_quarter(analysis, {feature, node});
  if (cells == 0) return safety * entry->value_Pa;
  const double value_Pa = von_mises_of(unit_stress_at(analysis.responses, point), loads.values.col(instant));
  return std::max(safety * entry->value_Pa, for_want_of_cells(analysis, cells) * value_Pa);
}

/// The same, relative, at most 1; 0 where nothing is stressed.
double own_share(const Superposed& analysis, const std::string& feature, std::size_t node,
                 const ChannelHistory& loads, std::int32_t instant) {
  const auto unit = unit_stress_at(analysis.responses, {{{node, 1.0}}, instant});
  const double value_Pa = von_mises_of(unit, loads.values.col(instant));
  const auto error_Pa = error_by_cells_Pa(analysis, feature, node, loads, instant);
  return error_Pa && value_Pa > 0 ? std::min(1.0, *error_Pa / value_Pa) : 0;
}

/// What harmonics of pressures that were left out may bring to half a change of the loads [Pa]: of each port
/// what they may bring to the stress, by the share of its loads that change.
double tail_of_change_Pa(const Responded& analysis, const std::vector<std::array<double, 6>>& unit,
                         const Eigen::ArrayXXd& half_change) {
  double sum_Pa = 0;
  for (const auto& [port, pressure] : solved_pressures(analysis.loads))
    sum_Pa +=
        share_of_loads(analysis.loads, port, half_change) *
        harmonics_from_Pa({pressure, unit}, pressure.model.pattern, pressure.model.highest_harmonic + 1);
  return sum_Pa;
}

const PlaceStress* judged_place(const Judged& analysis, const std::string& feature) {
  for (const auto& place : analysis.place_stresses)
    if (place.feature == feature) return &place;
  return nullptr;
}

std::vector<PlaceStress> weld_toes(const Judged& analysis) {
  std::vector<PlaceStress> places;
  for (const auto& spot : analysis.hot_spots) {
    const double own_Pa = own_error_Pa(analysis, stress_point(spot));
    const bool is_coarse = spot.face_walls > fitted::longest_face_walls;
    const double error_Pa = spot.resolved || is_coarse
                                ? own_Pa
                                : std::min(own_Pa, fitted::largest_error_of_toes * spot.von_mises_Pa);
    places.push_back({spot.name, spot.near_node, spot.von_mises_Pa, error_Pa, spot.toe_m,
                      spot.resolved != nullptr, is_coarse ? own_Pa : 0});
  }
  return places;
}

std::vector<PlaceStress> without_weld_toes(const Judged& analysis, const std::vector<PlaceStress>& judged) {
  std::vector<PlaceStress> others;
  for (const auto& place : judged)
    if (std::none_of(analysis.hot_spots.begin(), analysis.hot_spots.end(),
                     [&](const auto& spot) { return spot.name == place.feature; }))
      others.push_back(place);
  return others;
}

/// What places tell of the largest stress of all of them.
void enter(ErrorBudget& errors, const std::vector<PlaceStress>& judged, const std::string& method) {
  const auto judgement = judge(judged);
  errors.set_numerical({"discretisation", method, judged[judgement.governing].error_Pa});
  errors.set_numerical({"other_places",
                        judgement.other_place.empty()
                            ? "no other place exceeds it, with its own error"
                            : fmt::format("{} with its own error exceeds it by that", judgement.other_place),
                        judgement.other_places_Pa});
}

/// The largest angle that a face at the node takes of the fillet's quarter circle; 0: no face of it is there.
double arc_at(const Responded& analysis, const meshes::TorusChart& torus, std::size_t node) {
  const auto& nodes = analysis.responses.nodes;
  double largest_rad = 0;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto face = nodes.face(f);
    if (nodes.face_boundary_id[f] != torus.boundary_id ||
        std::find(face.begin(), face.end(), std::int32_t(node)) == face.end())
      continue;
    const auto angle_rad = [&](std::size_t corner) {
      const double* x = &nodes.xyz_m[3 * std::size_t(face[corner])];
      return std::atan2(x[2] - torus.centre_z_m, std::hypot(x[0], x[1]) - torus.centre_radius_m);
    };
    for (std::size_t a = 0; a < std::size_t(nodes.shape().n_face_corners()); ++a)
      for (std::size_t b = 0; b < a; ++b)
        largest_rad = std::max(largest_rad, std::abs(std::remainder(angle_rad(a) - angle_rad(b), 2 * pi)));
  }
  return largest_rad;
}

/// Cells on a fillet's quarter before any was cut; 0: the feature is no fillet.
int cells_meshed(const BodyScene& body, const std::string& feature) {
  const auto names = fillets_of(body);
  const auto fillet = std::find(names.begin(), names.end(), feature);
  return fillet == names.end() ? 0 : body.shaft()->mesh.cells_at(int(fillet - names.begin()));
}

}  // namespace

int cells_on_quarter(const Responded& analysis, const PlaceStress& place) {
  const int meshed = cells_meshed(analysis.scene, place.feature);
  if (meshed == 0) return 0;
  if (!analysis.scene.refinements.empty())
    for (const auto& feature : analysis.mesh.features)
      for (const auto& torus : analysis.mesh.tori)
        if (feature.name == place.feature && torus.boundary_id == feature.boundary_id)
          if (const double arc_rad = arc_at(analysis, torus, place.node); arc_rad > 0)
            return std::max(1, int(std::lround(pi / 2 / arc_rad)));
  return meshed;
}

std::vector<PlaceStress> places_of_one_mesh(const Judged& analysis, double submodels_s) {
  const auto& maximum = analysis.envelope.von_mises;
  auto places =
      largest_by_feature(analysis.responses.nodes, maximum.value_Pa, analysis.mesh.features, analysis.places);
  const double largest_Pa = governing_stress(analysis).value_Pa;
  const bool of_blocks = is_of_blocks(analysis),
             of_tetrahedra = analysis.responses.nodes.shape().is_tetrahedron();
  for (auto& place : places) {
    if (place.value_Pa < share_worth_a_look * largest_Pa) {
      place.error_Pa = place.value_Pa;
      continue;
    }
    place.error_Pa = own_error_Pa(analysis, {{{place.node, 1.0}}, maximum.instant[place.node]});
    if (const int cells = cells_on_quarter(analysis, place); cells > 0) {
      const double wanting_Pa = for_want_of_cells(analysis, cells) * place.value_Pa;
      place.error_Pa = std::max(place.error_Pa, wanting_Pa);
      if (cells < fitted::cells_that_converge) place.least_error_Pa = wanting_Pa;
      place.has_fine_cells = cells_meshed(analysis.scene, place.feature) >= fitted::cells_that_converge;
    } else if (of_blocks && is_bore(analysis.mesh, place.feature)) {
      place.error_Pa *= fitted::safety_of_few_rows;
    }
    if (const double cells = of_blocks || of_tetrahedra ? cells_to_border(analysis, place) : 0; cells > 0) {
      const double wanting_Pa = for_want_of_cells_to_border(cells, of_tetrahedra) * place.value_Pa;
      place.error_Pa = std::max(place.error_Pa, wanting_Pa);
      place.least_error_Pa = std::max(place.least_error_Pa, wanting_Pa);
    }
    const double rise_Pa = rise_to_border_Pa(analysis, place);
    place.error_Pa += rise_Pa;
    place.least_error_Pa = std::max(place.least_error_Pa, rise_Pa);
  }
  ask_submodels(analysis, largest_Pa, submodels_s, places);
  const auto toes = weld_toes(analysis);
  places.insert(places.end(), toes.begin(), toes.end());
  return places;
}

void take_place_errors(Judged& analysis, const std::vector<PlaceStress>& judged, const std::string& method) {
  if (judged.empty()) return;
  auto& errors = errors_of_governing(analysis);
  enter(errors, judged, method);
  const bool toe_governs = &errors != &analysis.peak.errors;
  if (const auto others = without_weld_toes(analysis, judged); toe_governs && !others.empty())
    enter(analysis.peak.errors, others, method);
  analysis.place_stresses = judged;
  take_zone_errors(analysis);
}

double error_share_at(const Judged& analysis, const std::string& feature, std::size_t node,
                      const ChannelHistory& loads, std::int32_t instant) {
  const auto* place = judged_place(analysis, feature);
  if (place == nullptr) return std::numeric_limits<double>::infinity();
  if (!(place->value_Pa > 0)) return 0;
  const double judged = place->error_Pa / place->value_Pa;
  if (node == place->node) return judged;
  const double there = own_share(analysis, feature, node, loads, instant);
  const double here = own_share(analysis, feature, place->node, analysis.loads.history,
                                analysis.envelope.von_mises.instant[place->node]);
  constexpr double weight_of_search = 0.25;
  return std::max(judged,
                  here > 0 ? std::min(there, std::pow(judged / here, weight_of_search) * there) : there);
}

double error_share_at(const Judged& analysis, const std::string& feature, std::size_t node) {
  if (judged_place(analysis, feature) == nullptr) return std::numeric_limits<double>::infinity();
  return error_share_at(analysis, feature, node, analysis.loads.history,
                        analysis.envelope.von_mises.instant[node]);
}

double error_share_of_change(const Judged& analysis, const std::string& feature, std::size_t node,
                             const BodyLoads& change) {
  const double judged = error_share_at(analysis, feature, node);
  if (!std::isfinite(judged)) return judged;
  const StressPoint point{{{node, 1.0}}, 0};
  const auto unit = unit_stress_at(analysis.responses, point);
  const Eigen::ArrayXd factors = change.history.values.col(0),
                       largest = analysis.loads.history.values.col(analysis.envelope.von_mises.instant[node]);
  const double value_Pa = von_mises_of(unit, factors), largest_Pa = von_mises_of(unit, largest);
  if (!(value_Pa > 0) || !(largest_Pa > 0)) return judged;

  double share = judged;
  const auto estimate_Pa = [&](const Eigen::ArrayXd& of) {
    ChannelHistory history;
    history.values = of;
    return error_by_cells_Pa(analysis, feature, node, history, 0);
  };
  if (const auto own_Pa = estimate_Pa(factors)) {
    // The product of both tensors by the norms of their sum and difference.
    const double along = (std::pow(von_mises_of(unit, factors + largest), 2) -
                          std::pow(von_mises_of(unit, factors - largest), 2)) /
                         (4 * largest_Pa * largest_Pa);
    const double rest_Pa = estimate_Pa(factors - along * largest).value_or(0);
    share = std::max(judged, std::min({1.0, *own_Pa / value_Pa,
                                       (judged * std::abs(along) * largest_Pa + rest_Pa) / value_Pa}));
  }
  const auto others = self_estimate(point, analysis.responses, change, analysis.scene.material,
                                    geometry_share_at(point, analysis), analysis.places.excluded);
  for (const auto& entry : others.numerical)
    if (entry.source != "discretisation" && entry.source != "time_sampling" &&
        entry.source != "pressure_harmonics")
      share += entry.value_Pa / value_Pa;
  return share + tail_of_change_Pa(analysis, unit, change.history.values) / value_Pa;
}

double whole_error_share_of_change(const Judged& analysis, const std::string& feature, std::size_t node,
                                   const BodyLoads& change, double unresolved_share) {
  const double own = error_share_of_change(analysis, feature, node, change),
               stated = stated_error_share(analysis, feature);
  if (!std::isfinite(own)) return stated > 0 ? stated + unresolved_share : own;
  const StressPoint point{{{node, 1.0}}, 0};
  const double value_Pa =
      von_mises_of(unit_stress_at(analysis.responses, point), change.history.values.col(0));
  const double patches =
      value_Pa > 0 ? load_patch_error_Pa(analysis, point, change.history.values) / value_Pa : 0;
  return std::max(own + unresolved_share + patches + model_error_share(analysis, feature, node), stated);
}

ErrorBudget errors_at(const StressPoint& point, const Superposed& analysis) {
  return self_estimate(point, analysis.responses, analysis.loads, analysis.scene.material,
                       geometry_share_at(point, analysis), analysis.places.excluded);
}

void take_zone_errors(Judged& analysis) {
  auto& zones = analysis.zones.zones;
  for (std::size_t i = 0; i < zones.size(); ++i) {
    auto& zone = zones[i];
    const auto* place = judged_place(analysis, zone.feature);
    if (place == nullptr || !(place->value_Pa > 0)) continue;
    const double error_Pa = zone.peak_Pa * error_share_at(analysis, zone.feature, zone.peak_node,
                                                          analysis.loads.history, zone.instant);
    zone.error_Pa = error_Pa;
    if (i >= n_zones_shown) continue;
    auto errors = errors_at({{{zone.peak_node, 1.0}}, zone.instant}, analysis);
    errors.set_numerical({"discretisation", "as judged of its place", error_Pa});
    zone.error_Pa = errors.numerical_Pa();
  }
}

}  // namespace pipelines

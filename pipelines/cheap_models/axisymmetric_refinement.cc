#include "pipelines/cheap_models/axisymmetric_refinement.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <stdexcept>

#include "fem/axisymmetric/axisymmetric_responses.h"
#include "pipelines/analysis/exclusion_border.h"
#include "pipelines/body_stages/respond.h"
#include "pipelines/cheap_models/axisymmetric_body.h"
#include "pipelines/cheap_models/axisymmetric_run.h"
#include "pipelines/common/errors.h"
#include "pipelines/scene_reader/why_not.h"

namespace pipelines {
namespace {

/// Cells of the first step: three on a fillet's quarter; a quarter of the radius at the ends of loaded seats
/// and of the exclusion distance at sharp edges.
constexpr double size_on_fillet = 0.5, size_at_seat = 0.25, size_at_sharp_edge = 0.25;
constexpr double size_of_more = 0.1;  // of the radius, at the largest stress of a place
constexpr double first_growth = 1.5;  // of cells with the distance from a fine circle
/// The order that a place has shown counts up to that. At a seam, whose nodes belong to the fillet beside it,
/// a place's values creep with less than first order: hence the safety. A last change may be small by chance:
/// of the one before an eighth counts still, what cubic cells leave of it, and of the value this much.
constexpr double largest_order = 2, safety = 1.5, hidden_share = 1.0 / 8, unseen_share = 0.002;

void add(std::vector<fem::FineCircle>& circles, double z_m, double r_m, double size_m) {
  const auto same = std::find_if(circles.begin(), circles.end(), [&](const auto& c) {
    return std::hypot(c.z_m - z_m, c.r_m - r_m) < 1e-3 * size_m;
  });
  if (same == circles.end())
    circles.push_back({z_m, r_m, size_m});
  else
    same->size_m = std::min(same->size_m, size_m);
}

std::set<int> loaded_seats(const BodyLoads& loads) {
  std::set<int> ids;
  const auto enter = [&](const fem::LoadSurface& surface) {
    if (surface.kind == fem::LoadSurface::Kind::seat) ids.insert(surface.boundary_id);
  };
  for (const auto& load : loads.unit_loads)
    if (const auto* resultant = std::get_if<fem::SurfaceResultant>(&load.shape))
      enter(resultant->surface);
    else if (const auto* pressure = std::get_if<fem::SeatPressure>(&load.shape))
      enter(pressure->surface);
  return ids;
}

std::vector<fem::FineCircle> first_circles(const fem::MeridianBody& section, const meshes::BodyMesh& mesh,
                                           const BodyLoads& loads) {
  std::vector<fem::FineCircle> circles;
  const auto at = [&](int point) { return section.points_m[std::size_t(point)]; };
  std::map<int, std::map<int, int>> n_edges;  // of seats, by id and point: one at the ends of a seat
  const auto seats = loaded_seats(loads);
  for (const auto& edge : section.edges) {
    for (const auto& torus : section.tori)
      if (torus.boundary_id == edge.boundary_id)
        for (const int end : edge.ends) add(circles, at(end)[0], at(end)[1], size_on_fillet * torus.radius_m);
    if (seats.count(edge.boundary_id))
      for (const int end : edge.ends) ++n_edges[edge.boundary_id][end];
  }
  for (const auto& [id, points] : n_edges)
    for (const auto& [point, n] : points)
      if (n == 1) add(circles, at(point)[0], at(point)[1], size_at_seat * at(point)[1]);
  for (const auto& edge : mesh.sharp_edges) {
    if (edge.pieces.empty()) continue;
    const auto& p = edge.pieces.front().front();
    add(circles, p[2], std::hypot(p[0], p[1]), size_at_sharp_edge * edge.distance_m);
  }
  return circles;
}

/// What is missing of the last of these values.
double missing_Pa(const std::vector<double>& values) {
  const std::size_t n = values.size();
  if (n < 2) return values.back();
  const double last = std::abs(values[n - 1] - values[n - 2]);
  if (n < 3) return std::max(safety * last, unseen_share * values.back());
  const double before = std::abs(values[n - 2] - values[n - 3]);
  const double order = last > 0 ? std::clamp(std::log2(before / last), 1.0, largest_order) : largest_order;
  return std::max(safety * last / (std::exp2(order) - 1), hidden_share * before);
}

/// Of torsional stress on one section alone: largest error of 53 twisted shafts 0.31 %, but for what lies
/// between rings.
constexpr double error_of_one_section = 0.02;

/// Inside, of a node's value: sections keep their points there. A seat that is tilted had 6.86 MPa at 16 mm
/// from the axis, where the solid had 7.06 at 15 mm.
constexpr double unseen_inside = 0.04;

/// What the parabola through a point of a curve and those before and behind it adds to the point's value;
/// nothing where one of these is higher.
double above_points_Pa(double value_Pa, double before_Pa, double h1, double behind_Pa, double h2) {
  const double slope_1 = (before_Pa - value_Pa) / h1, slope_2 = (behind_Pa - value_Pa) / h2;
  if (slope_1 > 0 || slope_2 > 0) return 0;  // the place ends here: what is higher belongs to the next one
  const double curvature = (slope_1 + slope_2) / (h1 + h2);
  const double slope = (slope_2 * h1 - slope_1 * h2) / (h1 + h2);
  return curvature < 0 ? slope * slope / (-4 * curvature) : 0;
}

/// What a parabola through the nodes before and behind it on the half plane's surface adds to a node's value:
/// points of one section are among those of the next, so that a change does not tell of what lies between.
double between_points_Pa(const fem::Nodes& nodes, const std::vector<double>& value_Pa, std::size_t node) {
  std::set<std::int32_t> beside;
  constexpr std::size_t along[4] = {1, 0, 3, 2};  // the other end of a face's edge in the half plane
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto face = nodes.face(f);
    for (std::size_t i = 0; i < 4; ++i)
      if (std::size_t(face[i]) == node) beside.insert(face[along[i]]);
  }
  if (beside.empty()) return unseen_inside * value_Pa[node];
  if (beside.size() != 2) return 0;
  const auto distance_m = [&](std::int32_t other) {
    const double *a = &nodes.xyz_m[3 * node], *b = &nodes.xyz_m[3 * std::size_t(other)];
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  };
  const double h1 = distance_m(*beside.begin()), h2 = distance_m(*beside.rbegin());
  return above_points_Pa(value_Pa[node], value_Pa[std::size_t(*beside.begin())], h1,
                         value_Pa[std::size_t(*beside.rbegin())], h2);
}

/// Of one step: the largest ring of a feature, and what lies between rings, or between them and the border of
/// what is left out: by the parabola through its neighbours, and by TorsionRing::rise_Pa.
struct FeatureTorsion {
  double value_Pa = 0, between_Pa = 0;
};

double distance_m(const TorsionRing& a, const TorsionRing& b) {
  return std::hypot(a.z_m - b.z_m, a.radius_m - b.radius_m);
}

/// The nearest ring of another feature; null: there is none.
const TorsionRing* next_beyond(const std::vector<TorsionRing>& rings, const TorsionRing& end) {
  const TorsionRing* nearest = nullptr;
  for (const auto& ring : rings)
    if (ring.feature != end.feature &&
        (nearest == nullptr || distance_m(ring, end) < distance_m(*nearest, end)))
      nearest = &ring;
  return nearest;
}

/// Rings at seams count to both features, as nodes do.
std::map<std::string, FeatureTorsion> torsion_by_feature(const std::vector<TorsionRing>& rings) {
  std::map<std::string, std::vector<const TorsionRing*>> by_feature;  // ascending z: a bore's are apart
  for (const auto& ring : rings) by_feature[ring.feature].push_back(&ring);
  std::map<std::string, FeatureTorsion> result;
  for (auto& [feature, own] : by_feature) {
    const auto *first = next_beyond(rings, *own.front()), *last = next_beyond(rings, *own.back());
    if (first != nullptr) own.insert(own.begin(), first);
    if (last != nullptr) own.push_back(last);
    const auto largest =
        std::max_element(own.begin(), own.end(), [](auto* a, auto* b) { return a->max_Pa < b->max_Pa; });
    const auto& here = **largest;
    auto& torsion = result[feature];
    torsion.value_Pa = here.max_Pa;
    for (const auto* ring : own)
      torsion.between_Pa = std::max(torsion.between_Pa, ring->max_Pa + ring->rise_Pa - here.max_Pa);
    if (largest == own.begin() || largest + 1 == own.end()) continue;
    const auto &before = **(largest - 1), &behind = **(largest + 1);
    if (before.max_Pa == 0 || behind.max_Pa == 0) continue;  // left out beside a sharp edge
    torsion.between_Pa =
        std::max(torsion.between_Pa, above_points_Pa(here.max_Pa, before.max_Pa, distance_m(before, here),
                                                     behind.max_Pa, distance_m(here, behind)));
  }
  return result;
}

}  // namespace

const PlaceStress& AxisymmetricStep::peak() const {
  return *std::max_element(places.begin(), places.end(),
                           [](const auto& a, const auto& b) { return a.value_Pa < b.value_Pa; });
}

double AxisymmetricStep::peak_error_Pa() const {
  const auto& leading = peak();
  double error_Pa = leading.error_Pa;
  for (const auto& place : places)
    error_Pa = std::max(error_Pa, place.value_Pa + place.error_Pa - leading.value_Pa);
  return error_Pa;
}

AxisymmetricRefinement::AxisymmetricRefinement(const BodyScene& body, const MeshedBody& meshed,
                                               const BodyLoads& loads, int n_threads)
    : meshed_(&meshed), loads_(&loads), n_threads_(threads(n_threads)), section_([&] {
        if (const auto why = why_not_axisymmetric(body); !why.empty())
          throw StageRefused("the " + body.name + " " + why + ": no axisymmetric model");
        return meridian_body(with_coarse_blocks(body), meshed.mesh);
      }()) {
  section_.masses_of_loads = meshed.masses;
  circles_ = first_circles(section_, meshed.mesh, loads);
  for (const auto& plane : meshed.mesh.sections)
    planes_.push_back({plane.z_m, plane.radius_m, plane.axis_x_m, plane.axis_y_m, plane.inner_radius_m});
}

AxisymmetricStep AxisymmetricRefinement::next(StageClock& clock) {
  const auto start = std::chrono::steady_clock::now();
  const double scale = std::exp2(-n_steps_);
  section_.n_cuts = std::min(n_steps_, 1);
  section_.fine_growth = first_growth * scale;
  section_.fine_circles = circles_;
  for (auto& circle : section_.fine_circles) circle.size_m *= scale;
  AxisymmetricStep step;
  step.responses =
      clock.run("solve", [&] { return fem::axisymmetric_responses(section_, loads_->unit_loads, planes_); });
  step.envelope =
      clock.run("superpose", [&] { return envelope(loads_->history, step.responses, n_threads_); });
  clock.run("zones", [&] {
    step.node_places = locate_nodes(step.responses.nodes, meshed_->mesh.features, meshed_->mesh.ports,
                                    meshed_->mesh.sharp_edges);
    step.places = largest_by_feature(step.responses.nodes, step.envelope.von_mises.value_Pa,
                                     meshed_->mesh.features, step.node_places);
  });
  step.fineness = fmt::format("section cut {} times, {} fine circles of {:.3g} mm and more", section_.n_cuts,
                              circles_.size(), [&] {
                                double least = 0;
                                for (const auto& c : section_.fine_circles)
                                  least = least == 0 ? c.size_m : std::min(least, c.size_m);
                                return 1e3 * least;
                              }());
  learn(step);
  learn_torsion(step);
  ++n_steps_;
  add_circles(step);
  step.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return step;
}

void AxisymmetricRefinement::learn(AxisymmetricStep& step) {
  const auto& nodes = step.responses.nodes;
  const auto& von_mises_Pa = step.envelope.von_mises.value_Pa;
  for (auto& place : step.places) {
    auto& values = values_Pa_[place.feature];
    values.push_back(place.value_Pa);
    place.error_Pa = missing_Pa(values) + between_points_Pa(nodes, von_mises_Pa, place.node);
    if (place.feature != inside_the_body)  // has unseen_inside
      place.error_Pa += rise_to_border_Pa({nodes, von_mises_Pa, step.node_places, meshed_->mesh}, place);
  }
}

/// Twist is the harmonic m = 0 alone: bending and what its section is wrong by have no part in it.
void AxisymmetricRefinement::learn_torsion(AxisymmetricStep& step) {
  double own_error_Pa = 0, most_Pa = 0;
  for (const auto& [feature, now] :
       torsion_by_feature(torsion_rings(*loads_, step.responses, meshed_->mesh))) {
    if (now.value_Pa == 0) continue;  // not twisted, or no ring of it is outside what is left out
    auto& values_Pa = torsion_Pa_[feature];
    values_Pa.push_back(now.value_Pa);
    const double error_Pa =
        now.between_Pa + (values_Pa.size() < 2 ? error_of_one_section * now.value_Pa : missing_Pa(values_Pa));
    most_Pa = std::max(most_Pa, now.value_Pa + error_Pa);
    if (now.value_Pa < step.torsion.value_Pa) continue;
    step.torsion.value_Pa = now.value_Pa;
    own_error_Pa = error_Pa;
  }
  step.torsion.error_Pa = std::max(own_error_Pa, most_Pa - step.torsion.value_Pa);
}

/// Where a place could be the largest by its error, its largest stress gets a circle of its own.
void AxisymmetricRefinement::add_circles(const AxisymmetricStep& step) {
  if (n_steps_ < 2) return;
  const auto& leading = step.peak();
  for (const auto& place : step.places) {
    if (place.value_Pa + place.error_Pa < leading.value_Pa) continue;
    const auto& p = place.position_m;
    const double r_m = std::hypot(p[0], p[1]);
    double outside_m = r_m;
    for (const auto& point : section_.points_m) outside_m = std::max(outside_m, point[1]);
    add(circles_, p[2], r_m, size_of_more * (r_m > 0 ? r_m : outside_m));
  }
}

bool AxisymmetricRefinement::is_met(const AxisymmetricStep& step, double target) {
  return step.peak_error_Pa() <= target * step.peak().value_Pa;
}

AxisymmetricStresses axisymmetric_stresses(const BodyScene& body, const MeshedBody& meshed,
                                           const BodyLoads& loads, int n_threads, double target,
                                           std::size_t most_unknowns) {
  MeshedBody own = meshed;
  own.mesh.sections.clear();
  StageClock silent;
  AxisymmetricRefinement refinement(body, own, loads, n_threads);
  auto step = refinement.next(silent);
  for (int i = 1; i < AxisymmetricRefinement::most_steps && !AxisymmetricRefinement::is_met(step, target);
       ++i) {
    if (step.responses.n_dofs > most_unknowns) break;
    step = refinement.next(silent);
  }
  return {std::move(step.places), step.torsion};
}

}  // namespace pipelines

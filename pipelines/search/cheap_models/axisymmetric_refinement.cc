#include "pipelines/search/cheap_models/axisymmetric_refinement.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <stdexcept>

#include "fem/models/axisymmetric/axisymmetric_responses.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/judge/analysis/exclusion_border.h"
#include "pipelines/respond/responses/respond.h"
#include "pipelines/scene/reader/why_not.h"
#include "pipelines/search/cheap_models/axisymmetric_body.h"
#include "pipelines/search/cheap_models/fitted.h"
#include "pipelines/search/cheap_models/nodes_at_maxima.h"
#include "pipelines/search/cheap_models/section_changes.h"
#include "pipelines/search/cheap_models/torsion_by_feature.h"

namespace pipelines {
namespace {

/// Cells of the first step: three on a fillet's quarter; a quarter of the radius at the ends of loaded seats
/// and of the exclusion distance at sharp edges.
constexpr double size_on_fillet = 0.5, size_at_seat = 0.25, size_at_sharp_edge = 0.25;
constexpr double size_of_more = 0.1;  // of the radius, at the largest stress of a place
constexpr double first_growth = 1.5;  // of cells with the distance from a fine circle
/// A fillet's largest stress that is nearer to an end of the arc than this share of the radius may be that of
/// the seat or shoulder there.
constexpr double beside_end = 0.1;

void add(std::vector<fem::FineCircle>& circles, double z_m, double r_m, double size_m) {
  const auto same = std::find_if(circles.begin(), circles.end(), [&](const auto& c) {
    return std::hypot(c.z_m - z_m, c.r_m - r_m) < 1e-3 * size_m;
  });
  if (same == circles.end())
    circles.push_back({z_m, r_m, size_m});
  else
    same->size_m = std::min(same->size_m, size_m);
}

/// Half planes by which the stress at any angle is known: more than twice as many as the highest harmonic.
int angles_for(const BodyLoads& loads, int usual) {
  int highest = 1;
  for (const auto& load : loads.unit_loads)
    if (const auto* pressure = std::get_if<fem::SeatPressure>(&load.shape))
      highest = std::max(highest, pressure->harmonic);
  return std::max(usual, 2 * highest + 2);
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

Surroundings surroundings(const fem::MeridianBody& section, const meshes::BodyMesh& mesh,
                          const PlaceStress& place) {
  const double z_m = place.position_m[2], r_m = std::hypot(place.position_m[0], place.position_m[1]);
  for (const auto& feature : mesh.features)
    for (const auto& torus : section.tori) {
      if (feature.name != place.feature || feature.boundary_id != torus.boundary_id) continue;
      std::map<int, int> n_edges;  // by point: one at the ends of the arc
      for (const auto& edge : section.edges)
        if (edge.boundary_id == torus.boundary_id)
          for (const int end : edge.ends) ++n_edges[end];
      const bool is_at_end = std::any_of(n_edges.begin(), n_edges.end(), [&](const auto& point) {
        const auto& p = section.points_m[std::size_t(point.first)];
        return point.second == 1 && std::hypot(z_m - p[0], r_m - p[1]) <= beside_end * torus.radius_m;
      });
      return is_at_end ? Surroundings::any : Surroundings::inside_fillet;
    }
  return Surroundings::any;
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
  section_.n_angles = angles_for(loads, section_.n_angles);
  circles_ = first_circles(section_, meshed.mesh, loads);
  for (const auto& plane : meshed.mesh.sections)
    planes_.push_back({plane.z_m, plane.radius_m, plane.axis_x_m, plane.axis_y_m, plane.inner_radius_m});
}

AxisymmetricStep AxisymmetricRefinement::next(StageClock& clock) {
  const auto start = std::chrono::steady_clock::now();
  section_.n_cuts = n_steps_;
  section_.fine_growth = first_growth;
  section_.fine_circles = circles_;
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
    move_nodes_to_maxima(loads_->history, meshed_->mesh, section_.n_angles,
                         {step.responses, step.envelope, step.node_places, step.places});
    move_rings_to_maxima(*loads_, meshed_->mesh, step.responses);
  });
  double least_m = 0;  // before all cells are cut
  for (const auto& circle : circles_)
    least_m = least_m == 0 ? circle.size_m : std::min(least_m, circle.size_m);
  step.fineness = fmt::format("section cut {} times, {} fine circles of {:.3g} mm and more", section_.n_cuts,
                              circles_.size(), 1e3 * least_m * std::exp2(-n_steps_));
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
    place.error_Pa = missing_Pa(values, surroundings(section_, meshed_->mesh, place));
    place.error_Pa += place.feature == inside_the_body
                          ? fitted::unseen_inside * place.value_Pa
                          : rise_to_border_Pa({nodes, von_mises_Pa, step.node_places, meshed_->mesh}, place);
  }
}

/// Twist is the harmonic m = 0 alone: bending and what its section is wrong by have no part in it.
void AxisymmetricRefinement::learn_torsion(AxisymmetricStep& step) {
  double own_error_Pa = 0, most_Pa = 0;
  for (const auto& [feature, now] : torsion_by_feature(*loads_, step.responses, meshed_->mesh)) {
    if (now.value_Pa == 0) continue;  // not twisted, or no ring of it is outside what is left out
    auto& values_Pa = torsion_Pa_[feature];
    values_Pa.push_back(now.value_Pa);
    const double error_Pa = now.rise_Pa + (values_Pa.size() < 2 ? fitted::error_of_one_section * now.value_Pa
                                                                : missing_Pa(values_Pa, Surroundings::any));
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

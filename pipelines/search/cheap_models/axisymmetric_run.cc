#include "pipelines/search/cheap_models/axisymmetric_run.h"
#include "pipelines/judge/analysis/error_text.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "fem/beam/beam_responses.h"
#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/stage_clock.h"
#include "pipelines/judge/estimates/in_time.h"
#include "pipelines/judge/stages/place_errors.h"
#include "pipelines/judge/stages/respond.h"
#include "pipelines/judge/stages/superpose_body.h"
#include "pipelines/search/cheap_models/axisymmetric_body.h"
#include "pipelines/search/cheap_models/axisymmetric_refinement.h"
#include "pipelines/search/cheap_models/cheap_responses.h"

namespace pipelines {
namespace {

/// Of the discretisation: half of a tolerance, and without one what a second buys.
constexpr double share_of_tolerance = 0.5, usual_target = 0.01;

SearchStep record(const Scene& scene, const BodyScene& body, const AxisymmetricStep& step) {
  SearchStep entry;
  entry.fineness = step.fineness;
  entry.instants_per_turn = scene.sampling.instants_per_turn;
  entry.pressure_harmonics = body.pressure_harmonics;
  entry.n_dofs = step.responses.n_dofs;
  entry.value_Pa = step.peak().value_Pa;
  entry.errors.set_numerical({"discretisation", "change from the coarser section", step.peak_error_Pa()});
  const auto& principal = step.envelope.principal.value_Pa;
  entry.principal_Pa = principal[peak_node(principal, step.node_places)];
  entry.seconds = step.seconds;
  entry.gigabytes = peak_memory_gigabytes();
  return entry;
}

/// Bending by axial force and torsion by force across, both by the offset of an eccentric segment's axis from
/// that of the model; largest over sections and instants, as von Mises stress.
double offset_axis_Pa(const BodyAnalysis& analysis) {
  double largest_Pa = 0;
  if (!analysis.diagrams) return 0;
  for (const auto& section : analysis.diagrams->sections) {
    const auto& plane = section.plane;
    const double offset_m = std::hypot(plane.axis_x_m, plane.axis_y_m);
    if (offset_m == 0) continue;
    const double r = plane.radius_m, r_i = plane.inner_radius_m;
    const double second_m4 = pi / 4 * (std::pow(r, 4) - std::pow(r_i, 4));
    const double bending_Pa = section.by_statics.row(2).abs().maxCoeff() * offset_m * r / second_m4;
    const double shear_Pa =
        section.by_statics.topRows<2>().matrix().colwise().norm().maxCoeff() * offset_m * r / (2 * second_m4);
    largest_Pa = std::max(largest_Pa, std::hypot(bending_Pa, std::sqrt(3.0) * shear_Pa));
  }
  return largest_Pa;
}

void enter_errors(BodyAnalysis& analysis, const std::vector<PlaceStress>& places) {
  take_place_errors(analysis, places, "change from the coarser section");
  auto& errors = analysis.peak.errors;
  errors.set_numerical(
      {"geometry", "arcs are curves of degree 3: their changes are those of the discretisation", 0});
  if (const auto beam = beam_shaft(analysis.scene, analysis.mesh))
    if (const double share = fem::eccentricity_error(*beam); share > 0)
      errors.set_model({"eccentric_segments",
                        "eccentric shoulders taken as concentric: the fillets' factors at their heights",
                        share * analysis.peak.value_Pa});
  if (const double offset_Pa = offset_axis_Pa(analysis); offset_Pa > 0)
    errors.set_model(
        {"offset_axis", "bending and torsion by the offset of eccentric segments' axes", offset_Pa});
}

}  // namespace

BodyAnalysis analyse_axisymmetric(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                                  BodyLoads loads, const RunOptions& options, StageClock& clock,
                                  double tolerance, double seconds) {
  const auto start = std::chrono::steady_clock::now();
  const int n_threads = threads(options.n_threads);
  MeshedBody own = meshed;
  own.mesh.sections = describe_revolved(body).mesh.sections;
  const double target = tolerance > 0 ? share_of_tolerance * tolerance : usual_target;
  AxisymmetricRefinement refinement(body, own, loads, n_threads);
  Search search;
  search.quantity = "peak von Mises stress";
  search.tolerance = tolerance;
  search.ended = "the tolerance is met";
  auto step = refinement.next(clock);
  search.steps.push_back(record(scene, body, step));
  clock.note(text_of_step(body.name, search));
  while (!AxisymmetricRefinement::is_met(step, target)) {
    if (int(search.steps.size()) >= AxisymmetricRefinement::most_steps) {
      search.ended = "too many steps";
      break;
    }
    const std::chrono::duration<double> so_far = std::chrono::steady_clock::now() - start;
    if (!in_time(seconds - so_far.count(), [&] { step = refinement.next(clock); })) {
      search.ended = time_is_up;
      break;
    }
    search.steps.push_back(record(scene, body, step));
    clock.note(text_of_step(body.name, search));
  }
  const std::chrono::duration<double> solve = std::chrono::steady_clock::now() - start;
  const auto places = step.places;
  auto torsion = step.torsion;
  if (const auto beam = beam_shaft(body, own.mesh))
    torsion.error_Pa += fem::eccentricity_error(*beam) * torsion.value_Pa;
  auto analysis = superpose_body(body, own, std::move(loads), std::move(step.responses), options.n_threads,
                                 clock, {std::move(step.envelope), {}});
  analysis.method = Method::axisymmetric;
  analysis.solve_s = solve.count();
  enter_errors(analysis, places);
  if (analysis.diagrams) analysis.diagrams->by_harmonics = torsion;
  if (tolerance > 0) {
    search.steps.back().errors = analysis.peak.errors;
    search.met = analysis.peak.errors.reducible_Pa() <= tolerance * analysis.peak.value_Pa;
    if (!search.met && search.ended == "the tolerance is met")
      search.ended = "the section is fine enough; what is left is not its error";
    analysis.search = std::move(search);
  }
  return analysis;
}

}  // namespace pipelines

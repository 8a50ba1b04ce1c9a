#include "pipelines/search/models/harmonics_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "fem/models/beam/beam_responses.h"
#include "pipelines/base/common/constants.h"
#include "pipelines/judge/stages/place_errors.h"
#include "pipelines/search/cheap_models/axisymmetric_body.h"
#include "pipelines/search/cheap_models/axisymmetric_refinement.h"
#include "pipelines/search/cheap_models/cheap_responses.h"
#include "pipelines/search/cheap_models/fitted.h"

namespace pipelines {
namespace {

/// The error that the discretisation may have: half of a tolerance, and without one what a second buys.
constexpr double share_of_tolerance = 0.5, usual_target = 0.01;

/// Of a section that is the second one: whether the third is to tell by which order the errors fall.
bool is_order_asked(double tolerance, const AxisymmetricStep& step) {
  return tolerance > 0 && tolerance <= fitted::asks_for_order &&
         step.responses.n_dofs <= fitted::most_before_order;
}

/// Bending by axial force and torsion by force across, both by the offset of an eccentric segment's axis from
/// that of the model; largest over sections and instants, as von Mises stress.
double offset_axis_Pa(const Judged& analysis) {
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

/// Errors of the model itself, which no section lowers.
void enter_model_errors(Judged& analysis) {
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

/// Harmonics of pressures that the first section is solved with to see what those left out bring: so many,
/// and so many times the present ones. Above 24 the bound is 0.02 % of the largest stress beside a seat's
/// end.
constexpr int many_harmonics = 24, times_as_many = 2, most_harmonics = 64;
/// For what a coarse section may have wrong of that; the share of the tolerance from which a bound is worth
/// it.
constexpr double safety_of_tail = 1.5, worth_a_section = 0.1;

/// Nothing where there are no more to be had.
std::optional<Scene> with_many_harmonics(Scene scene, std::size_t index) {
  auto& body = scene.bodies[index];
  int highest = body.pressure_harmonics;
  for (const auto& [port, pressure] : body.pressures) highest = std::max(highest, pressure.highest_harmonic);
  const int more = std::min(most_harmonics, std::max(many_harmonics, times_as_many * highest)) - highest;
  if (more <= 0) return std::nullopt;
  body.pressure_harmonics += more;
  for (auto& [port, pressure] : body.pressures) pressure.highest_harmonic += more;
  body.felt_seats.clear();
  return scene;
}

MeshedBody with_own_sections(const BodyScene& body, MeshedBody meshed) {
  meshed.mesh.sections = describe_revolved(body).mesh.sections;
  return meshed;
}

}  // namespace

/// The sections so far under the same loads.
struct HarmonicsModel::Series {
  MeshedBody meshed;
  BodyLoads loads;
  AxisymmetricRefinement refinement;
  int n_sections = 0;
  double seconds = 0;

  Series(const BodyScene& body, MeshedBody own, BodyLoads of_body, int n_threads)
      : meshed(std::move(own)), loads(std::move(of_body)), refinement(body, meshed, loads, n_threads) {}
};

HarmonicsModel::HarmonicsModel(RunOfBody run, Loaded loaded)
    : BodyModel(std::move(run), std::move(loaded)),
      series_(std::make_shared<Series>(body(), with_own_sections(body(), meshed()), body_loads(),
                                       run_.options.n_threads)) {}

Judged HarmonicsModel::solve() {
  const RunTime time;
  auto step = series_->refinement.next(clock());
  ++series_->n_sections;
  const double target = run_.tolerance > 0 ? share_of_tolerance * run_.tolerance : usual_target;
  is_section_fine_ = AxisymmetricRefinement::is_met(step, target) &&
                     (series_->n_sections > 2 || !is_order_asked(run_.tolerance, step));
  fineness_ = step.fineness;
  places_ = std::move(step.places);
  torsion_ = step.torsion;
  if (const auto beam = beam_shaft(body(), meshed().mesh))
    torsion_.error_Pa += fem::eccentricity_error(*beam) * torsion_.value_Pa;
  series_->seconds += time.seconds();
  auto by_harmonics = responded(body(), series_->meshed, body_loads(), std::move(step.responses));
  by_harmonics.method = Method::axisymmetric;
  by_harmonics.solve_s = series_->seconds;
  auto solved = judged(std::move(by_harmonics), series_->meshed, std::move(step.envelope));
  tail_Pa_ = solved_tail_Pa(solved);
  return solved;
}

std::optional<double> HarmonicsModel::solved_tail_Pa(const Judged& solved) const {
  const auto leading = std::max_element(places_.begin(), places_.end(),
                                        [](const auto& a, const auto& b) { return a.value_Pa < b.value_Pa; });
  const double bound_Pa = solved.peak.errors.of("pressure_harmonics");
  if (!is_section_fine_ || leading == places_.end() || bound_Pa <= leading->error_Pa ||
      bound_Pa <= worth_a_section * run_.tolerance * leading->value_Pa)
    return std::nullopt;
  const auto scene = with_many_harmonics(loaded_.scene, run_.index);
  if (!scene) return std::nullopt;

  const auto loaded = loaded_with(*scene, MeshedBody(meshed()));
  const auto& loads = loaded.body_loads[run_.index];
  MeshedBody without_sections = series_->meshed;
  without_sections.mesh.sections.clear();
  AxisymmetricRefinement refinement(body(), without_sections, loads, run_.options.n_threads);
  const auto step = refinement.next(clock());
  std::map<std::string, double> more_Pa;
  for (const auto& place : step.places) more_Pa[place.feature] = place.value_Pa;
  double largest_Pa = 0;
  for (const auto& place : places_) {
    const auto more = more_Pa.find(place.feature);
    if (more == more_Pa.end()) continue;
    const double change_Pa = more->second - series_->refinement.values_Pa().at(place.feature).front();
    largest_Pa = std::max(largest_Pa, place.value_Pa + change_Pa);
  }
  const StressPoint there{{{step.peak().node, 1.0}}, step.envelope.von_mises.instant[step.peak().node]};
  const double rest_Pa =
      self_estimate(there, step.responses, loads, body().material, 0).of("pressure_harmonics");
  return std::min(bound_Pa, safety_of_tail * std::abs(largest_Pa - leading->value_Pa) + rest_Pa);
}

void HarmonicsModel::enter_errors(Judged& analysis) const {
  enter_model_errors(analysis);
  if (tail_Pa_)
    analysis.peak.errors.set_numerical(
        {"pressure_harmonics", "the first section with many more harmonics, and a bound of those above",
         *tail_Pa_});
}

void HarmonicsModel::judge(Judged& solved) {
  take_place_errors(solved, places_, "change from the coarser section");
  enter_errors(solved);
  if (solved.diagrams) solved.diagrams->by_harmonics = torsion_;
}

Finer HarmonicsModel::finer(const Judged& judged, const Search& search) {
  const bool is_last_section = series_->n_sections >= AxisymmetricRefinement::most_steps;
  if (!is_section_fine_ && !is_last_section) return {std::make_unique<HarmonicsModel>(*this), "", 0};
  if (auto scene = better_loads_.next(loaded_.scene, run_.index, judged, run_.tolerance)) {
    auto better = std::make_unique<HarmonicsModel>(run_, loaded_with(*scene, MeshedBody(meshed())));
    better->better_loads_ = better_loads_;
    return {std::move(better), "", series_->seconds};
  }
  if (search.met) return {nullptr, "the tolerance is met"};
  return {nullptr,
          is_section_fine_ ? "the section is fine enough; what is left is not its error" : "too many steps"};
}

Judged HarmonicsModel::again(Judged& before) {
  auto after = BodyModel::again(before);
  enter_errors(after);
  return after;
}

}  // namespace pipelines

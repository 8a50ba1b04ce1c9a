#include "pipelines/sweep/body_design.h"

#include <algorithm>
#include <cmath>

#include "pipelines/analysis/place_errors.h"
#include "pipelines/analysis/superpose_body.h"
#include "pipelines/responses/response_key.h"

namespace pipelines {
namespace {

std::string text_of(const fem::UnitLoad& load) {
  return response_key({}, "none", {load}, {}, fem::Solver::automatic, 0);
}

}  // namespace

BodyDesign::BodyDesign(const BodyScene& as_read, SceneRun& run, std::size_t i_body, std::string point)
    : searched_for_(std::move(point)),
      found_(run.scene.bodies[i_body]),
      added_harmonics_(found_.pressure_harmonics - as_read.pressure_harmonics),
      instants_per_turn_(run.scene.sampling.instants_per_turn),
      meshed_(std::move(run.loaded.meshed[i_body])) {
  const auto analysis = std::find_if(run.analyses.begin(), run.analyses.end(),
                                     [&](const BodyAnalysis& a) { return a.scene.name == found_.name; });
  analysis_ = std::move(*analysis);
  meshed_.model.reset();
  for (const auto& load : analysis_.loads.unit_loads) unit_loads_[load.channel] = text_of(load);
  if (!serves_other_points()) return;
  leading_ = std::make_shared<const LeadingStress>(analysis_);
  for (const auto& place : analysis_.place_stresses)
    if (place.value_Pa > 0) shares_[place.feature].judged = place.error_Pa / place.value_Pa;
  for (const auto& place : places_of_one_mesh(analysis_, false))
    if (place.value_Pa > 0) shares_[place.feature].own = place.error_Pa / place.value_Pa;
}

void BodyDesign::enter(Scene& scene, std::size_t i_body) const {
  auto& body = scene.bodies[i_body];
  body.shape = found_.shape;
  body.degree = found_.degree;
  body.refinements = found_.refinements;
  body.singular = found_.singular;
  body.pressure_harmonics += added_harmonics_;
  for (auto& [port, pressure] : body.pressures) pressure.highest_harmonic += added_harmonics_;
  scene.sampling.instants_per_turn = std::max(scene.sampling.instants_per_turn, instants_per_turn_);
}

bool BodyDesign::covers(const BodyLoads& loads) const {
  return std::all_of(loads.unit_loads.begin(), loads.unit_loads.end(), [&](const fem::UnitLoad& load) {
    const auto own = unit_loads_.find(load.channel);
    return own != unit_loads_.end() && own->second == text_of(load);
  });
}

BodyLoads BodyDesign::with_all_channels(BodyLoads loads) const {
  const auto& all = analysis_.loads.history.channels;
  auto& history = loads.history;
  const bool same = history.channels.size() == all.size() &&
                    std::equal(all.begin(), all.end(), history.channels.begin(),
                               [](const Channel& a, const Channel& b) { return a.name == b.name; });
  if (same) return loads;
  const auto widened = [&](const Eigen::ArrayXXd& values) {
    Eigen::ArrayXXd wide = Eigen::ArrayXXd::Zero(Eigen::Index(all.size()), values.cols());
    for (std::size_t k = 0; k < history.channels.size(); ++k) {
      const auto row = std::find_if(all.begin(), all.end(),
                                    [&](const Channel& c) { return c.name == history.channels[k].name; });
      wide.row(row - all.begin()) = values.row(Eigen::Index(k));
    }
    return wide;
  };
  history.values = widened(history.values);
  for (auto& part : history.by_effect) part = widened(part);
  history.channels = all;
  loads.unit_loads = analysis_.loads.unit_loads;
  return loads;
}

BodyAnalysis BodyDesign::at_point(BodyAnalysis analysis, const BodyScene& body, BodyLoads loads,
                                  const ZoneRule* zones) const {
  analysis.scene = body;
  loads = with_all_channels(std::move(loads));
  auto leading = leading_->envelope(loads.history, analysis.responses);
  if (zones != nullptr) {
    const auto& value_Pa = leading.von_mises.value_Pa;
    const double peak_Pa = value_Pa[peak_node(value_Pa, analysis.places)];
    leading_->complete_above(zone_level_Pa(*zones, peak_Pa, body.yield_strength_Pa), loads.history,
                             analysis.responses, leading);
  }
  analysis = under_other_loads(std::move(analysis), meshed_, std::move(loads), std::move(leading), zones);
  // A place keeps the share of error that the search knows, more where this mesh alone is in more doubt of it
  // than at the point of the search: the maximum may have moved to larger cells.
  auto places = places_of_one_mesh(analysis, false);
  for (auto& place : places) {
    const auto known = shares_.find(place.feature);
    if (known == shares_.end() || place.value_Pa <= 0) continue;
    const auto& share = known->second;
    if (share.judged <= 0 || share.own <= 0) continue;
    const double own = place.error_Pa / place.value_Pa;
    place.error_Pa = std::min(own, share.judged * std::max(1.0, own / share.own)) * place.value_Pa;
  }
  take_place_errors(analysis, places, "shares of the stress as the mesh's search found them");
  return analysis;
}

}  // namespace pipelines

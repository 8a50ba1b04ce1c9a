#include "pipelines/study/variations/body_design.h"

#include <algorithm>
#include <cmath>

#include "pipelines/judge/stages/judge_body.h"
#include "pipelines/judge/stages/place_errors.h"

namespace pipelines {

BodyDesign::BodyDesign(const Scene& as_read, SceneRun& run, std::size_t i_body, std::string point)
    : searched_for_(std::move(point)),
      found_(as_read, run.loaded.scene, i_body),
      meshed_(std::move(run.loaded.meshed[i_body])) {
  const auto analysis = std::find_if(run.analyses.begin(), run.analyses.end(),
                                     [&](const Judged& a) { return a.scene.name == found_.body.name; });
  analysis_ = std::move(*analysis);
  meshed_.model.reset();
  served_.emplace(analysis_.loads);
  if (!serves_other_points()) return;
  leading_ = std::make_shared<const LeadingStress>(analysis_);
  for (const auto& place : analysis_.place_stresses)
    if (place.value_Pa > 0) shares_[place.feature].judged = place.error_Pa / place.value_Pa;
  for (const auto& place : places_of_one_mesh(analysis_, 0))
    if (place.value_Pa > 0) shares_[place.feature].own = place.error_Pa / place.value_Pa;
}

Judged BodyDesign::at_point(Judged analysis, const BodyScene& body, BodyLoads loads,
                            const ZoneRule* zones) const {
  analysis.scene = body;
  loads = served_->with_all_channels(std::move(loads));
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
  auto places = places_of_one_mesh(analysis, 0);
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

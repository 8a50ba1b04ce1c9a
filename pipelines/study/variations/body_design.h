/// A body of a sweep that is meshed and solved, and what its unit responses tell of further points.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "pipelines/judge/analysis/judged.h"
#include "pipelines/judge/figures/served_loads.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/search/loop/found_body.h"
#include "pipelines/search/loop/scene_run.h"
#include "pipelines/study/variations/leading_stress.h"

namespace pipelines {

/// What is known of the error of a place, as a share of its stress.
struct PlaceShare {
  double judged = 0;  ///< by the search that found the mesh
  double own = 0;     ///< by that mesh alone
};

class BodyDesign {
public:
  /// @param as_read  the point before a search chose its mesh
  /// @param run      the body's analysis is moved out of it
  /// @param point    whose run it is, as searched_for() has it
  BodyDesign(const Scene& as_read, SceneRun& run, std::size_t i_body, std::string point);

  /// The shares of another design on the same mesh, which a search has found.
  void take_shares(const BodyDesign& searched) {
    shares_ = searched.shares_;
    searched_for_ = searched.searched_for_;
  }

  /// Puts the mesh, harmonics and instants that were found into the scene of another point.
  void enter(Scene& scene, std::size_t i_body) const { found_.enter(scene, i_body); }

  const MeshedBody& meshed() const { return meshed_; }
  const Judged& analysis() const { return analysis_; }
  /// Cheap models have no responses that serve other points: their bodies are run anew.
  bool serves_other_points() const { return analysis_.method == Method::solid; }
  /// Whether its unit responses are those of all these loads.
  bool covers(const BodyLoads& loads) const { return served_->missing(loads).empty(); }

  /// Settings of the point that the mesh was searched for: "machine.drive.speed=1200 rpm"; "the scene" as it
  /// is.
  const std::string& searched_for() const { return searched_for_; }

  /// The body under the loads of another point: leading stresses with their errors.
  /// @param analysis  a copy of analysis(), used again and again
  /// @param body      the point's body, with the mesh entered
  /// @param loads     loads that it covers
  /// @param zones     null: none
  Judged at_point(Judged analysis, const BodyScene& body, BodyLoads loads, const ZoneRule* zones) const;

private:
  std::string searched_for_;
  FoundBody found_;
  MeshedBody meshed_;
  Judged analysis_;
  std::optional<ServedLoads> served_;
  std::map<std::string, PlaceShare> shares_;
  std::shared_ptr<const LeadingStress> leading_;  ///< none of cheap models
};

}  // namespace pipelines

/// A body of hexahedra or tetrahedra.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "pipelines/search/models/body_model.h"
#include "pipelines/search/refinement/local_refinement.h"
#include "pipelines/search/refinement/peak_growth.h"
#include "pipelines/search/refinement/place_history.h"
#include "pipelines/search/refinement/refinement.h"

namespace pipelines {

/// What the meshes of a search so far tell, and what of them may still become finer.
struct KnownOfMeshes {
  explicit KnownOfMeshes(const BodyScene& body) : history(mesh_parts(body), trust_in_meshes(body)) {}

  PlaceHistory history;
  PeakGrowth growth;
  std::set<MeshPart> exhausted{};  ///< parts that cannot be finer
};

/// Before it is solved the first mesh of a shaft is guided by a second model, harmonics around the axis,
/// where they apply; from then on it is judged beside them, by the changes from mesh to mesh and by goals.
/// The next model has more instants or harmonics where these dominate the error, else a finer mesh of what
/// promises most at the place that holds the error back.
class SolidModel : public BodyModel {
public:
  /// @param loaded  with the first mesh of a search, or the scene's own
  SolidModel(RunOfBody run, Loaded loaded);

  /// @throws fem::SolveFailed, fem::DoesNotFit, LoadsDoNotClose
  Judged solve() override;
  void judge(Judged& solved) override;
  bool judge_rest(Judged& judged) override;
  std::string reason_to_end(const Search& search, const GoverningStress& stress) const override;
  Finer finer(const Judged& judged, const Search& search) override;
  void release() const override;

  std::string fineness() const override;
  std::string refined() const override { return step_ ? to_string(step_->part) : ""; }
  double seconds_after() const override;

private:
  void be_guided();
  void compare_with_second_model();
  std::optional<SecondModel> second_model();
  void leave_out_edge_without_bound(Judged& analysis);
  std::vector<PlaceStress> places_of_this_mesh(const Judged& analysis, double end_s);
  void judge_places(Judged& analysis, GoalPlaces places);
  void judge_once(Judged& analysis);
  Finer with_better_loads(const Scene& next, double seconds_before) const;
  Finer with_finer_mesh(const Scene& next, const Judged& judged, double seconds_before);
  Finer forecast(std::unique_ptr<SolidModel> finer, double seconds_before) const;
  bool may_be_last(const std::vector<PlaceStress>& places) const;

  KnownOfMeshes known_;
  bool is_first_ = true;
  std::size_t n_dofs_ = 0;        ///< that were solved
  bool has_other_loads_ = false;  ///< than the mesh before
  std::optional<MeshStep> step_;  ///< that led to this mesh
  LocalRefinement local_;         ///< what the next step would cut
  bool is_rest_judged_ = true;    ///< places that do not lead, too
  double second_model_s_ = 0;     ///< of this step, which a finer mesh does not take again
};

}  // namespace pipelines

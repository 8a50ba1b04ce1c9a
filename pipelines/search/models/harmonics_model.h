/// A shaft by harmonics around its axis.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/search/models/better_loads.h"
#include "pipelines/search/models/body_model.h"

namespace pipelines {

/// One section of a body of revolution (search/cheap_models/axisymmetric_refinement.h). The next model is the
/// next finer section, until no place of the body exceeds the stated peak by more than half of the tolerance
/// with its error, by 1 % where there is none; then better loads. Errors of the peak: time sampling as for
/// the solid; pressure harmonics too, or where that is the largest error from the first section once more
/// with many harmonics; discretisation from the change between sections, place by place; of eccentric
/// segments the model's own (fem::eccentricity_error). A node lies where the largest stress of each place
/// does (nodes_at_maxima.h).
class HarmonicsModel : public BodyModel {
public:
  /// @param loaded  with the shaft as describe_revolved or the solid's mesh describes it
  /// @throws StageRefused if why_not_axisymmetric is not empty
  HarmonicsModel(RunOfBody run, Loaded loaded);

  /// @throws LoadsDoNotClose
  Judged solve() override;
  void judge(Judged& solved) override;
  Finer finer(const Judged& judged, const Search& search) override;
  std::string fineness() const override { return fineness_; }
  Judged again(Judged& before) override;

private:
  struct Series;
  /// What the harmonics of pressures that were left out bring to the peak; nothing where their bound
  /// is no more than its discretisation or a tenth of the tolerance, or the section is not the last.
  std::optional<double> solved_tail_Pa(const Judged& solved) const;
  void enter_errors(Judged& analysis) const;

  std::shared_ptr<Series> series_;
  BetterLoads better_loads_;
  // What is known of the section that was solved:
  std::string fineness_;
  bool is_section_fine_ = false;
  std::vector<PlaceStress> places_;
  LargestTorsion torsion_;
  std::optional<double> tail_Pa_;
};

}  // namespace pipelines

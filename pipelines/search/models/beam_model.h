/// A shaft as a beam with fillet factors.
#pragma once

#include "pipelines/search/models/better_loads.h"
#include "pipelines/search/models/body_model.h"

namespace pipelines {

/// Envelope, peak and effects of beam theory (search/cheap_models/cheap_responses.h). It has no section
/// diagrams and no rings of torsion; zones are patches of surface without volume. Inside there are nodes on
/// the axis alone, with the mean of the circle around them, so that there are cells to look at. Errors of the
/// model: the spread of the fillets' published factors, bored seats that go oval, spin. No mesh is finer;
/// loads may be.
class BeamModel : public BodyModel {
public:
  /// @param loaded  with the shaft as describe_revolved or the solid's mesh describes it
  using BodyModel::BodyModel;

  /// @throws StageRefused if why_not_beam is not empty; LoadsDoNotClose
  Judged solve() override;
  void judge(Judged& solved) override;
  Finer finer(const Judged& judged, const Search& search) override;
  std::string fineness() const override { return "beam"; }
  Judged again(Judged& before) override;

private:
  BetterLoads better_loads_;
  double seconds_ = 0;  ///< of solving
};

}  // namespace pipelines

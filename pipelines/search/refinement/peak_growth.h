/// Watches the peak of a body from mesh to mesh.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

/// The peak's values at one place, mesh after mesh. Of tetrahedra each feature's own: they all become finer
/// where they may lead, and the peak goes from one to the other where several are alike.
class PeakGrowth {
public:
  /// @param ratio  of cell sizes from the step before to this one
  /// @return whether the stress there grows without bound (refinement.h); never for hot-spot stresses, which
  /// are extrapolated past the toe, nor on a fillet, nor beside an edge that is left out already
  bool at(const Judged& analysis, double ratio);

private:
  struct Course {
    std::vector<double> values, ratios;
  };
  std::map<std::string, Course> courses_;  ///< by feature
};

/// How far stress is left out around an edge at which it grows: as around imported bodies' edges
/// (meshes::usual_exclusion_m), of the flat faces between the corners.
double left_out_around_edges_m(const fem::Nodes& nodes);

}  // namespace pipelines

/// Finer loads on the mesh that a body has: more instants, more pressure harmonics, and the odd harmonics of
/// seats that are felt. The direction in which models without a mesh of their own are refined last.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "pipelines/judge/analysis/judged.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

class BetterLoads {
public:
  /// The scene with better loads, while these alone hold the tolerance back and become better; then once with
  /// the seats whose pressure the leading places feel.
  /// @param judged     under the loads of `scene`
  /// @param tolerance  of the governing stress, relative; 0: none
  std::optional<Scene> next(const Scene& scene, std::size_t index, const Judged& judged, double tolerance);

private:
  std::optional<Scene> refined(const Scene& scene, std::size_t index, const Judged& judged, double tolerance);

  double share_before_ = std::numeric_limits<double>::infinity();  ///< of the loads' errors
  bool are_seats_felt_ = false;                                    ///< and asked for
};

}  // namespace pipelines

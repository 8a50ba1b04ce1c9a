#include "pipelines/search/models/better_loads.h"

#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/analysis/load_patch.h"
#include "pipelines/search/refinement/refinement.h"

namespace pipelines {

std::optional<Scene> BetterLoads::refined(const Scene& scene, std::size_t index, const Judged& judged,
                                          double tolerance) {
  constexpr double least_gain = 0.75;
  const auto stress = governing_stress(judged);
  const double of_loads_Pa = stress.errors.of("time_sampling") + stress.errors.of("pressure_harmonics");
  const double rest_Pa = stress.errors.reducible_Pa() - of_loads_Pa, most_Pa = tolerance * stress.value_Pa;
  const double share = stress.value_Pa > 0 ? of_loads_Pa / stress.value_Pa : 0;
  if (rest_Pa + of_loads_Pa <= most_Pa || rest_Pa > most_Pa) return std::nullopt;
  // The series of a narrow pattern stands still at first, and then falls.
  const bool is_of_series = 2 * stress.errors.of("pressure_harmonics") > of_loads_Pa;
  if (!is_of_series && share > least_gain * share_before_) return std::nullopt;
  Scene next = scene;
  next.bodies[index].felt_seats.merge(felt_seats(judged));
  if (!refine_sampling_and_harmonics(next, index, stress, judged.loads.history).possible) return std::nullopt;
  share_before_ = share;
  return next;
}

std::optional<Scene> BetterLoads::next(const Scene& scene, std::size_t index, const Judged& judged,
                                       double tolerance) {
  if (are_seats_felt_) return std::nullopt;
  if (tolerance > 0)
    if (auto better = refined(scene, index, judged, tolerance)) return better;
  are_seats_felt_ = true;
  auto felt = felt_seats(judged);
  if (felt.empty()) return std::nullopt;
  Scene next = scene;
  next.bodies[index].felt_seats.merge(felt);
  return next;
}

}  // namespace pipelines

#include "pipelines/search/loop/without_mesh.h"

#include <iterator>
#include <limits>
#include <utility>

#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/analysis/load_patch.h"
#include "pipelines/judge/estimates/in_time.h"
#include "pipelines/search/refinement/refinement.h"

namespace pipelines {

void prepend_steps(std::vector<SearchStep> before, Search& search) {
  before.insert(before.end(), std::make_move_iterator(search.steps.begin()),
                std::make_move_iterator(search.steps.end()));
  search.steps = std::move(before);
}

BodyAnalysis search_without_mesh(const RunOfBody& run, std::size_t i_body, double tolerance, double end_s) {
  constexpr double least_gain = 0.75;
  double before_s = run.seconds(), before_share = std::numeric_limits<double>::infinity();
  auto analysis = run.analyse();
  const auto analyse_again = [&](Scene next) {
    run.take(std::move(next));
    auto steps = std::move(analysis.search.steps);
    analysis = run.analyse();
    prepend_steps(std::move(steps), analysis.search);
  };
  while (tolerance > 0) {
    const auto stress = governing_stress(analysis);
    const double of_loads_Pa = stress.errors.of("time_sampling") + stress.errors.of("pressure_harmonics");
    const double rest_Pa = stress.errors.reducible_Pa() - of_loads_Pa, most_Pa = tolerance * stress.value_Pa;
    const double share = stress.value_Pa > 0 ? of_loads_Pa / stress.value_Pa : 0;
    if (rest_Pa + of_loads_Pa <= most_Pa || rest_Pa > most_Pa) break;
    // The series of a narrow pattern stands still at first, and then falls.
    const bool is_of_series = 2 * stress.errors.of("pressure_harmonics") > of_loads_Pa;
    if (!is_of_series && share > least_gain * before_share) break;
    const double now_s = run.seconds();
    if (end_s > 0 && now_s + (now_s - before_s) > end_s) {
      analysis.search.ended = time_is_up;
      analysis.search.next_seconds = now_s - before_s;
      break;
    }
    Scene next = run.scene;
    next.bodies[i_body].felt_seats.merge(felt_seats(analysis));
    if (!refine_sampling_and_harmonics(next, i_body, stress, analysis.loads.history).possible) break;
    before_s = now_s, before_share = share;
    analyse_again(std::move(next));
  }
  const double last_s = run.seconds() - before_s;
  if (auto felt = felt_seats(analysis); !felt.empty() && !(end_s > 0 && run.seconds() + last_s > end_s)) {
    Scene next = run.scene;
    next.bodies[i_body].felt_seats.merge(felt);
    analyse_again(std::move(next));
  }
  return analysis;
}

}  // namespace pipelines

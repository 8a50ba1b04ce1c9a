#include "pipelines/judge/stages/analyse_body.h"

#include <chrono>

#include "pipelines/judge/stages/respond.h"
#include "pipelines/judge/stages/superpose_body.h"

namespace pipelines {

BodyAnalysis analyse_body(const BodyScene& body, const MeshedBody& meshed, BodyLoads loads,
                          const RunOptions& options, StageClock& clock) {
  const auto start = std::chrono::steady_clock::now();
  auto answer = respond(body, meshed, loads, options, clock);
  const std::chrono::duration<double> solve = std::chrono::steady_clock::now() - start;
  auto analysis = superpose_body(body, meshed, std::move(loads), std::move(answer.responses),
                                 options.n_threads, clock, {{}, {}, !options.keep_factor});
  analysis.responses_reused = answer.reused;
  analysis.warnings = std::move(answer.warnings);
  analysis.solve_s = answer.reused ? 0 : solve.count();
  return analysis;
}

}  // namespace pipelines

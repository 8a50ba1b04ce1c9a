#include "pipelines/analysis/body_analysis.h"

#include <chrono>

#include "pipelines/analysis/respond.h"
#include "pipelines/analysis/superpose_body.h"

namespace pipelines {

BodyAnalysis::BodyAnalysis() = default;
BodyAnalysis::BodyAnalysis(const BodyAnalysis&) = default;
BodyAnalysis::BodyAnalysis(BodyAnalysis&&) noexcept = default;
BodyAnalysis& BodyAnalysis::operator=(const BodyAnalysis&) = default;
BodyAnalysis& BodyAnalysis::operator=(BodyAnalysis&&) noexcept = default;
BodyAnalysis::~BodyAnalysis() = default;

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

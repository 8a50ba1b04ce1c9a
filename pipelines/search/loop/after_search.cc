#include "pipelines/search/loop/after_search.h"

#include <memory>

#include "pipelines/judge/estimates/in_time.h"
#include "pipelines/judge/life/body_fatigue.h"
#include "pipelines/judge/stages/body_vibration.h"
#include "pipelines/respond/responses/respond.h"

namespace pipelines {
namespace {

std::string warning_of_left_out(const std::string& body, const std::string& what,
                                const std::string& unknown) {
  return body + ": " + what + " are left out, since the time was up: " + unknown +
         "; a longer time limit has them";
}

}  // namespace

std::vector<std::string> add_frequencies(const Scene& scene, const MeshedBody& meshed,
                                         const kinetics::LoadHistory& loads, double seconds, Judged& analysis,
                                         StageClock& clock) {
  const bool is_whole = in_time(seconds, [&] { add_vibration(scene, meshed, loads, analysis, clock); });
  add_critical_speeds(scene, meshed, loads, analysis, clock);
  if (!is_whole)
    return {warning_of_left_out(analysis.scene.name, "natural frequencies",
                                "what resonance adds to the stress is not known")};
  if (!analysis.vibration) return {};
  return {warning_of(analysis.scene, *analysis.vibration),
          warning_of_frequencies(analysis.scene, *analysis.vibration)};
}

std::vector<std::string> add_fatigue(const Scene& scene, const kinetics::LoadHistory& loads, double seconds,
                                     int n_threads, Judged& analysis, StageClock& clock) {
  const auto judge = [&] {
    const auto& time_s = loads.time_s;
    const double step_s = time_s.size() > 1 ? time_s[1] - time_s[0] : 0;
    analysis.fatigue = std::make_shared<const BodyFatigue>(judge_fatigue(
        analysis, {step_s * double(time_s.size()), double(scene.sampling.turns)}, threads(n_threads)));
  };
  if (!in_time(seconds, [&] { clock.run("fatigue", judge); }))
    return {warning_of_left_out(analysis.scene.name, "lives", "nothing is known of its fatigue")};
  return analysis.fatigue->warnings;
}

}  // namespace pipelines

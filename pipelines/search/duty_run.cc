#include "pipelines/search/duty_run.h"

#include <algorithm>

#include "pipelines/analysis/respond.h"
#include "pipelines/analysis/served_loads.h"
#include "pipelines/common/errors.h"
#include "pipelines/search/duty_loads.h"

namespace pipelines {
namespace {

constexpr double day_s = 86400;

/// A block's loads with the channels of the unit responses, and the envelope that they bring.
struct ServedBlock {
  BodyLoads running;
  std::optional<BodyLoads> starting;
  NodalMaximum von_mises;
};

ServedBlock serve(const DutyBlock& block, const BodyAnalysis& analysis, BlockLoads& loads, std::size_t b,
                  int n_threads) {
  const ServedLoads served(analysis.loads);
  const auto fitted = [&](BodyLoads&& own) {
    if (const auto channel = served.missing(own); !channel.empty())
      throw StageRefused(block.origin + ": block \"" + block.name + "\" loads " + analysis.scene.name + "/" +
                         channel + ", for which this run has no unit response; run again with --fresh");
    return served.with_all_channels(std::move(own));
  };
  ServedBlock result;
  result.running = fitted(std::move(loads.running[b]));
  if (!loads.starting.empty()) result.starting = fitted(std::move(loads.starting[b]));
  result.von_mises = envelope(result.running.history, analysis.responses, threads(n_threads)).von_mises;
  return result;
}

BlockStress stress_of(const BodyAnalysis& analysis, const NodalMaximum& von_mises) {
  const auto node = peak_node(von_mises.value_Pa, analysis.places);
  BlockStress stress{analysis.scene.name, "", von_mises.value_Pa[node], 0};
  if (const auto feature = analysis.places.feature[node]; feature >= 0)
    stress.feature = analysis.places.feature_names[std::size_t(feature)];
  stress.safety = analysis.scene.yield_strength_Pa / stress.value_Pa;
  return stress;
}

LoadPeriod period_of(const kinetics::LoadHistory& loads, const Scene& scene) {
  const double step_s = loads.time_s.size() > 1 ? loads.time_s[1] - loads.time_s[0] : 0;
  return {step_s * double(loads.time_s.size()), double(scene.sampling.turns)};
}

}  // namespace

DutyResult run_duty(const Scene& as_read, const SceneRun& run, int n_threads, StageClock& clock) {
  DutyResult result;
  for (const auto& block : run.scene.duty) result.in_operation += block.share;
  std::vector<BlockLoads> loads;
  for (const auto& block : run.scene.duty) {
    auto& own = loads.emplace_back(loads_of_block(block, as_read, run.scene, run.loaded.meshed, clock));
    result.blocks.push_back({block.name,
                             block.share,
                             block.start ? block.start->per_day : 0,
                             !own.starting.empty(),
                             {},
                             std::move(own.bearings)});
  }
  for (std::size_t b = 0; b < run.analyses.size(); ++b) {
    const auto& analysis = run.analyses[b];
    std::vector<ServedBlock> served;
    clock.run("blocks", [&] {
      for (std::size_t k = 0; k < loads.size(); ++k) {
        served.push_back(serve(run.scene.duty[k], analysis, loads[k], b, n_threads));
        result.blocks[k].stresses.push_back(stress_of(analysis, served.back().von_mises));
      }
    });
    if (!analysis.scene.fatigue) continue;
    std::vector<BlockOnBody> blocks;
    for (std::size_t k = 0; k < loads.size(); ++k)
      blocks.push_back({&served[k].running.history, &served[k].von_mises,
                        period_of(loads[k].loads, *run.scene.duty[k].scene),
                        result.blocks[k].share / result.in_operation,
                        served[k].starting ? &served[k].starting->history : nullptr,
                        result.blocks[k].starts_per_day / (day_s * result.in_operation)});
    result.places[analysis.scene.name] = clock.run("fatigue", [&] { return judge_duty(analysis, blocks); });
  }
  result.bearings = bearings_over_blocks(result.blocks, run.scene.bearings);
  return result;
}

}  // namespace pipelines

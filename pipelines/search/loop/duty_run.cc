#include "pipelines/search/loop/duty_run.h"

#include <fmt/core.h>

#include <algorithm>

#include "pipelines/base/common/errors.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/estimates/hot_spots.h"
#include "pipelines/judge/estimates/time_sampling.h"
#include "pipelines/judge/figures/served_loads.h"
#include "pipelines/judge/life/duty_shares.h"
#include "pipelines/respond/responses/respond.h"
#include "pipelines/search/loop/duty_loads.h"

namespace pipelines {
namespace {

constexpr double day_s = 86400;

/// A block's loads with the channels of the unit responses, and the envelope that they bring.
struct ServedBlock {
  BodyLoads running;
  std::optional<BodyLoads> starting;
  NodalCycles cycles;
  NodalMaximum von_mises, start_von_mises;  ///< in starts: of some of the instants
};

/// About so many instants of a start tell where it stresses most.
constexpr Eigen::Index instants_looked_at = 720;

ChannelHistory thinned(const ChannelHistory& history) {
  const auto n = history.values.cols(), step = std::max<Eigen::Index>(1, n / instants_looked_at);
  const Eigen::Index kept = (n + step - 1) / step;
  const auto of = [&](const Eigen::ArrayXXd& values) -> Eigen::ArrayXXd {
    return values(Eigen::all, Eigen::seqN(0, kept, step));
  };
  ChannelHistory result = history;
  result.values = of(history.values);
  for (auto& part : result.by_effect) part = of(part);
  return result;
}

ServedBlock serve(const DutyBlock& block, const Responded& analysis, BlockLoads& loads, std::size_t b,
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
  if (auto denser = denser_course(result.running.history)) result.running.history = std::move(*denser);
  if (!loads.starting.empty()) result.starting = fitted(std::move(loads.starting[b]));
  result.von_mises = envelope(result.running.history, analysis.responses, threads(n_threads)).von_mises;
  if (analysis.scene.fatigue)
    result.cycles = nodal_cycles(result.running.history, analysis.responses, result.von_mises,
                                 surface_nodes(analysis.responses.nodes), threads(n_threads));
  if (result.starting)
    result.start_von_mises =
        envelope(thinned(result.starting->history), analysis.responses, threads(n_threads)).von_mises;
  return result;
}

BlockStress stress_of(const Judged& analysis, const ServedBlock& block) {
  const auto& largest_Pa = block.von_mises.value_Pa;
  const auto node = peak_node(largest_Pa, analysis.places);
  const auto feature = feature_at(analysis.responses.nodes, analysis.places, node);
  BlockStress stress{analysis.scene.name, feature, false, largest_Pa[node], 0, 0};
  const auto spots =
      hot_spots_under(analysis.mesh.hot_spots, analysis.responses, block.running.history, analysis.hot_spots);
  if (!spots.empty() && spots.front().von_mises_Pa > stress.value_Pa)
    stress = {analysis.scene.name, spots.front().name, true, spots.front().von_mises_Pa, 0, 0};
  stress.safety = analysis.scene.yield_strength_Pa / stress.value_Pa;
  const auto at = stress.is_hot_spot ? stress_point(spots.front()) : StressPoint{{{node, 1.0}}, 0};
  stress.sampling_error_Pa = sampling_error_Pa(unit_stress_at(analysis.responses, at), block.running.history);
  return stress;
}

/// A resonance, a window that does not close: what holds for the block alone.
std::vector<std::string> warnings_of(const DutyBlock& block, const BlockLoads& loads, const Scene& scene,
                                     const kinetics::LoadHistory& of_scene) {
  std::vector<std::string> result;
  for (const auto* list : {&block.scene->warnings, &loads.warnings})
    for (const auto& warning : *list) {
      const auto is_known = [&](const std::vector<std::string>& known) {
        return std::find(known.begin(), known.end(), warning) != known.end();
      };
      if (!is_known(scene.warnings) && !is_known(of_scene.warnings))
        result.push_back(fmt::format("block \"{}\": {}", block.name, warning));
    }
  return result;
}

LoadPeriod period_of(const kinetics::LoadHistory& loads, const Scene& scene) {
  const double step_s = loads.time_s.size() > 1 ? loads.time_s[1] - loads.time_s[0] : 0;
  return {step_s * double(loads.time_s.size()), double(scene.sampling.turns)};
}

}  // namespace

DutyResult run_duty(const Scene& as_read, const SceneRun& run, int n_threads, StageClock& clock) {
  DutyResult result;
  for (const auto& block : run.loaded.scene.duty) result.in_operation += block.share;
  double needed = 0;
  for (const auto& analysis : run.analyses)
    needed = std::max(needed, instants_of_duty(analysis.loads.history));
  std::vector<BlockLoads> loads;
  for (const auto& block : run.loaded.scene.duty) {
    auto& own = loads.emplace_back(
        loads_of_block(block, as_read, run.loaded.scene, run.loaded.meshed, clock, needed));
    for (auto& warning : warnings_of(block, own, as_read, run.loaded.loads))
      result.warnings.push_back(std::move(warning));
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
        served.push_back(serve(run.loaded.scene.duty[k], analysis, loads[k], b, n_threads));
        result.blocks[k].stresses.push_back(stress_of(analysis, served.back()));
      }
    });
    if (!analysis.scene.fatigue) continue;
    std::vector<BlockOnBody> blocks;
    for (std::size_t k = 0; k < loads.size(); ++k)
      blocks.push_back({&served[k].running.history, &served[k].von_mises, &served[k].cycles,
                        period_of(loads[k].loads, *run.loaded.scene.duty[k].scene),
                        result.blocks[k].share / result.in_operation,
                        served[k].starting ? &served[k].starting->history : nullptr,
                        result.blocks[k].starts_per_day / (day_s * result.in_operation),
                        !run.loaded.scene.duty[k].start ? nullptr
                        : served[k].starting            ? &served[k].start_von_mises
                                                        : &served[k].von_mises});
    result.effects[analysis.scene.name] = effects_of_blocks(blocks);
    result.places[analysis.scene.name] =
        clock.run("fatigue", [&] { return judge_duty(analysis, blocks, threads(n_threads)); });
  }
  result.bearings = bearings_over_blocks(result.blocks, run.loaded.scene.bearings);
  return result;
}

std::vector<std::string> blocks_beyond_the_scene(const DutyResult& duty, const SceneRun& run) {
  constexpr double rounding = 1e-6;
  std::vector<std::string> sentences;
  for (const auto& block : duty.blocks)
    for (std::size_t b = 0; b < block.stresses.size(); ++b) {
      const auto& stress = block.stresses[b];
      const double own_Pa = governing_stress(run.analyses[b]).value_Pa;
      if (stress.value_Pa > (1 + rounding) * own_Pa)
        sentences.push_back(fmt::format(
            "block \"{}\" stresses the {} more than the scene's own running, {:.4g} MPa instead of {:.4g}: "
            "zones, pictures and errors are of the latter; give the scene the block's keys to see them",
            block.name, stress.body, stress.value_Pa / 1e6, own_Pa / 1e6));
    }
  return sentences;
}

std::vector<std::string> duty_lives_beyond_curves(const DutyResult& duty) {
  std::vector<std::string> sentences;
  for (const auto& [body, places] : duty.places) {
    const auto is_beyond = [](const DutyPlace& place) { return !place.certainty.beyond.empty(); };
    const auto first = std::find_if(places.begin(), places.end(), is_beyond);
    if (first != places.end())
      sentences.push_back(warning_beyond_curve(
          body + " over all blocks", std::size_t(std::count_if(places.begin(), places.end(), is_beyond)),
          first->feature, first->certainty.beyond));
  }
  return sentences;
}

}  // namespace pipelines

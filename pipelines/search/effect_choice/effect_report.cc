#include "pipelines/search/effect_choice/effect_report.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "kinetics/values/machine_refused.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/scene/values/effect_groups.h"
#include "pipelines/scene/whole/machine_kind.h"

namespace pipelines {
namespace {

using kinetics::LoadHistory;

/// A load over the cycle: two rows of a force, or one of a torque or of what a load table brings besides.
struct Load {
  std::string name;
  Eigen::ArrayXXd values;
};

/// The loads of a history, or the parts that one effect has in them.
/// @param effect  empty: the whole loads. A load table's quantities have no parts: parts_of
std::vector<Load> loads_of(const LoadHistory& history, const std::string& effect = "") {
  std::vector<Load> loads;
  for (const auto& resultant : history.resultants) {
    const Eigen::Array3Xd* values = effect.empty() ? &resultant.total : nullptr;
    for (const auto& part : resultant.contributions)
      if (history.effects[part.effect] == effect) values = &part.load;
    if (values == nullptr) continue;
    loads.push_back({resultant.role + ".force", values->topRows<2>()});
    loads.push_back({resultant.role + ".torque", values->row(2)});
  }
  if (has_samples(history) && effect.empty())
    for (const auto& quantity : history.quantities)
      loads.push_back({quantity.name, quantity.values.transpose()});
  return loads;
}

Eigen::ArrayXd magnitude(const Eigen::ArrayXXd& values) {
  return values.matrix().colwise().norm().transpose();
}

double largest(const Eigen::ArrayXXd& values) {
  return magnitude(values).maxCoeff();
}

double rms(const Eigen::ArrayXXd& values) {
  return std::sqrt(magnitude(values).square().mean());
}

const Load* find(const std::vector<Load>& loads, const std::string& name) {
  const auto found =
      std::find_if(loads.begin(), loads.end(), [&](const Load& load) { return load.name == name; });
  return found == loads.end() ? nullptr : &*found;
}

/// Largest change of a load between two histories; one that is gone carries nothing.
double change(const Load& load, const std::vector<Load>& others) {
  const Load* const other = find(others, load.name);
  return other ? largest(load.values - other->values) : largest(load.values);
}

/// What an effect brings to the loads. A load table's histories add up, so that one effect's part is what the
/// table brings with it alone, axial forces and accelerations included.
std::vector<Load> parts_of(const Scene& scene, const std::string& effect, const LoadHistory& all) {
  if (!has_samples(all)) return loads_of(all, effect);
  return loads_of(compute_loads(scene.machine, {effect}, scene.sampling));
}

std::vector<LoadShare> shares_of(const std::vector<Load>& parts, const LoadHistory& all,
                                 const LoadHistory* other) {
  const auto others = other ? loads_of(*other) : std::vector<Load>{};
  std::vector<LoadShare> shares;
  for (const auto& load : loads_of(all)) {
    const double size = largest(load.values);
    if (size == 0) continue;
    LoadShare share;
    share.load = load.name;
    if (const Load* const part = find(parts, load.name)) {
      share.largest = largest(part->values) / size;
      share.rms = rms(part->values) / rms(load.values);
    }
    share.if_off = other ? change(load, others) / size : std::numeric_limits<double>::quiet_NaN();
    if (share.largest > 0 || share.if_off > 1e-12) shares.push_back(share);
  }
  return shares;
}

double seconds_of_one_run(const Scene& scene, const std::vector<std::string>& effects) {
  const auto start = std::chrono::steady_clock::now();
  const auto history = compute_loads(scene.machine, effects, scene.sampling);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return elapsed.count() / double(history.n_instants());
}

MeasuredTime measured(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  return {seconds[seconds.size() / 2], seconds[1], seconds[seconds.size() - 2]};
}

/// All effects and all but one in turns, so that what disturbs the machine for a while disturbs all alike;
/// the first turn, which finds caches and memory cold, does not count.
void measure_times(const Scene& scene, EffectReport& report) {
  constexpr int n_turns = 7;
  const auto names = scene.kinetics_effects();
  std::vector<double> all;
  std::vector<std::vector<double>> saved(report.effects.size());
  for (int turn = -1; turn < n_turns; ++turn) {
    const double with_all = seconds_of_one_run(scene, names);
    if (turn >= 0) all.push_back(with_all);
    for (std::size_t e = 0; e < report.effects.size(); ++e) {
      const auto& worth = report.effects[e];
      if (!worth.indispensable.empty()) continue;
      const double without = seconds_of_one_run(scene, names_without(names, {worth.effect.name}));
      if (turn >= 0) saved[e].push_back(with_all - without);
    }
  }
  report.per_instant = measured(all);
  for (std::size_t e = 0; e < report.effects.size(); ++e)
    if (!saved[e].empty()) report.effects[e].per_instant = measured(saved[e]);
}

/// Effects that build on a given one go with it.
struct Trial {
  LoadHistory history;
  std::string refusal;  ///< not empty: the machine cannot be without them
};

Trial try_without(const Scene& scene, const std::vector<std::string>& off) {
  const auto left = names_without(scene.kinetics_effects(), off);
  if (left.empty()) return {{}, "it is the only effect of the scene"};
  try {
    return {compute_loads(scene.machine, left, scene.sampling), ""};
  } catch (const kinetics::MachineRefused& refused) {
    return {{}, refused.what()};
  }
}

/// The sum of what several effects bring to the loads.
std::vector<Load> sum_of_parts(const Scene& scene, const std::vector<std::string>& effects,
                               const LoadHistory& all) {
  std::vector<Load> sum;
  for (const auto& effect : effects)
    for (auto& part : parts_of(scene, effect, all)) {
      const auto same =
          std::find_if(sum.begin(), sum.end(), [&](const Load& l) { return l.name == part.name; });
      if (same == sum.end())
        sum.push_back(std::move(part));
      else
        same->values += part.values;
    }
  return sum;
}

std::vector<GroupWorth> groups_of(const Scene& scene, const LoadHistory& all) {
  const auto groups = effect_groups(scene.kinetics_effects());
  if (!any_sums(groups)) return {};
  std::vector<GroupWorth> worth;
  for (const auto& group : groups) {
    const Trial trial = try_without(scene, group.effects);
    worth.push_back({group.name, group.effects,
                     shares_of(sum_of_parts(scene, group.effects, all), all,
                               trial.refusal.empty() ? &trial.history : nullptr),
                     trial.refusal});
  }
  return worth;
}

/// For each effect, it and what needs it, where leaving them out changes no load by more than the threshold;
/// from the least to the most important.
std::vector<EffectStep> steps_below(const Scene& scene, const LoadHistory& all, const EffectReport& report) {
  const auto table = effects_of(scene.machine);
  std::vector<EffectStep> steps;
  for (const auto& worth : report.effects) {
    EffectStep step{with_dependents(table, scene.kinetics_effects(), {worth.effect.name}), worth.if_off};
    if (step.effects.size() > 1) {
      const Trial trial = try_without(scene, step.effects);
      if (!trial.refusal.empty()) continue;
      step.if_off = largest_change(all, trial.history).share;
    }
    if (step.if_off < report.threshold) steps.push_back(std::move(step));
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const auto& a, const auto& b) { return a.if_off < b.if_off; });
  return steps;
}

}  // namespace

LoadChange largest_change(const LoadHistory& all, const LoadHistory& other) {
  const auto loads = loads_of(all), others = loads_of(other);
  LoadChange worst;
  double scale = 0;
  for (const auto& load : loads) scale = std::max(scale, largest(load.values));
  for (const auto& load : loads) {
    const double size = largest(load.values);
    if (size <= 1e-12 * scale) continue;
    const double share = change(load, others) / size;
    if (share > worst.share || worst.load.empty()) worst = {share, load.name};
  }
  return worst;
}

EffectReport report_effects(const Scene& scene, double threshold, bool timed) {
  if (!(threshold > 0 && threshold < 1))
    throw OptionError("threshold = " + std::to_string(threshold) +
                      ": must lie between 0 and 100 %; 1 % is a good beginning");
  const auto names = scene.kinetics_effects();
  const LoadHistory all = compute_loads(scene.machine, names, scene.sampling);
  EffectReport report;
  report.threshold = threshold;
  for (const auto& info : effects_of(scene.machine)) {
    if (!scene.has_effect(info.name)) continue;
    const Trial trial = try_without(scene, {info.name});
    EffectWorth worth;
    worth.effect = info;
    worth.indispensable = trial.refusal;
    worth.shares =
        shares_of(parts_of(scene, info.name, all), all, trial.refusal.empty() ? &trial.history : nullptr);
    const LoadChange worst = trial.refusal.empty() ? largest_change(all, trial.history)
                                                   : LoadChange{std::numeric_limits<double>::quiet_NaN(), ""};
    worth.if_off = worst.share;
    worth.worst_load = worst.load;
    report.effects.push_back(std::move(worth));
  }
  report.groups = groups_of(scene, all);
  if (timed) measure_times(scene, report);

  for (const EffectStep& step : steps_below(scene, all, report)) {
    auto off = report.dispensable;
    for (const auto& effect : step.effects)
      if (std::find(off.begin(), off.end(), effect) == off.end()) off.push_back(effect);
    if (off.size() == report.dispensable.size()) continue;
    const Trial trial = try_without(scene, off);
    if (!trial.refusal.empty()) continue;
    const LoadChange worst = largest_change(all, trial.history);
    if (worst.share >= threshold) continue;
    report.steps.push_back(
        {{off.begin() + std::ptrdiff_t(report.dispensable.size()), off.end()}, step.if_off});
    report.dispensable = off;
    report.if_all_off = worst.share;
    report.worst_load = worst.load;
  }
  return report;
}

}  // namespace pipelines

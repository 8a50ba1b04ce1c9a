#include "pipelines/effect_report.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "kinetics/machine_refused.h"
#include "pipelines/errors.h"

namespace pipelines {
namespace {

using kinetics::LoadHistory;

/// A load over the cycle: two rows of a force, or one of a torque or of what a load table brings besides.
struct Load {
  std::string name;
  Eigen::ArrayXXd values;
};

/// The loads of a history, or the parts that one effect has in them.
/// @param effect  empty: the whole loads. A load table's quantities have no parts
std::vector<Load> loads_of(const LoadHistory& history, const std::string& effect = "") {
  std::vector<Load> loads;
  for (const auto& resultant : history.resultants) {
    const Eigen::Array3Xd* values = effect.empty() ? &resultant.total : nullptr;
    for (const auto& part : resultant.contributions)
      if (part.effect == effect) values = &part.load;
    if (values == nullptr) continue;
    loads.push_back({resultant.role + ".force", values->topRows<2>()});
    loads.push_back({resultant.role + ".torque", values->row(2)});
  }
  if (history.machine == "load_table" && effect.empty())
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

std::vector<std::string> without(const std::vector<std::string>& names, const std::vector<std::string>& off) {
  std::vector<std::string> left;
  for (const auto& name : names)
    if (std::find(off.begin(), off.end(), name) == off.end()) left.push_back(name);
  return left;
}

/// Largest change of a load between two histories; one that is gone carries nothing.
double change(const Load& load, const std::vector<Load>& others) {
  const Load* const other = find(others, load.name);
  return other ? largest(load.values - other->values) : largest(load.values);
}

std::vector<LoadShare> shares_of(const std::string& effect, const LoadHistory& all,
                                 const LoadHistory* other) {
  const auto parts = loads_of(all, effect);
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

/// The shortest of a few runs: what the machine needs when nothing else disturbs it.
double seconds_per_instant(const Scene& scene, const std::vector<std::string>& effects) {
  double best = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    const auto history = compute_loads(scene.machine, effects, scene.sampling);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    best = std::min(best, elapsed.count() / double(history.n_instants()));
  }
  return best;
}

/// Effects that build on a given one go with it.
struct Trial {
  LoadHistory history;
  std::string refusal;  ///< not empty: the machine cannot be without them
};

Trial try_without(const Scene& scene, const std::vector<std::string>& off) {
  const auto left = without(scene.kinetics_effects(), off);
  if (left.empty()) return {{}, "it is the only effect of the scene"};
  try {
    return {compute_loads(scene.machine, left, scene.sampling), ""};
  } catch (const kinetics::MachineRefused& refused) {
    return {{}, refused.what()};
  }
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
  if (timed) report.seconds_per_instant = seconds_per_instant(scene, names);
  for (const auto& info : effects_of(scene.machine)) {
    if (!scene.has_effect(info.name)) continue;
    const Trial trial = try_without(scene, {info.name});
    EffectWorth worth;
    worth.effect = info;
    worth.indispensable = trial.refusal;
    worth.shares = shares_of(info.name, all, trial.refusal.empty() ? &trial.history : nullptr);
    const LoadChange worst = trial.refusal.empty() ? largest_change(all, trial.history)
                                                   : LoadChange{std::numeric_limits<double>::quiet_NaN(), ""};
    worth.if_off = worst.share;
    worth.worst_load = worst.load;
    if (timed && trial.refusal.empty())
      worth.seconds_per_instant =
          std::max(0.0, report.seconds_per_instant - seconds_per_instant(scene, without(names, {info.name})));
    report.effects.push_back(std::move(worth));
  }

  std::vector<const EffectWorth*> ascending;
  for (const auto& worth : report.effects)
    if (worth.if_off < threshold) ascending.push_back(&worth);
  std::stable_sort(ascending.begin(), ascending.end(),
                   [](const auto* a, const auto* b) { return a->if_off < b->if_off; });
  for (const auto* worth : ascending) {
    auto off = report.dispensable;
    off.push_back(worth->effect.name);
    const Trial trial = try_without(scene, off);
    if (!trial.refusal.empty()) continue;
    const LoadChange worst = largest_change(all, trial.history);
    if (worst.share >= threshold) continue;
    report.dispensable = off;
    report.if_all_off = worst.share;
    report.worst_load = worst.load;
  }
  return report;
}

}  // namespace pipelines

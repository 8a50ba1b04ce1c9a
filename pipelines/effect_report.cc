#include "pipelines/effect_report.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pipelines {
namespace {

using kinetics::LoadHistory;

/// A load as rows: the two of a force, or the one of a torque.
struct Load {
  std::string name;
  const kinetics::Resultant* resultant;
  Eigen::Index first_row, n_rows;
};

std::vector<Load> loads_of(const LoadHistory& history) {
  std::vector<Load> loads;
  for (const auto& resultant : history.resultants) {
    loads.push_back({resultant.role + ".force", &resultant, 0, 2});
    loads.push_back({resultant.role + ".torque", &resultant, 2, 1});
  }
  return loads;
}

Eigen::ArrayXd magnitude(const Load& load, const Eigen::Array3Xd& values) {
  return values.middleRows(load.first_row, load.n_rows).matrix().colwise().norm().transpose();
}

double largest(const Load& load, const Eigen::Array3Xd& values) {
  return magnitude(load, values).maxCoeff();
}

double rms(const Load& load, const Eigen::Array3Xd& values) {
  return std::sqrt(magnitude(load, values).square().mean());
}

std::vector<std::string> without(const std::vector<std::string>& names, const std::vector<std::string>& off) {
  std::vector<std::string> left;
  for (const auto& name : names)
    if (std::find(off.begin(), off.end(), name) == off.end()) left.push_back(name);
  return left;
}

/// Largest change of a load between two histories; a role that is gone carries nothing.
double change(const Load& load, const LoadHistory& other) {
  const Eigen::Array3Xd& before = load.resultant->total;
  if (!other.has_resultant(load.resultant->role)) return largest(load, before);
  return largest(load, before - other.resultant(load.resultant->role).total);
}

struct Change {
  double share = 0;
  std::string load;
};

/// The load that changes most. A load that is nothing but round-off (the torque of a joint that carries none)
/// does not count.
Change worst_change(const LoadHistory& all, const LoadHistory& other) {
  Change worst;
  double scale = 0;
  for (const auto& load : loads_of(all)) scale = std::max(scale, largest(load, load.resultant->total));
  for (const auto& load : loads_of(all)) {
    const double size = largest(load, load.resultant->total);
    if (size <= 1e-12 * scale) continue;
    const double share = change(load, other) / size;
    if (share > worst.share || worst.load.empty()) worst = {share, load.name};
  }
  return worst;
}

std::vector<LoadShare> shares_of(const std::string& effect, const LoadHistory& all,
                                 const LoadHistory* other) {
  std::vector<LoadShare> shares;
  for (const auto& load : loads_of(all)) {
    const double size = largest(load, load.resultant->total), mean = rms(load, load.resultant->total);
    if (size == 0) continue;
    LoadShare share;
    share.load = load.name;
    for (const auto& part : load.resultant->contributions)
      if (part.effect == effect) {
        share.largest = largest(load, part.load) / size;
        share.rms = rms(load, part.load) / mean;
      }
    share.if_off = other ? change(load, *other) / size : std::numeric_limits<double>::quiet_NaN();
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
  } catch (const std::invalid_argument& refused) {
    return {{}, refused.what()};
  }
}

}  // namespace

EffectReport report_effects(const Scene& scene, double threshold, bool timed) {
  if (!(threshold > 0 && threshold < 1))
    throw std::invalid_argument("threshold = " + std::to_string(threshold) +
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
    const Change worst = trial.refusal.empty() ? worst_change(all, trial.history)
                                               : Change{std::numeric_limits<double>::quiet_NaN(), ""};
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
    const Change worst = worst_change(all, trial.history);
    if (worst.share >= threshold) continue;
    report.dispensable = off;
    report.if_all_off = worst.share;
    report.worst_load = worst.load;
  }
  return report;
}

}  // namespace pipelines

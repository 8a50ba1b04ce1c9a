/// What each effect of a scene is worth: its share of every load, what leaving it out would change, and its
/// seconds. So that "simulate only the effects a scene calls for" is a decision with figures.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "kinetics/values/load_history.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// Part of one effect in one load. A load is the force of a resultant (the length of fx, fy), its torque, or
/// what a load table brings besides.
struct LoadShare {
  std::string load;    ///< "<role>.force", "<role>.torque", "<port>.fz", or the quantity's name
  double largest = 0;  ///< largest magnitude of the effect's part over the largest magnitude of the load
  double rms = 0;      ///< the same of the root mean squares
  double if_off = 0;   ///< largest change of the load over the cycle when the effect is left out, over the
                       ///< largest magnitude of the load; NaN where the machine cannot be without it
};

/// Nanoseconds are lost in the noise of a machine that does other things too, so that they have a range.
struct MeasuredTime {
  double median_s = 0;
  double low_s = 0, high_s = 0;  ///< of seven runs without the shortest and the longest

  bool is_seen() const { return low_s > 0; }  ///< more than the runs differ by
};

struct EffectWorth {
  kinetics::EffectInfo effect;
  std::vector<LoadShare> shares;  ///< loads it is part of, or that change without it
  std::string worst_load;         ///< the one that changes most
  double if_off = 0;              ///< its change; NaN where the machine cannot be without the effect
  std::string indispensable;      ///< why the machine cannot be without it; empty if it can
  MeasuredTime per_instant;       ///< of the load stage: with all effects less without this one
};

/// What one part of the machine brings to the loads: effects that it makes together (effect_groups.h).
struct GroupWorth {
  std::string name;
  std::vector<std::string> effects;
  std::vector<LoadShare> shares;  ///< of the sum of their parts
  std::string indispensable;      ///< why the machine cannot be without all of them; empty if it can
};

/// Effects that can be left out together, since they need each other, and the largest change of a load then.
struct EffectStep {
  std::vector<std::string> effects;
  double if_off = 0;
};

struct EffectReport {
  std::vector<EffectWorth> effects;
  std::vector<GroupWorth> groups;  ///< empty where no group has two effects
  double threshold = 0.01;
  std::vector<EffectStep> steps;         ///< of `dispensable`, in its order
  std::vector<std::string> dispensable;  ///< can be left out TOGETHER: the change stays below the threshold
  std::string worst_load;                ///< of leaving all of these out
  double if_all_off = 0;                 ///< its change
  MeasuredTime per_instant;              ///< with all effects
};

/// Runs the load stage with all effects of the scene, and once more without each. Effects are taken from the
/// least to the most important into the list of the dispensable as long as leaving out all of them together
/// changes no load by more than the threshold: effects that cancel each other are not dropped one by one,
/// and those that need each other go together. Of the machine's effects; body_effect_report.h has the
/// bodies'.
/// @param threshold  share of each load's largest magnitude, in (0, 1)
/// @param timed      false: no seconds are measured (they are zero), for tests of repeatability
EffectReport report_effects(const Scene& scene, double threshold, bool timed = true);

/// The load that changes most from one history to another. One that is nothing but round-off (the torque of a
/// joint that carries none) does not count.
LoadChange largest_change(const kinetics::LoadHistory& all, const kinetics::LoadHistory& other);

/// "1.23 %"; "-" where the share is not finite.
std::string percent(double share);

/// Shares of loads below that are counted, not listed.
inline constexpr double negligible_load_share = 0.01;

/// Groups of effects (effect_groups.h), then each effect, by what each is worth to the load that feels it
/// most, and what can be left out.
/// @param all  every share of every load, seconds, descriptions and sources
void print_effects(std::ostream& out, const Scene& scene, const EffectReport& report, bool all);
std::string effects_json(const Scene& scene, const EffectReport& report);

}  // namespace pipelines

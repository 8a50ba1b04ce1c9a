#include "pipelines/search/effect_choice/effect_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "pipelines/base/names/name_lists.h"
#include "pipelines/loads/channels/bearings.h"
#include "pipelines/loads/channels/closure.h"
#include "pipelines/loads/stage/effect_closure.h"
#include "pipelines/scene/whole/body_effects.h"
#include "pipelines/scene/whole/machine_kind.h"
#include "pipelines/search/effect_choice/effect_report.h"

namespace pipelines {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double usual_tolerance = 0.05, tenth = 0.1;

constexpr double indispensable = std::numeric_limits<double>::infinity();

/// Notes effects that go in one step.
void drop_together(const std::vector<std::string>& effects, double share, EffectChoice& choice) {
  for (const auto& effect : effects)
    choice.dropped.push_back({effect, share, names_without(effects, {effect})});
}

double spin_force(const fem::BodyForce& body, const std::vector<RegionMass>& regions) {
  for (const auto& region : regions)
    if (region.volume_ids == body.volume_ids) {
      const auto& m = region.masses;
      return std::sqrt(m.mass_kg * (m.second_moments_kg_m2[0] + m.second_moments_kg_m2[1]));
    }
  return 0;
}

double ratio(const ArrayXd& part, const ArrayXd& whole) {
  const double change = part.size() > 0 ? part.maxCoeff() : 0;
  if (change == 0) return 0;
  const double scale = whole.maxCoeff();
  return scale > 0 ? change / scale : std::numeric_limits<double>::infinity();
}

class Judge {
public:
  /// @throws SceneError if even all effects together leave a body without equilibrium
  Judge(const Scene& scene, const std::vector<MeshedBody>& meshed)
      : scene_(scene),
        meshed_(meshed),
        masses_(agree_masses(scene, meshed)),
        all_(try_effects(scene, meshed, masses_)) {
    require_equilibrium(scene, meshed, masses_, all_.bodies);
  }

  /// What has to be off with these, so that the rest is admissible; empty: the scene cannot be without them.
  std::optional<ClosedSet> closed(const std::vector<std::string>& off) const {
    return closed_set(scene_, meshed_, masses_, off);
  }

  /// Share of the loads that changes with others in their place; infinite if a bearing loses its load.
  double change(const EffectTrial& left) const {
    double worst = 0;
    for (std::size_t i = 0; i < meshed_.size(); ++i)
      worst = std::max(worst, share_of_loads(all_.bodies[i], left.bodies[i], meshed_[i].regions));
    for (const auto& bearing : scene_.bearings) {
      const auto before = force_of(bearing.load, all_.history, channels(all_)),
                 after = force_of(bearing.load, left.history, channels(left));
      if (before && !after) return indispensable;
      if (before) worst = std::max(worst, ratio((*before - *after).abs(), before->abs()));
    }
    return worst;
  }

  LoadChange change_of_loads(const EffectTrial& left) const {
    return largest_change(all_.history, left.history);
  }

private:
  static std::vector<const ChannelHistory*> channels(const EffectTrial& trial) {
    std::vector<const ChannelHistory*> result;
    for (const auto& body : trial.bodies) result.push_back(&body.history);
    return result;
  }

  const Scene& scene_;
  const std::vector<MeshedBody>& meshed_;
  MassAgreement masses_;
  EffectTrial all_;
};

/// Effects that go together, and the share of the loads that changes with them.
struct Candidate {
  std::vector<std::string> effects;
  double share = indispensable;
};

/// One for each effect: it and what needs it; from the least to the most important. What the scene cannot be
/// without comes last: others may have gone by then.
std::vector<Candidate> candidates_of(const Scene& scene, const Judge& judge) {
  std::vector<Candidate> candidates;
  for (const auto& effect : scene.effects) {
    const auto group = judge.closed({effect});
    Candidate candidate{group ? group->off : std::vector<std::string>{effect}};
    if (group) candidate.share = judge.change(group->trial);
    const auto is_same = [&](const Candidate& other) { return other.effects == candidate.effects; };
    if (std::none_of(candidates.begin(), candidates.end(), is_same))
      candidates.push_back(std::move(candidate));
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.share < b.share; });
  return candidates;
}

/// What the choice comes to for bodies: effects in the order of their worth, those that need each other
/// together. Every set on the way is admissible.
void choose_for_bodies(Scene& scene, const std::vector<MeshedBody>& meshed) {
  const Judge judge(scene, meshed);
  auto& choice = scene.effect_choice;
  std::vector<std::string> off;
  for (const auto& candidate : candidates_of(scene, judge)) {
    if (candidate.share >= choice.limit && candidate.share != indispensable) continue;
    auto more = off;
    for (const auto& effect : candidate.effects)
      if (!contains(off, effect)) more.push_back(effect);
    if (more.size() == off.size()) continue;
    const auto closed = judge.closed(more);
    if (!closed) continue;
    const double together = judge.change(closed->trial);
    if (together >= choice.limit) continue;
    const double alone = candidate.share == indispensable ? together - choice.share : candidate.share;
    drop_together(names_without(closed->off, off), alone, choice);
    choice.share = together;
    choice.load_change = judge.change_of_loads(closed->trial);
    off = closed->off;
  }
  scene.effects = names_without(scene.effects, off);
}

void choose_by_loads(Scene& scene) {
  const auto report = report_effects(scene, scene.effect_choice.limit, false);
  auto& choice = scene.effect_choice;
  for (const auto& step : report.steps) drop_together(step.effects, step.if_off, choice);
  if (report.dispensable.empty()) return;
  choice.share = report.if_all_off;
  choice.load_change = {report.if_all_off, report.worst_load};
  scene.effects = names_without(scene.effects, report.dispensable);
}

}  // namespace

double negligible_share(double tolerance) {
  return tenth * (tolerance > 0 ? tolerance : usual_tolerance);
}

UnitSize size_of_unit(const fem::UnitLoad& load, const std::vector<RegionMass>& regions) {
  if (const auto* pressure = std::get_if<fem::SeatPressure>(&load.shape))
    return {std::abs(pressure->coefficient), 0};
  const auto w = wanted_resultant(load, regions);
  UnitSize size{std::hypot(w[0], w[1], w[2]), std::hypot(w[3], w[4], w[5])};
  const auto* body = std::get_if<fem::BodyForce>(&load.shape);
  if (body != nullptr && body->field == fem::BodyForce::Field::spin)
    size.force = std::max(size.force, spin_force(*body, regions));
  return size;
}

double share_of_loads(const BodyLoads& all, const BodyLoads& other, const std::vector<RegionMass>& regions) {
  const Index n = all.history.values.cols();
  ArrayXd force = ArrayXd::Zero(n), moment = force, force_change = force, moment_change = force;
  const auto add = [&](const fem::UnitLoad& load, const ArrayXd& before, const ArrayXd& after) {
    const UnitSize size = size_of_unit(load, regions);
    force += size.force * before.abs();
    moment += size.moment * before.abs();
    force_change += size.force * (before - after).abs();
    moment_change += size.moment * (before - after).abs();
  };
  std::map<std::string, Index> rows;
  for (std::size_t k = 0; k < other.unit_loads.size(); ++k) rows[other.unit_loads[k].channel] = Index(k);
  for (std::size_t k = 0; k < all.unit_loads.size(); ++k) {
    const auto found = rows.find(all.unit_loads[k].channel);
    const ArrayXd before = all.history.values.row(Index(k)).transpose();
    add(all.unit_loads[k], before,
        found == rows.end() ? ArrayXd::Zero(n).eval()
                            : ArrayXd(other.history.values.row(found->second).transpose()));
    if (found != rows.end()) rows.erase(found);
  }
  for (const auto& [channel, k] : rows)  // that only the other one has
    add(other.unit_loads[std::size_t(k)], ArrayXd::Zero(n), other.history.values.row(k).transpose());
  return std::max(ratio(force_change, force), ratio(moment_change, moment));
}

Scene with_effects_chosen(Scene scene, const std::vector<MeshedBody>& meshed, double limit) {
  auto& choice = scene.effect_choice;
  if (!choice.open) return scene;
  choice.open = false;
  choice.limit = limit;
  if (kind_of(scene.machine).has_samples() || scene.run_up) return scene;
  meshed.empty() ? choose_by_loads(scene) : choose_for_bodies(scene, meshed);
  return scene;
}

bool has_what_it_needs(const Scene& scene) {
  return open_needs(effect_table(scene), scene.effects).empty();
}

Scene with_effect_back(Scene scene, const std::string& effect) {
  auto& choice = scene.effect_choice;
  auto on = scene.effects;
  std::vector<std::string> back{effect};
  for (std::size_t i = 0; i < back.size(); ++i) {  // more join on the way
    on.push_back(back[i]);
    const auto join = [&](const std::string& other) {
      if (!contains(on, other) && !contains(back, other)) back.push_back(other);
    };
    for (const auto& dropped : choice.dropped)
      if (dropped.effect == back[i]) std::for_each(dropped.with.begin(), dropped.with.end(), join);
    for (const auto& open : open_needs(effect_table(scene), on)) join(open.need.effect);
  }
  choice.dropped.erase(std::remove_if(choice.dropped.begin(), choice.dropped.end(),
                                      [&](const auto& dropped) { return contains(back, dropped.effect); }),
                       choice.dropped.end());
  choice.taken_back.insert(choice.taken_back.end(), back.begin(), back.end());
  return with_effects(std::move(scene), on);
}

Scene with_effects(Scene scene, const std::vector<std::string>& effects) {
  const auto& offered = scene.effect_choice.offered;
  scene.effects.clear();
  std::copy_if(offered.begin(), offered.end(), std::back_inserter(scene.effects),
               [&](const auto& effect) { return contains(effects, effect); });
  return scene;
}

}  // namespace pipelines

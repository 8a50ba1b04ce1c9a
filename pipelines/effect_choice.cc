#include "pipelines/effect_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "kinetics/machine_refused.h"
#include "pipelines/body_analysis.h"
#include "pipelines/closure.h"
#include "pipelines/contains.h"
#include "pipelines/effect_report.h"
#include "pipelines/errors.h"
#include "pipelines/load_stage.h"
#include "pipelines/scene_effects.h"

namespace pipelines {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double usual_tolerance = 0.05, tenth = 0.1;

std::vector<std::string> without(const std::vector<std::string>& names, const std::vector<std::string>& off) {
  std::vector<std::string> left;
  std::remove_copy_if(names.begin(), names.end(), std::back_inserter(left),
                      [&](const auto& name) { return contains(off, name); });
  return left;
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

/// The loads of a scene with some of its effects.
struct Trial {
  kinetics::LoadHistory history;
  std::vector<BodyLoads> bodies;
};

class Judge {
public:
  Judge(const Scene& scene, const std::vector<MeshedBody>& meshed)
      : scene_(scene), meshed_(meshed), masses_(agree_masses(scene, meshed)), all_(*trial({})) {}

  /// Share of the loads that changes without these effects; empty: the machine cannot be without them.
  std::optional<double> change(const std::vector<std::string>& off) const {
    const auto left = trial(off);
    if (!left) return std::nullopt;
    double worst = 0;
    for (std::size_t i = 0; i < meshed_.size(); ++i)
      worst = std::max(worst, share_of_loads(all_.bodies[i], left->bodies[i], meshed_[i].regions));
    for (const auto& bearing : scene_.bearings) {
      const auto before = force_of(bearing.load, all_.history, channels(all_)),
                 after = force_of(bearing.load, left->history, channels(*left));
      if (before && after) worst = std::max(worst, ratio((*before - *after).abs(), before->abs()));
      if (before && !after) return std::nullopt;
    }
    return worst;
  }

  LoadChange change_of_loads(const std::vector<std::string>& off) const {
    return largest_change(all_.history, trial(off)->history);
  }

private:
  std::optional<Trial> trial(const std::vector<std::string>& off) const {
    const Scene scene = with_effects(scene_, without(scene_.effects, off));
    if (scene.kinetics_effects().empty() || !has_what_it_needs(scene)) return std::nullopt;
    try {
      Trial result{load_stage(scene, masses_.machine), {}};
      for (std::size_t i = 0; i < meshed_.size(); ++i)
        result.bodies.push_back(distribute_body(scene, scene.bodies[i], result.history,
                                                loaded_body(scene.bodies[i], meshed_[i]), masses_));
      return result;
    } catch (const kinetics::MachineRefused&) {
      if (off.empty()) throw;
      return std::nullopt;
    } catch (const StageRefused&) {
      if (off.empty()) throw;
      return std::nullopt;
    }
  }

  static std::vector<const ChannelHistory*> channels(const Trial& trial) {
    std::vector<const ChannelHistory*> result;
    for (const auto& body : trial.bodies) result.push_back(&body.history);
    return result;
  }

  const Scene& scene_;
  const std::vector<MeshedBody>& meshed_;
  MassAgreement masses_;
  Trial all_;
};

/// What the choice comes to for bodies: effects in the order of their worth.
void choose_for_bodies(Scene& scene, const std::vector<MeshedBody>& meshed) {
  const Judge judge(scene, meshed);
  struct Candidate {
    std::string effect;
    double share;
  };
  constexpr double indispensable = std::numeric_limits<double>::infinity();
  std::vector<Candidate> candidates;
  for (const auto& effect : scene.effects)
    candidates.push_back({effect, judge.change({effect}).value_or(indispensable)});
  // What others build on comes last: these may have gone by then.
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.share < b.share; });
  auto& choice = scene.effect_choice;
  std::vector<std::string> off;
  for (const auto& candidate : candidates) {
    if (candidate.share >= choice.limit && candidate.share != indispensable) continue;
    auto more = off;
    more.push_back(candidate.effect);
    const auto together = judge.change(more);
    if (!together || *together >= choice.limit) continue;
    const double alone = candidate.share == indispensable ? *together - choice.share : candidate.share;
    choice.dropped.push_back({candidate.effect, alone});
    choice.share = *together;
    off = more;
  }
  if (off.empty()) return;
  choice.load_change = judge.change_of_loads(off);
  scene.effects = without(scene.effects, off);
}

void choose_by_loads(Scene& scene) {
  const auto report = report_effects(scene, scene.effect_choice.limit, false);
  Scene left = with_effects(scene, without(scene.effects, report.dispensable));
  if (report.dispensable.empty() || !has_what_it_needs(left)) return;
  auto& choice = left.effect_choice;
  for (const auto& effect : report.dispensable)
    for (const auto& worth : report.effects)
      if (worth.effect.name == effect) choice.dropped.push_back({effect, worth.if_off});
  choice.share = report.if_all_off;
  choice.load_change = {report.if_all_off, report.worst_load};
  scene = std::move(left);
}

/// Of the scene's machine; only vibratory mills have such rules.
std::vector<EffectNeed> needs_of(const Scene& scene) {
  const auto* mill = std::get_if<kinetics::VibratoryMill>(&scene.machine);
  return mill ? vibratory_mill_rules(mill->convention, true).needs : std::vector<EffectNeed>{};
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
  if (std::holds_alternative<kinetics::LoadTable>(scene.machine) || scene.run_up) return scene;
  meshed.empty() ? choose_by_loads(scene) : choose_for_bodies(scene, meshed);
  return scene;
}

bool has_what_it_needs(const Scene& scene) {
  const auto needs = needs_of(scene);
  return std::none_of(needs.begin(), needs.end(), [&](const auto& need) {
    return scene.has_effect(need.effect) && !scene.has_effect(need.needed);
  });
}

Scene with_effect_back(Scene scene, const std::string& effect) {
  auto& choice = scene.effect_choice;
  auto on = scene.effects;
  on.push_back(effect);
  choice.dropped.erase(std::remove_if(choice.dropped.begin(), choice.dropped.end(),
                                      [&](const auto& dropped) { return dropped.effect == effect; }),
                       choice.dropped.end());
  choice.taken_back.push_back(effect);
  scene = with_effects(std::move(scene), on);
  for (const auto& need : needs_of(scene))
    if (need.effect == effect && !scene.has_effect(need.needed))
      return with_effect_back(std::move(scene), need.needed);
  return scene;
}

Scene with_effects(Scene scene, const std::vector<std::string>& effects) {
  const auto& offered = scene.effect_choice.offered;
  scene.effects.clear();
  std::copy_if(offered.begin(), offered.end(), std::back_inserter(scene.effects),
               [&](const auto& effect) { return contains(effects, effect); });
  return scene;
}

}  // namespace pipelines

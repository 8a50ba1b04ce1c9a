#include "pipelines/search/effect_choice/effect_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "kinetics/values/machine_refused.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/analysis/stress_under_changed_loads.h"
#include "pipelines/search/effect_choice/effect_choice.h"

namespace pipelines {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;
using Component = fem::SurfaceResultant::Component;

/// A rigid acceleration of the whole body: its unit load is balanced by itself.
bool makes_no_stress(const fem::UnitLoad& load) {
  const auto* body = std::get_if<fem::BodyForce>(&load.shape);
  return body != nullptr && body->volume_ids.empty() && body->field != fem::BodyForce::Field::spin;
}

/// Whether a channel is a force (true) or a moment at a port; neither for the others.
std::optional<bool> is_port_force(const fem::UnitLoad& load) {
  const auto* surface = std::get_if<fem::SurfaceResultant>(&load.shape);
  if (surface == nullptr) return std::nullopt;
  return surface->component <= Component::fz;
}

/// A difference of loads: on the channels that were solved, and the size of the rest.
struct Difference {
  ArrayXXd solved;
  double unsolved_N = 0, unsolved_Nm = 0;
};

/// loads `a` less loads `b`.
Difference difference(const BodyLoads& a, const BodyLoads& b, const Responded& analysis,
                      const std::vector<RegionMass>& regions) {
  std::map<std::string, Index> solved;
  const auto& own = analysis.loads.unit_loads;
  for (std::size_t k = 0; k < own.size(); ++k) solved[own[k].channel] = Index(k);
  Difference result{ArrayXXd::Zero(Index(own.size()), analysis.loads.history.values.cols())};
  std::map<std::string, std::pair<fem::UnitLoad, Eigen::ArrayXd>> rest;
  for (const auto& [loads, sign] : {std::pair{&a, 1.0}, {&b, -1.0}})
    for (std::size_t k = 0; k < loads->unit_loads.size(); ++k) {
      const auto& load = loads->unit_loads[k];
      const Eigen::ArrayXd values = sign * loads->history.values.row(Index(k)).transpose();
      if (const auto found = solved.find(load.channel); found != solved.end()) {
        result.solved.row(found->second) += values.transpose();
      } else if (!makes_no_stress(load)) {
        const auto [entry, is_first] = rest.try_emplace(load.channel, load, values);
        if (!is_first) entry->second.second += values;
      }
    }
  for (const auto& [channel, entry] : rest) {
    const auto size = size_of_unit(entry.first, regions);
    const double largest = entry.second.abs().maxCoeff();
    (size.force > 0 ? result.unsolved_N : result.unsolved_Nm) +=
        (size.force > 0 ? size.force : size.moment) * largest;
  }
  return result;
}

/// Stress at a point from loads that were not solved: each force at the worst port.
MoreStress estimate(const Difference& change, const Responded& analysis) {
  return [&change, &analysis](const double* unit) {
    if (change.unsolved_N == 0 && change.unsolved_Nm == 0) return 0.0;
    double per_N = 0, per_Nm = 0;
    bool has_force = false, has_moment = false;
    const auto& loads = analysis.loads.unit_loads;
    for (std::size_t k = 0; k < loads.size(); ++k) {
      const auto is_force = is_port_force(loads[k]);
      if (!is_force) continue;
      Stress s;
      std::copy_n(unit + 6 * k, 6, s.begin());
      double& most = *is_force ? per_N : per_Nm;
      (*is_force ? has_force : has_moment) = true;
      most = std::max(most, von_mises_Pa(s));
    }
    if ((change.unsolved_N > 0 && !has_force) || (change.unsolved_Nm > 0 && !has_moment))
      return std::numeric_limits<double>::infinity();  // nothing to compare with: the effect has to come back
    return change.unsolved_N * per_N + change.unsolved_Nm * per_Nm;
  };
}

double governing_Pa(const LargestStresses& stresses, const Judged& analysis) {
  return governing_stress(analysis).kind == GoverningStress::Kind::peak ? stresses.peak_Pa
                                                                        : stresses.hot_spot_Pa;
}

/// How much further both stresses may go.
LargestStresses bound(const Difference& change, const Judged& analysis, bool with_unsolved) {
  const MoreStress none = [](const double*) { return 0.0; };
  const auto most = bound_under(analysis, change.solved, with_unsolved ? estimate(change, analysis) : none);
  const auto own = largest_stresses(analysis);
  return {std::max(0.0, most.peak_Pa - own.peak_Pa), std::max(0.0, most.hot_spot_Pa - own.hot_spot_Pa)};
}

EffectBound effect_bound(const std::string& effect, const Difference& change, const Judged& analysis) {
  EffectBound result;
  result.effect = effect;
  result.bound_Pa = governing_Pa(bound(change, analysis, true), analysis);
  if (change.unsolved_N > 0 || change.unsolved_Nm > 0)
    result.estimated_Pa = result.bound_Pa - governing_Pa(bound(change, analysis, false), analysis);
  return result;
}

}  // namespace

void bound_dropped_effects(const Loaded& loaded, std::size_t index, Judged& analysis) {
  const auto& scene = loaded.scene;
  const auto& choice = scene.effect_choice;
  if (choice.dropped.empty()) return;
  const auto& regions = loaded.meshed[index].regions;
  const auto loads_with = [&](const std::vector<std::string>& effects) -> std::optional<BodyLoads> {
    const Scene other = with_effects(scene, effects);
    if (!has_what_it_needs(other)) return std::nullopt;
    try {
      const auto history = load_stage(other, loaded.masses.machine);
      return distribute_body(other, other.bodies[index], history,
                             loaded_body(other.bodies[index], loaded.meshed[index]), loaded.masses);
    } catch (const kinetics::MachineRefused&) {  // it needs another one that is off
      return std::nullopt;
    } catch (const StageRefused&) {
      return std::nullopt;
    }
  };
  auto effects = scene.effects;
  for (const auto& dropped : choice.dropped) effects.push_back(dropped.effect);
  const BodyLoads all = loads_with(effects).value();

  DroppedBounds bounds;
  for (const auto& dropped : choice.dropped) {
    auto on = scene.effects, off = effects, group = dropped.with;
    group.push_back(dropped.effect);
    on.insert(on.end(), group.begin(), group.end());
    off.erase(std::remove_if(off.begin(), off.end(), [&](const auto& e) { return contains(group, e); }),
              off.end());
    if (const auto with = loads_with(on))
      bounds.effects.push_back(
          effect_bound(dropped.effect, difference(*with, analysis.loads, analysis, regions), analysis));
    else if (const auto without = loads_with(off))
      bounds.effects.push_back(
          effect_bound(dropped.effect, difference(all, *without, analysis, regions), analysis));
  }
  const auto together = difference(all, analysis.loads, analysis, regions);
  bounds.together = effect_bound("", together, analysis);
  const auto both = bound(together, analysis, true);
  const std::string method =
      std::string("von Mises stress of the loads that effects = \"auto\" leaves out") +
      (bounds.together.estimated_Pa > 0 ? "; what was not solved as its forces at the worst port" : "");
  analysis.peak.errors.set_model({"dropped_effects", method, both.peak_Pa});
  if (!analysis.hot_spots.empty())
    analysis.hot_spot_errors.set_model({"dropped_effects", method, both.hot_spot_Pa});
  analysis.dropped = std::move(bounds);
}

std::string effect_to_take_back(const Scene& scene, const std::vector<Judged>& analyses) {
  for (const auto& analysis : analyses) {
    if (!analysis.dropped) continue;
    const double stress_Pa = governing_stress(analysis).value_Pa;
    if (analysis.dropped->together.bound_Pa <= scene.effect_choice.limit * stress_Pa) continue;
    const auto& bounds = analysis.dropped->effects;
    const auto worst = std::max_element(bounds.begin(), bounds.end(),
                                        [](const auto& a, const auto& b) { return a.bound_Pa < b.bound_Pa; });
    return worst == bounds.end() ? scene.effect_choice.dropped.back().effect : worst->effect;
  }
  return "";
}

}  // namespace pipelines

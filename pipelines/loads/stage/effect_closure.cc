#include "pipelines/loads/stage/effect_closure.h"

#include <algorithm>
#include <array>

#include "kinetics/values/machine_refused.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/loads/stage/body_loads.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/scene/whole/body_effects.h"

namespace pipelines {
namespace {

using Eigen::Index;
using Names = std::vector<std::string>;

std::vector<std::array<double, 6>> wanted_resultants(const BodyLoads& loads,
                                                     const std::vector<RegionMass>& regions) {
  std::vector<std::array<double, 6>> wanted;
  for (const auto& load : loads.unit_loads) wanted.push_back(wanted_resultant(load, regions));
  return wanted;
}

/// Largest over the instants of the sum over the channels, by component: fx, fy, fz [N], mx, my, mz [N m]
/// about the origin.
std::array<double, 6> residual(const Eigen::ArrayXXd& channels,
                               const std::vector<std::array<double, 6>>& resultants) {
  std::array<double, 6> largest{};
  for (std::size_t c = 0; c < 6 && channels.cols() > 0; ++c) {
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(channels.cols());
    for (std::size_t k = 0; k < resultants.size(); ++k)
      sum += resultants[k][c] * channels.row(Index(k)).transpose();
    largest[c] = sum.abs().maxCoeff();
  }
  return largest;
}

double largest_of(const std::array<double, 3>& values) {
  return *std::max_element(values.begin(), values.end());
}

/// Effects that some body's equilibrium lacks the counterpart of; empty optional: it lacks something, or all
/// loads, and no effect can be told.
std::optional<Names> unbalanced_in(const EffectTrial& trial, const std::vector<MeshedBody>& meshed) {
  Names unbalanced;
  for (std::size_t i = 0; i < trial.bodies.size(); ++i) {
    const auto& loads = trial.bodies[i];
    if (loads.unit_loads.empty()) return std::nullopt;
    if (closure_of(loads, meshed[i].regions).holds()) continue;
    const auto own = unbalanced_effects(loads, meshed[i].regions);
    if (own.empty()) return std::nullopt;
    unbalanced.insert(unbalanced.end(), own.begin(), own.end());
  }
  return unbalanced;
}

}  // namespace

EffectTrial try_effects(const Scene& scene, const std::vector<MeshedBody>& meshed,
                        const MassAgreement& masses) {
  EffectTrial trial{load_stage(scene, masses.machine), {}};
  for (std::size_t i = 0; i < meshed.size(); ++i)
    trial.bodies.push_back(distribute_body(scene, scene.bodies[i], trial.history,
                                           loaded_body(scene.bodies[i], meshed[i]), masses));
  return trial;
}

Closure closure_of(const BodyLoads& loads, const std::vector<RegionMass>& regions) {
  return check_closure(loads, wanted_resultants(loads, regions), regions);
}

Names unbalanced_effects(const BodyLoads& loads, const std::vector<RegionMass>& regions) {
  const auto resultants = wanted_resultants(loads, regions);
  const auto closure = check_closure(loads, resultants, regions);
  const double force_N = largest_of(closure.force_scale_N), moment_Nm = largest_of(closure.moment_scale_Nm);
  Names unbalanced;
  for (std::size_t e = 0; e < loads.history.effects.size(); ++e) {
    const auto rest = residual(loads.history.by_effect[e], resultants);
    if (std::max({rest[0], rest[1], rest[2]}) > Closure::limit * force_N ||
        std::max({rest[3], rest[4], rest[5]}) > Closure::limit * moment_Nm)
      unbalanced.push_back(loads.history.effects[e]);
  }
  return unbalanced;
}

bool is_admissible(const EffectTrial& trial, const std::vector<MeshedBody>& meshed) {
  for (std::size_t i = 0; i < trial.bodies.size(); ++i)
    if (trial.bodies[i].unit_loads.empty() || !closure_of(trial.bodies[i], meshed[i].regions).holds())
      return false;
  return true;
}

std::optional<ClosedSet> closed_set(const Scene& scene, const std::vector<MeshedBody>& meshed,
                                    const MassAgreement& masses, Names off) {
  const auto table = effect_table(scene);
  Scene left = scene;
  while (true) {
    off = with_dependents(table, scene.effects, off);
    left.effects = names_without(scene.effects, off);
    if (left.kinetics_effects().empty()) return std::nullopt;
    ClosedSet result{off, {}};
    try {
      result.trial = try_effects(left, meshed, masses);
    } catch (const kinetics::MachineRefused&) {  // the load stage cannot do without them
      return std::nullopt;
    } catch (const StageRefused&) {
      return std::nullopt;
    }
    const auto unbalanced = unbalanced_in(result.trial, meshed);
    if (!unbalanced) return std::nullopt;
    if (unbalanced->empty()) return result;
    for (const auto& effect : *unbalanced) {
      if (!contains(scene.effects, effect)) return std::nullopt;  // a body's own guide: no effect's fault
      off.push_back(effect);
    }
  }
}

}  // namespace pipelines

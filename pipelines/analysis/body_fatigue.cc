#include "pipelines/analysis/body_fatigue.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "kinetics/load_spectrum.h"
#include "pipelines/analysis/hot_spots.h"
#include "pipelines/analysis/place_stress.h"
#include "pipelines/analysis/stress_gradient.h"
#include "pipelines/common/errors.h"
#include "pipelines/common/nearest_name.h"
#include "pipelines/fatigue/critical_plane.h"
#include "pipelines/fatigue/endurance.h"
#include "pipelines/fatigue/sn_curve.h"
#include "pipelines/fatigue/weld_fatigue.h"
#include "pipelines/superposition/stress_shares.h"

namespace pipelines {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;

constexpr double never = std::numeric_limits<double>::infinity();

/// The rules with the factors of one scene.
class Rules {
public:
  explicit Rules(const FatigueScene& scene)
      : scene_(scene),
        factor_(reliability_factor_of_97_5(scene.reliability) *
                (scene.endurance_Pa ? *scene.endurance_Pa / reversed_strength_Pa(scene.material) : 1.0)) {}

  EnduranceLimit limit(double gradient_per_m, const CyclicStress& stress) const {
    SurfaceState surface;
    surface.roughness_m = scene_.roughness_m;
    surface.treatment_factor = scene_.treatment;
    auto limit =
        endurance_limit(scene_.material, StressKind::normal, gradient_per_m, surface, stress, scene_.safety);
    limit.reversed_Pa *= factor_;
    limit.amplitude_Pa *= factor_;
    limit.utilisation /= factor_;
    return limit;
  }

  /// The least that any mean leaves of the endurance limit, over that without mean: field IV of the diagram.
  double least_mean_stress_factor() const { return limit(0, {0, 1}).amplitude_Pa / limit(0, {}).reversed_Pa; }

  const FatigueScene& scene() const { return scene_; }
  const GroupConstants& group() const { return constants_of(scene_.material.group); }

private:
  const FatigueScene& scene_;
  double factor_;
};

CyclicStress scalar(const StressCycle& cycle) {
  return {cycle.amplitude_Pa, cycle.signed_mean_Pa};
}

/// Counted cycles as amplitudes at R = -1. Means are those along the largest cycle; that one has the mean of
/// its tensors, so that stress across it counts too.
std::vector<StressBlock> reversed_blocks(const std::vector<kinetics::LoadCycle>& counted,
                                         const StressCycle& largest, double sensitivity) {
  double most = 0;
  for (const auto& cycle : counted) most = std::max(most, cycle.range);
  std::vector<StressBlock> blocks;
  for (const auto& cycle : counted) {
    const double mean = cycle.range == most ? largest.signed_mean_Pa : cycle.mean;
    blocks.push_back({equivalent_reversed_amplitude_Pa({cycle.range / 2, mean}, sensitivity), cycle.count});
  }
  return blocks;
}

/// At the design limit. Where one cycle is above the knee, those below it count by the same slope (Miner's
/// elementary rule): damage lowers the limit.
SnCurve design_curve(const Rules& rules, const EnduranceLimit& limit,
                     const std::vector<StressBlock>& blocks) {
  const auto& group = rules.group();
  SnCurve curve{limit.reversed_Pa / rules.scene().safety, group.knee_cycles, group.slope_normal,
                group.second_slope_normal};
  const bool above = std::any_of(blocks.begin(), blocks.end(), [&](const auto& block) {
    return block.amplitude_Pa > curve.knee_amplitude_Pa;
  });
  if (above && !curve.second_slope) curve.second_slope = curve.slope;
  return curve;
}

void take_life(const Rules& rules, const ArrayXXd& stress_Pa, const EnduranceLimit& limit,
               const LoadPeriod& period, FatiguePlace& place) {
  if (!(place.cycle.amplitude_Pa > 0)) return;
  const auto counted = kinetics::rainflow_repeating(along_cycle_Pa(stress_Pa, place.cycle));
  place.n_counted = counted.size();
  const auto blocks = reversed_blocks(counted, place.cycle, limit.mean_stress_sensitivity);
  const auto curve = design_curve(rules, limit, blocks);
  const double damage = miner_damage(curve, blocks);
  place.damage_per_turn = damage / period.turns;
  if (damage > 0) place.life_s = period.duration_s / damage;
  if (const auto wanted = rules.scene().wanted_life_s)
    place.life_safety = life_factor(curve, blocks, *wanted / period.duration_s);
}

SecondOpinions second_opinions(const Rules& rules, const ArrayXXd& stress_Pa, const EnduranceLimit& limit,
                               const StressCycle& cycle) {
  const auto& material = rules.scene().material;
  const auto lines = mean_stress_safety(
      scalar(cycle), {limit.reversed_Pa, material.tensile_strength_Pa, material.yield_strength_Pa});
  SecondOpinions others{lines.goodman, lines.gerber, lines.soderberg, never};
  const double shear = rules.group().f_W_tau;
  if (cycle.amplitude_Pa > 0 && shear > 0.5 && shear < 1) {
    const auto plane =
        findley(stress_Pa.matrix(), findley_limit(limit.reversed_Pa, shear * limit.reversed_Pa));
    if (plane.utilisation > 0) others.findley = 1 / plane.utilisation;
  }
  return others;
}

double error_share_of(const BodyAnalysis& analysis, const std::string& feature) {
  for (const auto& place : analysis.place_stresses)
    if (place.feature == feature) return place.value_Pa > 0 ? place.error_Pa / place.value_Pa : 0;
  return never;
}

/// Finds the node of a feature that is used up most: nodes are looked at by falling bound of their amplitude,
/// until no other can reach what is found.
class PlaceSearch {
public:
  PlaceSearch(const BodyAnalysis& analysis, const Rules& rules, const LoadPeriod& period)
      : analysis_(analysis),
        rules_(rules),
        period_(period),
        slopes_(analysis.responses.nodes),
        half_ranges_(0.5 * (analysis.loads.history.values.rowwise().maxCoeff() -
                            analysis.loads.history.values.rowwise().minCoeff())),
        most_per_Pa_(rules.scene().safety /
                     (rules.limit(0, {}).reversed_Pa * rules.least_mean_stress_factor())) {}

  FatiguePlace worst_of(const std::string& feature, const std::vector<std::size_t>& nodes) const {
    std::vector<std::pair<double, std::size_t>> by_bound;
    for (const auto node : nodes) by_bound.emplace_back(most_amplitude_Pa(node), node);
    std::stable_sort(by_bound.begin(), by_bound.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    FatiguePlace worst;
    worst.utilisation = -1;
    for (const auto& [bound_Pa, node] : by_bound) {
      if (most_per_Pa_ * bound_Pa <= worst.utilisation) break;
      auto place = at(node);
      if (place.utilisation > worst.utilisation) worst = std::move(place);
    }
    return finished(feature, std::move(worst));
  }

private:
  /// Half of the difference of two stresses has at most the larger von Mises stress of both, and at most the
  /// sum of the channels' own: exact zero where no channel changes.
  double most_amplitude_Pa(std::size_t node) const {
    const auto unit = unit_stresses_at(analysis_.responses, node);
    double of_channels_Pa = 0;
    for (Index k = 0; k < unit.cols(); ++k) {
      Stress s{};
      Eigen::Map<Eigen::Matrix<double, 6, 1>>(s.data()) = unit.col(k);
      of_channels_Pa += half_ranges_[k] * von_mises_Pa(s);
    }
    return std::min(of_channels_Pa, analysis_.envelope.von_mises.value_Pa[node]);
  }

  FatiguePlace at(std::size_t node) const {
    FatiguePlace place;
    place.node = node;
    place.cycle = largest_cycle(stress_history_Pa(analysis_.responses, analysis_.loads.history, node));
    place.utilisation = rules_.limit(0, scalar(place.cycle)).utilisation;
    if (analysis_.method == Method::beam || !(place.cycle.amplitude_Pa > 0)) return place;
    const auto& values = analysis_.loads.history.values;
    const Eigen::VectorXd half = 0.5 * (values.col(place.cycle.to) - values.col(place.cycle.from)).matrix();
    place.gradient_per_m = slopes_.related_gradient_per_m(node, [&](std::size_t other) {
      Stress s{};
      Eigen::Map<Eigen::Matrix<double, 6, 1>>(s.data()) = unit_stresses_at(analysis_.responses, other) * half;
      return von_mises_Pa(s);
    });
    place.utilisation = rules_.limit(place.gradient_per_m, scalar(place.cycle)).utilisation;
    return place;
  }

  FatiguePlace finished(const std::string& feature, FatiguePlace place) const {
    place.feature = feature;
    place.surface = analysis_.places.place[place.node];
    std::copy_n(&analysis_.responses.nodes.xyz_m[3 * place.node], 3, place.position_m.begin());
    const auto limit = rules_.limit(place.gradient_per_m, scalar(place.cycle));
    place.support = limit.support;
    place.endurance_Pa = limit.amplitude_Pa;
    place.safety = place.cycle.amplitude_Pa > 0 ? limit.amplitude_Pa / place.cycle.amplitude_Pa : never;
    const auto stress_Pa = stress_history_Pa(analysis_.responses, analysis_.loads.history, place.node);
    take_life(rules_, stress_Pa, limit, period_, place);
    place.others = second_opinions(rules_, stress_Pa, limit, place.cycle);
    place.effect_share = shares_of_change(unit_stresses_at(analysis_.responses, place.node),
                                          analysis_.loads.history, place.cycle.from, place.cycle.to)
                             .effects;
    place.error_share = error_share_of(analysis_, feature);
    return place;
  }

  const BodyAnalysis& analysis_;
  const Rules& rules_;
  LoadPeriod period_;
  SurfaceSlopes slopes_;
  Eigen::ArrayXd half_ranges_;  // of the channels
  double most_per_Pa_;          // bound of the utilisation per von Mises stress
};

/// The nodes of each feature outside the exclusion distances; one on a seam belongs to both.
std::map<std::string, std::vector<std::size_t>> nodes_by_feature(const BodyAnalysis& analysis) {
  const auto& nodes = analysis.responses.nodes;
  std::map<int, std::string> name_of;
  for (const auto& feature : analysis.mesh.features) name_of[feature.boundary_id] = feature.name;
  std::map<std::string, std::vector<std::size_t>> result;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f)
    for (const auto node : nodes.face(f))
      if (!analysis.places.excluded[std::size_t(node)])
        result[name_of.at(nodes.face_boundary_id[f])].push_back(std::size_t(node));
  for (auto& [name, list] : result) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return result;
}

std::vector<std::string> assumptions_of(const Rules& rules, const BodyAnalysis& analysis) {
  const auto& scene = rules.scene();
  const auto limit = rules.limit(0, {});
  std::vector<std::string> lines;
  lines.push_back(fmt::format(
      "FKM, local stresses, {}: R_m {:.0f} MPa, reversed limit {:.1f} MPa with R_z {:.3g} um (K_R {:.3f}), "
      "treatment {:.3g}, survival {:.5g} %",
      rules.group().name, scene.material.tensile_strength_Pa / 1e6, limit.reversed_Pa / 1e6,
      scene.roughness_m * 1e6, limit.roughness, scene.treatment, 100 * scene.reliability));
  lines.push_back(
      fmt::format("safety factor {:.3g} ({}); mean-stress sensitivity {:.3f}; S-N slope {:.3g}, knee at "
                  "{:.0e} cycles",
                  scene.safety, scene.safety_reason, limit.mean_stress_sensitivity,
                  rules.group().slope_normal, rules.group().knee_cycles));
  if (scene.endurance_Pa)
    lines.push_back(
        fmt::format("the smooth specimen's limit is the scene's, {:.1f} MPa", *scene.endurance_Pa / 1e6));
  if (!analysis.hot_spots.empty())
    lines.push_back(
        fmt::format("weld toes: IIW, structural hot-spot stress, FAT {:.0f} / gamma_M {:.3g}, 95 % survival, "
                    "as welded; range of "
                    "the principal stress within 60 degrees of the toe's normal",
                    scene.toes.class_Pa / 1e6, scene.toes.partial_factor));
  if (analysis.method == Method::beam)
    lines.push_back("a beam knows no stress gradient: no support is counted, which is safe");
  return lines;
}

/// @throws StageRefused if the scene names a toe that the body does not have
void check_toe_names(const FatigueScene& scene, const BodyAnalysis& analysis) {
  for (const auto& [name, toe] : scene.toes_by_name) {
    std::vector<std::string> names;
    for (const auto& spot : analysis.hot_spots) names.push_back(spot.name);
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw StageRefused(analysis.scene.name + ".fatigue.welds.toes: \"" + name +
                         "\" is no weld toe of this body; write one of " + listed(names));
  }
}

/// At failure under ranges of unlike size (IIW 4.3.1).
constexpr double damage_sum_of_spectra = 0.5;

std::vector<WeldFatigue> judge_welds(const BodyAnalysis& analysis, const FatigueScene& scene,
                                     const LoadPeriod& period) {
  check_toe_names(scene, analysis);
  if (analysis.hot_spots.empty()) return {};
  const SurfaceSlopes surface(analysis.responses.nodes);
  std::vector<WeldFatigue> welds;
  for (const auto& spot : analysis.hot_spots) {
    const auto drawing = std::find_if(analysis.mesh.hot_spots.begin(), analysis.mesh.hot_spots.end(),
                                      [&](const auto& drawn) { return drawn.name == spot.name; });
    if (drawing == analysis.mesh.hot_spots.end()) continue;
    const auto unit = unit_stress_at(analysis.responses, stress_point(spot));
    const Eigen::Map<const Eigen::MatrixXd> unit_Pa(unit.front().data(), 6, Index(unit.size()));
    const auto normal = surface.outward_normal(spot.near_node);
    const Eigen::Vector3d across = Eigen::Map<const Eigen::Vector3d>(drawing->near_m.data()) -
                                   Eigen::Map<const Eigen::Vector3d>(drawing->toe_m.data());
    const auto toe = toe_stress(unit_Pa * analysis.loads.history.values.matrix(),
                                Eigen::Map<const Eigen::Vector3d>(normal.data()), across);
    const auto own = scene.toes_by_name.find(spot.name);
    const auto& rules = own != scene.toes_by_name.end() ? own->second : scene.toes;
    const WeldDetail detail{rules.class_Pa, drawing->thickness_m, WeldDetail().thickness_exponent,
                            rules.partial_factor};
    const auto amplitude = toe.cycles.size() > 1 ? LoadAmplitude::variable : LoadAmplitude::constant;
    WeldFatigue weld;
    weld.name = spot.name;
    weld.toe_m = spot.toe_m;
    weld.class_Pa = rules.class_Pa;
    weld.thickness_m = drawing->thickness_m;
    weld.angle_rad = toe.angle_rad;
    weld.is_principal = toe.is_principal;
    weld.n_counted = toe.cycles.size();
    std::vector<StressBlock> ranges;
    for (const auto& cycle : toe.cycles) {
      weld.range_Pa = std::max(weld.range_Pa, cycle.range);
      ranges.push_back({cycle.range, cycle.count});
    }
    const double damage = weld_damage(detail, amplitude, toe.cycles);
    weld.damage_per_turn = damage / period.turns;
    const double damage_sum = amplitude == LoadAmplitude::variable ? damage_sum_of_spectra : 1;
    if (damage > 0) weld.life_s = period.duration_s * damage_sum / damage;
    if (scene.wanted_life_s)
      weld.life_safety = life_factor(weld_curve(detail, amplitude), ranges,
                                     *scene.wanted_life_s / period.duration_s, damage_sum);
    weld.error_share = error_share_of(analysis, spot.name);
    welds.push_back(std::move(weld));
  }
  std::stable_sort(welds.begin(), welds.end(), [](const auto& a, const auto& b) {
    return a.damage_per_turn != b.damage_per_turn ? a.damage_per_turn > b.damage_per_turn
                                                  : a.range_Pa > b.range_Pa;
  });
  return welds;
}

}  // namespace

BodyFatigue judge_fatigue(const BodyAnalysis& analysis, const LoadPeriod& period, int n_threads) {
  const Rules rules(analysis.scene.fatigue.value());
  const auto& nodes = analysis.responses.nodes;
  BodyFatigue fatigue;
  fatigue.cycles = nodal_cycles(analysis.loads.history, analysis.responses, analysis.envelope.von_mises,
                                surface_nodes(nodes), n_threads);
  for (const auto& cycle : fatigue.cycles.cycles)
    fatigue.utilisation_at.push_back(rules.limit(0, scalar(cycle)).utilisation);
  const PlaceSearch search(analysis, rules, period);
  for (auto& [feature, list] : nodes_by_feature(analysis))
    fatigue.places.push_back(search.worst_of(feature, list));
  std::stable_sort(fatigue.places.begin(), fatigue.places.end(),
                   [](const auto& a, const auto& b) { return a.utilisation > b.utilisation; });
  fatigue.welds = judge_welds(analysis, rules.scene(), period);
  fatigue.assumptions = assumptions_of(rules, analysis);
  return fatigue;
}

}  // namespace pipelines

#include "pipelines/judge/life/body_fatigue.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "pipelines/base/common/parallel.h"
#include "pipelines/base/fatigue/critical_plane.h"
#include "pipelines/base/fatigue/weld_classes.h"
#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/judge/analysis/weld_places.h"
#include "pipelines/judge/estimates/place_stress.h"
#include "pipelines/judge/estimates/time_sampling.h"
#include "pipelines/judge/life/damage_shares.h"
#include "pipelines/judge/life/fatigue_places.h"
#include "pipelines/judge/life/fatigue_rules.h"
#include "pipelines/judge/stages/place_errors.h"
#include "pipelines/superpose/envelope/stress_shares.h"

namespace pipelines {
namespace {

using Eigen::ArrayXXd;

constexpr double never = std::numeric_limits<double>::infinity();

/// Life by a damage in that time; none: nothing damages.
std::optional<double> life_of(double damage, double duration_s) {
  return damage > 0 ? std::optional(duration_s / damage) : std::nullopt;
}

/// @param cycle  the largest one
LifeCertainty certainty_at(const FatigueRules& rules, double error_share, const StressCycle& cycle,
                           const std::vector<StressBlock>& blocks, const LoadPeriod& period) {
  return certainty_of(
      error_share,
      beyond_curve(cycle.amplitude_Pa + std::abs(cycle.signed_mean_Pa),
                   rules.scene().material.yield_strength_Pa, rules.design_curve(blocks), blocks),
      [&](double factor) {
        const auto other = scaled(blocks, factor);
        return life_of(miner_damage(rules.design_curve(other), other), period.duration_s);
      });
}

void take_life(const FatigueRules& rules, const CountedNode& counted, const LoadPeriod& period,
               FatiguePlace& place) {
  const auto& blocks = counted.blocks;
  place.n_counted = blocks.size();
  if (blocks.empty()) {  // nothing changes
    place.certainty.range.emplace();
    return;
  }
  const auto curve = rules.design_curve(blocks);
  const double damage = miner_damage(curve, blocks);
  place.damage_per_turn = damage / period.turns;
  if (damage > 0) place.life_s = period.duration_s / damage;
  if (const auto wanted = rules.scene().wanted_life_s)
    place.life_safety = life_safety(curve, blocks, *wanted / period.duration_s);
  place.certainty = certainty_at(rules, place.error_share, place.cycle, blocks, period);
}

MeanStressSafety lines_of(const FatigueRules& rules, const EnduranceLimit& limit, const CyclicStress& cycle) {
  const auto& material = rules.scene().material;
  return mean_stress_safety(cycle,
                            {limit.reversed_Pa, material.tensile_strength_Pa, material.yield_strength_Pa});
}

/// Between 48 places in a period a crest may lose 0.2 %; with eight times as many 3e-5.
constexpr Eigen::Index places_for_findley = 8;

double findley_safety(const FatigueRules& rules, const StressCourse& course, const EnduranceLimit& limit,
                      double amplitude_Pa) {
  const double shear = rules.group().f_W_tau;
  if (!(amplitude_Pa > 0) || !(shear > 0.5 && shear < 1)) return never;
  const auto plane = findley(course.stress_Pa().matrix(), course.denser_Pa(places_for_findley).matrix(),
                             findley_limit(limit.reversed_Pa, shear * limit.reversed_Pa));
  return plane.utilisation > 0 ? 1 / plane.utilisation : never;
}

/// The nodes of a feature, without support by the gradient, where each of Shigley's lines is used up most, by
/// the cycles at the instants. FKM does not see every mean (fields I and IV), so that its worst node says
/// little about them.
std::vector<std::size_t> worst_by_lines(const FatigueRules& rules, const NodalCycles& known,
                                        const std::vector<std::size_t>& nodes) {
  const auto limit = rules.limit(0, {});
  std::array<std::pair<double, std::size_t>, 3> least;
  least.fill({never, 0});
  for (const auto node : nodes) {
    const auto at = std::lower_bound(known.nodes.begin(), known.nodes.end(), node) - known.nodes.begin();
    const auto lines = lines_of(rules, limit, scalar(known.cycles[std::size_t(at)]));
    const std::array<double, 3> safety{lines.goodman, lines.gerber, lines.soderberg};
    for (std::size_t i = 0; i < safety.size(); ++i)
      if (safety[i] < least[i].first) least[i] = {safety[i], node};
  }
  std::vector<std::size_t> result;
  for (const auto& [safety, node] : least)
    if (safety < never && std::find(result.begin(), result.end(), node) == result.end())
      result.push_back(node);
  return result;
}

/// Least of each rule over FKM's worst node and the rule's own nodes.
SecondOpinions second_opinions(const FatigueRules& rules, const FatigueNode& worst,
                               std::vector<std::size_t> by_lines, const FatiguePlaces& search) {
  SecondOpinions least{never, never, never, never};
  if (std::find(by_lines.begin(), by_lines.end(), worst.node) == by_lines.end())
    by_lines.push_back(worst.node);
  for (const auto node : by_lines) {
    const auto one = node == worst.node ? worst : search.at(node);
    const auto limit = rules.limit(one.gradient_per_m, scalar(one.cycle));
    const auto lines = lines_of(rules, limit, scalar(one.cycle));
    least.goodman = std::min(least.goodman, lines.goodman);
    least.gerber = std::min(least.gerber, lines.gerber);
    least.soderberg = std::min(least.soderberg, lines.soderberg);
    least.findley =
        std::min(least.findley, findley_safety(rules, search.stress_of(node), limit, one.cycle.amplitude_Pa));
  }
  return least;
}

/// One of the nodes that may be the worst of a feature.
struct JudgedNode {
  FatigueNode node;
  CountedNode counted;
};

JudgedNode worst_of(const std::vector<FatigueNode>& candidates, const FatiguePlaces& search,
                    const FatigueRules& rules, double duration_s) {
  JudgedNode worst;
  for (const auto& node : candidates) {
    JudgedNode one{node, search.counted(node, duration_s)};
    if (worst.node.utilisation < 0 ||
        damages_more(rules, one.counted.blocks, worst.counted.blocks, duration_s))
      worst = std::move(one);
  }
  worst.counted = search.stationary(worst.node, worst.counted);
  return worst;
}

/// The loads that fatigue is judged by: those of the analysis, or at denser instants where theirs do not tell
/// the course.
struct JudgedLoads {
  const ChannelHistory& history;
  const NodalMaximum& von_mises;  ///< envelope over these
  double per_instant;             ///< instants of these loads per instant of the analysis
};

FatiguePlace place_of(const std::string& feature, const JudgedNode& worst,
                      const std::vector<std::size_t>& by_lines, const FatiguePlaces& search,
                      const Judged& analysis, const JudgedLoads& loads, const FatigueRules& rules,
                      const LoadPeriod& period) {
  FatiguePlace place;
  place.feature = feature;
  place.node = worst.node.node;
  place.cycle = worst.node.cycle;
  place.from = worst.node.from / loads.per_instant;
  place.to = worst.node.to / loads.per_instant;
  place.gradient_per_m = worst.node.gradient_per_m;
  place.utilisation = worst.node.utilisation;
  place.surface = analysis.places.place[place.node];
  std::copy_n(&analysis.responses.nodes.xyz_m[3 * place.node], 3, place.position_m.begin());
  const auto limit = rules.limit(place.gradient_per_m, scalar(place.cycle));
  place.support = limit.support;
  place.endurance_Pa = limit.amplitude_Pa;
  place.safety = place.cycle.amplitude_Pa > 0 ? limit.amplitude_Pa / place.cycle.amplitude_Pa : never;
  place.unresolved_share = search.unresolved_share(worst.node, worst.counted);
  place.error_share = whole_error_share_of_change(analysis, feature, place.node,
                                                  search.half_change_between(worst.node.from, worst.node.to),
                                                  place.unresolved_share);
  take_life(rules, worst.counted, period, place);
  place.others = second_opinions(rules, worst.node, by_lines, search);
  place.effect_share = shares_of_change(unit_stresses_at(analysis.responses, place.node),
                                        search.between(worst.node.from, worst.node.to), 0, 1)
                           .effects;
  place.damage_share =
      shares_in_damage(analysis, loads.history, search, rules, worst.node, worst.counted, false).effects;
  return place;
}

/// What each effect brings to the difference between the largest and the smallest stress along the direction
/// that governs, at the instants of the loads.
std::vector<double> shares_of_range(const WeldPlace& place, const ChannelHistory& loads) {
  const auto toe = place.stress(loads.values);
  Eigen::Index high = 0, low = 0;
  const double range_Pa = toe.stress_Pa.maxCoeff(&high) - toe.stress_Pa.minCoeff(&low);
  std::vector<double> shares;
  if (!(range_Pa > 0)) return shares;
  for (const auto& part : loads.by_effect) {
    const ArrayXXd change = part.col(high) - part.col(low);
    shares.push_back(place.along_Pa(change, toe.angle_rad)[0] / range_Pa);
  }
  return shares;
}

WeldFatigue weld_of(const WeldPlace& place, const FactorCourse& course, const Responded& analysis,
                    const ChannelHistory& loads, const LoadPeriod& period) {
  const auto toe = place.stress(course);
  const auto amplitude = toe.cycles.size() > 1 ? LoadAmplitude::variable : LoadAmplitude::constant;
  WeldFatigue weld;
  weld.name = place.name;
  weld.toe_m = place.toe_m;
  weld.type = place.type;
  weld.class_Pa = place.detail.fat_Pa;
  if (place.type != effective_notch) weld.thickness_m = place.detail.thickness_m;
  weld.thickness_exponent = place.detail.thickness_exponent;
  weld.thickness_factor = thickness_factor(place.detail.thickness_m, weld.thickness_exponent);
  weld.angle_rad = toe.angle_rad;
  weld.is_principal = toe.is_principal;
  weld.n_counted = toe.cycles.size();
  weld.effect_share = shares_of_range(place, loads);
  std::vector<StressBlock> ranges;
  for (const auto& cycle : toe.cycles) {
    weld.range_Pa = std::max(weld.range_Pa, cycle.range);
    ranges.push_back({cycle.range, cycle.count});
  }
  const double damage = weld_damage(place.detail, amplitude, toe.cycles);
  weld.damage_per_turn = damage / period.turns;
  const double damage_sum = amplitude == LoadAmplitude::variable ? damage_sum_of_spectra : 1;
  if (damage > 0) weld.life_s = period.duration_s * damage_sum / damage;
  if (const auto wanted = analysis.scene.fatigue->wanted_life_s)
    weld.life_safety =
        life_safety(weld_curve(place.detail, amplitude), ranges, *wanted / period.duration_s, damage_sum);
  weld.unresolved_share = place.unresolved_share(course, toe);
  weld.error_share = place.error_share + weld.unresolved_share;
  const auto curve = weld_curve(place.detail, amplitude);
  weld.damage_share = shares_in_damage(place, loads, course, toe, curve);
  weld.certainty = certainty_of(
      weld.error_share,
      beyond_curve(toe.stress_Pa.abs().maxCoeff(), analysis.scene.yield_strength_Pa, curve, ranges),
      [&](double factor) {
        return life_of(miner_damage(curve, scaled(ranges, factor)) / damage_sum, period.duration_s);
      });
  return weld;
}

std::vector<WeldFatigue> judge_welds(const Judged& analysis, const FactorCourse& course,
                                     const ChannelHistory& loads, const LoadPeriod& period) {
  std::vector<WeldFatigue> welds;
  for (const auto& place : weld_places(analysis))
    welds.push_back(weld_of(place, course, analysis, loads, period));
  std::stable_sort(welds.begin(), welds.end(), [](const auto& a, const auto& b) {
    return a.damage_per_turn != b.damage_per_turn ? a.damage_per_turn > b.damage_per_turn
                                                  : a.range_Pa > b.range_Pa;
  });
  return welds;
}

ZoneDamage damage_of(const Zone& zone, const FatiguePlaces& search, const Judged& analysis,
                     const ChannelHistory& loads, const FatigueRules& rules, const LoadPeriod& period,
                     bool is_on_surface) {
  ZoneDamage result;
  result.is_on_surface = is_on_surface;
  if (!is_on_surface) return result;
  const auto node = search.at(zone.peak_node);
  const auto counted = search.stationary(node, search.counted(node, period.duration_s));
  if (counted.blocks.empty()) {  // nothing changes
    result.certainty.range.emplace();
    return result;
  }
  const double damage = miner_damage(rules.design_curve(counted.blocks), counted.blocks);
  result.damage_per_turn = damage / period.turns;
  result.life_s = life_of(damage, period.duration_s);
  result.error_share = whole_error_share_of_change(analysis, zone.feature, zone.peak_node,
                                                   search.half_change_between(node.from, node.to),
                                                   search.unresolved_share(node, counted));
  result.certainty = certainty_at(rules, result.error_share, node.cycle, counted.blocks, period);
  result.shares = shares_in_damage(analysis, loads, search, rules, node, counted, true);
  return result;
}

/// FKM's d_eff: of a contour the largest of its segments, by 4 V / O of a long bar or tube; of other bodies
/// 4 V / O. 0 where a rank knows a part of the body.
double effective_diameter(const Responded& analysis) {
  if (const auto* shaft = analysis.scene.shaft()) {
    double largest_m = 0;
    for (const auto& segment : shaft->geometry.segments)
      largest_m = std::max(largest_m, segment.diameter_m - segment.bore_m);
    return largest_m;
  }
  const auto& nodes = analysis.responses.nodes;
  if (analysis.responses.shared) return 0;
  double surface_m2 = 0;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto face = nodes.face(f);
    const auto corner = [&](std::size_t i) {
      return Eigen::Map<const Eigen::Vector3d>(&nodes.xyz_m[3 * std::size_t(face[i])]);
    };
    for (std::size_t i = 2; i < std::size_t(nodes.shape().n_face_corners()); ++i)
      surface_m2 += (corner(i - 1) - corner(0)).cross(corner(i) - corner(0)).norm() / 2;
  }
  return surface_m2 > 0 ? 4 * analysis.masses.volume_m3 / surface_m2 : 0;
}

/// Whether a feature is an edge that was rounded for its effective notch stress.
bool is_rounded_weld(const meshes::BodyMesh& mesh, const std::string& feature) {
  return std::any_of(mesh.features.begin(), mesh.features.end(), [&](const auto& of) {
    return of.name == feature &&
           std::any_of(mesh.notches.begin(), mesh.notches.end(),
                       [&](const auto& notch) { return notch.boundary_id == of.boundary_id; });
  });
}

/// Judges the place that is used most with the size of every kind of material of the group. Cycles are
/// counted along the direction of the strength as given.
void take_sizes(const Responded& analysis, const FatiguePlaces& search, const FatigueRules& rules,
                const LoadPeriod& period, BodyFatigue& fatigue) {
  fatigue.effective_diameter_m = effective_diameter(analysis);
  if (!(fatigue.effective_diameter_m > 0) || fatigue.places.empty() || rules.scene().endurance_Pa) return;
  const auto node = search.at(fatigue.places.front().node);
  const auto counted = search.stationary(node, search.counted(node, period.duration_s));
  for (const auto& size : sizes_of(rules.group().group, fatigue.effective_diameter_m)) {
    FatigueScene scene = rules.scene();
    scene.material.tensile_strength_Pa *= size.tensile_factor;
    scene.material.yield_strength_Pa =
        std::min(scene.material.yield_strength_Pa, scene.material.tensile_strength_Pa);
    const FatigueRules at_size(scene);
    const auto limit = at_size.limit(node.gradient_per_m, scalar(node.cycle));
    LifeAtSize life{size, node.cycle.amplitude_Pa > 0 ? limit.amplitude_Pa / node.cycle.amplitude_Pa : never,
                    std::nullopt};
    if (!counted.blocks.empty()) {
      const auto blocks = at_size.counted(search.stress_of(node.node).cycles_along(counted.direction), limit);
      life.life_s = life_of(miner_damage(at_size.design_curve(blocks), blocks), period.duration_s);
    }
    fatigue.at_size.push_back(life);
  }
}

/// The places of a list where the curve does not hold.
template <typename Place, typename Name>
void warn_beyond(const std::string& body, const std::vector<Place>& places, const Name& name,
                 std::vector<std::string>& warnings) {
  const auto is_beyond = [](const Place& place) { return !place.certainty.beyond.empty(); };
  const auto first = std::find_if(places.begin(), places.end(), is_beyond);
  if (first == places.end()) return;
  const auto n = std::size_t(std::count_if(places.begin(), places.end(), is_beyond));
  warnings.push_back(warning_beyond_curve(body, n, name(*first), first->certainty.beyond));
}

/// Share of the stress that the instants may miss before a run warns: what is stated of its amplitude beside,
/// without a range, is wrong by as much.
constexpr double much_between_instants = 0.2;

/// Warns of the place of a list that may be used most, if the instants miss much of its stress.
/// @param size  the amplitude of a place, in any measure
template <typename Place, typename Size, typename Name>
void warn_of_few_instants(const std::string& body, const std::vector<Place>& places, const Size& size,
                          const Name& name, std::vector<std::string>& warnings) {
  const auto may_reach = [&](const Place& place) { return size(place) * (1 + place.unresolved_share); };
  const auto first = std::max_element(places.begin(), places.end(), [&](const auto& a, const auto& b) {
    return may_reach(a) < may_reach(b);
  });
  if (first == places.end() || !(first->unresolved_share > much_between_instants)) return;
  warnings.push_back(
      fmt::format("{}: {}: fatigue knows the instants, between which the amplitude may be larger by up to "
                  "{:.0f} %: safety and life may be less than stated; raise sampling.instants_per_turn",
                  body, name(*first), 100 * first->unresolved_share));
}

std::vector<std::string> warnings_of(const FatigueRules& rules, const std::string& body,
                                     const BodyFatigue& fatigue) {
  std::vector<std::string> warnings;
  const double reversed_Pa = rules.limit(0, {}).reversed_Pa,
               yield_Pa = rules.scene().material.yield_strength_Pa;
  if (reversed_Pa > yield_Pa)
    warnings.push_back(fmt::format(
        "{}.fatigue: a reversed amplitude of {:.0f} MPa is endured for ever by its keys, more than "
        "the yield strength, {:.0f} MPa: check surface_treatment = {:.3g}{}",
        body, reversed_Pa / 1e6, yield_Pa / 1e6, rules.scene().treatment,
        rules.scene().endurance_Pa ? " and endurance_limit" : ""));
  const auto feature = [](const FatiguePlace& place) { return place.feature; };
  const auto toe = [](const WeldFatigue& weld) { return "weld toe " + weld.name; };
  warn_of_few_instants(
      body, fatigue.places, [](const auto& place) { return place.utilisation; }, feature, warnings);
  warn_of_few_instants(
      body, fatigue.welds, [](const auto& weld) { return weld.range_Pa; }, toe, warnings);
  warn_beyond(body, fatigue.places, feature, warnings);
  warn_beyond(body, fatigue.welds, toe, warnings);
  return warnings;
}

}  // namespace

BodyFatigue judge_fatigue(const Judged& analysis, const LoadPeriod& period, int n_threads) {
  const FatigueRules rules(analysis.scene.fatigue.value());
  const auto& nodes = analysis.responses.nodes;
  BodyFatigue fatigue;
  const auto& own = analysis.loads.history;
  const auto denser = denser_course(own);
  const auto denser_maximum =
      denser ? envelope(*denser, analysis.responses, n_threads).von_mises : NodalMaximum();
  const JudgedLoads loads{denser ? *denser : own, denser ? denser_maximum : analysis.envelope.von_mises,
                          denser ? double(denser->values.cols()) / double(own.values.cols()) : 1};
  fatigue.cycles =
      nodal_cycles(loads.history, analysis.responses, loads.von_mises, surface_nodes(nodes), n_threads);
  for (const auto& cycle : fatigue.cycles.cycles)
    fatigue.utilisation_at.push_back(rules.limit(0, scalar(cycle)).utilisation);
  const SurfaceSlopes slopes(nodes);
  const FatiguePlaces search(analysis, slopes, loads.history, loads.von_mises.value_Pa, rules);
  const auto features = nodes_by_feature(analysis);
  fatigue.places.resize(features.size());
  const int at_once = threads_in_step(analysis.responses, n_threads);
  for_each_parallel(features.size(), at_once, [&](std::size_t, std::size_t i) {
    const auto& [feature, of_feature] = features[i];
    fatigue.places[i] =
        place_of(feature, worst_of(search.worst_of(of_feature), search, rules, period.duration_s),
                 worst_by_lines(rules, fatigue.cycles, of_feature), search, analysis, loads, rules, period);
  });
  std::stable_sort(fatigue.places.begin(), fatigue.places.end(),
                   [](const auto& a, const auto& b) { return a.utilisation > b.utilisation; });
  if (is_din_steel(rules.group()))
    fatigue.nominal = din_743_of_fillets(analysis, loads.history, [&](const std::string& fillet) {
      const auto place = std::find_if(fatigue.places.begin(), fatigue.places.end(),
                                      [&](const auto& p) { return p.feature == fillet; });
      return place == fatigue.places.end() ? LocalAmplitude()
                                           : LocalAmplitude{place->cycle.amplitude_Pa, place->error_share};
    });
  fatigue.welds = judge_welds(analysis, search.course(), loads.history, period);
  const auto& zones = analysis.zones.zones;
  fatigue.zones.resize(zones.size());
  for_each_parallel(zones.size(), at_once, [&](std::size_t, std::size_t i) {
    const auto& surface = fatigue.cycles.nodes;
    const bool is_judged = !is_rounded_weld(analysis.mesh, zones[i].feature);
    fatigue.zones[i] =
        damage_of(zones[i], search, analysis, loads.history, rules, period,
                  is_judged && std::binary_search(surface.begin(), surface.end(), zones[i].peak_node));
  });
  if (rules.scene().size_factor == 1 && rules.scene().strength_source.empty())
    take_sizes(analysis, search, rules, period, fatigue);
  fatigue.warnings = warnings_of(rules, analysis.scene.name, fatigue);
  if (const auto corners = corners_left_out(analysis); !corners.empty())
    fatigue.warnings.push_back(
        fmt::format("{}: no fatigue is judged at sharp corners, where cracks may begin first: {}",
                    analysis.scene.name, corners));
  return fatigue;
}

}  // namespace pipelines

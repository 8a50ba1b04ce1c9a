#include "pipelines/search/refinement/local_refinement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "fem/base/values/errors.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/judge/analysis/exclusion_border.h"
#include "pipelines/judge/estimates/error_budget.h"
#include "pipelines/judge/estimates/fitted.h"
#include "pipelines/judge/estimates/submodels.h"
#include "pipelines/judge/stages/place_errors.h"
#include "pipelines/search/cheap_models/fitted.h"
#include "pipelines/superpose/envelope/superposition.h"

namespace pipelines {
namespace {

/// Contributions that differ by less count as equal.
constexpr double alike = 1e-3;
/// The power of von Mises stress by which the nodes of a place count: high enough to follow its maximum,
/// which moves between nodes, low enough to see the cells around it.
constexpr double concentration = 11;
/// Below this share of the place's maximum a node counts nothing: 0.5^11 is 5e-4.
constexpr double least_share = 0.5;
/// Places by falling sum of stress and error: cutting cells for more of them costs more than it tells.
constexpr std::size_t most_goals = 6;

/// Each mending makes the larger cells half as large; those of a search are at most so often cut.
constexpr int most_mendings = 10;

/// A place with the goal of the search there.
struct Goal {
  std::string feature;
  std::vector<std::string> images;  ///< features that are its mirror images: the goal is theirs, too
  fem::StressGoal stress;
  std::vector<std::size_t> nodes;  ///< whose cells are cut at least
  bool is_toe = false;
  double value_Pa = 0;

  std::vector<std::string> features() const {
    auto all = images;
    all.insert(all.begin(), feature);
    return all;
  }

  bool is_at(const std::string& name) const { return contains(features(), name); }

  /// The error, from the contributions of all cells.
  double error_Pa(const std::vector<double>& contributions_Pa) const {
    return (is_toe ? fitted::share_at_toes : fitted::share_on_surfaces) *
           std::accumulate(contributions_Pa.begin(), contributions_Pa.end(), 0.0);
  }
};

/// The derivative of von Mises stress by the stress, times a weight; its product with the stress itself is
/// the weighted von Mises stress.
std::array<double, 6> direction_of(const Stress& s, double weight) {
  const double mean = (s[0] + s[1] + s[2]) / 3, von_mises = von_mises_Pa(s);
  std::array<double, 6> tensor{};
  if (!(von_mises > 0)) return tensor;
  for (std::size_t c = 0; c < 6; ++c) tensor[c] = 1.5 * weight * (s[c] - (c < 3 ? mean : 0)) / von_mises;
  return tensor;
}

std::vector<double> factors_at(const Responded& analysis, std::int32_t instant) {
  const Eigen::ArrayXd column = analysis.loads.history.values.col(instant);
  return {column.begin(), column.end()};
}

Goal goal_at(const Responded& analysis, const HotSpotStress& spot) {
  Goal goal{spot.name, {}, {factors_at(analysis, spot.instant), {}}, {}, true};
  const auto point = stress_point(spot);
  Stress stress{};
  for (const auto& part : point.parts) {
    const auto own = stress_at(analysis.responses, analysis.loads.history, part.node, spot.instant);
    for (std::size_t c = 0; c < 6; ++c) stress[c] += part.weight * own[c];
  }
  for (const auto& part : point.parts) {
    goal.stress.parts.push_back({part.node, direction_of(stress, part.weight)});
    goal.nodes.push_back(part.node);
  }
  return goal;
}

/// Nodes on the faces of a feature outside the exclusion distances; inside the body those without a feature.
std::vector<std::size_t> nodes_of(const Superposed& analysis, const std::string& feature) {
  const auto& nodes = analysis.responses.nodes;
  std::vector<char> belongs(nodes.n, 0);
  for (const auto& known : analysis.mesh.features) {
    if (known.name != feature) continue;
    for (std::size_t f = 0; f < nodes.n_faces(); ++f)
      if (nodes.face_boundary_id[f] == known.boundary_id)
        for (const auto node : nodes.face(f)) belongs[std::size_t(node)] = 1;
  }
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < nodes.n; ++i) {
    const bool is_inside = feature == inside_the_body && analysis.places.feature[i] < 0;
    if ((belongs[i] || is_inside) && !analysis.places.excluded[i]) result.push_back(i);
  }
  return result;
}

Goal goal_at(const Superposed& analysis, const PlaceStress& place) {
  const auto instant = analysis.envelope.von_mises.instant[place.node];
  Goal goal{place.feature, {}, {factors_at(analysis, instant), {}}, {place.node}, false};
  double sum = 0;
  for (const auto node : nodes_of(analysis, place.feature)) {
    const auto stress = stress_at(analysis.responses, analysis.loads.history, node, instant);
    const double share = von_mises_Pa(stress) / place.value_Pa;
    if (share < least_share) continue;
    // Nodes are dense where cells are small already.
    const double weight =
        std::pow(share, concentration) * std::cbrt(std::pow(analysis.responses.nodes.volume_m3[node], 2));
    goal.stress.parts.push_back({node, direction_of(stress, weight)});
    sum += weight;
  }
  for (auto& part : goal.stress.parts)
    for (double& component : part.tensor) component /= sum;
  return goal;
}

double leading_Pa(const std::vector<PlaceStress>& judged) {
  return judged[judge(judged).governing].value_Pa;
}

std::vector<const PlaceStress*> places_that_may_lead(const std::vector<PlaceStress>& judged) {
  std::vector<const PlaceStress*> leading;
  for (const auto& place : judged)
    if (place.value_Pa > 0 && place.value_Pa + place.error_Pa >= leading_Pa(judged))
      leading.push_back(&place);
  return leading;
}

/// Those whose error is not the stress itself.
std::vector<const PlaceStress*> places_worth_a_look(const std::vector<PlaceStress>& judged) {
  std::vector<const PlaceStress*> places;
  for (const auto& place : judged)
    if (place.value_Pa > 0 && place.value_Pa >= share_worth_a_look * leading_Pa(judged))
      places.push_back(&place);
  return places;
}

/// By falling sum of stress and error.
std::vector<const PlaceStress*> by_bound(std::vector<const PlaceStress*> places) {
  std::stable_sort(places.begin(), places.end(), [](const auto* a, const auto* b) {
    return a->value_Pa + a->error_Pa > b->value_Pa + b->error_Pa;
  });
  return places;
}

double range_Pa(const HotSpotStress& spot) {
  return spot.max_normal_Pa - spot.min_normal_Pa;
}

/// Weld toes whose faces are too long to tell, that may lead by stress, or by its range where fatigue is
/// asked for.
std::vector<const HotSpotStress*> coarse_toes(const Judged& analysis,
                                              const std::vector<PlaceStress>& judged) {
  double leading_range_Pa = 0;
  for (const auto& spot : analysis.hot_spots) leading_range_Pa = std::max(leading_range_Pa, range_Pa(spot));
  std::vector<const HotSpotStress*> toes;
  for (const auto& place : judged)
    for (const auto& spot : analysis.hot_spots) {
      if (spot.name != place.feature || spot.face_walls <= fitted::longest_face_walls || place.value_Pa == 0)
        continue;
      const double most = 1 + place.error_Pa / place.value_Pa;
      const bool leads_range = analysis.scene.fatigue && most * range_Pa(spot) >= leading_range_Pa;
      if (most * place.value_Pa >= leading_Pa(judged) || leads_range) toes.push_back(&spot);
    }
  return toes;
}

/// Whether nodes are the mirror images of others, in any order: those of a cell have another one in its
/// image.
bool are_images(const fem::MirrorImages& images, const std::vector<std::size_t>& nodes,
                std::vector<std::size_t> others) {
  if (images.node.empty()) return false;
  std::vector<std::size_t> mirrored;
  for (const auto node : nodes) mirrored.push_back(std::size_t(images.node[node]));
  std::sort(mirrored.begin(), mirrored.end());
  std::sort(others.begin(), others.end());
  return mirrored == others;
}

/// Places that are mirror images of each other share a goal.
/// @param most  goals
std::vector<Goal> goals_of(const Judged& analysis, const std::vector<const PlaceStress*>& places,
                           std::size_t most) {
  std::vector<Goal> goals;
  for (const auto* place : places) {
    const auto spot = std::find_if(analysis.hot_spots.begin(), analysis.hot_spots.end(),
                                   [&](const auto& s) { return s.name == place->feature; });
    const bool is_toe = spot != analysis.hot_spots.end();
    Goal goal = is_toe ? goal_at(analysis, *spot) : goal_at(analysis, *place);
    goal.value_Pa = place->value_Pa;
    const auto known = std::find_if(goals.begin(), goals.end(), [&](const auto& other) {
      return are_images(analysis.responses.images, other.nodes, goal.nodes);
    });
    if (known != goals.end())
      known->images.push_back(goal.feature);
    else if (goals.size() < most)
      goals.push_back(std::move(goal));
  }
  return goals;
}

/// What each cell contributes to the error of each goal. Some at a time: dual solutions and their stresses
/// are as large as those of unit loads.
std::vector<std::vector<double>> contributions_Pa(const fem::Model& model, const Responded& analysis,
                                                  const std::vector<Goal>& goals) {
  constexpr std::size_t at_once = 12;
  std::vector<std::vector<double>> all;
  for (std::size_t first = 0; first < goals.size(); first += at_once) {
    std::vector<fem::StressGoal> stresses;
    for (std::size_t g = first; g < std::min(first + at_once, goals.size()); ++g)
      stresses.push_back(goals[g].stress);
    for (auto& of_goal : model.goal_errors_Pa(analysis.responses, stresses))
      all.push_back(std::move(of_goal));
  }
  return all;
}

/// Indices of the goals whose places may lead, at most most_goals.
std::vector<std::size_t> goals_to_cut_for(const std::vector<Goal>& goals,
                                          const std::vector<PlaceStress>& judged) {
  std::vector<std::size_t> leading;
  for (const auto* place : by_bound(places_that_may_lead(judged)))
    for (std::size_t g = 0; g < goals.size() && leading.size() < most_goals; ++g)
      if (goals[g].is_at(place->feature) && std::find(leading.begin(), leading.end(), g) == leading.end())
        leading.push_back(g);
  return leading;
}

/// Beside a sharp shoulder stress is too high where cells are large, and a single cut moves the maximum to
/// the next large cell around the shaft: all nodes there that are nearly as high.
std::vector<std::size_t> nodes_at_border(const Superposed& analysis, const PlaceStress& place) {
  constexpr double nearly = 0.9;
  std::vector<std::size_t> result;
  for (const auto node : nodes_of(analysis, place.feature)) {
    const double value_Pa = analysis.envelope.von_mises.value_Pa[node];
    if (value_Pa < nearly * place.value_Pa) continue;
    const double* x_m = &analysis.responses.nodes.xyz_m[3 * node];
    if (is_at_border(analysis.mesh, {x_m[0], x_m[1], x_m[2]})) result.push_back(node);
  }
  return result;
}

/// @param allowed_Pa  error that a goal may have in the end
double part_to_cut(double error_Pa, double allowed_Pa, bool is_toe) {
  if (!(error_Pa > 0)) return fitted::least_that_is_cut;
  return std::clamp(
      (1 - (is_toe ? fitted::aim_at_toes : fitted::aim) * allowed_Pa / error_Pa) / fitted::gain_of_cutting,
      fitted::least_that_is_cut, fitted::most_that_is_cut);
}

/// Marks the cells by falling contribution until they make up a part of the sum.
void mark_largest(const std::vector<double>& contributions, double part, std::vector<char>& marked) {
  std::vector<std::size_t> order(contributions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return contributions[a] > contributions[b]; });
  const double wanted = part * std::accumulate(contributions.begin(), contributions.end(), 0.0);
  double sum = 0, last = 0;
  for (const auto cell : order) {
    // Cells that symmetry makes alike are cut together, whatever rounding makes of them.
    if (sum >= wanted && contributions[cell] < (1 - alike) * last) break;
    sum += contributions[cell];
    last = contributions[cell];
    marked[cell] = 1;
  }
}

}  // namespace

std::vector<PlaceStress> with_goal_errors(std::vector<PlaceStress> judged, const LocalRefinement& local) {
  for (auto& place : judged)
    if (const auto error = local.goal_errors_Pa.find(place.feature); error != local.goal_errors_Pa.end())
      place.error_Pa = std::max(place.error_Pa, error->second);
  return judged;
}

bool is_refined_locally(const BodyScene& body) {
  const bool is_of_blocks = (body.shaft() != nullptr && body.shaft()->keyways.empty()) ||
                            std::holds_alternative<ChamberShape>(body.shape);
  return is_of_blocks && body.degree > 1;
}

LocalRefinement cells_to_cut(const fem::Model& model, const Judged& analysis,
                             const std::vector<PlaceStress>& by_changes, GoalPlaces places,
                             double tolerance) {
  const auto goals = places == GoalPlaces::all
                         ? goals_of(analysis, by_bound(places_worth_a_look(by_changes)), by_changes.size())
                         : goals_of(analysis, by_bound(places_that_may_lead(by_changes)), most_goals);
  const auto errors_Pa = contributions_Pa(model, analysis, goals);
  LocalRefinement result;
  for (std::size_t g = 0; g < goals.size(); ++g)
    for (const auto& feature : goals[g].features())
      result.goal_errors_Pa[feature] = goals[g].error_Pa(errors_Pa[g]);
  const auto judged = with_goal_errors(by_changes, result);
  const auto leading = goals_to_cut_for(goals, judged);
  const double allowed_Pa = (1 + tolerance) * leading_Pa(judged);
  const auto& nodes = analysis.responses.nodes;
  std::vector<char> marked(nodes.n_cells(), 0), is_place(nodes.n, 0);
  for (const auto g : leading) {
    mark_largest(
        errors_Pa[g],
        part_to_cut(goals[g].error_Pa(errors_Pa[g]), allowed_Pa - goals[g].value_Pa, goals[g].is_toe),
        marked);
    for (const auto node : goals[g].nodes) is_place[node] = 1;
  }
  for (const auto* place : places_that_may_lead(judged))
    if (analysis.scene.shaft() != nullptr &&
        place->least_error_Pa > fitted::aim * (allowed_Pa - place->value_Pa) &&
        is_at_border(analysis.mesh, place->position_m))
      for (const auto node : nodes_at_border(analysis, *place)) is_place[node] = 1;
  for (const auto g : leading)
    for (const auto& feature : goals[g].features()) result.features.push_back(feature);
  for (const auto* toe : coarse_toes(analysis, judged)) {
    const bool is_goal = contains(result.features, toe->name);
    for (const auto& part : toe->parts) {
      is_place[part.node] = 1;
      const double* x_m = &nodes.xyz_m[3 * part.node];
      if (is_goal && toe->face_walls > 2 * fitted::longest_face_walls)
        result.again_at_m.push_back({x_m[0], x_m[1], x_m[2]});
    }
  }
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    if (std::any_of(cell.begin(), cell.end(), [&](auto i) { return is_place[std::size_t(i)] != 0; }))
      marked[c] = 1;
  }
  // The mesh stays its own mirror image.
  const auto& images = analysis.responses.images.cell;
  for (std::size_t c = 0; c < images.size(); ++c)
    if (marked[c] != 0) marked[std::size_t(images[c])] = 1;
  for (std::size_t c = 0; c < marked.size(); ++c)
    if (marked[c] != 0) result.cells.push_back(std::int32_t(c));
  for (const auto& place : judged)
    if (const int cells = cells_on_quarter(analysis, place); 0 < cells && cells < fitted::cells_that_converge)
      result.coarse.push_back(place.feature);
  return result;
}

std::optional<MeshStep> refine_locally(BodyScene& body, const LocalRefinement& local) {
  if (local.cells.empty()) return std::nullopt;
  body.refinements.push_back({local.cells, local.again_at_m});
  return MeshStep{MeshPart::local, 2, fitted::order_of_halving, local.features, local.coarse};
}

MeshedBody mesh_refined(BodyScene& body, const std::function<MeshedBody()>& mesh) {
  for (int n_mended = 0;; ++n_mended) {
    try {
      return mesh();
    } catch (const fem::InvertedBesideLarger& inverted) {
      if (n_mended == most_mendings) throw;
      body.refinements.push_back({inverted.larger()});
    }
  }
}

}  // namespace pipelines

#include "pipelines/search/cheap_models/nodes_at_maxima.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "pipelines/base/common/constants.h"
#include "pipelines/judge/analysis/exclusion_border.h"
#include "pipelines/search/cheap_models/circle_patch.h"

namespace pipelines {
namespace {

/// Local maxima at the nodes that are as high as this share of the place's largest value are looked at, and
/// of these so many: between nodes another one may be the highest.
constexpr double worth_a_climb = 0.99;
constexpr std::size_t most_climbs = 4;
/// A parabola's maximum is no farther from its highest point than half way to the next one.
constexpr double half_way = 0.5;
/// Around the axis a high harmonic may have its crest between nodes that are not the highest ones.
constexpr double most_turn = 0.9;
/// A node on its way to the end of a surface keeps this share of the distance.
constexpr double kept_distance = 0.05;
/// A rise by less is not worth a node's move.
constexpr double least_rise = 1e-6;

/// A node's new place.
struct Move {
  std::size_t node = 0;
  std::array<double, 3> position_m{};
  std::vector<double> stress_Pa, displacement_m;  // unit responses
  double value_Pa = 0;
};

/// Circles side by side on the surface of one boundary id: of each one the next ones on both sides, one at
/// the surface's ends.
using Neighbours = std::map<std::size_t, std::vector<std::size_t>>;

std::map<int, Neighbours> circles_by_surface(const fem::Nodes& nodes, int n_angles) {
  std::map<int, Neighbours> result;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto face = nodes.face(f);
    const auto a = std::size_t(face[0]), b = std::size_t(face[1]);
    if (first_of_circle(nodes, a, n_angles) != a || first_of_circle(nodes, b, n_angles) != b) continue;
    auto& of_surface = result[nodes.face_boundary_id[f]];
    of_surface[a].push_back(b);
    of_surface[b].push_back(a);
  }
  return result;
}

class Climber {
public:
  Climber(const ChannelHistory& loads, const meshes::BodyMesh& mesh, int n_angles,
          const RevolvedResults& results)
      : loads_(loads),
        mesh_(mesh),
        n_angles_(n_angles),
        results_(results),
        surfaces_(circles_by_surface(results.responses.nodes, n_angles)) {
    for (const auto& [id, circles] : surfaces_)
      for (const auto& [circle, beside] : circles) ++n_surfaces_[circle];
  }

  /// Where the largest stress of the surface lies; nothing where a node has it.
  std::optional<Move> climb(int boundary_id) const {
    const auto surface = surfaces_.find(boundary_id);
    if (surface == surfaces_.end()) return std::nullopt;
    std::optional<Move> highest;
    double most_Pa = 0;
    for (const std::size_t node : local_maxima(surface->second)) {
      most_Pa = std::max(most_Pa, value_Pa(node));
      auto move = climb_from(node, boundary_id, surface->second);
      if (move && (!highest || move->value_Pa > highest->value_Pa)) highest = std::move(move);
    }
    if (highest && highest->value_Pa <= (1 + least_rise) * most_Pa) highest.reset();
    return highest;
  }

private:
  double value_Pa(std::size_t node) const { return results_.envelope.von_mises.value_Pa[node]; }
  bool is_left_out(std::size_t node) const { return results_.node_places.excluded[node] != 0; }
  bool is_on_axis(std::size_t circle) const {
    const double* p = &results_.responses.nodes.xyz_m[3 * circle];
    return p[0] == 0 && p[1] == 0;
  }
  std::size_t node_of(std::size_t circle, int half_plane) const {
    return is_on_axis(circle) ? circle : circle + std::size_t((half_plane + n_angles_) % n_angles_);
  }
  /// Where two surfaces meet.
  bool is_seam(std::size_t circle) const { return n_surfaces_.at(circle) > 1; }

  /// Nodes outside of what is left out that are as high as those beside them, the highest ones first.
  std::vector<std::size_t> local_maxima(const Neighbours& circles) const {
    std::vector<std::size_t> found;
    double most_Pa = 0;
    for (const auto& [circle, beside] : circles)
      for (int j = 0; j < (is_on_axis(circle) ? 1 : n_angles_); ++j)
        if (const auto node = node_of(circle, j); !is_left_out(node))
          most_Pa = std::max(most_Pa, value_Pa(node));
    for (const auto& [circle, beside] : circles)
      for (int j = 0; j < (is_on_axis(circle) ? 1 : n_angles_); ++j) {
        const auto node = node_of(circle, j);
        const double own_Pa = value_Pa(node);
        if (is_left_out(node) || own_Pa < worth_a_climb * most_Pa) continue;
        bool is_highest =
            own_Pa >= value_Pa(node_of(circle, j - 1)) && own_Pa >= value_Pa(node_of(circle, j + 1));
        for (const auto other : beside) {
          const auto next = node_of(other, j);
          is_highest = is_highest && (is_left_out(next) || own_Pa >= value_Pa(next));
        }
        if (is_highest) found.push_back(node);
      }
    std::stable_sort(found.begin(), found.end(),
                     [&](std::size_t a, std::size_t b) { return value_Pa(a) > value_Pa(b); });
    found.resize(std::min(found.size(), most_climbs));
    return found;
  }

  /// Three circles on the surface, the given one among them: in the middle, or at an end of the surface
  /// first.
  static std::optional<std::array<std::size_t, 3>> three_circles(std::size_t circle,
                                                                 const Neighbours& circles) {
    const auto& beside = circles.at(circle);
    if (beside.size() == 2) return std::array<std::size_t, 3>{beside[0], circle, beside[1]};
    if (beside.size() != 1) return std::nullopt;
    for (const auto next : circles.at(beside[0]))
      if (next != circle) return std::array<std::size_t, 3>{circle, beside[0], next};
    return std::nullopt;
  }

  /// Along a patch from one of its circles to the border of what is left out beside the next one.
  double border_m(const CirclePatch& patch, double from_m, double to_m, double angle_rad,
                  int boundary_id) const {
    const auto is_outside = [&](double along_m) {
      return beyond_border_m(mesh_, patch.position_m({along_m, angle_rad}), boundary_id) >= 0;
    };
    if (!is_outside(from_m)) return from_m;
    double outside_m = from_m, within_m = to_m;
    for (int i = 0; i < 40; ++i) {
      const double middle_m = (outside_m + within_m) / 2;
      (is_outside(middle_m) ? outside_m : within_m) = middle_m;
    }
    return outside_m;
  }

  std::optional<Move> climb_from(std::size_t node, int boundary_id, const Neighbours& circles) const {
    const auto& nodes = results_.responses.nodes;
    const std::size_t circle = first_of_circle(nodes, node, n_angles_);
    const int half_plane = int(node - circle);
    const auto three = three_circles(circle, circles);
    if (is_on_axis(circle) || !three) return std::nullopt;
    CirclePatch patch(results_.responses, n_angles_, *three);
    const std::size_t own = (*three)[1] == circle ? 1 : 0;
    const double spacing_rad = 2 * pi / n_angles_, angle_rad = half_plane * spacing_rad;
    const double start_m = patch.along_m(own);

    // From the node's circle to both sides: half way to the next one, or to the border beside it.
    const auto reach_m = [&](std::size_t next) {
      const double to_m = patch.along_m(next);
      if (is_left_out(node_of((*three)[next], half_plane)))
        return border_m(patch, start_m, to_m, angle_rad, boundary_id);
      return start_m + (own == 1 ? half_way : 1 - kept_distance) * (to_m - start_m);
    };
    const double low_m = own == 1 ? reach_m(0) : start_m, high_m = reach_m(own + 1);
    const double low_rad = angle_rad - most_turn * spacing_rad,
                 high_rad = angle_rad + most_turn * spacing_rad;

    PatchLocation highest{start_m, angle_rad};
    double most_Pa = 0;
    std::int32_t instant_of_most = 0;
    for (const int beside : {0, -1, 1}) {
      const auto instant = results_.envelope.von_mises.instant[node_of(circle, half_plane + beside)];
      patch.load(loads_.values.col(instant));
      PatchLocation at{start_m, angle_rad};
      double here_Pa = patch.von_mises_Pa(at);
      double step_m = (high_m - low_m) / 2, step_rad = half_way * spacing_rad;
      for (int i = 0; i < 14; ++i, step_m /= 2, step_rad /= 2)
        for (bool is_higher = true; is_higher;) {
          is_higher = false;
          for (const auto& [m, rad] :
               {std::pair{step_m, 0.0}, {-step_m, 0.0}, {0.0, step_rad}, {0.0, -step_rad}}) {
            const PatchLocation next{std::clamp(at.along_m + m, low_m, high_m),
                                     std::clamp(at.angle_rad + rad, low_rad, high_rad)};
            const double next_Pa = patch.von_mises_Pa(next);
            if (!(next_Pa > (1 + 1e-12) * here_Pa)) continue;
            at = next;
            here_Pa = next_Pa;
            is_higher = true;
          }
        }
      if (here_Pa > most_Pa) {
        most_Pa = here_Pa;
        highest = at;
        instant_of_most = instant;
      }
    }
    if (!(most_Pa > (1 + least_rise) * value_Pa(node))) return std::nullopt;

    // The node itself moves, or the next one where it may not, or where that is nearer.
    const double off_m = highest.along_m - start_m;
    std::size_t moved = circle;
    if (off_m != 0) {
      const std::size_t next = off_m > 0 ? own + 1 : 0;
      const double share = off_m / (patch.along_m(next) - start_m);
      if (is_seam(circle) && share <= kept_distance)
        highest.along_m = start_m;
      else if (is_seam(circle) || share > half_way)
        moved = (*three)[next];
      if (is_seam(moved) && moved != circle) moved = circle;
      if (is_seam(moved)) highest.along_m = start_m;
    }
    patch.load(loads_.values.col(instant_of_most));
    Move move;
    move.node = node_of(moved, half_plane);
    // Along the surface the node stays where it is, at most half a distance of nodes away: in an oblique cell
    // the slope below the surface, which fatigue asks for, is off by a seventh.
    move.position_m = patch.position_m({moved == circle ? start_m : highest.along_m, highest.angle_rad});
    move.stress_Pa = patch.unit_stress_Pa(highest);
    move.displacement_m = patch.unit_displacement_m(highest);
    move.value_Pa = patch.von_mises_Pa(highest);
    return move;
  }

  const ChannelHistory& loads_;
  const meshes::BodyMesh& mesh_;
  int n_angles_;
  const RevolvedResults& results_;
  std::map<int, Neighbours> surfaces_;
  std::map<std::size_t, int> n_surfaces_;  // by circle
};

/// Enters the nodes at their new places, with their envelope.
void apply(const std::vector<Move>& moves, const ChannelHistory& loads, RevolvedResults& results) {
  auto& responses = results.responses;
  const std::size_t n_channels = responses.channels.size();
  fem::UnitResponses moved;
  moved.channels = responses.channels;
  moved.nodes.n = moves.size();
  for (const auto& move : moves) {
    moved.stress_Pa.insert(moved.stress_Pa.end(), move.stress_Pa.begin(), move.stress_Pa.end());
    double* const at_m = &responses.nodes.xyz_m[3 * move.node];
    responses.nodes.moved_from_m.insert({move.node, {at_m[0], at_m[1], at_m[2]}});
    std::copy(move.position_m.begin(), move.position_m.end(), at_m);
    std::copy(move.stress_Pa.begin(), move.stress_Pa.end(), &responses.stress_Pa[6 * n_channels * move.node]);
    std::copy(move.displacement_m.begin(), move.displacement_m.end(),
              &responses.displacement_m[3 * n_channels * move.node]);
  }
  const auto own = envelope(loads, moved, 1);
  const auto take = [&](const NodalMaximum& from, NodalMaximum& to) {
    for (std::size_t i = 0; i < moves.size(); ++i) {
      to.value_Pa[moves[i].node] = from.value_Pa[i];
      to.instant[moves[i].node] = from.instant[i];
      if (!to.stress_Pa.empty()) to.stress_Pa[moves[i].node] = from.stress_Pa[i];
    }
  };
  take(own.von_mises, results.envelope.von_mises);
  take(own.principal, results.envelope.principal);
  const std::size_t n_effects = loads.effects.size();
  for (std::size_t i = 0; i < moves.size() && !own.effect_share.empty(); ++i)
    std::copy_n(&own.effect_share[i * n_effects], n_effects,
                &results.envelope.effect_share[moves[i].node * n_effects]);
}

}  // namespace

void move_nodes_to_maxima(const ChannelHistory& loads, const meshes::BodyMesh& mesh, int n_angles,
                          RevolvedResults results) {
  const Climber climber(loads, mesh, n_angles, results);
  std::map<std::size_t, Move> moves;  // by node
  for (const auto& feature : mesh.features)
    if (auto move = climber.climb(feature.boundary_id)) {
      const auto known = moves.find(move->node);
      if (known == moves.end() || known->second.value_Pa < move->value_Pa)
        moves[move->node] = std::move(*move);
    }
  if (moves.empty()) return;
  std::vector<Move> all;
  for (auto& [node, move] : moves) all.push_back(std::move(move));
  apply(all, loads, results);
  results.node_places = locate_nodes(results.responses.nodes, mesh.features, mesh.ports, mesh.sharp_edges);
  results.places = largest_by_feature(results.responses.nodes, results.envelope.von_mises.value_Pa,
                                      mesh.features, results.node_places);
}

}  // namespace pipelines

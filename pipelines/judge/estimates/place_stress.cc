#include "pipelines/judge/estimates/place_stress.h"

#include <algorithm>
#include <map>

namespace pipelines {
namespace {

/// Nodes that share a cell with a higher one: their stress rises towards that. Beside what is left out the
/// border has the highest stress, and nothing is said.
std::vector<char> beside_higher_ones(const fem::Nodes& nodes, const std::vector<double>& von_mises_Pa,
                                     const NodePlaces& places) {
  std::vector<char> beside(nodes.n, 0);
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    if (std::any_of(cell.begin(), cell.end(), [&](auto i) { return places.excluded[std::size_t(i)] != 0; }))
      continue;
    double largest_Pa = 0;
    for (const auto i : cell) largest_Pa = std::max(largest_Pa, von_mises_Pa[std::size_t(i)]);
    for (const auto i : cell)
      if (von_mises_Pa[std::size_t(i)] < largest_Pa) beside[std::size_t(i)] = 1;
  }
  return beside;
}

}  // namespace

std::vector<PlaceStress> largest_by_feature(const fem::Nodes& nodes, const std::vector<double>& von_mises_Pa,
                                            const std::vector<meshes::Feature>& features,
                                            const NodePlaces& places) {
  std::map<int, std::size_t> by_id;
  std::vector<PlaceStress> largest(features.size() + 1);
  std::vector<char> found(features.size() + 1, 0);
  for (std::size_t f = 0; f < features.size(); ++f) {
    by_id[features[f].boundary_id] = f;
    largest[f].feature = features[f].name;
  }
  largest.back().feature = inside_the_body;
  const auto consider = [&](std::size_t place, std::size_t node) {
    if (places.excluded[node] || (found[place] && von_mises_Pa[node] <= largest[place].value_Pa)) return;
    found[place] = 1;
    largest[place].node = node;
    largest[place].value_Pa = von_mises_Pa[node];
    std::copy_n(&nodes.xyz_m[3 * node], 3, largest[place].position_m.begin());
  };
  for (std::size_t face = 0; face < nodes.n_faces(); ++face)
    for (const auto node : nodes.face(face))
      consider(by_id.at(nodes.face_boundary_id[face]), std::size_t(node));
  const auto beside = beside_higher_ones(nodes, von_mises_Pa, places);
  for (std::size_t node = 0; node < nodes.n; ++node)
    if (places.feature[node] < 0 && beside[node] == 0) consider(features.size(), node);
  std::vector<PlaceStress> result;
  double on_surface_Pa = 0;
  for (std::size_t place = 0; place + 1 < largest.size(); ++place)
    if (found[place]) {
      result.push_back(largest[place]);
      on_surface_Pa = std::max(on_surface_Pa, largest[place].value_Pa);
    }
  if (found.back() && largest.back().value_Pa >= share_of_inside * on_surface_Pa)
    result.push_back(largest.back());
  return result;
}

PlaceJudgement judge(const std::vector<PlaceStress>& places) {
  PlaceJudgement judgement;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i].value_Pa > places[judgement.governing].value_Pa) judgement.governing = i;
  const auto& governing = places[judgement.governing];
  judgement.holding_back = judgement.governing;
  double most_Pa = governing.error_Pa;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double above_Pa = places[i].value_Pa + places[i].error_Pa - governing.value_Pa;
    if (above_Pa <= most_Pa) continue;
    most_Pa = above_Pa;
    judgement.holding_back = i;
  }
  if (judgement.holding_back != judgement.governing) {
    judgement.other_places_Pa = most_Pa - governing.error_Pa;
    judgement.other_place = places[judgement.holding_back].feature;
  }
  return judgement;
}

}  // namespace pipelines

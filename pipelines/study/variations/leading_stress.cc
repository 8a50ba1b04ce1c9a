#include "pipelines/study/variations/leading_stress.h"

#include <algorithm>
#include <cmath>

#include "pipelines/judge/estimates/place_stress.h"

namespace pipelines {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

/// A reach holds up to rounding, which the slack covers.
constexpr double slack = 1 + 1e-9;

/// Nodes of each place in the first walk, and nodes that are walked at once.
constexpr std::size_t first_of_each_place = 4, at_once = 512;

/// Walks some nodes and enters them into an envelope of all.
class Walker {
public:
  Walker(const ChannelHistory& loads, const fem::UnitResponses& responses, Envelope& all)
      : loads_(loads), walk_(loads), responses_(responses), all_(all), walked_(responses.nodes.n, 0) {
    some_.channels = responses.channels;
  }

  bool has(std::int32_t node) const { return walked_[std::size_t(node)] != 0; }
  double stress_Pa(std::int32_t node) const { return all_.von_mises.value_Pa[std::size_t(node)]; }

  void walk(const std::vector<std::int32_t>& nodes) {
    if (nodes.empty()) return;
    const std::size_t n_numbers = responses_.channels.size() * 6, n_effects = loads_.effects.size();
    some_.nodes.n = nodes.size();
    some_.stress_Pa.clear();
    for (const auto node : nodes) {
      const double* const unit = responses_.unit_stress_Pa(std::size_t(node));
      some_.stress_Pa.insert(some_.stress_Pa.end(), unit, unit + n_numbers);
    }
    const Envelope found = walk_.of(some_, 1);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto node = std::size_t(nodes[i]);
      walked_[node] = 1;
      const auto enter = [&](const NodalMaximum& from, NodalMaximum& to) {
        to.value_Pa[node] = from.value_Pa[i];
        to.instant[node] = from.instant[i];
        to.stress_Pa[node] = from.stress_Pa[i];
      };
      enter(found.von_mises, all_.von_mises);
      enter(found.principal, all_.principal);
      std::copy_n(found.effect_share.begin() + std::ptrdiff_t(i * n_effects), n_effects,
                  all_.effect_share.begin() + std::ptrdiff_t(node * n_effects));
    }
  }

private:
  const ChannelHistory& loads_;
  EnvelopeWalk walk_;
  const fem::UnitResponses& responses_;
  Envelope& all_;
  std::vector<char> walked_;
  fem::UnitResponses some_;
};

/// Finds the largest stress of a place.
class PlaceSearch {
public:
  /// @param floor_Pa  stress that does not matter
  PlaceSearch(const std::vector<std::int32_t>& nodes, const ArrayXd& reach, double floor_Pa)
      : nodes_(&nodes), reach_(&reach), best_Pa_(floor_Pa) {}

  void add_first(const Walker& walker, std::vector<std::int32_t>& wanted) const {
    auto open = open_nodes(walker);
    const auto n = std::min(first_of_each_place, open.size());
    std::partial_sort(open.begin(), open.begin() + std::ptrdiff_t(n), open.end(),
                      [&](auto a, auto b) { return (*reach_)[a] > (*reach_)[b]; });
    wanted.insert(wanted.end(), open.begin(), open.begin() + std::ptrdiff_t(n));
  }

  void update(const Walker& walker) {
    for (const auto node : *nodes_)
      if (walker.has(node)) best_Pa_ = std::max(best_Pa_, walker.stress_Pa(node));
  }

  /// Nodes that may exceed the best one.
  std::vector<std::int32_t> open_nodes(const Walker& walker) const {
    std::vector<std::int32_t> open;
    for (const auto node : *nodes_)
      if (!walker.has(node) && (*reach_)[node] * slack >= best_Pa_) open.push_back(node);
    return open;
  }

private:
  const std::vector<std::int32_t>* nodes_;
  const ArrayXd* reach_;
  double best_Pa_;
};

/// Walks all nodes, in pieces: their unit stresses are copied.
void walk_all(std::vector<std::int32_t> nodes, Walker& walker) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  for (std::size_t begin = 0; begin < nodes.size(); begin += at_once)
    walker.walk({nodes.begin() + std::ptrdiff_t(begin),
                 nodes.begin() + std::ptrdiff_t(std::min(nodes.size(), begin + at_once))});
}

void search_places(std::vector<PlaceSearch>& searches, const ArrayXd& reach, Walker& walker) {
  std::vector<std::int32_t> wanted;
  const auto distinct = [&] {
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  };
  for (const auto& search : searches) search.add_first(walker, wanted);
  while (!wanted.empty()) {
    distinct();
    walker.walk(wanted);
    wanted.clear();
    for (auto& search : searches) {
      search.update(walker);
      const auto open = search.open_nodes(walker);
      wanted.insert(wanted.end(), open.begin(), open.end());
    }
    distinct();
    if (wanted.size() > at_once) {
      std::nth_element(wanted.begin(), wanted.begin() + at_once, wanted.end(),
                       [&](auto a, auto b) { return reach[a] > reach[b]; });
      wanted.resize(at_once);
    }
  }
}

}  // namespace

LeadingStress::LeadingStress(const Superposed& known)
    : channels_(known.loads.history.values),
      known_Pa_(Eigen::Map<const ArrayXd>(known.envelope.von_mises.value_Pa.data(),
                                          Index(known.envelope.von_mises.value_Pa.size()))),
      excluded_(known.places.excluded) {
  const auto& responses = known.responses;
  const auto& nodes = responses.nodes;
  const auto n_channels = Index(responses.channels.size());
  unit_Pa_.resize(Index(nodes.n), n_channels);
  for (std::size_t node = 0; node < nodes.n; ++node)
    for (Index k = 0; k < n_channels; ++k) {
      Stress unit;
      std::copy_n(responses.unit_stress_Pa(node) + 6 * k, 6, unit.begin());
      unit_Pa_(Index(node), k) = von_mises_Pa(unit);
    }
  weight_ = unit_Pa_.colwise().maxCoeff().transpose().array();
  std::vector<int> ids;
  for (const auto& feature : known.mesh.features) ids.push_back(feature.boundary_id);
  places_.resize(ids.size());
  for (std::size_t face = 0; face < nodes.n_faces(); ++face) {
    const auto place = std::find(ids.begin(), ids.end(), nodes.face_boundary_id[face]);
    if (place == ids.end()) continue;
    for (const auto node : nodes.face(face))
      if (!known.places.excluded[std::size_t(node)])
        places_[std::size_t(place - ids.begin())].push_back(node);
  }
  for (auto& place : places_) {
    std::sort(place.begin(), place.end());
    place.erase(std::unique(place.begin(), place.end()), place.end());
  }
  for (std::size_t node = 0; node < nodes.n; ++node)
    if (known.places.feature[node] < 0 && !known.places.excluded[node]) inside_.push_back(std::int32_t(node));
}

ArrayXd LeadingStress::reach(const ChannelHistory& loads) const {
  Eigen::ArrayXXd change = loads.values;
  double factor = 0;
  if (change.rows() == channels_.rows() && change.cols() == channels_.cols()) {
    const auto weighted = channels_.colwise() * weight_.square();
    const double size = (weighted * channels_).sum();
    if (size > 0) factor = (weighted * change).sum() / size;
    change -= factor * channels_;
  }
  const ArrayXd sizes = change.abs().rowwise().maxCoeff();
  return (std::abs(factor) * known_Pa_ + (unit_Pa_ * sizes.matrix()).array()) * slack;
}

Envelope LeadingStress::envelope(const ChannelHistory& loads, const fem::UnitResponses& responses) const {
  const std::size_t n_nodes = responses.nodes.n;
  Envelope all;
  for (NodalMaximum* maximum : {&all.von_mises, &all.principal}) {
    maximum->value_Pa.assign(n_nodes, 0.0);
    maximum->instant.assign(n_nodes, 0);
    maximum->stress_Pa.assign(n_nodes, Stress{});
  }
  all.effect_share.assign(n_nodes * loads.effects.size(), 0.0f);
  const ArrayXd most_Pa = reach(loads);
  Walker walker(loads, responses, all);
  std::vector<PlaceSearch> surface;
  for (const auto& place : places_)
    if (!place.empty()) surface.emplace_back(place, most_Pa, 0.0);
  search_places(surface, most_Pa, walker);
  double on_surface_Pa = 0;
  for (const auto& place : places_)
    for (const auto node : place)
      if (walker.has(node)) on_surface_Pa = std::max(on_surface_Pa, walker.stress_Pa(node));
  std::vector<PlaceSearch> inside{{inside_, most_Pa, share_of_inside * on_surface_Pa}};
  search_places(inside, most_Pa, walker);
  return all;
}

void LeadingStress::complete_above(double level_Pa, const ChannelHistory& loads,
                                   const fem::UnitResponses& responses, Envelope& leading) const {
  const auto& value_Pa = leading.von_mises.value_Pa;
  const auto is_known = [&](std::int32_t node) { return value_Pa[std::size_t(node)] > 0; };
  const ArrayXd most_Pa = reach(loads);
  Walker walker(loads, responses, leading);
  std::vector<std::int32_t> wanted;
  for (Index node = 0; node < most_Pa.size(); ++node)
    if (!excluded_[std::size_t(node)] && most_Pa[node] >= level_Pa && !is_known(std::int32_t(node)))
      wanted.push_back(std::int32_t(node));
  walk_all(std::move(wanted), walker);
  // A zone ends between a node above the level and one below it: the volume asks for both.
  std::vector<std::int32_t> beside;
  for (std::size_t c = 0; c < responses.nodes.n_cells(); ++c) {
    const auto cell = responses.nodes.cell(c);
    const bool is_cut = std::any_of(cell.begin(), cell.end(), [&](std::int32_t node) {
      return !excluded_[std::size_t(node)] && is_known(node) && value_Pa[std::size_t(node)] >= level_Pa;
    });
    if (!is_cut) continue;
    for (const auto node : cell)
      if (!is_known(node)) beside.push_back(node);
  }
  walk_all(std::move(beside), walker);
}

}  // namespace pipelines

#include "pipelines/write/drawing/label_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pipelines {
namespace {

/// Centres of the labels `chosen` (ascending anchors) side by side, least squares from their anchors: pools
/// of labels that touch move together.
std::vector<double> centres(const std::vector<LabelRequest>& requests, const std::vector<std::size_t>& chosen,
                            const LabelRows& rows) {
  struct Pool {
    double sum = 0;
    std::size_t n = 0;
    double mean() const { return sum / double(n); }
  };
  // Distance of each label from the first one where all up to it touch.
  std::vector<double> offset(chosen.size(), 0);
  for (std::size_t i = 1; i < chosen.size(); ++i)
    offset[i] = offset[i - 1] + 0.5 * (requests[chosen[i - 1]].width + requests[chosen[i]].width) + rows.gap;
  std::vector<Pool> pools;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    pools.push_back({requests[chosen[i]].anchor_x - offset[i], 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
      pools[pools.size() - 2].sum += pools.back().sum;
      pools[pools.size() - 2].n += pools.back().n;
      pools.pop_back();
    }
  }
  std::vector<double> result;
  if (chosen.empty()) return result;
  const double lowest = rows.left + 0.5 * requests[chosen.front()].width;
  const double highest = rows.right - 0.5 * requests[chosen.back()].width - offset.back();
  for (const auto& pool : pools)
    for (std::size_t i = 0; i < pool.n; ++i)
      result.push_back(std::max(lowest, std::min(highest, pool.mean())) + offset[result.size()]);
  if (lowest > highest && chosen.size() > 1)  // too many: squeezed
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = lowest + offset[i] * (highest + offset.back() - lowest) / offset.back();
  return result;
}

struct Leader {
  double x0, y0, x1, y1;
};

bool cross(const Leader& a, const Leader& b) {
  const auto side = [](const Leader& l, double x, double y) {
    return (l.x1 - l.x0) * (y - l.y0) - (l.y1 - l.y0) * (x - l.x0) > 0;
  };
  return side(a, b.x0, b.y0) != side(a, b.x1, b.y1) && side(b, a.x0, a.y0) != side(b, a.x1, a.y1);
}

}  // namespace

std::vector<LabelPlace> place_labels(const std::vector<LabelRequest>& requests, const LabelRows& rows) {
  const std::size_t n = requests.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return requests[a].anchor_x < requests[b].anchor_x; });

  std::vector<LabelPlace> best(n);
  double least = std::numeric_limits<double>::infinity();
  const auto attempt = [&](const std::vector<bool>& above) {
    std::vector<LabelPlace> places(n);
    std::vector<Leader> leaders;
    double cost = 0;
    for (const bool row : {true, false}) {
      std::vector<std::size_t> chosen;
      for (const std::size_t i : order)
        if (above[i] == row) chosen.push_back(i);
      const auto middle = centres(requests, chosen, rows);
      const double y = row ? rows.above_y : rows.below_y;
      double end = rows.left;
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        const auto& request = requests[chosen[i]];
        places[chosen[i]] = {row, middle[i] - 0.5 * request.width};
        leaders.push_back({request.anchor_x, request.anchor_y, middle[i], y});
        cost += std::pow(middle[i] - request.anchor_x, 2) + std::pow(y - request.anchor_y, 2);
        if (places[chosen[i]].left < end - 0.5) cost += 1e9;  // overlaps its neighbour or leaves the row
        end = places[chosen[i]].left + request.width;
      }
    }
    for (std::size_t i = 0; i < leaders.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (cross(leaders[i], leaders[j])) cost += 1e6;
    if (cost < least) {
      least = cost;
      best = std::move(places);
    }
  };

  std::vector<bool> above(n);
  constexpr std::size_t n_tried = 10;  // all ways of sharing out the first ten; the others alternate
  for (std::size_t way = 0; way < (std::size_t(1) << std::min(n, n_tried)); ++way) {
    for (std::size_t i = 0; i < n; ++i) above[order[i]] = i < n_tried ? way >> i & 1 : i % 2;
    attempt(above);
  }
  return best;
}

}  // namespace pipelines

#include "meshes/solids/straight_edges.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "meshes/checks/curved_quality.h"
#include "meshes/values/vectors.h"

namespace meshes {

namespace {

/// An edge by its middle node.
struct CurvedEdge {
  std::array<int, 2> ends{};
  Point arrow{};     // from the middle of its ends to where the surface has the middle
  double share = 1;  // share of the arrow that is left
  std::vector<std::size_t> cells;
};

class Straightener {
public:
  Straightener(CellMesh& mesh, double wanted) : mesh_(mesh), wanted_(wanted) {}

  std::vector<StraightEdge> straighten() {
    for (std::size_t c = 0; c < mesh_.n_cells(); ++c)
      if (scaled_jacobian(mesh_, c) < wanted_) bad_.insert(c);
    if (bad_.empty()) return {};
    find_edges();
    while (!bad_.empty()) {
      const std::size_t cell = *bad_.begin();
      bad_.erase(bad_.begin());
      mend(cell);
    }
    return straightened();
  }

private:
  void find_edges() {
    for (std::size_t f = 0; f < mesh_.n_faces(); ++f)
      for (std::size_t i = 0; i < 3; ++i) {
        const int *face = mesh_.face(f), a = face[i], b = face[(i + 1) % 3], m = face[3 + i];
        CurvedEdge edge;
        edge.ends = {a, b};
        for (std::size_t d = 0; d < 3; ++d) edge.arrow[d] = point(m)[d] - (point(a)[d] + point(b)[d]) / 2;
        constexpr double rounding = 1e-9;  // share of the edge's length
        if (length(edge.arrow) > rounding * length(minus(point(b), point(a)))) edges_.emplace(m, edge);
      }
    for (std::size_t c = 0; c < mesh_.n_cells(); ++c)
      for (std::size_t i = 4; i < 10; ++i)
        if (const auto found = edges_.find(mesh_.cell(c)[i]); found != edges_.end())
          found->second.cells.push_back(c);
  }

  /// One edge alone if that is enough, the one that leaves the surface least; else all of them together.
  void mend(std::size_t cell) {
    if (scaled_jacobian(mesh_, cell) >= wanted_) return;
    std::vector<int> curved;
    for (std::size_t i = 4; i < 10; ++i)
      if (const auto found = edges_.find(mesh_.cell(cell)[i]);
          found != edges_.end() && found->second.share > 0)
        curved.push_back(found->first);
    std::pair<double, std::vector<int>> least{0, {}};  // distance, edges
    double left = 0;
    for (const int edge : curved)
      if (const auto share = share_that_mends(cell, {edge}); share.second) {
        const double off = (1 - share.first) * length(edges_.at(edge).arrow);
        if (least.second.empty() || off < least.first) least = {off, {edge}}, left = share.first;
      }
    if (least.second.empty()) {
      least.second = curved;
      left = share_that_mends(cell, curved).first;
    }
    for (const int edge : least.second) {
      if (edges_.at(edge).share <= left) continue;  // nothing that would be better
      keep(edge, left);
      for (const auto other : edges_.at(edge).cells)
        if (scaled_jacobian(mesh_, other) < wanted_) bad_.insert(other);
    }
  }

  /// The largest share of the edges' curvature at which the cell is as good as wanted, of those that are
  /// tried; else, and false, the best one for the cell. Leaves the edges as they were.
  std::pair<double, bool> share_that_mends(std::size_t cell, const std::vector<int>& edges) {
    constexpr int n_steps = 4;
    std::map<int, double> before;
    for (const int edge : edges) before[edge] = edges_.at(edge).share;
    std::pair<double, bool> found{0, false};
    double best = -2;
    for (int i = n_steps - 1; i >= 0 && !found.second; --i) {
      const double share = double(i) / n_steps;
      for (const int edge : edges) keep(edge, share);
      const double quality = scaled_jacobian(mesh_, cell);
      if (quality > best) best = quality, found = {share, quality >= wanted_};
      for (const int edge : edges) restore(edge, before.at(edge));
    }
    return found;
  }

  void keep(int edge, double share) { restore(edge, std::min(share, edges_.at(edge).share)); }
  void restore(int middle, double share) {
    CurvedEdge& edge = edges_.at(middle);
    edge.share = share;
    for (std::size_t d = 0; d < 3; ++d)
      mesh_.points[std::size_t(middle)][d] =
          (point(edge.ends[0])[d] + point(edge.ends[1])[d]) / 2 + share * edge.arrow[d];
  }

  std::vector<StraightEdge> straightened() const {
    std::vector<StraightEdge> result;
    for (const auto& [middle, edge] : edges_)
      if (edge.share < 1)
        result.push_back({point(middle), length(minus(point(edge.ends[1]), point(edge.ends[0]))),
                          (1 - edge.share) * length(edge.arrow)});
    return result;
  }

  const Point& point(int node) const { return mesh_.points[std::size_t(node)]; }

  CellMesh& mesh_;
  double wanted_;
  std::set<std::size_t> bad_;
  std::map<int, CurvedEdge> edges_;
};

}  // namespace

std::vector<StraightEdge> straighten_edges(CellMesh& mesh, double wanted) {
  return Straightener(mesh, wanted).straighten();
}

}  // namespace meshes

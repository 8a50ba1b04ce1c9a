#include "meshes/solids/inner_nodes.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "meshes/checks/curved_quality.h"

namespace meshes {

namespace {

constexpr int edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}};  // gmsh's order

class Mover {
public:
  explicit Mover(CellMesh& mesh)
      : mesh_(mesh),
        cells_of_(mesh.points.size()),
        fixed_(mesh.points.size(), 0),
        moved_at_(mesh.points.size(), 0),
        failed_at_(mesh.points.size(), -1) {
    std::vector<int> volume(mesh.points.size(), 0);
    for (std::size_t c = 0; c < mesh.n_cells(); ++c)
      for (std::size_t i = 0; i < 10; ++i) {
        const int node = mesh.cell(c)[i];
        if (!cells_of_[node].empty() && volume[node] != mesh.volume_id[c]) fixed_[node] = 1;
        volume[node] = mesh.volume_id[c];
        cells_of_[node].push_back(c);
      }
    for (const int node : mesh.faces) fixed_[node] = 1;
  }

  /// Tries the 26 neighbours on a lattice whose step gets smaller; keeps the best.
  bool improve(int node) {
    if (fixed_[node]) return false;
    Group group = group_of(node);
    if (newest_move(group) <= failed_at_[node]) return false;  // it would find the same again
    bool moved = false;
    const double before = sort_by_quality(group.cells);
    double best = before;
    for (double step = 0.3 * group.size; step > 0.01 * group.size; step /= 2) {
      Point best_move{};
      for (int i = 0; i < 27; ++i) {
        const int steps[] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
        const Point move = {step * steps[0], step * steps[1], step * steps[2]};
        shift(group, move, 1);
        if (const double quality = worst_of(group.cells, best); quality > best) {
          best = quality;
          best_move = move;
        }
        shift(group, move, -1);
      }
      shift(group, best_move, 1);
      moved = moved || best_move != Point{};
    }
    if (moved) {
      ++n_moves_;
      moved_at_[node] = n_moves_;
      for (const int m : group.middles) moved_at_[m] = n_moves_;
    } else {
      failed_at_[node] = n_moves_;
    }
    return best > before + 1e-6;
  }

private:
  struct Group {
    int node = 0;
    std::vector<int> middles;        // inner ones of the edges at a corner
    std::vector<std::size_t> cells;  // cells that any of these belongs to
    double size = 1e300;             // shortest edge of the node's cells
  };

  Group group_of(int node) const {
    Group group;
    group.node = node;
    std::set<int> middles;
    std::set<std::size_t> cells(cells_of_[node].begin(), cells_of_[node].end());
    for (const auto c : cells_of_[node])
      for (int e = 0; e < 6; ++e) {
        const int a = mesh_.cell(c)[edges[e][0]], b = mesh_.cell(c)[edges[e][1]], m = mesh_.cell(c)[4 + e];
        double sum = 0;
        for (int d = 0; d < 3; ++d) sum += std::pow(mesh_.points[a][d] - mesh_.points[b][d], 2);
        group.size = std::min(group.size, std::sqrt(sum));
        if ((a == node || b == node) && !fixed_[m]) middles.insert(m);
      }
    for (const int m : middles) cells.insert(cells_of_[m].begin(), cells_of_[m].end());
    group.middles.assign(middles.begin(), middles.end());
    group.cells.assign(cells.begin(), cells.end());
    return group;
  }
  int newest_move(const Group& group) const {
    int newest = 0;
    for (const auto c : group.cells)
      for (std::size_t i = 0; i < 10; ++i) newest = std::max(newest, moved_at_[mesh_.cell(c)[i]]);
    return newest;
  }
  /// The worst first: of most moves it tells alone that they are no good.
  /// @return its quality
  double sort_by_quality(std::vector<std::size_t>& cells) const {
    std::vector<std::pair<double, std::size_t>> order;
    order.reserve(cells.size());
    for (const auto c : cells) order.emplace_back(scaled_jacobian(mesh_, c), c);
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = order[i].second;
    return order.empty() ? 1 : std::min(1.0, order.front().first);
  }
  /// Something not above `enough` as soon as a cell is not.
  double worst_of(const std::vector<std::size_t>& cells, double enough) const {
    double worst = 1;
    for (std::size_t i = 0; i < cells.size() && worst > enough; ++i)
      worst = std::min(worst, scaled_jacobian(mesh_, cells[i]));
    return worst;
  }
  void shift(const Group& group, const Point& move, double sign) {
    for (int d = 0; d < 3; ++d) {
      mesh_.points[group.node][d] += sign * move[d];
      for (const int m : group.middles) mesh_.points[m][d] += sign * move[d] / 2;
    }
  }

  CellMesh& mesh_;
  std::vector<std::vector<std::size_t>> cells_of_;  // nodes
  std::vector<char> fixed_;
  int n_moves_ = 0;
  std::vector<int> moved_at_;   // number of each node's last move; 0: none
  std::vector<int> failed_at_;  // number of moves when nothing was better for a node; -1: never
};

}  // namespace

void move_inner_nodes(CellMesh& mesh, double wanted) {
  std::vector<std::size_t> bad;
  for (std::size_t c = 0; c < mesh.n_cells(); ++c)
    if (scaled_jacobian(mesh, c) < wanted) bad.push_back(c);
  // Where a good share of them is flat the part is thin against its cells: moves take hours and mend nothing.
  constexpr double hopeless_share = 0.3;
  if (bad.empty() || double(bad.size()) > hopeless_share * double(mesh.n_cells())) return;
  Mover mover(mesh);
  constexpr int n_passes = 5;
  bool any = true;
  for (int pass = 0; pass < n_passes && any; ++pass) {
    any = false;
    for (const auto c : bad)
      for (std::size_t i = 0; i < 10 && scaled_jacobian(mesh, c) < wanted; ++i)
        any = mover.improve(mesh.cell(c)[i]) || any;
  }
}

}  // namespace meshes

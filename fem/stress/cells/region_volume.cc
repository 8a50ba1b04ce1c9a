#include "fem/stress/cells/region_volume.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "fem/equations/operators/subdomain.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/reference_cell.h"

namespace fem {
namespace {

/// Nodes are numbered as in grid.h.
struct SubTetrahedron {
  std::array<int, 4> nodes{};
  double reference_volume = 0;
};

/// The four corners of a quadratic tetrahedron, and the octahedron between them cut along its diagonal 6-8.
std::vector<SubTetrahedron> pieces_of_tetrahedron() {
  std::vector<SubTetrahedron> pieces;
  for (const auto& nodes : std::vector<std::array<int, 4>>{{0, 4, 6, 7},
                                                           {4, 1, 5, 8},
                                                           {6, 5, 2, 9},
                                                           {7, 8, 9, 3},
                                                           {6, 8, 4, 5},
                                                           {6, 8, 5, 9},
                                                           {6, 8, 9, 7},
                                                           {6, 8, 7, 4}})
    pieces.push_back({nodes, 1. / 48});
  return pieces;
}

/// Six around each of the four diagonals of every box between nodes: one for each order of the axes. All four
/// count a quarter, so that what is measured does not depend on how the cell is turned or mirrored.
std::vector<SubTetrahedron> pieces_of_hexahedron(int degree) {
  const auto& nodes = nodes_in_cell({CellKind::hexahedra, degree}).point;  // the first ones along an edge
  const std::array<int, 3> stride = {1, degree + 1, (degree + 1) * (degree + 1)};
  const std::array<std::array<bool, 3>, 4> high_starts = {
      {{false, false, false}, {true, false, false}, {false, true, false}, {false, false, true}}};
  std::vector<SubTetrahedron> pieces;
  for (int box = 0; box < degree * degree * degree; ++box) {
    const std::array<int, 3> low = {box % degree, box / degree % degree, box / (degree * degree)};
    double volume = 1;
    for (std::size_t d = 0; d < 3; ++d)
      volume *= nodes[std::size_t(low[d]) + 1][0] - nodes[std::size_t(low[d])][0];
    for (const auto& starts_high : high_starts) {
      int first = 0;
      std::array<int, 3> step = stride;
      for (std::size_t d = 0; d < 3; ++d) {
        first += stride[d] * (low[d] + starts_high[d]);
        if (starts_high[d]) step[d] = -step[d];
      }
      std::array<std::size_t, 3> axes = {0, 1, 2};
      do {
        const int second = first + step[axes[0]], third = second + step[axes[1]];
        pieces.push_back({{first, second, third, third + step[axes[2]]}, volume / 24});
      } while (std::next_permutation(axes.begin(), axes.end()));
    }
  }
  return pieces;
}

/// Pieces cut into eight at the middles of their edges. Points are the cell's nodes, then the middles.
struct HalvedPieces {
  std::vector<std::array<int, 2>> middle_of;  ///< by middle: the nodes at the ends of its edge
  ReferencePoints points;
  std::vector<SubTetrahedron> pieces;

  HalvedPieces(const ReferencePoints& nodes, const std::vector<SubTetrahedron>& whole) : points(nodes) {
    const auto eighths = pieces_of_tetrahedron();  // of the corners and middles of any tetrahedron
    constexpr std::array<std::array<std::size_t, 2>, 6> edges = {
        {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
    std::map<std::array<int, 2>, int> known;
    for (const auto& piece : whole) {
      std::array<int, 10> at{};
      std::copy(piece.nodes.begin(), piece.nodes.end(), at.begin());
      for (std::size_t e = 0; e < edges.size(); ++e) {
        std::array<int, 2> ends = {piece.nodes[edges[e][0]], piece.nodes[edges[e][1]]};
        std::sort(ends.begin(), ends.end());
        const auto [entry, is_new] = known.try_emplace(ends, int(points.size()));
        if (is_new) {
          const auto &a = nodes[std::size_t(ends[0])], &b = nodes[std::size_t(ends[1])];
          points.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
          middle_of.push_back(ends);
        }
        at[4 + e] = entry->second;
      }
      for (const auto& eighth : eighths) {
        auto& part = pieces.emplace_back();
        for (std::size_t i = 0; i < 4; ++i) part.nodes[i] = at[std::size_t(eighth.nodes[i])];
        part.reference_volume = piece.reference_volume / 8;
      }
    }
  }
};

/// Measures one cell after the other; keeps what all cells share.
class CellVolumes {
public:
  explicit CellVolumes(const Nodes& nodes)
      : part_(make_subdomain(nodes)),
        at_nodes_(nodes_in_cell(nodes.shape())),
        inside_(
            gauss_in_cell(nodes.shape(), nodes.shape().is_tetrahedron() ? 2 : (3 * nodes.degree + 1) / 2)),
        pieces_(nodes.shape().is_tetrahedron() ? pieces_of_tetrahedron()
                                               : pieces_of_hexahedron(nodes.degree)),
        determinant_(nodes.nodes_per_cell()),
        volumes_(pieces_.size()) {}

  /// Adds the cell's volume to its nodes'.
  void share_out(std::size_t cell, std::vector<double>& volume_of_node) {
    const double whole = exact(cell), sum = measure_pieces(cell, whole);
    if (!(sum > 0)) return;
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      for (const int corner : pieces_[p].nodes)
        volume_of_node[node(cell, corner)] += whole * volumes_[p] / sum / 4;
  }

  double above(std::size_t cell, const std::vector<double>& value, double level,
               const std::vector<char>& left_out) {
    const auto is_in = [&](std::size_t i) { return value[i] >= level && left_out[i] == 0; };
    const int n_local = part_.grid.nodes_per_cell();
    int n_in = 0;
    for (int i = 0; i < n_local; ++i) n_in += is_in(node(cell, i));
    if (n_in == 0) return 0;
    const double whole = exact(cell);
    if (n_in == n_local) return whole;
    const double sum = measure_pieces(cell, whole);
    if (!(sum > 0)) return 0;
    double part = 0;
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const auto& piece = pieces_[p];
      std::array<double, 4> beyond{};
      int n_kept = 0, n_kept_in = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const auto own = node(cell, piece.nodes[i]);
        beyond[i] = value[own] - level;
        n_kept += left_out[own] == 0;
        n_kept_in += is_in(own);
      }
      if (n_kept_in > 0) part += volumes_[p] * share_above_zero(beyond) * n_kept / 4;
    }
    return whole * part / sum;
  }

  /// The same of a field that is curved between the nodes.
  /// @param slope  of the field at each node; of cells of degree 1, whose shape functions are straight
  double curved_above(std::size_t cell, const std::vector<double>& value, double level,
                      const std::vector<char>& left_out, const std::vector<Eigen::Vector3d>& slope) {
    const int n_local = part_.grid.nodes_per_cell();
    int n_in = 0, n_left_out = 0;
    for (int i = 0; i < n_local; ++i) {
      n_in += value[node(cell, i)] >= level;
      n_left_out += left_out[node(cell, i)] != 0;
    }
    if (n_left_out > 0 || n_in == 0 || n_in == n_local) return above(cell, value, level, left_out);
    if (!halved_) {
      halved_.emplace(at_nodes_.point, pieces_);
      at_halved_ = tabulate_in_cell(part_.grid.shape(), halved_->points);
    }
    const std::size_t n_points = halved_->points.size();
    std::vector<double> beyond(n_points), determinant(n_points);
    for (std::size_t q = 0; q < n_points; ++q) {
      determinant[q] = jacobian(part_.grid, cell, at_halved_, int(q)).determinant();
      beyond[q] = q < std::size_t(n_local) ? value[node(cell, int(q))] - level
                                           : at_middle(cell, q, value, slope) - level;
    }
    const double whole = exact(cell);
    double sum = 0, part = 0;
    for (const auto& piece : halved_->pieces) {
      double volume = 0;
      std::array<double, 4> at_corners{};
      for (std::size_t i = 0; i < 4; ++i) {
        const auto q = std::size_t(piece.nodes[i]);
        volume += piece.reference_volume * determinant[q] / 4;
        at_corners[i] = beyond[q];
      }
      sum += volume;
      part += volume * share_above_zero(at_corners);
    }
    return sum > collapsed * whole ? whole * part / sum : above(cell, value, level, left_out);
  }

  /// Calls back with the four nodes of every piece that has no corner left out, its volume, and the
  /// field's slope in it.
  template <typename Take>
  void for_pieces(std::size_t cell, const std::vector<double>& value, const std::vector<char>& left_out,
                  const Take& take) const {
    for (const auto& piece : pieces_) {
      std::array<std::size_t, 4> at{};
      for (std::size_t i = 0; i < 4; ++i) at[i] = node(cell, piece.nodes[i]);
      if (std::any_of(at.begin(), at.end(), [&](std::size_t i) { return left_out[i] != 0; })) continue;
      Eigen::Vector3d rise;
      for (std::size_t i = 0; i < 3; ++i) rise[Eigen::Index(i)] = value[at[i + 1]] - value[at[0]];
      const Eigen::Matrix3d edges = edges_of(cell, piece);
      const double volume = std::abs(edges.determinant()) / 6;
      const double size = edges.colwise().norm().prod();
      if (volume > flat * size) take(at, volume, Eigen::Vector3d(edges.transpose().inverse() * rise));
    }
  }

private:
  static constexpr double flat = 1e-6;       // of a piece that has collapsed at the axis
  static constexpr double collapsed = 1e-6;  // likewise of a cell

  /// By the shape functions; of cells of degree 1 by Hermite's cubic between both ends of the edge.
  double at_middle(std::size_t cell, std::size_t q, const std::vector<double>& value,
                   const std::vector<Eigen::Vector3d>& slope) const {
    const int n_local = part_.grid.nodes_per_cell();
    if (part_.grid.degree == 1) {
      const auto& ends = halved_->middle_of[q - std::size_t(n_local)];
      const auto a = node(cell, ends[0]), b = node(cell, ends[1]);
      return (value[a] + value[b]) / 2 +
             (slope[a] - slope[b]).dot(position(cell, ends[1]) - position(cell, ends[0])) / 8;
    }
    double sum = 0;
    for (int i = 0; i < n_local; ++i)
      sum += at_halved_.value[q * std::size_t(n_local) + std::size_t(i)] * value[node(cell, i)];
    return sum;
  }

  Eigen::Map<const Eigen::Vector3d> position(std::size_t cell, int local) const {
    return Eigen::Map<const Eigen::Vector3d>(
        part_.grid.position(std::size_t(part_.grid.nodes_of(cell)[local])));
  }

  /// In the numbers of the body.
  std::size_t node(std::size_t cell, int local) const {
    return std::size_t(part_.node[std::size_t(part_.grid.nodes_of(cell)[local])]);
  }

  /// Volumes of the pieces of a cell; cells that the level does not cut do without. A cell
  /// that is turned from a triangle at the axis is a tetrahedron, and its Jacobian vanishes at all corners:
  /// its pieces have the volumes between their corners.
  /// @return their sum; 0: the cell has no volume
  double measure_pieces(std::size_t cell, double whole) {
    for (std::size_t i = 0; i < determinant_.size(); ++i)
      determinant_[i] = jacobian(part_.grid, cell, at_nodes_, int(i)).determinant();
    double sum = 0;
    for (std::size_t p = 0; p < pieces_.size(); ++p) sum += volumes_[p] = volume_of(pieces_[p]);
    if (sum > collapsed * whole) return sum;
    sum = 0;
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      sum += volumes_[p] = volume_between_corners(cell, pieces_[p]);
    return sum;
  }

  double volume_of(const SubTetrahedron& piece) const {
    double sum = 0;
    for (const int corner : piece.nodes) sum += determinant_[std::size_t(corner)];
    return piece.reference_volume * sum / 4;
  }

  double volume_between_corners(std::size_t cell, const SubTetrahedron& piece) const {
    return std::abs(edges_of(cell, piece).determinant()) / 6;
  }

  /// From the first corner to the others.
  Eigen::Matrix3d edges_of(std::size_t cell, const SubTetrahedron& piece) const {
    const auto corner = [&](std::size_t i) {
      return Eigen::Map<const Eigen::Vector3d>(
          part_.grid.position(part_.grid.nodes_of(cell)[piece.nodes[i]]));
    };
    Eigen::Matrix3d edges;
    for (std::size_t i = 0; i < 3; ++i) edges.col(Eigen::Index(i)) = corner(i + 1) - corner(0);
    return edges;
  }

  double exact(std::size_t cell) const {
    double volume = 0;
    for (int q = 0; q < inside_.n_points; ++q)
      volume += inside_.weight[std::size_t(q)] * jacobian(part_.grid, cell, inside_, q).determinant();
    return volume;
  }

  Subdomain part_;  // all cells, in our order of nodes
  Tabulation at_nodes_, inside_;
  std::vector<SubTetrahedron> pieces_;
  std::vector<double> determinant_, volumes_;
  std::optional<HalvedPieces> halved_;
  Tabulation at_halved_;
};

/// Volume-weighted means over the tetrahedra around each node.
std::vector<Eigen::Vector3d> slopes(const CellVolumes& measure, const Nodes& nodes,
                                    const std::vector<double>& value, const std::vector<char>& left_out) {
  std::vector<Eigen::Vector3d> slope(nodes.n, Eigen::Vector3d::Zero());
  std::vector<double> weight(nodes.n, 0.0);
  for (std::size_t c = 0; c < nodes.n_cells(); ++c)
    measure.for_pieces(c, value, left_out,
                       [&](const auto& corners, double volume, const Eigen::Vector3d& of_piece) {
                         for (const auto i : corners) {
                           slope[i] += volume * of_piece;
                           weight[i] += volume;
                         }
                       });
  for (std::size_t i = 0; i < nodes.n; ++i)
    if (weight[i] > 0) slope[i] /= weight[i];
  return slope;
}

}  // namespace

// With a, b >= 0 above and -c, -e below it, one corner above is a small tetrahedron, one below leaves the
// rest, and two above a wedge: sum of d_i^3 / prod (d_i - d_j) over the corners above, without its 0 / 0 at a
// = b.
double share_above_zero(std::array<double, 4> corners) {
  std::sort(corners.begin(), corners.end(), std::greater<>());
  if (!(corners.front() >= 0)) return 0;
  if (corners.back() >= 0) return 1;
  const double scale = std::max(corners.front(), -corners.back());  // fourth powers of 1e+-150 would not do
  for (double& corner : corners) corner /= scale;
  const auto [a, b, third, fourth] = corners;
  const double e = -fourth;
  if (third >= 0) return 1 - e / (a + e) * (e / (b + e)) * (e / (third + e));
  const double c = -third;
  if (b < 0) return a / (a - b) * (a / (a + c)) * (a / (a + e));
  return (a * a * b * b + a * b * (a + b) * (c + e) + c * e * (a * a + a * b + b * b)) /
         ((a + c) * (a + e) * (b + c) * (b + e));
}

std::vector<double> cell_volumes_above_m3(const Nodes& nodes, const std::vector<double>& value, double level,
                                          const std::vector<char>& left_out) {
  std::vector<double> volumes(nodes.n_cells());
  if (volumes.empty()) return volumes;
  CellVolumes measure(nodes);
  for (std::size_t c = 0; c < volumes.size(); ++c) volumes[c] = measure.above(c, value, level, left_out);
  return volumes;
}

std::vector<double> curved_cell_volumes_above_m3(const Nodes& nodes, const std::vector<double>& value,
                                                 double level, const std::vector<char>& left_out) {
  std::vector<double> volumes(nodes.n_cells());
  if (volumes.empty()) return volumes;
  CellVolumes measure(nodes);
  std::vector<Eigen::Vector3d> slope;
  if (nodes.degree == 1) slope = slopes(measure, nodes, value, left_out);
  for (std::size_t c = 0; c < volumes.size(); ++c)
    volumes[c] = measure.curved_above(c, value, level, left_out, slope);
  return volumes;
}

std::vector<double> nodal_volumes_m3(const Nodes& nodes) {
  std::vector<double> volumes(nodes.n, 0.0);
  if (nodes.n_cells() == 0) return volumes;
  CellVolumes measure(nodes);
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) measure.share_out(c, volumes);
  return volumes;
}

}  // namespace fem

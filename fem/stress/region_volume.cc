#include "fem/stress/region_volume.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>

#include "fem/common/lagrange.h"
#include "fem/mesh/reference_cell.h"
#include "fem/values/vtk_order.h"

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
  const auto at = nodes_on_edge(degree);
  const std::array<int, 3> stride = {1, degree + 1, (degree + 1) * (degree + 1)};
  const std::array<std::array<bool, 3>, 4> high_starts = {
      {{false, false, false}, {true, false, false}, {false, true, false}, {false, false, true}}};
  std::vector<SubTetrahedron> pieces;
  for (int box = 0; box < degree * degree * degree; ++box) {
    const std::array<int, 3> low = {box % degree, box / degree % degree, box / (degree * degree)};
    double volume = 1;
    for (std::size_t d = 0; d < 3; ++d) volume *= at[std::size_t(low[d]) + 1] - at[std::size_t(low[d])];
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

/// Measures one cell after the other; keeps what all cells share.
class CellVolumes {
public:
  explicit CellVolumes(const Nodes& nodes)
      : nodes_(nodes),
        at_nodes_(nodes_in_cell(nodes.shape())),
        inside_(
            gauss_in_cell(nodes.shape(), nodes.shape().is_tetrahedron() ? 2 : (3 * nodes.degree + 1) / 2)),
        pieces_(nodes.shape().is_tetrahedron() ? pieces_of_tetrahedron()
                                               : pieces_of_hexahedron(nodes.degree)),
        determinant_(nodes.nodes_per_cell()),
        volumes_(pieces_.size()),
        local_(nodes.nodes_per_cell()) {}

  /// Adds the cell's volume to its nodes'.
  void share_out(std::size_t cell, std::vector<double>& volume_of_node) {
    take(nodes_.cell(cell));
    const double whole = exact(), sum = measure_pieces(whole);
    if (!(sum > 0)) return;
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      for (const int corner : pieces_[p].nodes)
        volume_of_node[local_[std::size_t(corner)]] += whole * volumes_[p] / sum / 4;
  }

  double above(std::size_t cell, const std::vector<double>& value, double level,
               const std::vector<char>& left_out) {
    take(nodes_.cell(cell));
    const auto is_in = [&](std::size_t i) { return value[i] >= level && left_out[i] == 0; };
    const auto n_in = std::count_if(local_.begin(), local_.end(), is_in);
    if (n_in == 0) return 0;
    const double whole = exact();
    if (std::size_t(n_in) == local_.size()) return whole;
    const double sum = measure_pieces(whole);
    if (!(sum > 0)) return 0;
    double part = 0;
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const auto& piece = pieces_[p];
      std::array<double, 4> beyond{};
      int n_kept = 0, n_kept_in = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const auto node = local_[std::size_t(piece.nodes[i])];
        beyond[i] = value[node] - level;
        n_kept += left_out[node] == 0;
        n_kept_in += is_in(node);
      }
      if (n_kept_in > 0) part += volumes_[p] * share_above_zero(beyond) * n_kept / 4;
    }
    return whole * part / sum;
  }

private:
  void take(const NodeList& cell) {
    const int* order = vtk_hexahedron_order(nodes_.degree);
    for (std::size_t v = 0; v < cell.size(); ++v)
      local_[nodes_.shape().is_tetrahedron() ? v : std::size_t(order[v])] = std::size_t(cell[v]);
  }

  /// Volumes of the pieces of the cell that was taken; cells that the level does not cut do without. A cell
  /// that is turned from a triangle at the axis is a tetrahedron, and its Jacobian vanishes at all corners:
  /// its pieces have the volumes between their corners.
  /// @return their sum; 0: the cell has no volume
  double measure_pieces(double whole) {
    constexpr double collapsed = 1e-6;
    for (std::size_t i = 0; i < local_.size(); ++i) determinant_[i] = determinant(at_nodes_, int(i));
    double sum = 0;
    for (std::size_t p = 0; p < pieces_.size(); ++p) sum += volumes_[p] = volume_of(pieces_[p]);
    if (sum > collapsed * whole) return sum;
    sum = 0;
    for (std::size_t p = 0; p < pieces_.size(); ++p) sum += volumes_[p] = volume_between_corners(pieces_[p]);
    return sum;
  }

  double volume_of(const SubTetrahedron& piece) const {
    double sum = 0;
    for (const int corner : piece.nodes) sum += determinant_[std::size_t(corner)];
    return piece.reference_volume * sum / 4;
  }

  double volume_between_corners(const SubTetrahedron& piece) const {
    const auto corner = [&](std::size_t i) {
      return Eigen::Map<const Eigen::Vector3d>(&nodes_.xyz_m[3 * local_[std::size_t(piece.nodes[i])]]);
    };
    Eigen::Matrix3d edges;
    for (std::size_t i = 0; i < 3; ++i) edges.col(Eigen::Index(i)) = corner(i + 1) - corner(0);
    return std::abs(edges.determinant()) / 6;
  }

  double determinant(const Tabulation& at, int q) const {
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < local_.size(); ++i)
      jacobian +=
          Eigen::Map<const Eigen::Vector3d>(&nodes_.xyz_m[3 * local_[i]]) *
          Eigen::Map<const Eigen::RowVector3d>(at.gradient[std::size_t(q) * local_.size() + i].data());
    return jacobian.determinant();
  }

  double exact() const {
    double volume = 0;
    for (int q = 0; q < inside_.n_points; ++q)
      volume += inside_.weight[std::size_t(q)] * determinant(inside_, q);
    return volume;
  }

  const Nodes& nodes_;
  Tabulation at_nodes_, inside_;
  std::vector<SubTetrahedron> pieces_;
  std::vector<double> determinant_, volumes_;
  std::vector<std::size_t> local_;  // node of each local number
};

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

std::vector<double> nodal_volumes_m3(const Nodes& nodes) {
  std::vector<double> volumes(nodes.n, 0.0);
  if (nodes.n_cells() == 0) return volumes;
  CellVolumes measure(nodes);
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) measure.share_out(c, volumes);
  return volumes;
}

}  // namespace fem

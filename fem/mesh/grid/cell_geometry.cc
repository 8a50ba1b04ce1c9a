#include "fem/mesh/grid/cell_geometry.h"

#include <optional>
#include <sstream>

#include "fem/base/values/errors.h"

namespace fem {

Eigen::Matrix3d jacobian(const Grid& grid, std::size_t cell, const Tabulation& at, int q) {
  Eigen::Matrix3d j = Eigen::Matrix3d::Zero();
  const auto* nodes = grid.nodes_of(cell);
  for (int i = 0; i < at.n_shapes; ++i) {
    const Eigen::Map<const Eigen::Vector3d> x(grid.position(nodes[i]));
    const Eigen::Map<const Eigen::RowVector3d> g(at.gradient[std::size_t(q) * at.n_shapes + i].data());
    j += x * g;
  }
  return j;
}

Eigen::Vector3d position(const Grid& grid, std::size_t cell, const Tabulation& at, int q) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  const auto* nodes = grid.nodes_of(cell);
  for (int i = 0; i < at.n_shapes; ++i)
    x += at.value[std::size_t(q) * at.n_shapes + i] *
         Eigen::Map<const Eigen::Vector3d>(grid.position(nodes[i]));
  return x;
}

void compute_gradients(const Grid& grid, std::size_t cell, const Tabulation& at, CellGradients& result) {
  result.gradient.resize(3 * at.n_points, at.n_shapes);
  result.jxw.resize(at.n_points);
  for (int q = 0; q < at.n_points; ++q) {
    const Eigen::Matrix3d j = jacobian(grid, cell, at, q);
    const Eigen::Matrix3d to_space = j.inverse().transpose();
    const Eigen::Map<const Eigen::Matrix3Xd> reference(at.gradient[std::size_t(q) * at.n_shapes].data(), 3,
                                                       at.n_shapes);
    result.gradient.middleRows<3>(3 * q).noalias() = to_space.lazyProduct(reference);
    result.jxw[q] = j.determinant() * (at.weight.empty() ? 1.0 : at.weight[q]);
  }
}

FacePoint face_point(const Grid& grid, const std::vector<std::int32_t>& nodes, const Tabulation& at, int q) {
  FacePoint p{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  Eigen::Vector3d along_first = Eigen::Vector3d::Zero(), along_second = Eigen::Vector3d::Zero();
  for (int i = 0; i < at.n_shapes; ++i) {
    const Eigen::Map<const Eigen::Vector3d> x(grid.position(nodes[i]));
    const std::size_t k = std::size_t(q) * at.n_shapes + i;
    p.position += at.value[k] * x;
    along_first += at.gradient[k][0] * x;
    along_second += at.gradient[k][1] * x;
  }
  p.area = along_first.cross(along_second) * at.weight[q];
  return p;
}

std::vector<std::int32_t> nodes_of_face(const Grid& grid, std::size_t cell, int face) {
  std::vector<std::int32_t> nodes;
  for (const int i : face_nodes(grid.shape(), face)) nodes.push_back(grid.nodes_of(cell)[i]);
  return nodes;
}

namespace {

struct InvertedPoint {
  std::size_t cell = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// One point of each inverted cell, at most so many.
std::vector<InvertedPoint> inverted_points(const Grid& grid, std::size_t most) {
  const Tabulation tables[] = {nodes_in_cell(grid.shape()), gauss_in_cell(grid.shape(), grid.degree + 1)};
  const auto inverted_point = [&](std::size_t cell) -> std::optional<Eigen::Vector3d> {
    for (const auto& at : tables)
      for (int q = 0; q < at.n_points; ++q)
        if (!(jacobian(grid, cell, at, q).determinant() > 0)) return position(grid, cell, at, q);
    return std::nullopt;
  };
  std::vector<InvertedPoint> found;
  for (std::size_t c = 0; c < grid.n_cells() && found.size() < most; ++c)
    if (const auto point = inverted_point(c)) found.push_back({c, *point});
  return found;
}

}  // namespace

std::vector<std::size_t> inverted_cells(const Grid& grid) {
  std::vector<std::size_t> cells;
  for (const auto& point : inverted_points(grid, grid.n_cells())) cells.push_back(point.cell);
  return cells;
}

void refuse_inverted_cells(const Grid& grid) {
  for (const auto& [cell, x] : inverted_points(grid, 1)) {
    std::ostringstream message;
    message << "the mesh has an inverted or degenerate cell in volume " << grid.volume_id[cell] << " (number "
            << cell + 1 << " of all cells) near (" << x[0] << ", " << x[1] << ", " << x[2]
            << ") m: refine the mesh there or check its geometry";
    throw MeshUnusable(message.str());
  }
}

}  // namespace fem

#include "fem/equations/loads/clamps.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "fem/base/common/dense_algebra.h"
#include "fem/mesh/grid/cell_geometry.h"

namespace fem {

namespace {

/// Largest distance of a node from the first one: the body's size up to a factor of two.
double size_m(const Grid& grid) {
  const Eigen::Map<const Eigen::Matrix3Xd> nodes(grid.xyz_m.data(), 3, grid.n_nodes);
  return (nodes.colwise() - nodes.col(0)).colwise().norm().maxCoeff();
}

std::vector<std::int32_t> held_nodes(const Grid& grid, const Clamp& clamp, double size) {
  const std::string name = "clamp of boundary group " + std::to_string(clamp.boundary_id);
  if (!clamp.fixed[0] && !clamp.fixed[1] && !clamp.fixed[2])
    throw std::invalid_argument(name + ": it fixes no direction; fix one of x, y, z or leave it out");
  constexpr double same_height = 1e-9;  // of the body's size: rounding of coordinates, far below any cell
  bool has_faces = false;
  std::vector<std::int32_t> nodes;
  for (const auto& face : grid.boundary) {
    if (face.boundary_id != clamp.boundary_id) continue;
    has_faces = true;
    for (const auto node : nodes_of_face(grid, face.cell, face.face))
      if (!clamp.only_at_z_m || std::abs(grid.position(node)[2] - *clamp.only_at_z_m) <= same_height * size)
        nodes.push_back(node);
  }
  if (!has_faces) throw std::invalid_argument(name + ": the mesh has no faces in this physical group");
  if (nodes.empty()) {
    std::ostringstream message;
    message << name << ": none of its nodes lies at z = " << *clamp.only_at_z_m
            << " m; put a row of nodes there";
    throw std::invalid_argument(message.str());
  }
  return nodes;
}

/// The rigid motion that moves the held unknowns least must move them at all. Rotations count by the
/// displacement at the body's size.
void refuse_rigid_motion(const Grid& grid, const std::vector<std::int64_t>& unknowns, double size) {
  const Eigen::Map<const Eigen::Matrix3Xd> nodes(grid.xyz_m.data(), 3, grid.n_nodes);
  const Eigen::Vector3d centre = nodes.rowwise().mean();
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
  for (const auto unknown : unknowns) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(unknown % 3);
    Vector6 row;  // e . (t + w x r) = e . t + (r x e) . w
    row << axis, ((nodes.col(unknown / 3) - centre) / size).cross(axis);
    gram += row * row.transpose();
  }
  const Eigenpairs modes = symmetric_eigenpairs(gram);
  constexpr double negligible =
      1e-6;  // the share of the best held motion: displacements on a line, as meshed
  if (modes.value[0] > negligible * negligible * modes.value[5]) return;
  Vector6 motion = modes.vector.col(0);
  Eigen::Index largest = 0;
  motion.cwiseAbs().maxCoeff(&largest);
  motion = ((motion / motion[largest]) * 1000).array().round() / 1000 + 0.0;  // + 0.0: no -0
  std::ostringstream message;
  message << "the clamps leave the body a rigid motion, translation (" << motion[0] << ", " << motion[1]
          << ", " << motion[2] << ") with rotation (" << motion[3] << ", " << motion[4] << ", " << motion[5]
          << ") in units of its size: hold all six motions, or none and let inertia balance the loads";
  throw std::invalid_argument(message.str());
}

}  // namespace

std::vector<std::int64_t> clamped_unknowns(const Grid& grid, const std::vector<Clamp>& clamps) {
  std::vector<std::int64_t> unknowns;
  if (clamps.empty()) return unknowns;
  const double size = size_m(grid);
  for (const auto& clamp : clamps)
    for (const auto node : held_nodes(grid, clamp, size))
      for (int d = 0; d < 3; ++d)
        if (clamp.fixed[d]) unknowns.push_back(3 * std::int64_t(node) + d);
  std::sort(unknowns.begin(), unknowns.end());
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  refuse_rigid_motion(grid, unknowns, size);
  return unknowns;
}

void clamp(const std::vector<std::int64_t>& unknowns, SymmetricMatrix& matrix) {
  std::vector<char> held(matrix.n, 0);
  for (const auto unknown : unknowns) held[unknown] = 1;
  for (std::int64_t j = 0; j < matrix.n; ++j)
    for (auto k = matrix.column_begin[j]; k < matrix.column_begin[j + 1]; ++k)
      if (matrix.row[k] != j && (held[j] || held[matrix.row[k]])) matrix.value[k] = 0;
}

void clear_rows(const std::vector<std::int64_t>& unknowns, Eigen::MatrixXd& vectors) {
  for (const auto unknown : unknowns) vectors.row(unknown).setZero();
}

}  // namespace fem

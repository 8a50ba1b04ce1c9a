#include "fem/stress/cells/cell_stress.h"

#include <cmath>

namespace fem {

double von_mises(const double* s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt((a * a + b * b + c * c) / 2 + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

CellStress::CellStress(const Grid& grid, const Tabulation& at, const PerCell<Lame>& elastic,
                       const ConstBlock& displacement)
    : grid_(grid), at_(at), elastic_(elastic), displacement_(displacement) {}

void CellStress::operator()(std::size_t cell, Eigen::Ref<RowMajor> stress) {
  compute_gradients(grid_, cell, at_, gradients_);
  local_.resize(at_.n_shapes, displacement_.cols());
  for (int i = 0; i < at_.n_shapes; ++i) local_.row(i) = displacement_.row(grid_.nodes_of(cell)[i]);
  const Lame elastic = elastic_[cell];
  gradient_.noalias() = gradients_.gradient * local_;  // row 3 q + d: derivatives along d
  for (int q = 0; q < at_.n_points; ++q)
    for (Eigen::Index k = 0; k < displacement_.cols() / 3; ++k) {
      const auto g = [&](int component, int along) { return gradient_(3 * q + along, 3 * k + component); };
      const double dilatation = elastic.lambda_Pa * (g(0, 0) + g(1, 1) + g(2, 2));
      double* s = &stress(q, 6 * k);
      for (int d = 0; d < 3; ++d) s[d] = dilatation + 2 * elastic.mu_Pa * g(d, d);
      s[3] = elastic.mu_Pa * (g(0, 1) + g(1, 0));
      s[4] = elastic.mu_Pa * (g(1, 2) + g(2, 1));
      s[5] = elastic.mu_Pa * (g(0, 2) + g(2, 0));
    }
}

FreeFaceStress::FreeFaceStress(const Grid& grid, const Tabulation& at, const PerCell<Lame>& elastic,
                               const ConstBlock& displacement)
    : grid_(grid), at_(at), elastic_(elastic), displacement_(displacement) {}

void FreeFaceStress::operator()(const BoundaryFace& face, Eigen::Ref<RowMajor> stress) {
  // Plane stress: E / (1 - nu^2), and nu times it.
  const auto [lambda, mu] = elastic_[std::size_t(face.cell)];
  const double direct = 4 * mu * (lambda + mu) / (lambda + 2 * mu),
               cross = 2 * mu * lambda / (lambda + 2 * mu);
  const auto nodes = nodes_of_face(grid_, face.cell, face.face);
  for (int q = 0; q < at_.n_points; ++q) {
    const auto* reference = &at_.gradient[std::size_t(q) * at_.n_shapes];
    Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();  // dx / d(reference axes)
    for (int i = 0; i < at_.n_shapes; ++i)
      for (int a = 0; a < 2; ++a)
        tangents.col(a) += reference[i][a] * Eigen::Map<const Eigen::Vector3d>(grid_.position(nodes[i]));
    Eigen::Matrix<double, 3, 2> e;  // orthonormal in the face
    e.col(0) = tangents.col(0).normalized();
    e.col(1) = tangents.col(0).cross(tangents.col(1)).cross(tangents.col(0)).normalized();
    const Eigen::Matrix2d to_face =
        (e.transpose() * tangents).inverse();  // d(reference) / d(lengths along e)
    for (Eigen::Index k = 0; k < displacement_.cols() / 3; ++k) {
      Eigen::Matrix<double, 3, 2> derivative = Eigen::Matrix<double, 3, 2>::Zero();
      for (int i = 0; i < at_.n_shapes; ++i)
        for (int a = 0; a < 2; ++a)
          derivative.col(a) += reference[i][a] * displacement_.block<1, 3>(nodes[i], 3 * k).transpose();
      const Eigen::Matrix2d g = e.transpose() * derivative * to_face;
      Eigen::Matrix2d s;
      s(0, 0) = direct * g(0, 0) + cross * g(1, 1);
      s(1, 1) = direct * g(1, 1) + cross * g(0, 0);
      s(0, 1) = s(1, 0) = mu * (g(0, 1) + g(1, 0));
      const Eigen::Matrix3d t = e * s * e.transpose();
      stress.block<1, 6>(q, 6 * k) << t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(0, 2);
    }
  }
}

}  // namespace fem

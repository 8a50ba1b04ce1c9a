#include "fem/models/axisymmetric/harmonic_strain.h"

#include "fem/base/common/dense_algebra.h"
#include "fem/base/common/parallel.h"
#include "fem/base/values/constants.h"

namespace fem {

StrainMatrix strain_matrix(const SectionPoint& at, int m) {
  const auto n = at.value.size();
  StrainMatrix strain = StrainMatrix::Zero(6, 3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double by_r = at.by_r[i], by_z = at.by_z[i];
    const double over_r = at.r_m > 0 ? at.value[i] / at.r_m : by_r;
    auto b = strain.middleCols<3>(3 * i);
    b(0, 0) = by_r;
    b(1, 0) = over_r;
    b(3, 0) = by_z;
    b(4, 0) = -m * over_r;
    b(1, 1) = m * over_r;
    b(4, 1) = by_r - over_r;
    b(5, 1) = by_z;
    b(2, 2) = by_z;
    b(3, 2) = by_r;
    b(5, 2) = -m * over_r;
  }
  return strain;
}

Eigen::Matrix<double, 6, 6> elasticity_matrix(const Material& material) {
  const double E = material.youngs_modulus_Pa, nu = material.poisson_ratio;
  const double mu = E / (2 + 2 * nu), lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
  Eigen::Matrix<double, 6, 6> c = Eigen::Matrix<double, 6, 6>::Zero();
  c.topLeftCorner<3, 3>().setConstant(lambda);
  for (int i = 0; i < 6; ++i) c(i, i) += i < 3 ? 2 * mu : mu;
  return c;
}

double angle_integral(int m) {
  return m == 0 ? 2 * pi : pi;
}

Eigen::MatrixXd amplitudes_at(const SectionPoint& at, const MeridianGrid& grid,
                              const Eigen::Matrix<double, 6, 6>& elasticity, int m,
                              const Eigen::MatrixXd& displacement) {
  const auto& nodes = grid.cell_nodes[std::size_t(at.cell)];
  Eigen::MatrixXd own(3 * nodes.size(), displacement.cols());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(9, displacement.cols());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    own.middleRows<3>(3 * Eigen::Index(i)) = displacement.middleRows<3>(3 * nodes[i]);
    result.topRows<3>() += at.value[Eigen::Index(i)] * own.middleRows<3>(3 * Eigen::Index(i));
  }
  result.bottomRows<6>() = product(elasticity, product(strain_matrix(at, m), own));
  return result;
}

namespace {

/// The nearest amplitudes that belong to one tensor on the axis; a column per displacement.
void make_single_valued(int m, Eigen::MatrixXd& amplitudes) {
  for (Eigen::Index k = 0; k < amplitudes.cols(); ++k) {
    auto a = amplitudes.col(k);
    const double rr = a[3], tt = a[4], zz = a[5], rz = a[6], rt = a[7], tz = a[8];
    a.tail<6>().setZero();
    if (m == 0) {
      a[3] = a[4] = (rr + tt) / 2;
      a[5] = zz;
    } else if (m == 1) {
      a[6] = (rz - tz) / 2;
      a[8] = -a[6];
    } else if (m == 2) {
      a[3] = (rr - tt - 2 * rt) / 4;
      a[4] = a[7] = -a[3];
    }
  }
}

}  // namespace

Amplitudes result_amplitudes(const MeridianGrid& grid, const Material& material, int m,
                             const Eigen::MatrixXd& displacement) {
  const Eigen::Matrix<double, 6, 6> elasticity = elasticity_matrix(material);
  Amplitudes result(Eigen::Index(grid.results.size()), 9 * displacement.cols());
  const auto work = [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const auto& samples = grid.results[p].samples;
      Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(9, displacement.cols());
      for (const auto& sample : samples) mean += amplitudes_at(sample, grid, elasticity, m, displacement);
      mean /= double(samples.size());
      if (grid.results[p].on_axis()) make_single_valued(m, mean);
      result.row(Eigen::Index(p)) = Eigen::Map<const Eigen::RowVectorXd>(mean.data(), mean.size());
    }
  };
  parallel_for(grid.results.size(), 16, work);
  return result;
}

}  // namespace fem

#include "fem/harmonic_strain.h"

#include "fem/constants.h"

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

SurfaceAmplitudes surface_amplitudes(const MeridianGrid& grid, const Material& material, int m,
                                     const Eigen::MatrixXd& displacement) {
  const auto elasticity = elasticity_matrix(material);
  SurfaceAmplitudes result =
      SurfaceAmplitudes::Zero(Eigen::Index(grid.surface.size()), 9 * displacement.cols());
  for (std::size_t p = 0; p < grid.surface.size(); ++p) {
    const auto& samples = grid.surface[p].samples;
    Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(9, displacement.cols());
    for (const auto& sample : samples) {
      const auto& nodes = grid.cell_nodes[std::size_t(sample.cell)];
      Eigen::MatrixXd own(3 * nodes.size(), displacement.cols());
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        own.middleRows<3>(3 * Eigen::Index(i)) = displacement.middleRows<3>(3 * nodes[i]);
        mean.topRows<3>() += sample.value[Eigen::Index(i)] * own.middleRows<3>(3 * Eigen::Index(i));
      }
      mean.bottomRows<6>() += elasticity * (strain_matrix(sample, m) * own);
    }
    mean /= double(samples.size());
    result.row(Eigen::Index(p)) = Eigen::Map<const Eigen::RowVectorXd>(mean.data(), mean.size());
  }
  return result;
}

}  // namespace fem

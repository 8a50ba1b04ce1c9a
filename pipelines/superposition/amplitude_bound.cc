#include "pipelines/superposition/amplitude_bound.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include "pipelines/superposition/cycle_extremes.h"

namespace pipelines {
namespace {

using Eigen::Index;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// Powers of the half axis by which lines are weighed.
constexpr std::array<double, 3> powers = {1, 1.5, 2};

/// Of the largest channel: what rows may leave; nothing beside the slack of searches.
constexpr double same_row = 1e-10;

/// An eigenvalue in single steps of rounding.
constexpr double rounding = 1e-12;

double largest_eigenvalue(const Matrix5& matrix) {
  return Eigen::SelfAdjointEigenSolver<Matrix5>(matrix, Eigen::EigenvaluesOnly).eigenvalues()[4];
}

}  // namespace

AmplitudeBound::AmplitudeBound(const FactorCourse& course, const Eigen::ArrayXd& size)
    : mean_(course.fine().rowwise().mean().matrix()), lines_(course.strongest().matrix()) {
  const Index n = course.fine().cols(), n_lines = lines_.cols();
  Eigen::MatrixXd waves(2 * n_lines, n);
  for (Index l = 0; l < n_lines; ++l)
    for (Index i = 0; i < n; ++i) {
      const double angle = 2 * M_PI * std::fmod(course.orders()[l] * double(i), double(n)) / double(n);
      waves(2 * l, i) = std::cos(angle);
      waves(2 * l + 1, i) = -std::sin(angle);
    }
  Eigen::MatrixXd amplitudes(lines_.rows(), 2 * n_lines);
  for (Index l = 0; l < n_lines; ++l) {
    amplitudes.col(2 * l) = lines_.col(l).real();
    amplitudes.col(2 * l + 1) = lines_.col(l).imag();
  }
  const Eigen::MatrixXd about_mean = course.fine().matrix().colwise() - mean_;
  rest_ = (about_mean - amplitudes * waves).array().abs().rowwise().maxCoeff();
  const Eigen::VectorXd scale = (size > 0).select(size, 0).matrix();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> reduced(about_mean.transpose() * scale.asDiagonal());
  reduced.setThreshold(same_row);
  const Index rank = reduced.rank();
  const Eigen::MatrixXd rows = reduced.householderQ() * Eigen::MatrixXd::Identity(n, rank);
  of_rows_.resize(size.size(), rank + 1);
  of_rows_ << about_mean * rows, mean_;
  rows_.resize(rank + 1, n);
  rows_ << rows.transpose(), Eigen::RowVectorXd::Ones(n);
}

StressBall AmplitudeBound::about_mean(const UnitStresses& unit_Pa) const {
  const Eigen::Matrix<double, 5, Eigen::Dynamic> unit = deviatoric_coordinates(unit_Pa).matrix();
  StressBall ball;
  ball.mean_Pa = (unit * mean_).norm();
  const Eigen::Matrix<double, 5, Eigen::Dynamic> p = unit * lines_.real(), q = unit * lines_.imag();
  Eigen::ArrayXd axes(lines_.cols());
  for (Index l = 0; l < lines_.cols(); ++l) {
    const double pp = p.col(l).squaredNorm(), qq = q.col(l).squaredNorm(), pq = p.col(l).dot(q.col(l));
    axes[l] = std::sqrt((pp + qq + std::hypot(pp - qq, 2 * pq)) / 2);
  }
  const double largest = axes.size() > 0 ? axes.maxCoeff() : 0;
  if (largest > 0) {
    double least = std::numeric_limits<double>::infinity();
    for (const double power : powers) {
      const Eigen::ArrayXd shares = (axes / largest).pow(power);
      Matrix5 sum = Matrix5::Zero();
      for (Index l = 0; l < lines_.cols(); ++l)
        if (shares[l] > 0)
          sum += (p.col(l) * p.col(l).transpose() + q.col(l) * q.col(l).transpose()) / shares[l];
      least = std::min(least, largest_eigenvalue(sum) * shares.sum());
    }
    ball.radius_Pa = std::sqrt(least) * (1 + rounding);
  }
  ball.radius_Pa += unit.colwise().norm().dot(rest_.matrix());
  return ball;
}

StressCourse AmplitudeBound::stress_of(const UnitStresses& unit_Pa, const FactorCourse& course) const {
  const UnitStresses of_rows = unit_Pa * of_rows_;
  return StressCourse::at_places((of_rows * rows_).array(), course);
}

}  // namespace pipelines

#include "pipelines/write/living/field_modes.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pipelines {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index modes_at_once = 4;  // a texel of the page has four numbers

/// Eigenvectors by falling eigenvalue; those below a share of the largest are left out.
struct Eigenpairs {
  VectorXd values;
  MatrixXd vectors;
};

Eigenpairs falling_eigenpairs(const MatrixXd& symmetric, double least_share) {
  const auto n = symmetric.rows();
  if (n == 0) return {};
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(symmetric);
  const double limit = least_share * std::max(solver.eigenvalues()[n - 1], 0.0);
  Index n_kept = 0;
  while (n_kept < n && solver.eigenvalues()[n - 1 - n_kept] > limit) ++n_kept;
  return {solver.eigenvalues().tail(n_kept).reverse(),
          solver.eigenvectors().rightCols(n_kept).rowwise().reverse()};
}

/// Modes before any is left out, and their factors in every set.
struct AllModes {
  MatrixXd modes;       ///< rows x q
  MatrixXd projection;  ///< q x K
  std::vector<MatrixXd> factors;
};

AllModes all_modes(const UnitFields& fields, const std::vector<ArrayXXd>& sets) {
  const auto& a = fields.values;
  const MatrixXd gram = a.transpose() * a;
  VectorXd size =
      gram.diagonal().cwiseSqrt();  // channels have unlike units: in those of the field they compare
  for (auto& s : size)
    if (s == 0) s = 1;
  const MatrixXd unit_gram = size.cwiseInverse().asDiagonal() * gram * size.cwiseInverse().asDiagonal();
  MatrixXd covariance = MatrixXd::Zero(a.cols(), a.cols());
  for (const auto& set : sets) {
    const MatrixXd own = size.asDiagonal() * set.matrix();
    const MatrixXd product = own * own.transpose();
    const double energy = (product.cwiseProduct(unit_gram)).sum();
    if (energy > 0) covariance += product / energy;
  }
  constexpr double rounding = 1e-15;
  const auto root = falling_eigenpairs(covariance, rounding);
  const MatrixXd r = root.vectors * root.values.cwiseSqrt().asDiagonal();
  const MatrixXd inverse =
      root.values.cwiseSqrt().cwiseInverse().asDiagonal() * root.vectors.transpose() * size.asDiagonal();
  const auto pairs = falling_eigenpairs(r.transpose() * unit_gram * r, 0);
  AllModes all;
  all.modes = a * (size.cwiseInverse().asDiagonal() * (r * pairs.vectors));
  all.projection = pairs.vectors.transpose() * inverse;
  for (const auto& set : sets) all.factors.push_back(all.projection * set.matrix());
  return all;
}

std::vector<Index> by_falling(const VectorXd& sizes) {
  std::vector<Index> order(static_cast<std::size_t>(sizes.size()));
  std::iota(order.begin(), order.end(), Index(0));
  std::stable_sort(order.begin(), order.end(), [&](Index i, Index j) { return sizes[i] > sizes[j]; });
  return order;
}

/// Largest length that the modes from `rank` on have at a node and an instant. The product of two norms, of
/// the node's rows and of the instant's factors, bounds it, so few have to be looked at.
class LengthOfRest {
public:
  LengthOfRest(const UnitFields& fields, const AllModes& all, Index rank)
      : modes_(all.modes.rightCols(all.modes.cols() - rank)),
        n_components_(fields.n_components),
        sizes_(fields.n_nodes()) {
    const VectorXd squares = modes_.rowwise().squaredNorm();
    for (Index i = 0; i < sizes_.size(); ++i)
      sizes_[i] = std::sqrt(squares.segment(i * n_components_, n_components_).sum());
    order_ = by_falling(sizes_);
  }

  /// @param enough  no more is looked for
  void look_at(const MatrixXd& factors, double enough) {
    const auto rest = factors.bottomRows(modes_.cols());
    const VectorXd sizes = rest.colwise().norm().transpose();
    const auto instants = by_falling(sizes);
    for (const auto i : order_) {
      if (largest_ > enough || sizes_[i] * sizes[instants.front()] <= largest_) return;
      for (const auto t : instants) {
        if (sizes_[i] * sizes[t] <= largest_) break;
        const double length = (modes_.middleRows(i * n_components_, n_components_) * rest.col(t)).norm();
        largest_ = std::max(largest_, length);
      }
    }
  }

  double largest() const { return largest_; }

private:
  MatrixXd modes_;
  Index n_components_;
  VectorXd sizes_;
  std::vector<Index> order_;
  double largest_ = 0;
};

double length_of_rest(const UnitFields& fields, const AllModes& all, Index rank, double enough) {
  if (rank >= all.modes.cols() || fields.n_nodes() == 0) return 0;
  LengthOfRest rest(fields, all, rank);
  for (const auto& factors : all.factors) rest.look_at(factors, enough);
  return rest.largest();
}

/// Sum of the factors' sizes, each times its weight, at the instant where it is largest.
double largest_sum(const AllModes& all, const VectorXd& weights) {
  double most = 0;
  for (const auto& factors : all.factors)
    most = std::max(
        most, (weights.asDiagonal() * factors.topRows(weights.size()).cwiseAbs()).colwise().sum().maxCoeff());
  return most;
}

/// Steps with which rounding changes a length by no more than `enough`, but for modes that would need more
/// than 16 bits then.
VectorXd steps_of(const UnitFields& fields, const AllModes& all, Index rank, double enough) {
  constexpr double largest_integer = 32767;
  const double half_diagonal = std::sqrt(double(fields.n_components)) / 2;
  const double sum = largest_sum(all, VectorXd::Ones(rank)) * half_diagonal;
  VectorXd steps(rank);
  for (Index m = 0; m < rank; ++m) {
    const double finest = all.modes.col(m).cwiseAbs().maxCoeff() / largest_integer;
    steps[m] = std::max(finest, sum > 0 ? enough / sum : 0);
    if (steps[m] == 0) steps[m] = 1;
  }
  return steps;
}

/// @param fields, sets  of sizes about 1
FieldModes modes_of(const UnitFields& fields, const std::vector<ArrayXXd>& sets, double tolerance,
                    Index most) {
  const auto all = all_modes(fields, sets);
  FieldModes result;
  const auto available = all.modes.cols();
  double left = 0;
  do {
    result.rank = std::min({result.rank + modes_at_once, available, most});
    left = length_of_rest(fields, all, result.rank, tolerance);
  } while (left > tolerance && result.rank < std::min(available, most));
  if (left > tolerance)
    left = length_of_rest(fields, all, result.rank, std::numeric_limits<double>::infinity());
  const auto shown = all.modes.leftCols(result.rank);
  result.steps = steps_of(fields, all, result.rank, tolerance / 2);
  result.projection = all.projection.topRows(result.rank);
  result.error = left + std::sqrt(double(fields.n_components)) / 2 * largest_sum(all, result.steps);
  const auto n = fields.n_nodes(), parts = Index(fields.n_components);
  result.values.reserve(std::size_t(n * parts * result.rank));
  for (Index c = 0; c < parts; ++c)
    for (Index m = 0; m < result.rank; ++m)
      for (Index i = 0; i < n; ++i)
        result.values.push_back(std::int16_t(std::lround(shown(i * parts + c, m) / result.steps[m])));
  return result;
}

}  // namespace

FieldModes field_modes(const UnitFields& fields, const std::vector<ArrayXXd>& sets, double tolerance,
                       Index most) {
  const auto size_of = [](double largest) { return largest > 0 ? largest : 1; };
  double largest = 0;
  for (const auto& set : sets) largest = std::max(largest, set.size() > 0 ? set.abs().maxCoeff() : 0);
  const double set_size = size_of(largest),
               field_size = size_of(fields.values.size() > 0 ? fields.values.cwiseAbs().maxCoeff() : 0);
  UnitFields scaled = fields;  // squares of very large and very small numbers are none
  scaled.values /= field_size;
  auto scaled_sets = sets;
  for (auto& set : scaled_sets) set /= set_size;
  auto modes = modes_of(scaled, scaled_sets, tolerance / field_size / set_size, most);
  modes.steps *= field_size;
  modes.error *= field_size * set_size;
  return modes;
}

double largest_length(const UnitFields& fields, const ArrayXXd& factors, Index stride) {
  double largest = 0;
  for (Index t = 0; t < factors.cols(); t += stride) {
    const VectorXd field = fields.values * factors.col(t).matrix();
    for (Index i = 0; i < fields.n_nodes(); ++i)
      largest = std::max(largest, field.segment(i * fields.n_components, fields.n_components).stableNorm());
  }
  return largest;
}

}  // namespace pipelines

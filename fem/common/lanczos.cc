#include "fem/common/lanczos.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "fem/values/errors.h"

namespace fem {

namespace {

constexpr Eigen::Index block_width = 4;  // above the repetitions of round (2) and cubic (3) bodies
constexpr double converged = 1e-9;       // relative in the mass norm; eigenvalues have its square
constexpr double dependent = 1e-12;      // relative: what rounding leaves of a vector in the basis' span

/// The same numbers with every standard library.
Eigen::MatrixXd pseudo_random(Eigen::Index n_rows, Eigen::Index n_columns) {
  std::mt19937_64 engine(1);
  Eigen::MatrixXd x(n_rows, n_columns);
  for (auto& entry : x.reshaped()) entry = static_cast<double>(engine() >> 11) * 0x1p-53 - 0.5;
  return x;
}

/// Vectors with V'MV = I, growing block by block.
struct Basis {
  Eigen::MatrixXd vector, mass_times;
  Eigen::Index n = 0;

  explicit Basis(Eigen::Index n_rows) : vector(n_rows, 0), mass_times(n_rows, 0) {}
  auto vectors() const { return vector.leftCols(n); }
  auto masses() const { return mass_times.leftCols(n); }

  /// Adds what the columns of w have outside of the span of the basis.
  /// @param negligible  mass norm below which a column has nothing
  /// @return  C (new vectors x columns of w): w = old part + new vectors C
  Eigen::MatrixXd extend(Eigen::MatrixXd w, const BlockOperator& mass, double negligible) {
    Eigen::MatrixXd share = Eigen::MatrixXd::Identity(w.cols(), w.cols());
    for (int pass = 0; pass < 3; ++pass) {  // once, and twice against the rounding of short remainders
      subtract_product(vectors(), transposed_product(masses(), w), w);
      const Eigen::MatrixXd mass_w = mass(w);
      Eigen::MatrixXd kept(w.rows(), 0), mass_kept(w.rows(), 0);
      Eigen::MatrixXd coefficients = Eigen::MatrixXd::Zero(w.cols(), w.cols());
      for (Eigen::Index c = 0; c < w.cols(); ++c) {
        const auto k = kept.cols();
        Eigen::VectorXd x = w.col(c), mx = mass_w.col(c);
        for (int again = 0; again < 2; ++again) {
          const Eigen::VectorXd along = transposed_product(mass_kept, x);
          subtract_product(kept, along, x);
          subtract_product(mass_kept, along, mx);
          coefficients.col(c).head(k) += along;
        }
        const double norm = std::sqrt(std::max(0.0, x.dot(mx)));
        if (norm <= (pass == 0 ? negligible : 0.5)) continue;
        coefficients(k, c) = norm;
        kept.conservativeResize(Eigen::NoChange, k + 1);
        mass_kept.conservativeResize(Eigen::NoChange, k + 1);
        kept.col(k) = x / norm;
        mass_kept.col(k) = mx / norm;
      }
      w = kept;
      share = product(coefficients.topRows(w.cols()), share);
    }
    vector.conservativeResize(w.rows(), n + w.cols());
    mass_times.conservativeResize(w.rows(), n + w.cols());
    vector.rightCols(w.cols()) = w;
    mass_times.rightCols(w.cols()) = mass(w);
    n += w.cols();
    return share;
  }
};

}  // namespace

Eigenpairs largest_eigenpairs(Eigen::Index n_rows, int n_wanted, const BlockOperator& mass,
                              const BlockOperator& inverse) {
  const Eigen::Index largest_basis = 40 * Eigen::Index(n_wanted) + 200;
  Basis basis(n_rows);
  const Eigen::MatrixXd start = inverse(pseudo_random(n_rows, block_width));
  const double start_norm = std::sqrt(start.cwiseProduct(mass(start)).colwise().sum().maxCoeff());
  basis.extend(start, mass, dependent * start_norm);
  Eigen::MatrixXd projected;  // V'M A M V
  for (Eigen::Index first = 0;;) {
    const auto width = basis.n - first;
    const Eigen::MatrixXd w = inverse(basis.mass_times.rightCols(width));
    const Eigen::MatrixXd along = transposed_product(basis.masses(), w);
    projected.conservativeResize(basis.n, basis.n);
    projected.rightCols(width) = along;
    projected.bottomRows(width) = along.transpose();
    first = basis.n;
    const Eigenpairs ritz = symmetric_eigenpairs(projected);  // ascending
    const double largest = ritz.value[first - 1];
    const Eigen::MatrixXd beyond = basis.extend(w, mass, dependent * largest);
    const auto n_pairs = std::min<Eigen::Index>(n_wanted, first);
    const Eigen::MatrixXd pairs = ritz.vector.rightCols(n_pairs).rowwise().reverse();
    const Eigen::VectorXd values = ritz.value.tail(n_pairs).reverse();
    const Eigen::VectorXd rest = product(beyond, pairs.bottomRows(width)).colwise().norm().transpose();
    const bool exhausted = basis.n == first;
    if (exhausted || (n_pairs == n_wanted && (rest.array() <= converged * values.array()).all()))
      return {values, product(basis.vector.leftCols(first), pairs)};
    if (basis.n > largest_basis)
      throw SolveFailed("the natural frequencies do not converge: " + std::to_string(first) +
                        " vectors were not enough for " + std::to_string(n_wanted) +
                        "; ask for fewer or check the mesh for degenerate cells");
  }
}

}  // namespace fem

#include "fem/solve/modes/natural_frequencies.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fem/base/common/dense_algebra.h"
#include "fem/base/values/errors.h"
#include "fem/solve/modes/krylov_schur.h"

namespace fem {

namespace {

// Squares of frequencies are off by the square of it. A slender bar of 40 diameters leaves 2e-6 by rounding
// alone.
constexpr double acceptable_residual = 1e-4;
// Frequencies come from energies, whose share of that is its square.
constexpr double most_rounding = 0.01;

void refuse_number(const VibratingBody& body, int n_modes) {
  const auto most = body.n_vibrating() / 10;  // higher modes are the mesh's, not the body's
  if (n_modes >= 1 && n_modes <= most) return;
  std::ostringstream message;
  message << "natural frequencies: " << n_modes << " asked for; ask for 1 to " << most
          << ", a tenth of the mesh's unknowns, or refine the mesh";
  throw TooManyModes(message.str());
}

/// @param rounding  share of the inertia forces that rounding alone may leave
void refuse_unbalanced(const NaturalMode& mode, std::size_t number, double rounding) {
  if (mode.residual <= std::max(acceptable_residual, std::min(rounding, most_rounding))) return;
  std::ostringstream message;
  message << "natural frequency " << number << " of " << mode.frequency_Hz << " Hz leaves a share of "
          << mode.residual << " of its inertia forces unbalanced, " << acceptable_residual
          << " at most are accepted: check the mesh for degenerate cells, or use a coarser one";
  throw SolveFailed(message.str());
}

/// One step of inverse iteration, mended for the rounding of the solve; then the best of its span (Ritz).
/// Shapes on stiff springs (pins) need it: without, 4e-5 of a bar's inertia forces were left unbalanced. Its
/// x'K x is no better square of a frequency than the search's: on soft springs K's rounding drowns it.
/// @param pairs  w^2 ascending and shapes
/// @return shapes, in the same order
Eigen::MatrixXd improved_shapes(const VibratingBody& body, const Eigenpairs& pairs) {
  const Eigen::MatrixXd inertia = body.mass(pairs.vector) * pairs.value.asDiagonal();
  Eigen::MatrixXd shapes = body.inverse(inertia);
  shapes += body.inverse(inertia - body.stiffness(shapes));
  const Eigen::MatrixXd stiffness = transposed_product(shapes, body.stiffness(shapes)),
                        mass = transposed_product(shapes, body.mass(shapes));
  const Eigenpairs ritz =
      symmetric_eigenpairs((stiffness + stiffness.transpose()) / 2, (mass + mass.transpose()) / 2);
  return product(shapes, ritz.vector);
}

}  // namespace

std::vector<NaturalMode> natural_frequencies(const VibratingBody& body, int n_modes) {
  refuse_number(body, n_modes);
  auto pairs = lowest_modes({body.n_unknowns(),
                             [&](const Eigen::MatrixXd& x) { return body.stiffness(x); },
                             [&](const Eigen::MatrixXd& x) { return body.mass(x); },
                             [&](const Eigen::MatrixXd& f) { return body.inverse(f); },
                             body.unheld_motions(),
                             {}},
                            n_modes);
  pairs.vector = improved_shapes(body, pairs);

  Eigen::MatrixXd inertia = body.mass(pairs.vector) * pairs.value.asDiagonal();
  body.clear_clamped(inertia);
  const Eigen::MatrixXd rest = body.stiffness(pairs.vector) - inertia;
  std::vector<NaturalMode> modes;
  for (Eigen::Index i = 0; i < n_modes; ++i) {
    NaturalMode mode;
    mode.frequency_Hz = std::sqrt(pairs.value[i]) / (2 * EIGEN_PI);
    mode.residual = rest.col(i).norm() / inertia.col(i).norm();
    refuse_unbalanced(mode, modes.size() + 1,
                      body.rounding_of_rigid_part(pairs.vector.col(i)) / inertia.col(i).norm());
    Eigen::Index largest = 0;
    pairs.vector.col(i).cwiseAbs().maxCoeff(&largest);
    const Eigen::VectorXd shape = pairs.vector(largest, i) < 0 ? Eigen::VectorXd(-pairs.vector.col(i))
                                                               : Eigen::VectorXd(pairs.vector.col(i));
    mode.shape.assign(shape.begin(), shape.end());
    modes.push_back(std::move(mode));
  }
  return modes;
}

}  // namespace fem

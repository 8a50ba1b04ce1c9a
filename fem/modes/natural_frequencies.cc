#include "fem/modes/natural_frequencies.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "fem/modes/krylov_schur.h"
#include "fem/values/errors.h"

namespace fem {

namespace {

constexpr double acceptable_residual = 1e-6;
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

}  // namespace

std::vector<NaturalMode> natural_frequencies(const VibratingBody& body, int n_modes) {
  refuse_number(body, n_modes);
  const auto pairs = lowest_modes({body.n_unknowns(),
                                   [&](const Eigen::MatrixXd& x) { return body.stiffness(x); },
                                   [&](const Eigen::MatrixXd& x) { return body.mass(x); },
                                   [&](const Eigen::MatrixXd& f) { return body.inverse(f); },
                                   body.unheld_motions(),
                                   {}},
                                  n_modes);

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

#include "kinetics/torsion/steady.h"

#include <cmath>
#include <complex>

#include "kinetics/torsion/tree_solver.h"
#include "kinetics/torsion_chain/dense_algebra.h"

namespace kinetics::torsion {
namespace {

using Eigen::ArrayXcd;
using Eigen::ArrayXd;
using Complex = std::complex<double>;
const Complex i_unit(0, 1);

/// Response as the sum of each load's own, placed where it acts.
HarmonicState along_tree(const ReducedTrain& r, double w, const ArrayXcd& load) {
  const ArrayXcd node = -w * w * r.inertia.cast<Complex>() + i_unit * w * r.damping.cast<Complex>();
  const ArrayXcd edge = r.stiffness * (1.0 + i_unit * r.loss_factor.cast<Complex>()) +
                        i_unit * w * r.edge_damping.cast<Complex>();
  HarmonicState state{ArrayXcd::Zero(r.n_nodes()), ArrayXcd::Zero(r.n_edges()), ArrayXcd::Zero(r.n_edges())};
  for (Index root = 0; root < r.n_nodes(); ++root) {
    if (load[root] == 0.0) continue;
    ArrayXcd alone = ArrayXcd::Zero(r.n_nodes());
    alone[root] = load[root];
    const auto solution = TreeSolver<Complex>(r, node, edge, root).solve(alone);
    state.angle += solution.angle;
    state.torque += solution.torque;
  }
  return state;
}

/// Modal damping is a torque in the elements, 2 zeta (i w / w_k) times the elastic one of each mode.
HarmonicState in_modes(const ReducedTrain& r, const Spectrum& spectrum, double zeta, double w,
                       const ArrayXcd& load) {
  const Index m = r.n_edges(), rigid = r.held ? 0 : 1;
  const ArrayXd& w_k = spectrum.frequency_rad_s;
  Eigen::MatrixXd V(r.n_nodes(), m + rigid);
  if (rigid) V.col(0) = (r.inertia / r.inertia.sum()).sqrt().matrix();
  V.rightCols(m) = spectrum.node_vectors;
  ArrayXd weight = r.inertia.sqrt().inverse();
  if (r.held) weight[*r.held] = 0;

  ArrayXcd own(m + rigid);
  if (rigid) own[0] = -w * w;
  own.tail(m) = w_k * w_k - w * w + 2.0 * zeta * i_unit * w * w_k.cast<Complex>();
  const ArrayXd loss = r.loss_factor + w * r.edge_damping / r.stiffness;
  const Eigen::MatrixXd twist = spectrum.edge_vectors * w_k.matrix().asDiagonal();  // C^(1/2) theta
  const Eigen::VectorXcd f = V.transpose() * (weight * load).matrix();
  Eigen::VectorXcd y;
  if (r.damped()) {
    Eigen::MatrixXcd Z = own.matrix().asDiagonal();
    Z.imag() += weighted_gram(V, w * r.damping * weight.square());
    Z.imag().bottomRightCorner(m, m) += weighted_gram(twist, loss);
    y = solve(Z, f);
  } else {
    y = f.array() / own;
  }
  const ArrayXcd elastic = (twist * y.tail(m)).array();
  const ArrayXcd modal =
      r.stiffness.sqrt() *
      (spectrum.edge_vectors * (2.0 * zeta * i_unit * w * y.tail(m).array()).matrix()).array();
  return {weight * (V * y).array(),
          r.stiffness.sqrt() * elastic * (1.0 + i_unit * loss.cast<Complex>()) + modal, modal};
}

}  // namespace

MeanState mean_state(const ReducedTrain& r, const ArrayXd& load) {
  MeanState state;
  const double drag = r.damping.sum();
  // Torques that balance but for rounding accelerate nothing.
  const double sum = load.sum(), rounding = 1e-15 * double(load.size()) * load.abs().sum();
  const double unbalanced = std::abs(sum) > rounding ? sum : 0;
  if (!r.held && drag > 0) state.speed_rad_s = unbalanced / drag;
  if (!r.held && drag == 0) state.acceleration_rad_s2 = unbalanced / r.inertia.sum();
  ArrayXd left = load - r.inertia * state.acceleration_rad_s2 - r.damping * state.speed_rad_s;
  const auto steps = walk(r.n_nodes(), r.edges, r.held.value_or(0));
  state.torque = ArrayXd::Zero(r.n_edges());
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    state.torque[step->edge] = -step->sense * left[step->child];
    left[step->parent] += left[step->child];
  }
  state.angle = ArrayXd::Zero(r.n_nodes());
  for (const Step& step : steps)
    state.angle[step.child] =
        state.angle[step.parent] - step.sense * state.torque[step.edge] / r.stiffness[step.edge];
  if (!r.held) state.angle -= (state.angle * r.inertia).sum() / r.inertia.sum();
  return state;
}

HarmonicState harmonic_state(const ReducedTrain& reduced, const Spectrum& spectrum,
                             double modal_damping_ratio, double frequency_rad_s, const ArrayXcd& load) {
  return modal_damping_ratio == 0 ? along_tree(reduced, frequency_rad_s, load)
                                  : in_modes(reduced, spectrum, modal_damping_ratio, frequency_rad_s, load);
}

}  // namespace kinetics::torsion

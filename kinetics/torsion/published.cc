/// The paper's own tables, errata included (kinetics/README.md, errata 1-6).
#include <algorithm>
#include <cmath>

#include "kinetics/drive_train.h"
#include "kinetics/torsion_chain/checks.h"
#include "kinetics/torsion_chain/dense_algebra.h"
#include "kinetics/torsion_chain/published_chain.h"
#include "kinetics/torsion_chain/reduced.h"
#include "kinetics/values/constants.h"
#include "kinetics/values/machine_refused.h"
#include "kinetics/values/wrong_input.h"

namespace kinetics {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

/// The one frequency of all harmonics [rad/s], and their amplitudes per inertia.
std::pair<double, ArrayXd> harmonic_torques(const DriveTrain& train) {
  torsion::check_excitations(train);
  ArrayXd torque_Nm = ArrayXd::Zero(static_cast<Index>(train.inertias.size()));
  std::optional<double> frequency_rad_s;
  for (const TrainExcitation& x : train.excitations)
    for (const TorqueHarmonic& h : x.harmonics) {
      if (!h.frequency_rad_s || (frequency_rad_s && *frequency_rad_s != *h.frequency_rad_s))
        throw MachineRefused("excitation " + x.name +
                             ": the published tables know one frequency; give every harmonic the same "
                             "frequency_rad_s");
      frequency_rad_s = h.frequency_rad_s;
      torque_Nm[torsion::inertia_at(train, x.inertia, x.name + ".inertia")] += h.amplitude_Nm;
    }
  if (!frequency_rad_s)
    throw MachineRefused("excitations: the published tables need one harmonic at least; give the mains' one");
  return {*frequency_rad_s, torque_Nm};
}

PublishedChain reduced_to(const DriveTrain& train, std::size_t inertia) {
  DriveTrain to_shaft = train;
  to_shaft.reference_shaft = train.inertias.at(inertia).shaft;
  const auto reduced = torsion::reduce(to_shaft);
  const auto [frequency_rad_s, torque_Nm] = harmonic_torques(train);
  const Index n = reduced.ratio.size();
  if (reduced.n_nodes() != n || reduced.held)
    throw MachineRefused("the published tables hold a free chain without rigid elements; take them out");
  PublishedChain chain;
  chain.inertia_kg_m2 = reduced.inertia;
  chain.stiffness_N_m_rad = reduced.stiffness;
  chain.torque_Nm = torque_Nm;
  chain.excitation_rad_s = frequency_rad_s / (2 * pi) / std::abs(reduced.ratio[0]);
  chain.shaft = to_shaft.reference_shaft;
  for (const TrainInertia& i : train.inertias) chain.inertia.push_back(i.name);
  for (Index e = 0; e < reduced.n_edges(); ++e) {
    const TrainElement& element = train.elements[e];
    if (reduced.edges[e].first != e || reduced.edges[e].second != e + 1)
      throw MachineRefused(
          "element " + element.name +
          ": the published tables hold a chain; let each element join an inertia with the next");
    if (element.kind != ElementKind::shaft) chain.stiffness_N_m_rad[e] = *element.stiffness_N_m_rad;
    chain.element.push_back(element.name);
  }
  return chain;
}

/// @param sign  sign of w^2 J in the forced system, and of a: -1 as Table 7, +1 the slip of Table 4
PublishedTable solved(const PublishedChain& chain, double sign) {
  const Index n = chain.inertia_kg_m2.size();
  MatrixXd K = MatrixXd::Zero(n, n);
  for (Index e = 0; e + 1 < n; ++e)
    K.block<2, 2>(e, e) += chain.stiffness_N_m_rad[e] * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
  const MatrixXd J = chain.inertia_kg_m2.matrix().asDiagonal();
  const auto modes = torsion::symmetric_eigenpairs(K, J);
  PublishedTable table;
  table.frequency_rad_s = modes.value.tail(n - 1).reverse().array().sqrt();
  table.mode = modes.vector.rightCols(n - 1).rowwise().reverse().colwise().normalized().array();
  const auto angle_rad = [&](double sign_of_inertia) -> ArrayXd {
    const MatrixXd dynamic = K + sign_of_inertia * chain.excitation_rad_s * chain.excitation_rad_s * J;
    return -sign_of_inertia * torsion::solve_with_full_pivoting(dynamic, chain.torque_Nm.matrix()).array();
  };
  table.forced_angle_rad = angle_rad(sign);
  table.right_sign_angle_rad = angle_rad(-1);
  return table;
}

}  // namespace

namespace torsion {

PublishedChain chain_of_motor(const DriveTrain& train) {
  return reduced_to(train, 0);
}

PublishedChain chain_of_working_shaft(const DriveTrain& train) {
  PublishedChain chain = reduced_to(train, train.inertias.size() - 1);
  for (ArrayXd* values : {&chain.inertia_kg_m2, &chain.stiffness_N_m_rad, &chain.torque_Nm})
    values->reverseInPlace();
  chain.torque_Nm = 0 - chain.torque_Nm;  // no negative zeros
  for (auto* names : {&chain.inertia, &chain.element}) std::reverse(names->begin(), names->end());
  return chain;
}

PublishedTable table_4_of(const PublishedChain& chain) {
  return solved(chain, 1);
}

PublishedTable table_7_of(const PublishedChain& chain) {
  return solved(chain, -1);
}

}  // namespace torsion

PublishedTable published_table_4(const DriveTrain& train) {
  return torsion::table_4_of(torsion::chain_of_motor(train));
}

PublishedTable published_table_7(const DriveTrain& train) {
  return torsion::table_7_of(torsion::chain_of_working_shaft(train));
}

}  // namespace kinetics

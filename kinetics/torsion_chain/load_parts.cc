#include "kinetics/torsion_chain/load_parts.h"

#include <algorithm>
#include <cmath>

#include "kinetics/values/constants.h"

namespace kinetics::torsion {
namespace {

using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

/// A resultant that is a torque alone; parts whose torque is empty bring nothing to it.
template <class TorqueOf>
Resultant torque_on(const std::string& role, const std::string& description,
                    const std::vector<LoadPart>& parts, Index n, const TorqueOf& torque_of) {
  Resultant resultant{role, description, Array3Xd::Zero(3, n), {}};
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const ArrayXd torque_Nm = torque_of(parts[p]);
    if (torque_Nm.size() == 0) continue;
    Array3Xd load = Array3Xd::Zero(3, n);
    load.row(2) = torque_Nm.transpose();
    resultant.total += load;
    resultant.contributions.push_back({p, load});
  }
  return resultant;
}

void write_inertia(const DriveTrain& train, Index i, const TrainMotion& sum,
                   const std::vector<LoadPart>& parts, const std::string& angle_text, LoadHistory& history) {
  const TrainInertia& inertia = train.inertias[i];
  const Index n = sum.time_s.size();
  history.quantities.push_back(
      {inertia.name + ".angle", "rad", angle_text, sum.angle_rad.row(i).transpose()});
  history.quantities.push_back(
      {inertia.name + ".acceleration", "rad/s2", "phi'' in (9)", sum.acceleration_rad_s2.row(i).transpose()});
  auto excitation =
      torque_on("excitation_on_" + inertia.name, "excitations on " + inertia.name, parts, n,
                [&](const LoadPart& part) { return part.inertia == i ? part.torque_Nm : ArrayXd(); });
  if (!excitation.contributions.empty()) history.resultants.push_back(std::move(excitation));
  if (inertia.damping_N_m_s != 0)
    history.resultants.push_back(
        torque_on("damping_on_" + inertia.name, "drag of the ground on " + inertia.name + ", -D phi'", parts,
                  n, [&](const LoadPart& part) -> ArrayXd {
                    return -inertia.damping_N_m_s * part.motion.speed_rad_s.row(i).transpose();
                  }));
}

void write_element(const DriveTrain& train, Index e, const TrainMotion& sum,
                   const std::vector<LoadPart>& parts, LoadHistory& history) {
  const TrainElement& element = train.elements[e];
  const ArrayXd torque_Nm = sum.torque_Nm.row(e).transpose();
  const Index n = sum.time_s.size();
  history.quantities.push_back(
      {element.name + ".torque", "N m",
       "torque from " + element.first + " to " + element.second + ", on the shaft of " + element.first,
       torque_Nm});
  history.quantities.push_back({element.name + ".reduced_torque", "N m",
                                "the same, reduced to the reference shaft (7)",
                                sum.reduced_torque_Nm.row(e).transpose()});
  if (element.diameter_m > 0) {
    const double I_p_m4 = pi / 32 * (std::pow(element.diameter_m, 4) - std::pow(element.bore_m, 4));
    history.quantities.push_back(
        {element.name + ".shear_stress", "Pa", "K_t T r / I_p at the surface, the sign of the torque",
         element.stress_concentration * torque_Nm * (element.diameter_m / 2 / I_p_m4)});
  }
  const auto on_first = [&](const LoadPart& part) -> ArrayXd {
    return -part.motion.torque_Nm.row(e).transpose();
  };
  const auto on_second = [&](const LoadPart& part) -> ArrayXd {
    return part.motion.torque_Nm.row(e).transpose() / element.ratio;
  };
  for (const auto& [inertia, first] : {std::pair{element.first, true}, std::pair{element.second, false}}) {
    const std::string role = element.name + "_on_" + inertia,
                      text = "torque of " + element.name + " on " + inertia;
    history.resultants.push_back(first ? torque_on(role, text, parts, n, on_first)
                                       : torque_on(role, text, parts, n, on_second));
  }
}

ArrayXd closure(const DriveTrain& train, const LoadHistory& history) {
  ArrayXd worst = ArrayXd::Zero(history.time_s.size());
  for (const TrainInertia& inertia : train.inertias) {
    if (inertia.held) continue;
    ArrayXd sum = -inertia.inertia_kg_m2 * history.quantity(inertia.name + ".acceleration").values;
    ArrayXd size = sum.abs();
    const auto add = [&](const std::string& role) {
      if (!history.has_resultant(role)) return;
      const ArrayXd torque_Nm = history.resultant(role).total.row(2).transpose();
      sum += torque_Nm, size += torque_Nm.abs();
    };
    add("excitation_on_" + inertia.name);
    add("damping_on_" + inertia.name);
    for (const TrainElement& e : train.elements)
      if (e.first == inertia.name || e.second == inertia.name) add(e.name + "_on_" + inertia.name);
    const double scale = size.maxCoeff();
    if (scale > 0) worst = worst.max(sum.abs() / scale);
  }
  return worst;
}

}  // namespace

void write_parts(const DriveTrain& train, const TrainMotion& sum, const std::vector<LoadPart>& parts,
                 const std::string& angle_text, LoadHistory& history) {
  for (Index i = 0; i < static_cast<Index>(train.inertias.size()); ++i)
    write_inertia(train, i, sum, parts, angle_text, history);
  for (Index e = 0; e < static_cast<Index>(train.elements.size()); ++e)
    write_element(train, e, sum, parts, history);
}

void write_closure(const DriveTrain& train, LoadHistory& history) {
  history.quantities.push_back({"closure", "1",
                                "|sum of torques - J phi''| over their largest sum of sizes, worst inertia",
                                closure(train, history)});
}

}  // namespace kinetics::torsion

#include "kinetics/vibratory/books.h"

#include <algorithm>
#include <stdexcept>

namespace kinetics::vibratory {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

BodySums::BodySums(Index n)
    : force_N(Array2Xd::Zero(2, n)),
      force_scale_N(ArrayXd::Zero(n)),
      moment_Nm(ArrayXd::Zero(n)),
      moment_scale_Nm(ArrayXd::Zero(n)) {}

void BodySums::add(Index first, const Array2Xd& arm_m, const Array2Xd& force) {
  const Index count = force.cols();
  force_N.middleCols(first, count) += force;
  force_scale_N.segment(first, count) += force.matrix().colwise().norm().transpose().array();
  moment_Nm.segment(first, count) += cross(arm_m, force);
  moment_scale_Nm.segment(first, count) +=
      ((arm_m.row(0) * force.row(1)).abs() + (arm_m.row(1) * force.row(0)).abs()).transpose();
}

void BodySums::add_couple(Index first, const ArrayXd& couple_Nm) {
  moment_Nm.segment(first, couple_Nm.size()) += couple_Nm;
  moment_scale_Nm.segment(first, couple_Nm.size()) += couple_Nm.abs();
}

Books::Books(Index n)
    : chamber(n),
      shaft(n),
      charge_power_W(ArrayXd::Zero(n)),
      damping_power_W(ArrayXd::Zero(n)),
      couple_Nm(ArrayXd::Zero(n)) {}

void Books::open(const std::string& role, const std::string& description) {
  resultants.push_back({role, description, Array3Xd::Zero(3, charge_power_W.size()), {}});
}

void Books::post(const std::string& role, const std::string& effect, Index first, const Array3Xd& load) {
  const auto resultant =
      std::find_if(resultants.begin(), resultants.end(), [&](const Resultant& r) { return r.role == role; });
  if (resultant == resultants.end())
    throw std::logic_error("load posted to the role " + role + ", which is not open");
  auto& parts = resultant->contributions;
  auto part =
      std::find_if(parts.begin(), parts.end(), [&](const Contribution& c) { return c.effect == effect; });
  if (part == parts.end()) part = parts.insert(part, {effect, Array3Xd::Zero(3, charge_power_W.size())});
  part->load.middleCols(first, load.cols()) += load;
  resultant->total.middleCols(first, load.cols()) += load;
}

}  // namespace kinetics::vibratory

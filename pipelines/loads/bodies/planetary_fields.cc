#include "pipelines/loads/bodies/planetary_fields.h"

#include <sstream>

#include "pipelines/base/common/errors.h"

namespace pipelines::planetary {

using Eigen::Array2Xd;
using Eigen::Array3Xd;

void require_equilibrium(const kinetics::LoadHistory& loads) {
  const double force = loads.quantity("closure_force").values.maxCoeff(),
               moment = loads.quantity("closure_moment").values.maxCoeff();
  if (force <= 1e-12 && moment <= 1e-12) return;
  std::ostringstream text;
  text << "the convention \"" << loads.convention << "\" leaves " << 100 * force << " % of the forces and "
       << 100 * moment << " % of the moments without a counterpart: analyse bodies under \"consistent\"";
  throw StageRefused(text.str());
}

Array2Xd gravity(const kinetics::LoadHistory& loads, double g_m_s2) {
  Array2Xd a(2, loads.n_instants());
  a.row(0) = -g_m_s2 * loads.phi_rad.sin().transpose();
  a.row(1) = -g_m_s2 * loads.phi_rad.cos().transpose();
  return a;
}

Array2Xd transport(const kinetics::LoadHistory& loads, const kinetics::PlanetaryMill& mill) {
  Array2Xd a = Array2Xd::Zero(2, loads.n_instants());
  a.row(0) = mill.speed_rad_s * mill.speed_rad_s * kinetics::planetary_geometry(mill).carrier_m;
  return a;
}

AccelerationField translation(const Array2Xd& a) {
  AccelerationField field{Array3Xd::Zero(3, a.cols()), {}, {}};
  field.translation_m_s2.topRows<2>() = a;
  return field;
}

double typical_force(const kinetics::LoadHistory& loads) {
  return loads.resultant("axle").total.topRows<2>().abs().maxCoeff();
}

}  // namespace pipelines::planetary

#include "pipelines/base/fatigue/weld_fatigue.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/fatigue/fatigue_input.h"

namespace pipelines {
namespace {

/// The three stresses in the surface: along the toe's normal, along the toe, shear.
struct SurfaceHistory {
  Eigen::ArrayXd across_Pa, along_Pa, shear_Pa;
  SnCurve curve;  ///< for cycles of unlike size

  Eigen::ArrayXd at(double angle_rad) const {
    const double c = std::cos(angle_rad), s = std::sin(angle_rad);
    return c * c * across_Pa + s * s * along_Pa + 2 * s * c * shear_Pa;
  }
  /// Range of one cycle that does the damage of all.
  double range_at(double angle_rad) const {
    std::vector<StressBlock> blocks;
    for (const auto& cycle : kinetics::rainflow_repeating(at(angle_rad)))
      blocks.push_back({cycle.range, cycle.count});
    const double damage = miner_damage(curve, blocks);
    return damage > 0 ? endured_amplitude_Pa(curve, 1 / damage) : 0;
  }
};

Eigen::Matrix<double, 6, 1> form_between(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  Eigen::Matrix<double, 6, 1> w;
  w << u.x() * v.x(), u.y() * v.y(), u.z() * v.z(), u.x() * v.y() + u.y() * v.x(),
      u.y() * v.z() + u.z() * v.y(), u.x() * v.z() + u.z() * v.x();
  return w;
}

Eigen::ArrayXd history_between(const Eigen::Matrix<double, 6, Eigen::Dynamic>& history_Pa,
                               const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  return (form_between(u, v).transpose() * history_Pa).transpose().array();
}

/// Golden section on a bracket of one maximum.
double angle_of_largest_range(const SurfaceHistory& history, double low, double high) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double of_a = history.range_at(a), of_b = history.range_at(b);
  while (high - low > 1e-8) {
    if (of_a < of_b) {
      low = a;
      a = b;
      of_a = of_b;
      b = low + golden * (high - low);
      of_b = history.range_at(b);
    } else {
      high = b;
      b = a;
      of_b = of_a;
      a = high - golden * (high - low);
      of_a = history.range_at(a);
    }
  }
  return (low + high) / 2;
}

}  // namespace

double thickness_factor(double thickness_m, double exponent) {
  require_positive_input("thickness_m", thickness_m);
  require_input_between("thickness exponent", exponent, 0, 0.5);
  constexpr double reference_m = 0.025;
  return thickness_m > reference_m ? std::pow(reference_m / thickness_m, exponent) : 1;
}

SnCurve weld_curve(const WeldDetail& detail, LoadAmplitude amplitude) {
  require_input_between("fat_Pa", detail.fat_Pa, 1e6, 700e6);
  require_input_between("gamma_M", detail.gamma_M, 1, 2);
  constexpr double class_cycles = 2e6, knee_cycles = 1e7, slope = 3;
  const double at_class_Pa =
      thickness_factor(detail.thickness_m, detail.thickness_exponent) * detail.fat_Pa / detail.gamma_M;
  return {at_class_Pa * std::pow(class_cycles / knee_cycles, 1 / slope), knee_cycles, slope,
          amplitude == LoadAmplitude::constant ? 22 : 5};
}

double weld_damage(const WeldDetail& detail, LoadAmplitude amplitude,
                   const std::vector<kinetics::LoadCycle>& cycles) {
  std::vector<StressBlock> blocks;
  blocks.reserve(cycles.size());
  for (const kinetics::LoadCycle& cycle : cycles) blocks.push_back({cycle.range, cycle.count});
  return miner_damage(weld_curve(detail, amplitude), blocks);
}

ToeStress toe_stress(const Eigen::Matrix<double, 6, Eigen::Dynamic>& history_Pa,
                     const Eigen::Vector3d& surface_normal, const Eigen::Vector3d& toe_normal,
                     const WeldDetail& detail) {
  if (history_Pa.cols() == 0) throw std::invalid_argument("history_Pa: holds no instants; give at least one");
  if (!history_Pa.allFinite()) throw std::invalid_argument("history_Pa: holds a value that is not finite");
  const Eigen::Vector3d n = surface_normal.normalized();
  const Eigen::Vector3d in_surface = toe_normal - toe_normal.dot(n) * n;
  if (!(in_surface.norm() > 1e-6 * toe_normal.norm()) || !n.allFinite())
    throw std::invalid_argument("toe_normal: must have a part in the surface; both normals must not be zero");
  const Eigen::Vector3d u = in_surface.normalized(), v = n.cross(u);
  const SurfaceHistory history{history_between(history_Pa, u, u), history_between(history_Pa, v, v),
                               history_between(history_Pa, u, v),
                               weld_curve(detail, LoadAmplitude::variable)};
  const double degree = pi / 180;
  constexpr int step = 3, n_steps = 20;  // steps of three degrees, to 60 either way
  constexpr double sector = n_steps * step;
  std::vector<double> range_Pa;  // one beyond both ends
  for (int i = -n_steps - 1; i <= n_steps + 1; ++i) range_Pa.push_back(history.range_at(i * step * degree));

  ToeStress toe;
  double largest_Pa = range_Pa[n_steps + 1];
  for (int i = -n_steps; i <= n_steps; ++i) {
    const double* const at = range_Pa.data() + (i + n_steps + 1);
    if (at[0] < at[-1] || at[0] < at[1] || (at[0] == at[-1] && at[0] == at[1])) continue;
    const double angle_rad =
        angle_of_largest_range(history, (i - 1) * step * degree, (i + 1) * step * degree);
    const double found_Pa = history.range_at(angle_rad);
    if (std::abs(angle_rad) > sector * degree * (1 + 1e-9) || found_Pa < largest_Pa * (1 - 1e-12)) continue;
    largest_Pa = found_Pa;
    toe.angle_rad = angle_rad;
    toe.is_principal = true;
  }
  const Eigen::Vector3d governing = std::cos(toe.angle_rad) * u + std::sin(toe.angle_rad) * v;
  toe.form = form_between(governing, governing);
  toe.stress_Pa = history.at(toe.angle_rad);
  toe.cycles = kinetics::rainflow_repeating(toe.stress_Pa);
  return toe;
}

}  // namespace pipelines

#include <cmath>

#include "kinetics/drive_train.h"
#include "kinetics/torsion_chain/reduced.h"

namespace kinetics {

TrainMotion over_time(const DriveTrain& train, const ForcedResponse& response, const Eigen::ArrayXd& time_s) {
  using Eigen::ArrayXXd;
  using Eigen::RowVectorXd;
  const Eigen::ArrayXd u = torsion::reduce(train).ratio;
  const RowVectorXd ones = RowVectorXd::Ones(time_s.size());
  const auto constant = [&](const Eigen::ArrayXd& values) -> ArrayXXd { return values.matrix() * ones; };
  TrainMotion motion;
  motion.time_s = time_s;
  motion.angle_rad = constant(response.mean_angle_rad);
  motion.speed_rad_s = constant(u * response.speed_offset_rad_s);
  motion.acceleration_rad_s2 = constant(u * response.rigid_acceleration_rad_s2);
  motion.torque_Nm = constant(response.mean_torque_Nm);
  motion.reduced_torque_Nm = constant(response.mean_reduced_torque_Nm);
  for (const HarmonicResponse& h : response.harmonics) {
    const double w = h.frequency_rad_s;
    const RowVectorXd cosine = (w * time_s).cos().matrix().transpose();
    const RowVectorXd sine = (w * time_s).sin().matrix().transpose();
    const auto wave = [&](const Eigen::ArrayXcd& a, const RowVectorXd& real, const RowVectorXd& imaginary) {
      const Eigen::MatrixXd re = a.real().matrix() * real, im = a.imag().matrix() * imaginary;
      return ArrayXXd((re - im).array());
    };
    const ArrayXXd angle_rad = wave(h.angle_rad, cosine, sine);
    motion.angle_rad += angle_rad;
    motion.speed_rad_s -= w * wave(h.angle_rad, sine, -cosine);
    motion.acceleration_rad_s2 -= w * w * angle_rad;
    motion.torque_Nm += wave(h.torque_Nm, cosine, sine);
    motion.reduced_torque_Nm += wave(h.reduced_torque_Nm, cosine, sine);
  }
  return motion;
}

}  // namespace kinetics

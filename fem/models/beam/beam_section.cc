#include "fem/models/beam/beam_section.h"

#include "fem/base/values/constants.h"

namespace fem {
namespace {

/// sigma = mean + slope . (x - centroid); torque about the centroid.
struct Sectional {
  double mean_Pa, torque_Nm;
  Eigen::Vector2d slope_Pa_m;
};

Sectional about_centroid(const BeamSection& section, const Wrench6& w) {
  const Eigen::Vector2d& c = section.centroid_m;
  const double mx = w[3] - c[1] * w[2], my = w[4] + c[0] * w[2];
  return {w[2] / section.area_m2, w[5] - (c[0] * w[1] - c[1] * w[0]),
          section.moments_m4.inverse() * Eigen::Vector2d(-my, mx)};
}

}  // namespace

Eigen::Matrix<double, 6, 6> BeamSection::mass_per_length(double density_kg_m3, double z_m) const {
  const Eigen::Vector3d first(area_m2 * centroid_m[0], area_m2 * centroid_m[1], area_m2 * z_m);
  Eigen::Matrix3d second;
  second.topLeftCorner<2, 2>() = moments_m4 + area_m2 * centroid_m * centroid_m.transpose();
  second.topRightCorner<2, 1>() = z_m * first.head<2>();
  second.bottomLeftCorner<1, 2>() = z_m * first.head<2>().transpose();
  second(2, 2) = area_m2 * z_m * z_m;
  Eigen::Matrix3d cross;
  cross << 0, -first[2], first[1], first[2], 0, -first[0], -first[1], first[0], 0;
  Eigen::Matrix<double, 6, 6> mass;
  mass << area_m2 * Eigen::Matrix3d::Identity(), -cross, cross,
      second.trace() * Eigen::Matrix3d::Identity() - second;
  return density_kg_m3 * mass;
}

BeamSection beam_section(const BeamSegment& segment, double poisson_ratio) {
  const double R = segment.radius_m, b = segment.bore_radius_m, nu = poisson_ratio;
  const Eigen::Vector2d axis(segment.axis_x_m, segment.axis_y_m);
  const double disc = pi * R * R, hole = pi * b * b;
  BeamSection s;
  s.area_m2 = disc - hole;
  s.centroid_m = disc / s.area_m2 * axis;
  s.moments_m4 = (disc * R * R - hole * b * b) / 4 * Eigen::Matrix2d::Identity() +
                 disc * axis * axis.transpose() - s.area_m2 * s.centroid_m * s.centroid_m.transpose();
  s.polar_m4 = s.moments_m4.trace();
  s.rim_shear = 4.0 / 3 * (R * R + R * b + b * b) / (R * R + b * b);
  const double m2 = b * b / (R * R), ring = (1 + m2) * (1 + m2);
  s.shear_area_m2 = s.area_m2 * 6 * (1 + nu) * ring / ((7 + 6 * nu) * ring + (20 + 12 * nu) * m2);
  return s;
}

NominalStress nominal_stress(const BeamSegment& segment, const BeamSection& section, const Wrench6& internal,
                             const Eigen::Vector2d& direction) {
  const auto s = about_centroid(section, internal);
  const Eigen::Vector2d point =
      Eigen::Vector2d(segment.axis_x_m, segment.axis_y_m) + segment.radius_m * direction;
  const Eigen::Vector2d around(-direction[1], direction[0]);
  return {s.mean_Pa, s.slope_Pa_m.dot(point - section.centroid_m),
          s.torque_Nm * segment.radius_m / section.polar_m4 +
              section.rim_shear * internal.head<2>().dot(around) / section.area_m2};
}

Wrench6 strain_of_section(const BeamSection& section, const Wrench6& internal, const Wrench6& motion,
                          const Material& material) {
  const double E = material.youngs_modulus_Pa, G = E / (2 * (1 + material.poisson_ratio));
  const auto s = about_centroid(section, internal);
  const Eigen::Vector2d& c = section.centroid_m;
  const double twist = s.torque_Nm / (G * section.polar_m4);
  const Eigen::Vector2d slip = internal.head<2>() / (G * section.shear_area_m2);
  Wrench6 d;
  d << motion[4] + slip[0] + twist * c[1], -motion[3] + slip[1] - twist * c[0],
      (s.mean_Pa - s.slope_Pa_m.dot(c)) / E, s.slope_Pa_m[1] / E, -s.slope_Pa_m[0] / E, twist;
  return d;
}

}  // namespace fem

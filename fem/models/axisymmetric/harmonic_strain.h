/// Elasticity of one Fourier harmonic of a body of revolution. Internal to fem.
///
/// Displacement of the harmonic m:  u_r = U cos m theta, u_theta = V sin m theta, u_z = W cos m theta; its
/// counterpart, turned by a quarter of its period, has sin, -cos, sin. Both have the same stiffness. At m = 0
/// the amplitudes (U, W) and V stand for themselves: axial and radial motion, and torsion. Unknown 3 i + c is
/// component c of (U, V, W) at node i. Strain and stress amplitudes: rr, tt, zz, rz with the cosine, rt, tz
/// with the sine; shear strains are gamma.
#pragma once

#include <Eigen/Dense>

#include "fem/base/values/body.h"
#include "fem/models/axisymmetric/meridian_grid.h"

namespace fem {

using StrainMatrix = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Strain amplitudes of a cell's unknowns at one of its points; on the axis their limit.
StrainMatrix strain_matrix(const SectionPoint& at, int m);

/// Hooke's law for these amplitudes.
Eigen::Matrix<double, 6, 6> elasticity_matrix(const Material& material);

/// Integral over the angle of cos^2 m theta: 2 pi or pi.
double angle_integral(int m);

/// Amplitudes at points of the section, a row each: nine columns per displacement, U, V, W [m]; rr, tt, zz,
/// rz, rt, tz [Pa].
using Amplitudes = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// At one point of a cell, a column per displacement.
Eigen::MatrixXd amplitudes_at(const SectionPoint& at, const MeridianGrid& grid,
                              const Eigen::Matrix<double, 6, 6>& elasticity, int m,
                              const Eigen::MatrixXd& displacement);

/// At the result points, means of the cells' values. On the axis they are made those of a tensor that has one
/// value there, whatever the angle: of m = 0 its part that turns with the body, of m = 1 the shear along the
/// axis, of m = 2 the deviator across, of higher harmonics nothing.
Amplitudes result_amplitudes(const MeridianGrid& grid, const Material& material, int m,
                             const Eigen::MatrixXd& displacement);

}  // namespace fem

/// The k >= 0 that makes a vector series R0(t) + k G(t) small. Pure minimisation, no mechanics.
#pragma once

#include <Eigen/Core>

namespace kinetics::vibratory {

/// sqrt(mean |R|^2) and max |R| over the columns.
double rms_norm(const Eigen::Array2Xd& R);
double peak_norm(const Eigen::Array2Xd& R);

/// -mean(R0 . G) / mean(G . G), clipped at zero: least root mean square. G must not be zero throughout.
double rms_optimum(const Eigen::Array2Xd& R0, const Eigen::Array2Xd& G);

/// The smallest k >= 0 that makes max |R0 + k G| least. The maximum is convex in k: its slope, which is that
/// of the column where the maximum is taken (of several, the steepest), is negative before the optimum and
/// not after. Slopes within 1e-12 of the largest |R| |G| count as zero. G must not be zero throughout.
double peak_optimum(const Eigen::Array2Xd& R0, const Eigen::Array2Xd& G);

}  // namespace kinetics::vibratory

/// What the drum and the stub axles of a planetary mill have in common.
#pragma once

#include "kinetics/planetary_mill.h"
#include "kinetics/values/load_history.h"
#include "pipelines/loads/channels/load_collector.h"

namespace pipelines::planetary {

/// Conventions that leave a residual are not for bodies; where the two readings agree they may.
/// @throws StageRefused
void require_equilibrium(const kinetics::LoadHistory& loads);

/// G = -g (sin phi, cos phi) of the carrier frame.
Eigen::Array2Xd gravity(const kinetics::LoadHistory& loads, double g_m_s2);

/// Omega^2 l_OA e_x of the carrier frame.
Eigen::Array2Xd transport(const kinetics::LoadHistory& loads, const kinetics::PlanetaryMill& mill);

AccelerationField translation(const Eigen::Array2Xd& a);

double typical_force(const kinetics::LoadHistory& loads);

}  // namespace pipelines::planetary

/// The model errors of load patches: how far the largest stresses depend on the assumed shape of the
/// pressures on seats, and of that under a mill's charge.
#pragma once

#include <set>
#include <string>

#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

/// Adds the entries `load_patches` (seats and bores) and `charge_patch` (a mill's wall) to the model part of
/// the budgets of peak and hot-spot stress: the largest change of that stress when the half angles lie
/// elsewhere in PressureModel::half_angles. All ports move alike, and each for itself with the changes at the
/// governing point added; the larger one counts, and of its two signs the larger one: ErrorEntry::method
/// tells both. Resultants stay, only the Fourier coefficients of the harmonics n = 0, 2, 3 ... change, and
/// these are factors of responses that are solved already. What harmonics that were not solved would bring to
/// the governing point is estimated (solved_pressure.h) and added.
///
/// Nothing else is varied: forces on faces and added masses act on their whole port, whose size the scene
/// gives. A body without seat pressures, or whose governing stress does not feel them, gets no entry.
void add_load_patch_error(Judged& analysis);

/// What other half angles of all pressures may change the largest stress at a point by, the ports added [Pa]:
/// what the entries have of the governing point, of any point and loads.
/// @param values  channels x instants, in the order of the analysis' loads; those themselves, or half a
/// change
///                of them
double load_patch_error_Pa(const Responded& analysis, const StressPoint& point,
                           const Eigen::ArrayXXd& values);

/// Ports whose pressure is felt where the body's stress is largest, and of which harmonics that other half
/// angles have up to the third, or the scene's highest one, were not solved: by more than a five-hundredth of
/// the stress.
std::set<std::string> felt_seats(const Judged& analysis);

}  // namespace pipelines

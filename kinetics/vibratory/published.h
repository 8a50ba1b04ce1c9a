/// The paper's own formulas, exactly (convention `published`). Where they do not close: kinetics/README.md.
#pragma once

#include <vector>

#include "kinetics/values/load_history.h"
#include "kinetics/vibratory_effects/effect.h"

namespace kinetics::vibratory {

/// X_E, Y_E, R_E by (42)-(44); the motion of C and O, (1)-(27) (see kinematics.h); OD and DE by (57), (58);
/// with the effects that they belong to F_d (33), F_e (35), F_r (37), F_k (39), the charge's with their
/// components (45)-(50); with the effect `springs` also the two spring forces (31) and (59) and K* (60). JE =
/// c_x, LE = l_x, QE and HE = x of the springs, k = sum of ky.
///
/// K* divides by sin(phi), which passes through zero twice in a turn. Where sin(phi) is zero to round-off,
/// K_star holds the principal value (K*(phi - h) + K*(phi + h)) / 2, h = 1e-3 rad along the motion: finite,
/// and the limit where K* has one. Near these poles K* is huge, so that its extremes say nothing but how the
/// instants fell: the quantity is marked has_statistics = false. Without eccentricity there is no K_star, and
/// a warning says so.
LoadHistory published_loads(const VibratoryMill& mill, const std::vector<NamedEffect>& effects,
                            const TimeGrid& grid);

/// The same at any instants of steady running: fills a history that has its instants.
void published_over(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, const Instants& all,
                    LoadHistory& history);

}  // namespace kinetics::vibratory

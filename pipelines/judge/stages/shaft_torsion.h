/// Torsion of a shaft of a drive train: the torques of the train's elements beside what the stress field
/// carries of them, and torsional stress with its static and oscillating part.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "kinetics/train_crests.h"
#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

/// What a course over the instants amounts to: static part, oscillating part, largest size.
struct Course {
  double mean = 0;
  double amplitude = 0;  ///< half of the range
  double largest = 0;    ///< of |x|
};
Course course_of(const Eigen::ArrayXd& values);
/// With what is known of it between the instants.
/// @param is_whole  between is the whole course, of which the instants are a part
Course course_of(const Eigen::ArrayXd& values, const Eigen::ArrayXd& between, bool is_whole);

/// Polar section modulus of a round section, solid or bored: pi (d^4 - b^4) / (16 d) [m3].
double polar_modulus_m3(double diameter_m, double bore_m);

/// Torsional stress at one ring of the surface, and by the rule for round bars.
struct RingTorsion {
  TorsionRing ring;
  Eigen::ArrayXd stress_Pa;   ///< over the instants, along the direction in which it is largest
  Eigen::ArrayXd nominal_Pa;  ///< |T| r / I_p with the sign of stress_Pa: torque by statics in the section
                              ///< nearest to the ring, in the thinner of the segments that meet there
  Course stress, nominal;     ///< of both, over the whole course where it is known between the instants
  double factor = 0;          ///< K_ts, largest stress over the nominal one at that instant; 0: no torque
};

/// An element of the train at its port on the shaft.
struct ElementTorsion {
  std::string element, port;
  Eigen::ArrayXd torque_Nm;     ///< on the shaft, counter-clockwise positive, as the load stage has it
  Eigen::ArrayXd by_stress_Nm;  ///< what the torque of the stress field changes by from one side of the port
                                ///< to the other; the angular inertia of the piece between is in it
  double largest_difference_Nm = 0;
  Eigen::ArrayXd nominal_Pa;           ///< |torque_Nm| r / I_p in the port's segment, with the torque's sign
  Course torque, by_stress, nominal;   ///< over the whole course where it is known between the instants
  std::optional<RingTorsion> largest;  ///< the ring stressed most of those nearest to this port
};

/// The torsion of every element that joins the shaft; none of other bodies, and where no section diagrams
/// are.
/// @param loads   the load stage that the analysis is of
/// @param course  what the machine knows of its quantities between the instants; empty: nothing
std::vector<ElementTorsion> element_torsion(const Judged& analysis, const kinetics::LoadHistory& loads,
                                            const std::vector<kinetics::CourseFigures>& course = {});

/// Course of a ring's torsional stress along the direction that it has where it is largest: positive there.
/// @param shear_Pa  ring_shear_Pa
Eigen::ArrayXd signed_ring_stress_Pa(const Eigen::Array2Xd& shear_Pa);

/// What the largest torsional stress of the body may be wrong by, for want of a finer mesh [Pa]. On cells the
/// smaller of two estimates:
/// - at the ring's place for the channels that twist the ring alone, since the mean sees nothing of bending
///   and what that is off by; no component of shear is off by more than the von Mises stress of what the
///   tensor is off by, over sqrt(3). Beside what is left out at sharp edges, also TorsionRing::rise_Pa.
/// - the difference to Diagrams::by_harmonics with its error; that one, too, where the models differ by more
///   than both state.
/// Harmonics have their own error; infinite where nothing is known. To these comes what the ring's largest
/// stress between the instants may exceed max_Pa by (sampling_error_Pa), and rounding.
/// @param ring  largest_torsion_ring
double ring_error_Pa(const Judged& analysis, const TorsionRing& ring);

/// Largest torsional stress of a body with its error; none of a body without diagrams.
std::optional<LargestTorsion> largest_torsion(const Judged& analysis);

/// Whether the ring's stress is what rounding leaves where nothing twists the shaft.
bool is_rounding(const Judged& analysis, const TorsionRing& ring);

/// Diagrams::by_harmonics of an analysis for the same mesh under other loads: with the same relative
/// difference and error, as long as torsional stress is largest on the same feature.
void take_torsion_by_harmonics(const Judged& before, Judged& after);

}  // namespace pipelines

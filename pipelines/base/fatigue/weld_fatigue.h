/// Fatigue of weld toes by structural hot-spot stress.
///
/// Source: Hobbacher, Recommendations for Fatigue Design of Welded Joints and Components, IIW-1823-07 (2008):
/// structural stress 2.2.3, S-N curves 3.2, hot-spot classes 3.3, wall thickness 3.5, damage 4.3. Curves are
/// for steel and direct stress, with 95 % survival, as welded (high residual stress: the stress ratio brings
/// no bonus).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "kinetics/series/load_spectrum.h"
#include "pipelines/base/fatigue/sn_curve.h"

namespace pipelines {

/// FAT classes of hot-spot stress in steel [Pa]: load-carrying fillet welds, and ends of long attachments 90;
/// the others (butt joints, transverse attachments, fillet welds that carry no load) 100.
constexpr double fat_load_carrying_fillet_Pa = 90e6, fat_non_load_carrying_Pa = 100e6;

enum class LoadAmplitude { constant, variable };

/// Exponents n of the thickness factor (table 3.5-1), as welded unless said otherwise.
namespace thickness_exponent {
constexpr double cruciform_or_attachment = 0.3;  ///< cruciform and T joints, attachments, ends of stiffeners
constexpr double transverse_butt = 0.2;          ///< as welded
}  // namespace thickness_exponent

/// Factor on the FAT class: (25 mm / t)^n for t > 25 mm, else 1.
/// @param thickness_m  effective thickness of the plate that may crack, > 0
/// @param exponent     n, 0 to 0.5
/// @throws std::invalid_argument if one is outside its range
double thickness_factor(double thickness_m, double exponent = thickness_exponent::cruciform_or_attachment);

struct WeldDetail {
  double fat_Pa = fat_load_carrying_fillet_Pa;  ///< range with 95 % survival at 2e6 cycles
  double thickness_m = 0.025;
  double thickness_exponent = thickness_exponent::cruciform_or_attachment;
  double gamma_M = 1;  ///< partial factor of resistance, 1 to 2 (IIW: 1.0 to 1.4)
};

/// Design S-N curve of stress ranges (not amplitudes): N = 2e6 (f(t) FAT / gamma_M / range)^3, knee at 1e7
/// cycles, then slope 22 for constant and 5 for variable amplitude.
/// @throws std::invalid_argument if the FAT class is not between 1 MPa and 700 MPa, gamma_M outside 1 to 2,
/// or as thickness_factor
SnCurve weld_curve(const WeldDetail& detail, LoadAmplitude amplitude);

/// Damage of cycles (ranges in Pa; means do not count).
/// @throws std::invalid_argument as weld_curve and miner_damage
double weld_damage(const WeldDetail& detail, LoadAmplitude amplitude,
                   const std::vector<kinetics::LoadCycle>& cycles);

/// The scalar stress that governs a toe, and its cycles.
struct ToeStress {
  double angle_rad = 0;                     ///< from the toe's normal towards surface_normal x toe_normal
  bool is_principal = false;                ///< else the stress normal to the toe
  Eigen::Matrix<double, 6, 1> form;         ///< weights of the components that make that stress
  Eigen::ArrayXd stress_Pa;                 ///< one value for each instant
  std::vector<kinetics::LoadCycle> cycles;  ///< cycles of the period that repeats
};

/// Stress range across a toe. IIW: the principal stress in the surface, if its direction is within 60 degrees
/// of the toe's normal, else the stress normal to the toe. Over a cycle with turning principal directions
/// this is read as: of the fixed directions within 60 degrees, one where the damage of the counted cycles of
/// the normal stress has a maximum (the end of the sector is none), if it is not less than that normal to the
/// toe. With one cycle in the period that is the direction of the largest range; with proportional stress it
/// is the principal stress itself, and there are no jumps between two of them.
/// @param history_Pa      structural stress, rows xx, yy, zz, xy, yz, xz, a column for each instant of a
/// period
/// @param surface_normal  need not have unit length
/// @param toe_normal      across the toe; its part in the surface counts
/// @param detail          whose S-N curve for variable amplitude tells the damage
/// @throws std::invalid_argument as weld_curve, if the history is empty or not finite, or the toe's normal
/// has no part in the
///         surface
ToeStress toe_stress(const Eigen::Matrix<double, 6, Eigen::Dynamic>& history_Pa,
                     const Eigen::Vector3d& surface_normal, const Eigen::Vector3d& toe_normal,
                     const WeldDetail& detail);

}  // namespace pipelines

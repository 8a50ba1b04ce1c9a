/// The welds of a body as fatigue sees them, for any loads, and the rules of each: toes by their hot-spot
/// stress, rounded edges by their effective notch stress.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "pipelines/base/fatigue/weld_fatigue.h"
#include "pipelines/judge/analysis/judged.h"
#include "pipelines/superpose/between_instants/factor_course.h"

namespace pipelines {

/// At failure under ranges of unlike size (IIW 4.3.1).
constexpr double damage_sum_of_spectra = 0.5;

struct WeldPlace {
  std::string name;
  std::array<double, 3> toe_m{};
  Eigen::Matrix<double, 6, Eigen::Dynamic> unit_Pa;  ///< hot-spot or notch stress of each unit load
  Eigen::Vector3d surface_normal, across_toe;
  WeldDetail detail;
  std::string type;        ///< of weld_classes.h, or effective_notch; empty: the class is the scene's own
  double error_share = 0;  ///< whole error of the stress (whole_error_share); infinite: not known

  /// Stress along a direction in the surface, for ToeStress::angle_rad; a value per column of the factors.
  Eigen::ArrayXd along_Pa(const Eigen::ArrayXXd& factors, double angle_rad) const;

  /// Under loads with the channels of the unit responses. The direction is that of the places between the
  /// instants; cycles have their turning points where the stress has them.
  ToeStress stress(const FactorCourse& course) const;

  /// The stress of a series that is no period of a polynomial.
  ToeStress stress(const Eigen::ArrayXXd& factors) const {
    return toe_stress(unit_Pa * factors.matrix(), surface_normal, across_toe, detail);
  }

  /// By how much half a range may be larger than its instants tell, or the polynomial through them, as a
  /// share of it: what the toe's deviator may, at most.
  double unresolved_share(const FactorCourse& course, const ToeStress& toe) const;
};

/// @throws StageRefused if the scene's fatigue names a toe that the body does not have
void require_toes(const BodyScene& body, const meshes::BodyMesh& mesh);

/// All toes, in the order of Judged::hot_spots, then of each notch the node whose stress across the weld
/// changes most over the cycle.
std::vector<WeldPlace> weld_places(const Judged& analysis);

}  // namespace pipelines

/// Structural hot-spot stress of weld toes: the notch itself has no converged stress, so the stress of the
/// plate is extrapolated to it from 0.4 and 1.0 plate thicknesses: 1.67 s(0.4 t) - 0.67 s(1.0 t), each
/// component, or the same straight line from vertices close to these points (IIW, Recommendations for fatigue
/// design of welded joints, type "a" toes, fine mesh).
#pragma once

#include <memory>
#include <vector>

#include "fem/base/values/unit_responses.h"
#include "meshes/values/body_mesh.h"
#include "pipelines/judge/estimates/error_budget.h"
#include "pipelines/loads/channels/channels.h"
#include "pipelines/superpose/envelope/superposition.h"

namespace pipelines {

struct HotSpotStress {
  std::string name;
  std::array<double, 3> toe_m{};
  std::vector<StressPoint::Part> parts;  ///< nodes of the extrapolation, with its weights
  std::size_t near_node = 0;             ///< next to the point at 0.4 plate thicknesses
  /// Length across the toe, in plate thicknesses, of the face that has both this point and the toe; 0:
  /// another face's edge lies between.
  double face_walls = 0;
  double von_mises_Pa = 0;   ///< largest over the cycle
  std::int32_t instant = 0;  ///< instant of that stress
  double error_Pa = 0;       ///< numerical part, estimated on this mesh alone
  /// Unit stress of the extrapolation where a submodel was solved.
  std::shared_ptr<const ResolvedStress> resolved;
  /// Largest and least normal stress across the toe over the cycle: their range is what fatigue counts.
  double max_normal_Pa = 0, min_normal_Pa = 0;
};

/// The extrapolation at the instant of the largest von Mises stress.
StressPoint stress_point(const HotSpotStress& spot);

/// @return in descending order of the largest von Mises stress
/// @throws std::runtime_error if a point of a hot spot lies on no boundary face of the solution
std::vector<HotSpotStress> hot_spot_stresses(const std::vector<meshes::HotSpot>& spots,
                                             const fem::UnitResponses& responses,
                                             const ChannelHistory& loads);

/// Takes the largest stress, its instant and the range across the toe from the extrapolated unit stress.
void take_course(const meshes::HotSpot& drawing, const std::vector<std::array<double, 6>>& unit_Pa,
                 const ChannelHistory& loads, HotSpotStress& spot);

/// The same toes under other loads, by the same unit stress: a submodel's where one was solved.
/// @param drawings  drawings of all of `spots`, which are of the same responses
/// @param loads     with the channels of the unit responses
/// @return in descending order of the largest von Mises stress
std::vector<HotSpotStress> hot_spots_under(const std::vector<meshes::HotSpot>& drawings,
                                           const fem::UnitResponses& responses, const ChannelHistory& loads,
                                           std::vector<HotSpotStress> spots);

/// Descending; equal ones keep their order.
void sort_by_stress(std::vector<HotSpotStress>& spots);

/// A sentence for the user on weld toes without a hot-spot stress; empty where the mesh reads all of them.
std::string warning_of_covered(const std::string& body, const meshes::BodyMesh& mesh);

}  // namespace pipelines

/// The cheap models: unit responses of a shaft in the solid's channels, so that
/// envelope, peak and places come out of the same functions as the solid's.
#pragma once

#include <optional>
#include <vector>

#include "fem/base/values/unit_responses.h"
#include "fem/models/beam/beam_shaft.h"
#include "pipelines/judge/estimates/error_budget.h"
#include "pipelines/loads/channels/load_collector.h"
#include "pipelines/scene/values/body_scene.h"

namespace pipelines {

/// The shaft as a beam; nothing for other bodies, nor with keyways.
std::optional<fem::BeamShaft> beam_shaft(const BodyScene& body, const meshes::BodyMesh& mesh);

/// Beam theory with stress concentration factors (fem/models/beam/beam_responses.h). Locate its nodes with
/// the features, ports and sharp edges of `mesh`.
/// @param mesh  of the same body: its boundary ids
/// @return nothing if the body is no shaft, or has keyways
/// @throws std::invalid_argument as fem::beam_responses
std::optional<fem::UnitResponses> beam_responses(const BodyScene& body, const meshes::BodyMesh& mesh,
                                                 const std::vector<fem::UnitLoad>& loads);

/// What a beam leaves out of a bored seat under one-sided pressure: the section goes oval. Each harmonic p_n
/// of the pressure on a ring of mean radius r, wall t, loaded at the radius R: hoop bending 6 p_n R r / ((n^2
/// - 1) t^2), and p_0 R / t (Roark's Formulas, 7th ed., table 9.2). Harmonics add up without their phases.
/// @return largest over seats and instants [Pa]; 0 for a solid shaft
double ring_stress_Pa(const fem::BeamShaft& shaft, const BodyLoads& loads);

/// What a beam leaves out of spin: the hoop stress of each segment as a long cylinder that turns about its
/// axis, at its bore or in its middle (Timoshenko and Goodier, Theory of Elasticity, 3rd ed., article 32,
/// with the constants of plane strain).
/// @return largest over segments and instants [Pa]
double spin_stress_Pa(const fem::BeamShaft& shaft, const fem::Material& material, const BodyLoads& loads);

/// The entries of a beam's error that no mesh lowers: `model`, `near_loads`, `ovalisation`, `spin`; those
/// that are zero are left out, but for the first. `near_loads` is by how much the largest stress of any
/// circle of nodes, with fem::near_load_error_Pa, exceeds the peak.
/// @param von_mises_Pa  largest at each of the nodes
/// @param excluded      one per node: no peak is looked for there
std::vector<ErrorEntry> beam_model_entries(const fem::BeamShaft& shaft, const BodyLoads& loads,
                                           const fem::Nodes& nodes, const std::vector<double>& von_mises_Pa,
                                           const std::vector<char>& excluded, double peak_Pa);

/// Unit responses and what the model behind them leaves out.
struct AxisymmetricModel {
  fem::UnitResponses responses;
  double model_error = 0;  ///< relative, of a peak at a fillet: fem::eccentricity_error
};

/// Harmonics around the axis (fem/models/axisymmetric/axisymmetric_responses.h) on the half section of the
/// solid's blocks, for the same features, ports and sharp edges.
/// @return nothing if the body is no shaft, or has keyways
/// @throws as fem::axisymmetric_responses
std::optional<AxisymmetricModel> axisymmetric_responses(const BodyScene& body, const meshes::BodyMesh& mesh,
                                                        const std::vector<fem::UnitLoad>& loads);

}  // namespace pipelines

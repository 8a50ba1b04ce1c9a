/// A whole run of a body on the axisymmetric model: the same files as of the solid, from the same functions.
#pragma once

#include <limits>

#include "pipelines/judge/analysis/body_analysis.h"
#include "pipelines/loads/stage/body_mesh.h"

namespace pipelines {

/// The axisymmetric model in the place of analyse_body. The section is refined until no place of the body
/// exceeds the stated peak by more than `target` with its error; `tolerance` > 0 enters the steps as a
/// search. The peak's errors: time sampling and pressure harmonics as for the solid; discretisation from the
/// change between sections, place by place; of eccentric segments the model's own (fem::eccentricity_error).
/// A node lies where the largest stress of each place does (nodes_at_maxima.h).
/// @param meshed   of describe_revolved, or of the solid: masses, features, ports and sharp edges are taken
/// @param seconds  for all sections but the first, which is always solved
/// @throws std::invalid_argument if why_not_axisymmetric is not empty
/// @throws std::runtime_error if the loads do not close to 1e-9
BodyAnalysis analyse_axisymmetric(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                                  BodyLoads loads, const RunOptions& options, StageClock& clock,
                                  double tolerance = 0,
                                  double seconds = std::numeric_limits<double>::infinity());

/// What axisymmetric_stresses knows.
struct AxisymmetricStresses {
  std::vector<PlaceStress> places;
  LargestTorsion torsion;  ///< of the last section: sections are not refined for its sake
};

/// A section with so many unknowns is the last one of a second opinion: the next, with some 4 times as many,
/// would cost more than the solid that it stands beside.
constexpr std::size_t most_of_second_opinion = 100000;

/// By the axisymmetric model, refined until no place's error exceeds `target` of the largest value, or a
/// section has too many unknowns: the errors then say so. A second opinion on other models of the same loads:
/// on concentric shafts values are within their errors of the elastic solution.
/// @param meshed         features, ports, sharp edges and masses of whatever mesh the loads were made for
/// @param most_unknowns  of a section that another one follows
/// @throws as analyse_axisymmetric
AxisymmetricStresses axisymmetric_stresses(const BodyScene& body, const MeshedBody& meshed,
                                           const BodyLoads& loads, int n_threads, double target = 0.005,
                                           std::size_t most_unknowns = most_of_second_opinion);

}  // namespace pipelines

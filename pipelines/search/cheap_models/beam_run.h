/// A whole run of a shaft as a beam, as far as a beam goes.
#pragma once

#include "pipelines/judge/analysis/body_analysis.h"
#include "pipelines/loads/stage/body_mesh.h"

namespace pipelines {

/// The beam in the place of analyse_body: envelope, peak, effects. It has no section diagrams and no
/// rings of torsion; zones are patches of surface without volume. Inside there are nodes on the axis alone,
/// with the mean of the circle around them, so that there are cells to look at. Errors of the model: the
/// spread of the fillets' published factors, bored seats that go oval, spin.
/// @param meshed  of describe_revolved, or of the solid: masses, features, ports and sharp edges are taken
/// @throws std::invalid_argument if why_not_beam is not empty
/// @throws std::runtime_error if the loads do not close to 1e-9
BodyAnalysis analyse_beam(const BodyScene& body, const MeshedBody& meshed, BodyLoads loads,
                          const RunOptions& options, StageClock& clock);

}  // namespace pipelines

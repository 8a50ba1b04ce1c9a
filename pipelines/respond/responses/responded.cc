#include "pipelines/respond/responses/responded.h"

#include <utility>

namespace pipelines {

Responded responded(const BodyScene& body, const MeshedBody& meshed, BodyLoads loads,
                    fem::UnitResponses responses) {
  Responded result;
  result.scene = body;
  result.mesh = meshed.mesh;
  result.regions = meshed.regions;
  result.masses = meshed.masses;
  result.geometry_error = meshed.geometry_error;
  result.loads = std::move(loads);
  result.responses = std::move(responses);
  return result;
}

}  // namespace pipelines

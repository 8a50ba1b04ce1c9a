#include "pipelines/loads/stage/machine_masses.h"

#include <algorithm>
#include <cmath>

#include "pipelines/loads/stage/load_maker.h"

namespace pipelines {

double MassFigure::share() const {
  return difference == 0 ? 0 : difference / std::max(reference, 1e-300);
}

MassAgreement agree_masses(const Scene& scene, const std::vector<MeshedBody>& bodies) {
  MassAgreement result{scene.machine, {}, {}};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto& body = scene.bodies[i];
    result.attached[body.name];
    load_maker_of(body).agree_masses(scene, body, bodies[i], result);
  }
  return result;
}

}  // namespace pipelines

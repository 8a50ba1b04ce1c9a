#include "pipelines/search/loop/found_body.h"

#include <algorithm>

namespace pipelines {

FoundBody::FoundBody(const Scene& as_read, const Scene& found, std::size_t i_body)
    : body(found.bodies[i_body]),
      added_harmonics(body.pressure_harmonics - as_read.bodies[i_body].pressure_harmonics),
      instants_per_turn(found.sampling.instants_per_turn > as_read.sampling.instants_per_turn
                            ? found.sampling.instants_per_turn
                            : 0) {}

void FoundBody::enter(Scene& scene, std::size_t i_body) const {
  auto& other = scene.bodies[i_body];
  other.shape = body.shape;
  other.degree = body.degree;
  other.refinements = body.refinements;
  other.singular = body.singular;
  other.felt_seats = body.felt_seats;
  other.pressure_harmonics += added_harmonics;
  for (auto& [port, pressure] : other.pressures) pressure.highest_harmonic += added_harmonics;
  scene.sampling.instants_per_turn = std::max(scene.sampling.instants_per_turn, instants_per_turn);
}

}  // namespace pipelines

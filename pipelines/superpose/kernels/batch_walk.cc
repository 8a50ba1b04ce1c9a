#include "pipelines/superpose/kernels/batch_walk.h"

#include "pipelines/superpose/kernels/deviatoric_coordinates.h"
#include "pipelines/superpose/kernels/lode_cosine.h"

namespace pipelines {

BatchWalk::BatchWalk(const WalkedFactors& factors, const fem::UnitResponses& responses)
    : factors_(factors),
      kernel_factors_(factors.for_kernel()),
      responses_(responses),
      coordinates_(kernel::batch * factors.n_channels() * kernel::n_coordinates),
      room_(kernel::room_of_walk(kernel_factors_)) {}

const std::array<kernel::NodeMaximum, kernel::batch>& BatchWalk::of(std::size_t first, std::size_t n_nodes) {
  double* coordinates = coordinates_.data();
  for (std::size_t i = 0; i < n_nodes; ++i) {
    factors_.gather(responses_.unit_stress_Pa(responses_.node_of_row(first + i)), 6, coordinates);
    for (std::size_t k = 0; k < factors_.n_channels(); ++k, coordinates += kernel::n_coordinates) {
      const double mean = (coordinates[0] + coordinates[1] + coordinates[2]) / 3;
      find_deviatoric_coordinates(coordinates, coordinates);
      coordinates[5] = mean;
    }
  }
  kernel::walk_for_this_machine()(coordinates_.data(), n_nodes, kernel_factors_, lode_terms().data(),
                                  room_.data(), found_.data());
  return found_;
}

}  // namespace pipelines

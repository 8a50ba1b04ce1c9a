/// What UnitResponses do where several ranks share a body.
#include <algorithm>

#include "fem/base/values/unit_responses.h"
#include "fem/mesh/ranks/ranks.h"

namespace fem {

void UnitResponses::bring(const std::vector<std::int32_t>& wanted) const {
  if (!shared) return;
  std::vector<std::int32_t> missing;
  for (const auto node : wanted)
    if (auto& is_there = shared->is_everywhere[std::size_t(node)]; is_there == 0) {
      is_there = 1;
      missing.push_back(node);
    }
  const std::size_t of_displacement = 3 * channels.size(), per_node = 3 * of_displacement;
  constexpr std::size_t nodes_at_once = 4096;
  for (std::size_t first = 0; first < missing.size(); first += nodes_at_once) {
    const std::size_t n = std::min(nodes_at_once, missing.size() - first);
    std::vector<double> rows(n * per_node, 0.0);
    for (std::size_t i = 0; i < n; ++i)
      if (const auto node = std::size_t(missing[first + i]); has(node)) {
        std::copy_n(unit_displacement_m(node), of_displacement, &rows[i * per_node]);
        std::copy_n(unit_stress_Pa(node), 2 * of_displacement, &rows[i * per_node + of_displacement]);
      }
    fem::complete(shared->communicator, rows);
    for (std::size_t i = 0; i < n; ++i)
      shared->brought[missing[first + i]].assign(&rows[i * per_node], &rows[i * per_node] + per_node);
  }
}

const double* UnitResponses::brought(std::size_t node) const {
  bring({std::int32_t(node)});
  return shared->brought.at(std::int32_t(node)).data();
}

void UnitResponses::sum_over_ranks(double* values, std::size_t n) const {
  if (shared) fem::sum_over_ranks(shared->communicator, values, n);
}

void UnitResponses::complete(std::vector<double>& values) const {
  if (shared) fem::complete(shared->communicator, values);
}
void UnitResponses::complete(std::vector<float>& values) const {
  if (shared) fem::complete(shared->communicator, values);
}
void UnitResponses::complete(std::vector<std::int32_t>& values) const {
  if (shared) fem::complete(shared->communicator, values);
}

}  // namespace fem

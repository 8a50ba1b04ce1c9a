#include "fem/stress/cells/cell_stress_at_node.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fem/equations/operators/subdomain.h"
#include "fem/mesh/ranks/row_exchange.h"
#include "fem/stress/cells/cell_stress.h"

namespace fem {

std::vector<std::vector<std::array<double, 6>>> cell_stress_at_node_Pa(const UnitResponses& responses,
                                                                       const Material& material,
                                                                       std::size_t node) {
  const auto& nodes = responses.nodes;
  std::vector<std::int32_t> around;
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    if (std::find(cell.begin(), cell.end(), std::int32_t(node)) != cell.end())
      around.push_back(std::int32_t(c));
  }
  if (around.empty())
    throw std::invalid_argument("cell_stress_at_node_Pa: no cell holds node " + std::to_string(node));
  const Subdomain part = make_subdomain(nodes, around);
  responses.bring(part.node);
  RowMajor displacement(Eigen::Index(part.node.size()), 3 * Eigen::Index(responses.channels.size()));
  for (std::size_t i = 0; i < part.node.size(); ++i)
    std::copy_n(responses.displacement_anywhere_m(std::size_t(part.node[i])), displacement.cols(),
                displacement.row(Eigen::Index(i)).data());
  const auto place = std::find(part.node.begin(), part.node.end(), std::int32_t(node)) - part.node.begin();
  std::vector<std::vector<std::array<double, 6>>> stress_Pa;
  for (std::size_t c = 0; c < around.size(); ++c) {
    const auto* local = part.grid.nodes_of(c);
    const auto own = std::find(local, local + part.grid.nodes_per_cell(), std::int32_t(place)) - local;
    const auto at = tabulate_in_cell(nodes.shape(), {nodes_in_cell(nodes.shape()).point[std::size_t(own)]});
    RowMajor stress(1, 2 * displacement.cols());
    CellStress(part.grid, at, lame(material), displacement)(c, stress);
    auto& tensors = stress_Pa.emplace_back(responses.channels.size());
    std::copy_n(stress.data(), stress.size(), tensors.front().data());
  }
  return stress_Pa;
}

std::vector<double> largest_cell_differences_Pa(const UnitResponses& responses, const Material& material,
                                                const std::vector<const double*>& factors) {
  const auto& nodes = responses.nodes;
  std::vector<double> largest(nodes.n, 0.0);
  const auto is_asked = [&](std::size_t node) { return factors[node] != nullptr && responses.has(node); };
  std::vector<std::int32_t> asked;
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    if (std::any_of(cell.begin(), cell.end(), [&](auto node) { return is_asked(std::size_t(node)); }))
      asked.push_back(std::int32_t(c));
  }
  const Subdomain part = make_subdomain(nodes, asked);
  const auto n_channels = Eigen::Index(responses.channels.size());
  const Eigen::Map<const RowMajor> whole(responses.displacement_m.data(), Eigen::Index(responses.n_rows()),
                                         3 * n_channels);
  const RowMajor displacement = responses.shared ? RowExchange(*responses.shared, part.node)(whole)
                                                 : RowMajor(whole(part.node, Eigen::all));
  if (asked.empty()) {
    responses.complete(largest);
    return largest;
  }
  const int n_local = part.grid.nodes_per_cell();
  RowMajor stress(n_local, 6 * n_channels);
  CellStress of_cell(part.grid, nodes_in_cell(nodes.shape()), lame(material), displacement);
  const auto summed = [&](const double* unit, const double* by) {
    std::array<double, 6> sum{};
    for (Eigen::Index k = 0; k < n_channels; ++k)
      for (std::size_t i = 0; i < 6; ++i) sum[i] += by[k] * unit[std::size_t(6 * k) + i];
    return von_mises(sum.data());
  };
  for (std::size_t c = 0; c < asked.size(); ++c) {
    of_cell(c, stress);
    for (int i = 0; i < n_local; ++i) {
      const auto node = std::size_t(part.node[std::size_t(part.grid.nodes_of(c)[i])]);
      if (!is_asked(node)) continue;
      const double recovered = summed(responses.unit_stress_Pa(node), factors[node]);
      largest[node] =
          std::max(largest[node], std::abs(summed(stress.row(i).data(), factors[node]) - recovered));
    }
  }
  responses.complete(largest);
  return largest;
}

}  // namespace fem

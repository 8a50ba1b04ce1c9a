#include "fem/mesh/triangulation/local_refinement.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>

namespace fem {

namespace {

using Dof = dealii::types::global_dof_index;

/// The degree of freedom that stands for each one: a vertex in the middle of a larger cell's edge is the node
/// which that cell has there.
std::vector<Dof> merge_same_places(const dealii::AffineConstraints<double>& hanging, std::size_t n_dofs) {
  std::vector<Dof> same(n_dofs);
  std::iota(same.begin(), same.end(), Dof(0));
  for (const auto& line : hanging.get_lines())
    if (line.entries.size() == 1 && std::abs(line.entries[0].second - 1) < 1e-12)
      same[line.index] = line.entries[0].first;
  for (Dof i = 0; i < n_dofs; ++i)
    while (same[same[i]] != same[i]) same[i] = same[same[i]];
  return same;
}

/// Flags the cells that share the vertex nearest to one of the points. Nodes of the mesh before are a little
/// off the vertices on hanging faces, and between them in cubic cells.
void flag_cells_at(dealii::Triangulation<3>& mesh, const std::vector<std::array<double, 3>>& points_m) {
  constexpr double share_of_cell = 0.5;
  std::map<unsigned, dealii::Point<3>> meant;  // by vertex
  for (const auto& [x_m, y_m, z_m] : points_m) {
    const dealii::Point<3> point(x_m, y_m, z_m);
    meant.emplace(dealii::GridTools::find_closest_vertex(mesh, point), point);
  }
  for (const auto& cell : mesh.active_cell_iterators())
    for (const auto vertex : cell->vertex_indices()) {
      const auto found = meant.find(cell->vertex_index(vertex));
      if (found == meant.end()) continue;
      const auto& point = found->second;
      if (cell->vertex(vertex).distance(point) > share_of_cell * cell->diameter())
        throw std::invalid_argument("refinements: no vertex lies at (" + std::to_string(point[0]) + ", " +
                                    std::to_string(point[1]) + ", " + std::to_string(point[2]) + ") m");
      cell->set_refine_flag();
    }
}

}  // namespace

void refine_locally(dealii::Triangulation<3>& mesh, const std::vector<RefinementCycle>& cycles) {
  for (const auto& cycle : cycles) {
    std::vector<char> is_cut(mesh.n_active_cells(), 0);
    for (const auto cell : cycle.cells) {
      if (cell < 0 || std::size_t(cell) >= is_cut.size())
        throw std::invalid_argument("refinements: the mesh has no cell " + std::to_string(cell));
      is_cut[std::size_t(cell)] = 1;
    }
    for (const auto& cell : mesh.active_cell_iterators())
      if (is_cut[cell->active_cell_index()] != 0) cell->set_refine_flag();
    mesh.execute_coarsening_and_refinement();
    if (cycle.again_at_m.empty()) continue;
    flag_cells_at(mesh, cycle.again_at_m);
    mesh.execute_coarsening_and_refinement();
  }
}

std::vector<std::int32_t> larger_neighbours(const dealii::Triangulation<3>& mesh,
                                            const std::vector<std::size_t>& cells) {
  const auto cells_at = dealii::GridTools::vertex_to_cell_map(mesh);  // hanging vertices too
  std::vector<char> is_meant(mesh.n_active_cells(), 0);
  for (const auto cell : cells) is_meant[cell] = 1;
  std::set<std::int32_t> larger;
  for (const auto& cell : mesh.active_cell_iterators()) {
    if (is_meant[cell->active_cell_index()] == 0) continue;
    for (const auto vertex : cell->vertex_indices())
      for (const auto& neighbour : cells_at[cell->vertex_index(vertex)])
        if (neighbour->level() < cell->level()) larger.insert(std::int32_t(neighbour->active_cell_index()));
  }
  return {larger.begin(), larger.end()};
}

NodeNumbers number_nodes(const dealii::DoFHandler<3>& space) {
  dealii::AffineConstraints<double> direct;
  dealii::DoFTools::make_hanging_node_constraints(space, direct);
  const auto same = merge_same_places(direct, space.n_dofs());

  // The rest in terms of what is left, chains of hanging nodes resolved by deal.II.
  dealii::AffineConstraints<double> constraints;
  for (const auto& line : direct.get_lines()) {
    if (same[line.index] != line.index || constraints.is_constrained(line.index)) continue;
    constraints.add_line(line.index);
    for (const auto& [master, weight] : line.entries) constraints.add_entry(line.index, same[master], weight);
  }
  constraints.close();

  NodeNumbers numbers;
  numbers.of_dof.assign(space.n_dofs(), -1);
  for (Dof i = 0; i < space.n_dofs(); ++i)
    if (same[i] == i) numbers.of_dof[i] = std::int32_t(numbers.n_nodes++);
  for (Dof i = 0; i < space.n_dofs(); ++i) numbers.of_dof[i] = numbers.of_dof[same[i]];
  for (Dof i = 0; i < space.n_dofs(); ++i) {
    if (same[i] != i || !constraints.is_constrained(i)) continue;
    auto entries = *constraints.get_constraint_entries(i);
    std::sort(entries.begin(), entries.end());
    for (auto& entry : entries) entry.first = Dof(numbers.of_dof[entry.first]);
    numbers.hanging.add(numbers.of_dof[i], entries);
  }
  return numbers;
}

}  // namespace fem

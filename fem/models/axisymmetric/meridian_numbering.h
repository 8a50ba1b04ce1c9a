/// Which nodes of a cut section have unknowns of their own. Internal to fem.
#pragma once

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe.h>
#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace fem {

/// Numbers of the nodes that have unknowns, and what the others are made of.
class MeridianNumbering {
public:
  explicit MeridianNumbering(const dealii::DoFHandler<2>& dofs) : number_(dofs.n_dofs(), -1) {
    dealii::DoFTools::make_hanging_node_constraints(dofs, constraints_);
    constraints_.close();
    int next = 0;
    for (std::size_t i = 0; i < number_.size(); ++i)
      if (!constraints_.is_constrained(i)) number_[i] = next++;
  }
  int operator[](std::size_t dof) const { return number_[dof]; }

  /// The nodes of a cell, and by which of them and how much each of its degrees of freedom is made.
  struct OfCell {
    std::vector<int> nodes;
    std::vector<std::vector<std::pair<int, double>>> parts;
  };
  OfCell of(const dealii::DoFHandler<2>::active_cell_iterator& cell) const {
    std::vector<dealii::types::global_dof_index> own(cell->get_fe().n_dofs_per_cell());
    cell->get_dof_indices(own);
    OfCell result;
    const auto position = [&](std::size_t dof) {
      const auto found = std::find(result.nodes.begin(), result.nodes.end(), number_[dof]);
      if (found != result.nodes.end()) return int(found - result.nodes.begin());
      result.nodes.push_back(number_[dof]);
      return int(result.nodes.size()) - 1;
    };
    for (const auto dof : own) {
      result.parts.emplace_back();
      if (!constraints_.is_constrained(dof)) {
        result.parts.back().emplace_back(position(dof), 1.0);
        continue;
      }
      for (const auto& [master, factor] : *constraints_.get_constraint_entries(dof))
        result.parts.back().emplace_back(position(master), factor);
    }
    return result;
  }

private:
  dealii::AffineConstraints<double> constraints_;
  std::vector<int> number_;
};

}  // namespace fem

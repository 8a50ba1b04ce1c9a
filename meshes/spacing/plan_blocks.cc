#include "meshes/spacing/plan_blocks.h"

#include <cmath>

namespace meshes {

namespace {

int add_point(Plan& plan, double x_m, double y_m) {
  plan.points.push_back({x_m, y_m});
  return static_cast<int>(plan.points.size()) - 1;
}

}  // namespace

PointRows add_circles(Plan& plan, const std::array<double, 2>& centre_m, const std::vector<double>& radii_m,
                      const std::vector<double>& angles_rad, const std::vector<int>& inner_row) {
  PointRows rows;
  for (const double radius_m : radii_m) {
    if (rows.empty() && !inner_row.empty()) {
      rows.push_back(inner_row);
      continue;
    }
    std::vector<int> row;
    for (const double angle : angles_rad)
      row.push_back(add_point(plan, centre_m[0] + radius_m * std::cos(angle),
                              centre_m[1] + radius_m * std::sin(angle)));
    rows.push_back(row);
  }
  return rows;
}

PointRows add_ruled_rows(Plan& plan, const std::vector<int>& inner_row, const std::vector<int>& outer_row,
                         const std::vector<double>& shares) {
  PointRows rows = {inner_row};
  for (std::size_t k = 1; k + 1 < shares.size(); ++k) {
    std::vector<int> row;
    for (std::size_t j = 0; j < inner_row.size(); ++j) {
      const auto a = plan.points[inner_row[j]], b = plan.points[outer_row[j]];
      row.push_back(add_point(plan, a[0] + shares[k] * (b[0] - a[0]), a[1] + shares[k] * (b[1] - a[1])));
    }
    rows.push_back(row);
  }
  rows.push_back(outer_row);
  return rows;
}

void add_quads(PlanBlock& block, const PointRows& rows, bool closed, int inner_id, int outer_id) {
  const std::size_t n = rows.front().size(), n_columns = closed ? n : n - 1;
  for (std::size_t k = 0; k + 1 < rows.size(); ++k)
    for (std::size_t j = 0; j < n_columns; ++j) {
      const std::size_t next = (j + 1) % n;
      PlanQuad quad;
      quad.corners = {rows[k][j], rows[k + 1][j], rows[k + 1][next], rows[k][next]};
      quad.edge_ids[1] = k + 2 == rows.size() ? outer_id : 0;
      quad.edge_ids[3] = k == 0 ? inner_id : 0;
      block.quads.push_back(quad);
    }
}

}  // namespace meshes

#include "fem/stress/recovery/patch_geometry.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "fem/base/common/parallel.h"
#include "fem/base/values/constants.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/charts.h"

namespace fem {

namespace {

Eigen::Vector3d in_chart(const CylinderChart& chart, const Eigen::Vector3d& x) {
  const auto c = pull_back(chart, Coordinates{x[0], x[1], x[2]});
  return {c[0], c[1], c[2]};
}

}  // namespace

PatchGeometry::PatchGeometry(const Grid& grid, const CellsOfNodes& cells, const StressSamples& samples,
                             const std::vector<CylinderChart>& charts)
    : grid_(grid), cells_(cells), samples_(samples), has_chart_(grid.n_cells(), 0) {
  std::map<int, const CylinderChart*> chart_of_volume;
  for (const auto& chart : charts) chart_of_volume[chart.volume_id] = &chart;
  std::vector<const CylinderChart*> chart(grid.n_cells(), nullptr);
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    if (const auto found = chart_of_volume.find(grid.volume_id[c]); found != chart_of_volume.end()) {
      chart[c] = found->second;
      has_chart_[c] = 1;
    }
  chart_samples_.setZero(3, samples.position.cols());
  chart_nodes_.setZero(3, grid.n_nodes);
  parallel_for(samples.cell.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s)
      if (const auto* own = chart[samples.cell[s]]; own != nullptr)
        chart_samples_.col(s) = in_chart(*own, samples.position.col(s));
  });
  // Charts agree where their cells meet: any cell's will do for a node.
  parallel_for(grid.n_nodes, 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (auto k = cells.begin[i]; k < cells.begin[i + 1]; ++k)
        if (has_chart_[cells.cell[k]]) {
          chart_nodes_.col(i) = in_chart(*chart[cells.cell[k]], Eigen::Vector3d(grid.position(i)));
          break;
        }
  });
}

bool PatchGeometry::is_round(std::int32_t corner) const {
  return std::all_of(cells_.cell.begin() + cells_.begin[corner],
                     cells_.cell.begin() + cells_.begin[corner + 1],
                     [&](auto cell) { return has_chart_[cell]; });
}

/// From the corner, in space or in (r, theta, z).
Eigen::Vector3d PatchGeometry::offset(const Eigen::Vector3d& position, std::int32_t corner,
                                      bool round) const {
  if (!round) return position - Eigen::Vector3d(grid_.position(corner));
  Eigen::Vector3d d = position - chart_nodes_.col(corner);
  d[1] = std::remainder(d[1], 2 * pi);
  return d;
}

/// Columns: the edges of the first cell at the corner, each made straight with the edge that best continues
/// it on the other side. In a round patch theta is one of them (mesh lines run round the axis), the two
/// others lie in the meridian.
Eigen::Matrix3d PatchGeometry::directions(std::int32_t corner, bool round) const {
  constexpr double nearly_coplanar = 0.05, skewed = 0.5;
  if (grid_.shape().is_tetrahedron()) return Eigen::Matrix3d::Identity();
  const auto corners = corner_nodes(grid_.shape());
  std::vector<Eigen::Vector3d> edges;  // the first three belong to the first cell
  for (auto k = cells_.begin[corner]; k < cells_.begin[corner + 1]; ++k) {
    const auto* nodes = grid_.nodes_of(cells_.cell[k]);
    for (int c = 0; c < 8; ++c)
      if (nodes[corners[c]] == corner)
        for (const int axis : {1, 2, 4}) {
          const auto other = nodes[corners[c ^ axis]];
          Eigen::Vector3d edge = offset(
              round ? Eigen::Vector3d(chart_nodes_.col(other)) : Eigen::Vector3d(grid_.position(other)),
              corner, round);
          if (round) edge[1] *= chart_nodes_(0, corner);  // lengths, to compare with the others
          edges.push_back(edge.normalized());
        }
  }
  Eigen::Matrix3d directions;
  for (int d = 0; d < 3; ++d) {
    const auto opposite = *std::min_element(edges.begin(), edges.end(), [&](const auto& a, const auto& b) {
      return a.dot(edges[d]) < b.dot(edges[d]);
    });
    directions.col(d) =
        (opposite.dot(edges[d]) < -0.5 ? Eigen::Vector3d(edges[d] - opposite) : edges[d]).normalized();
  }
  if (round) {
    int around = 0;
    directions.row(1).cwiseAbs().maxCoeff(&around);
    directions.col(around).swap(directions.col(1));
    directions.row(1).setZero();
    directions.col(1) = Eigen::Vector3d::UnitY();
    directions.colwise().normalize();
  }
  if (!(std::abs(directions.determinant()) > nearly_coplanar)) directions.setIdentity();
  // Where cells of unlike size meet, their edges do not continue each other: right angles instead.
  if (grid_.hanging.n() > 0 && std::abs(directions.determinant()) < skewed)
    for (int d = 1; d < 3; ++d)
      for (int e = 0; e < d; ++e)
        directions.col(d) =
            (directions.col(d) - directions.col(e).dot(directions.col(d)) * directions.col(e)).normalized();
  return directions;
}

std::vector<std::int32_t> PatchGeometry::samples_around(std::int32_t corner, int n_layers) const {
  std::vector<std::int32_t> chosen(cells_.cell.begin() + cells_.begin[corner],
                                   cells_.cell.begin() + cells_.begin[corner + 1]);
  for (int layer = 1; layer < n_layers; ++layer) {
    auto larger = chosen;
    for (const auto cell : chosen)
      for (const int i : corner_nodes(grid_.shape())) {
        const auto node = grid_.nodes_of(cell)[i];
        larger.insert(larger.end(), cells_.cell.begin() + cells_.begin[node],
                      cells_.cell.begin() + cells_.begin[node + 1]);
      }
    std::sort(larger.begin(), larger.end());
    larger.erase(std::unique(larger.begin(), larger.end()), larger.end());
    chosen = larger;
  }
  std::vector<std::int32_t> around;
  for (const auto cell : chosen) {
    const auto& of_cell = samples_.of_cell[cell];
    around.insert(around.end(), of_cell.begin(), of_cell.end());
  }
  return around;
}

PatchPoints PatchGeometry::points(std::int32_t corner, const std::vector<std::int32_t>& samples,
                                  const std::vector<std::int32_t>& nodes) const {
  const bool round = is_round(corner);
  const Eigen::Matrix3d to_patch = directions(corner, round).inverse();
  PatchPoints points;
  points.samples.resize(3, samples.size());
  points.targets.resize(3, nodes.size());
  points.angle_axis = round ? 1 : -1;
  const Points& positions = round ? chart_samples_ : samples_.position;
  for (std::size_t s = 0; s < samples.size(); ++s)
    points.samples.col(s) = to_patch * offset(positions.col(samples[s]), corner, round);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    points.targets.col(i) = to_patch * offset(round ? Eigen::Vector3d(chart_nodes_.col(nodes[i]))
                                                    : Eigen::Vector3d(grid_.position(nodes[i])),
                                              corner, round);
  return points;
}

void turn_about_z(double cosine, double sine, double* tensor) {
  const double c = cosine, s = sine;
  const double xx = tensor[0], yy = tensor[1], xy = tensor[3], yz = tensor[4], xz = tensor[5];
  tensor[0] = c * c * xx + s * s * yy + 2 * c * s * xy;
  tensor[1] = s * s * xx + c * c * yy - 2 * c * s * xy;
  tensor[3] = c * s * (yy - xx) + (c * c - s * s) * xy;
  tensor[4] = c * yz - s * xz;
  tensor[5] = c * xz + s * yz;
}

}  // namespace fem

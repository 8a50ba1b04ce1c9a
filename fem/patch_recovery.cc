#include <algorithm>
#include <array>
#include <vector>

#include "fem/cell_geometry.h"
#include "fem/parallel.h"
#include "fem/patch_fit.h"
#include "fem/stress_recovery.h"

namespace fem {

namespace {

/// A corner, and the nodes that take a share of their value from the fit around it.
struct Patch {
  std::int32_t corner = 0;
  std::vector<std::int32_t> nodes;
  std::vector<double> weights;
};

enum class Centre : char { none, interior, boundary };

/// Which corners carry a patch: the interior ones, and all of a cell that has no interior corner.
std::vector<Centre> choose_centres(const Grid& grid) {
  const auto corners = corner_nodes(grid.degree);
  std::vector<char> on_boundary(grid.n_nodes, 0);
  for (const auto& face : grid.boundary)
    for (const auto node : nodes_of_face(grid, face.cell, face.face)) on_boundary[node] = 1;
  std::vector<Centre> centre(grid.n_nodes, Centre::none);
  for (std::size_t c = 0; c < grid.n_cells(); ++c) {
    bool interior = false;
    for (const int i : corners) interior = interior || !on_boundary[grid.nodes_of(c)[i]];
    for (const int i : corners) {
      const auto node = grid.nodes_of(c)[i];
      if (!on_boundary[node])
        centre[node] = Centre::interior;
      else if (!interior)
        centre[node] = Centre::boundary;
    }
  }
  return centre;
}

/// The patches and their nodes; every node's weights sum to 1.
std::vector<Patch> make_patches(const Grid& grid, const CellsOfNodes& cells) {
  const auto centre = choose_centres(grid);
  const auto corners = corner_nodes(grid.degree);
  const auto table = nodes_in_cell(grid.degree);
  std::vector<Patch> patches;
  std::vector<std::int32_t> patch_of(grid.n_nodes, -1);
  for (std::size_t i = 0; i < grid.n_nodes; ++i)
    if (centre[i] != Centre::none) {
      patch_of[i] = static_cast<std::int32_t>(patches.size());
      patches.push_back({static_cast<std::int32_t>(i), {}, {}});
    }

  std::vector<std::pair<std::int32_t, double>> shares;  // corner, weight
  for (std::size_t i = 0; i < grid.n_nodes; ++i) {
    const auto* first = grid.nodes_of(cells.cell[cells.begin[i]]);
    const auto local = std::find(first, first + grid.nodes_per_cell(), static_cast<std::int32_t>(i)) - first;
    const auto hats = corner_hats(table.point[local]);
    const auto by_hats = [&](Centre kind) {
      for (int c = 0; c < 8; ++c)
        if (hats[c] > 1e-12 && centre[first[corners[c]]] == kind)
          shares.emplace_back(first[corners[c]], hats[c]);
    };
    shares.clear();
    by_hats(Centre::interior);
    if (shares.empty()) {
      for (auto k = cells.begin[i]; k < cells.begin[i + 1]; ++k)
        for (const int c : corners)
          if (const auto node = grid.nodes_of(cells.cell[k])[c]; centre[node] == Centre::interior)
            shares.emplace_back(node, 1.0);
      std::sort(shares.begin(), shares.end());
      shares.erase(std::unique(shares.begin(), shares.end()), shares.end());
    }
    if (shares.empty()) by_hats(Centre::boundary);
    double sum = 0;
    for (const auto& share : shares) sum += share.second;
    for (const auto& [corner, weight] : shares) {
      auto& patch = patches[patch_of[corner]];
      patch.nodes.push_back(static_cast<std::int32_t>(i));
      patch.weights.push_back(weight / sum);
    }
  }
  return patches;
}

/// Axes of a patch: the edges of its first cell at the corner, each made straight with the edge that best
/// continues it on the other side.
Eigen::Matrix3d patch_directions(const Grid& grid, const CellsOfNodes& cells, std::int32_t corner) {
  const auto corners = corner_nodes(grid.degree);
  const Eigen::Vector3d origin(grid.position(corner));
  std::vector<Eigen::Vector3d> edges;  // the first three belong to the first cell
  for (auto k = cells.begin[corner]; k < cells.begin[corner + 1]; ++k) {
    const auto* nodes = grid.nodes_of(cells.cell[k]);
    for (int c = 0; c < 8; ++c)
      if (nodes[corners[c]] == corner)
        for (const int axis : {1, 2, 4})
          edges.push_back((Eigen::Vector3d(grid.position(nodes[corners[c ^ axis]])) - origin).normalized());
  }
  Eigen::Matrix3d directions;
  for (int d = 0; d < 3; ++d) {
    const auto opposite = *std::min_element(edges.begin(), edges.end(), [&](const auto& a, const auto& b) {
      return a.dot(edges[d]) < b.dot(edges[d]);
    });
    directions.col(d) = opposite.dot(edges[d]) < -0.5 ? Eigen::Vector3d(edges[d] - opposite) : edges[d];
  }
  return directions;
}

Points sample_positions(const Grid& grid, const Tabulation& at) {
  Points x(3, grid.n_cells() * at.n_points);
  parallel_for(grid.n_cells(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c)
      for (int q = 0; q < at.n_points; ++q) x.col(c * at.n_points + q) = position(grid, c, at, q);
  });
  return x;
}

/// Values at the samples of a patch's cells (cell after cell) to weighted values at its nodes.
Eigen::MatrixXd patch_operator(const Grid& grid, const CellsOfNodes& cells, int per_cell,
                               const Points& positions, const Patch& patch) {
  const auto first = cells.begin[patch.corner];
  const auto n_cells = static_cast<Eigen::Index>(cells.begin[patch.corner + 1] - first);
  Points samples(3, n_cells * per_cell), targets(3, patch.nodes.size());
  for (Eigen::Index k = 0; k < n_cells; ++k)
    samples.middleCols(k * per_cell, per_cell) =
        positions.middleCols(cells.cell[first + k] * Eigen::Index(per_cell), per_cell);
  for (std::size_t i = 0; i < patch.nodes.size(); ++i)
    targets.col(i) = Eigen::Map<const Eigen::Vector3d>(grid.position(patch.nodes[i]));
  const Eigen::Map<const Eigen::VectorXd> weights(patch.weights.data(), patch.weights.size());
  return weights.asDiagonal() * fit_operator(grid.degree, n_cells >= 8,
                                             patch_directions(grid, cells, patch.corner), samples, targets);
}

}  // namespace

void recover_by_patches(const Grid& grid, const CellsOfNodes& cells, const ConstBlock& samples,
                        Eigen::Ref<RowMajor> nodal) {
  const Tabulation at = gauss_in_cell(grid.degree, grid.degree);
  const Points positions = sample_positions(grid, at);
  const auto patches = make_patches(grid, cells);
  nodal.setZero();

  // Batches bound the memory of the operators. Inside a batch the operators are made in parallel; then they
  // are applied in parallel over groups of columns, patch after patch, so that sums do not depend on the
  // number of threads.
  constexpr std::size_t batch = 512;
  constexpr Eigen::Index width = 48;
  std::vector<Eigen::MatrixXd> operators(std::min(batch, patches.size()));
  for (std::size_t first = 0; first < patches.size(); first += batch) {
    const std::size_t n = std::min(batch, patches.size() - first);
    parallel_for(n, 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p)
        operators[p] = patch_operator(grid, cells, at.n_points, positions, patches[first + p]);
    });
    parallel_for((samples.cols() + width - 1) / width, 1, [&](std::size_t begin, std::size_t end) {
      RowMajor gathered, values;
      for (std::size_t group = begin; group < end; ++group) {
        const auto column = static_cast<Eigen::Index>(group) * width;
        const auto columns = std::min(width, samples.cols() - column);
        for (std::size_t p = 0; p < n; ++p) {
          const auto& patch = patches[first + p];
          gathered.resize(operators[p].cols(), columns);
          for (auto k = cells.begin[patch.corner]; k < cells.begin[patch.corner + 1]; ++k)
            gathered.middleRows((k - cells.begin[patch.corner]) * at.n_points, at.n_points) =
                samples.block(cells.cell[k] * Eigen::Index(at.n_points), column, at.n_points, columns);
          values.noalias() = operators[p] * gathered;
          for (std::size_t i = 0; i < patch.nodes.size(); ++i)
            nodal.row(patch.nodes[i]).segment(column, columns) += values.row(i);
        }
      }
    });
  }
}

}  // namespace fem

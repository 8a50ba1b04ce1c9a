#include "tests/unit/fem/examples/tetrahedra.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "fem/mesh/grid/cell_geometry.h"

namespace fem_tests {

namespace {

/// Nodes on a lattice of half cells.
class Lattice {
public:
  Lattice(const std::array<int, 3>& n, const std::function<Point(const Point&)>& bend) : n_(n), bend_(bend) {}
  std::int32_t node(const std::array<int, 3>& at, fem::Grid& grid) {
    const auto [known, is_new] = numbers_.emplace(at, static_cast<std::int32_t>(grid.n_nodes));
    if (is_new) {
      ++grid.n_nodes;
      const Point x = bend_(Point(at[0] / (2.0 * n_[0]), at[1] / (2.0 * n_[1]), at[2] / (2.0 * n_[2])));
      grid.xyz_m.insert(grid.xyz_m.end(), x.data(), x.data() + 3);
      lattice.push_back(at);
    }
    return known->second;
  }
  std::vector<std::array<int, 3>> lattice;  // of each node

private:
  std::array<int, 3> n_;
  std::function<Point(const Point&)> bend_;
  std::map<std::array<int, 3>, std::int32_t> numbers_;
};

void add_cell(std::array<std::array<int, 3>, 4> corners, Lattice& lattice, fem::Grid& grid) {
  constexpr int edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  for (const auto& corner : corners) grid.cell_nodes.push_back(lattice.node(corner, grid));
  for (const auto& edge : edges) {
    std::array<int, 3> middle{};
    for (int d = 0; d < 3; ++d) middle[d] = (corners[edge[0]][d] + corners[edge[1]][d]) / 2;
    grid.cell_nodes.push_back(lattice.node(middle, grid));
  }
  grid.volume_id.push_back(7);
}

}  // namespace

fem::Grid tetrahedra_cube(int n, const std::function<Point(const Point&)>& bend) {
  return tetrahedra_block({n, n, n}, bend);
}

fem::Grid tetrahedra_block(const std::array<int, 3>& n, const std::function<Point(const Point&)>& bend) {
  fem::Grid grid;
  grid.kind = fem::CellKind::tetrahedra;
  Lattice lattice(n, bend);
  for (int box = 0; box < n[0] * n[1] * n[2]; ++box) {
    // From the box' low corner to its high one along the axes, in each of the six orders.
    std::array<int, 3> order = {0, 1, 2};
    do {
      std::array<std::array<int, 3>, 4> corners;
      corners[0] = {2 * (box % n[0]), 2 * (box / n[0] % n[1]), 2 * (box / n[0] / n[1])};
      for (int step = 0; step < 3; ++step) {
        corners[step + 1] = corners[step];
        corners[step + 1][order[step]] += 2;
      }
      const bool odd = (order[1] + 3 - order[0]) % 3 == 2;
      if (odd) std::swap(corners[1], corners[2]);
      add_cell(corners, lattice, grid);
    } while (std::next_permutation(order.begin(), order.end()));
  }
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int f = 0; f < 4; ++f)
      for (int side = 0; side < 6; ++side) {
        const auto nodes = fem::nodes_of_face(grid, c, f);
        const auto on_side = [&](std::int32_t i) {
          return lattice.lattice[i][side / 2] == (side % 2 == 0 ? 0 : 2 * n[side / 2]);
        };
        if (std::all_of(nodes.begin(), nodes.end(), on_side))
          grid.boundary.push_back({static_cast<std::int32_t>(c), f, side + 1});
      }
  return grid;
}

fem::Grid irregular_cube(int n) {
  auto grid = tetrahedra_cube(n, [](const Point& x) { return x; });
  std::vector<char> fixed(grid.n_nodes, 0);
  for (const auto& face : grid.boundary)
    for (const auto node : fem::nodes_of_face(grid, face.cell, face.face)) fixed[node] = 1;
  std::mt19937 random(5);
  for (std::size_t i = 0; i < grid.n_nodes; ++i)
    for (int d = 0; d < 3; ++d) {
      const double share = double(random()) / double(std::mt19937::max()) - 0.5;
      if (!fixed[i]) grid.xyz_m[3 * i + d] += 0.4 * share / n;
    }
  constexpr int edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int e = 0; e < 6; ++e)
      for (int d = 0; d < 3; ++d)
        grid.xyz_m[3 * grid.nodes_of(c)[4 + e] + d] = (grid.position(grid.nodes_of(c)[edges[e][0]])[d] +
                                                       grid.position(grid.nodes_of(c)[edges[e][1]])[d]) /
                                                      2;
  return grid;
}

std::shared_ptr<const fem::CoarseMesh> cells_of(const fem::Grid& grid) {
  fem::CoarseMesh mesh;
  mesh.kind = fem::CellKind::tetrahedra;
  mesh.points_m = {{-9, -9, -9}};
  for (std::size_t i = 0; i < grid.n_nodes; ++i)
    mesh.points_m.push_back({grid.xyz_m[3 * i], grid.xyz_m[3 * i + 1], grid.xyz_m[3 * i + 2]});
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (const int i : {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}) mesh.cells.push_back(1 + grid.nodes_of(c)[i]);
  mesh.volume_id = grid.volume_id;
  for (const auto& face : grid.boundary) {
    for (const auto node : fem::nodes_of_face(grid, face.cell, face.face)) mesh.faces.push_back(1 + node);
    mesh.face_id.push_back(face.boundary_id);
  }
  return std::make_shared<const fem::CoarseMesh>(std::move(mesh));
}

}  // namespace fem_tests

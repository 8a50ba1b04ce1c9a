#include "tests/unit/fem/examples/tetrahedra.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <sstream>

#include "fem/mesh/cell_geometry.h"

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

std::string as_msh(const fem::Grid& grid) {
  const auto tag = [](std::int32_t node) { return 5 * (100000 - node); };
  std::set<int> groups;
  for (const auto& face : grid.boundary) groups.insert(face.boundary_id);
  std::ostringstream out;
  out.precision(17);
  out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 " << groups.size() << " 1\n";
  for (const int id : groups) out << id << " 0 0 0 1 1 1 1 " << id << " 0\n";
  out << "7 0 0 0 1 1 1 1 7 0\n$EndEntities\n$Nodes\n1 " << grid.n_nodes << " 1 500000\n3 7 0 "
      << grid.n_nodes << "\n";
  for (std::size_t i = 0; i < grid.n_nodes; ++i) out << tag(static_cast<std::int32_t>(i)) << "\n";
  for (std::size_t i = 0; i < grid.n_nodes; ++i)
    out << grid.xyz_m[3 * i] << " " << grid.xyz_m[3 * i + 1] << " " << grid.xyz_m[3 * i + 2] << "\n";
  const auto n_elements = grid.n_cells() + grid.boundary.size();
  out << "$EndNodes\n$Elements\n" << groups.size() + 1 << " " << n_elements << " 1 " << n_elements << "\n";
  std::size_t next = 1;
  for (const int id : groups) {
    out << "2 " << id << " 9 "
        << std::count_if(grid.boundary.begin(), grid.boundary.end(),
                         [id](const auto& face) { return face.boundary_id == id; })
        << "\n";
    for (const auto& face : grid.boundary) {
      if (face.boundary_id != id) continue;
      out << next++;
      for (const auto node : fem::nodes_of_face(grid, face.cell, face.face)) out << " " << tag(node);
      out << "\n";
    }
  }
  out << "3 7 11 " << grid.n_cells() << "\n";
  for (std::size_t c = 0; c < grid.n_cells(); ++c) {
    out << next++;
    for (const int i : {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}) out << " " << tag(grid.nodes_of(c)[i]);
    out << "\n";
  }
  out << "$EndElements\n";
  return out.str();
}

}  // namespace fem_tests

#include "fem/refine/submodel/cut_cells.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "fem/mesh/grid/reference_cell.h"

namespace fem {
namespace {

using Corners = std::array<int, 4>;  // places among the 10 nodes of the old cell

/// The octahedron's diagonals join the middles of opposite edges; the other four middles stand around each of
/// them.
struct Diagonal {
  std::array<int, 2> ends;
  std::array<int, 4> around;
};
constexpr std::array<Diagonal, 3> diagonals = {
    {{{4, 9}, {5, 6, 7, 8}}, {{5, 7}, {4, 6, 9, 8}}, {{6, 8}, {4, 5, 9, 7}}}};

Eigen::Map<const Eigen::Vector3d> at(const Grid& grid, std::int32_t node) {
  return Eigen::Map<const Eigen::Vector3d>(grid.position(node));
}

const Diagonal& shortest(const Grid& grid, const std::int32_t* nodes) {
  return *std::min_element(diagonals.begin(), diagonals.end(), [&](const Diagonal& a, const Diagonal& b) {
    const auto length = [&](const Diagonal& d) {
      return (at(grid, nodes[d.ends[0]]) - at(grid, nodes[d.ends[1]])).squaredNorm();
    };
    return length(a) < length(b);
  });
}

double volume(const ReferencePoints& points, const Corners& c) {
  const auto point = [&](int i) { return Eigen::Map<const Eigen::Vector3d>(points[std::size_t(i)].data()); };
  return (point(c[1]) - point(c[0])).cross(point(c[2]) - point(c[0])).dot(point(c[3]) - point(c[0]));
}

/// The eight new cells, all right-handed.
std::array<Corners, 8> parts_of(const Grid& grid, const std::int32_t* nodes, const ReferencePoints& points) {
  const auto& [ends, ring] = shortest(grid, nodes);
  // Around the diagonal: neighbours in the ring of four share an edge of the octahedron.
  std::array<Corners, 8> parts = {{{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3}}};
  for (std::size_t i = 0; i < 4; ++i) parts[4 + i] = {ends[0], ends[1], ring[i], ring[(i + 1) % 4]};
  for (auto& part : parts)
    if (volume(points, part) < 0) std::swap(part[2], part[3]);
  return parts;
}

/// Half way between each two of the 10 nodes: that of a and b is number 10 a + b.
ReferencePoints middles() {
  const auto& nodes = nodes_in_cell({CellKind::tetrahedra, 2}).point;
  ReferencePoints points;
  for (const auto& a : nodes)
    for (const auto& b : nodes) points.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
  return points;
}

class TetrahedraCutter {
public:
  explicit TetrahedraCutter(const GridField& coarse) : coarse_(coarse), new_nodes_(coarse, middles()) {
    fine_.grid.kind = CellKind::tetrahedra;
  }

  GridField cut() {
    faces_.resize(coarse_.grid.n_cells());
    for (const auto& face : coarse_.grid.boundary) faces_[std::size_t(face.cell)].push_back(face);
    for (std::size_t c = 0; c < coarse_.grid.n_cells(); ++c) cut(c);
    new_nodes_.add_to(fine_);
    return std::move(fine_);
  }

private:
  void cut(std::size_t c) {
    const auto* nodes = coarse_.grid.nodes_of(c);
    for (const auto& part : parts_of(coarse_.grid, nodes, nodes_in_cell(coarse_.grid.shape()).point)) {
      for (const int i : part) fine_.grid.cell_nodes.push_back(nodes[i]);
      for (const auto& [a, b] : tetrahedron_edges)
        fine_.grid.cell_nodes.push_back(middle(nodes, part[std::size_t(a)], part[std::size_t(b)]));
      keep_boundary(c, part);
      fine_.grid.volume_id.push_back(coarse_.grid.volume_id[c]);
    }
  }

  /// A face of a new cell lies on a face of the old one if its corners do.
  void keep_boundary(std::size_t c, const Corners& part) {
    const auto cell = std::int32_t(fine_.grid.volume_id.size());
    for (const auto& old : faces_[c]) {
      const auto on_old = face_nodes(coarse_.grid.shape(), old.face);
      for (int f = 0; f < 4; ++f) {
        const auto local = face_nodes(coarse_.grid.shape(), f);
        if (std::all_of(local.begin(), local.begin() + 3, [&](int i) {
              return std::find(on_old.begin(), on_old.end(), part[std::size_t(i)]) != on_old.end();
            }))
          fine_.grid.boundary.push_back({cell, f, old.boundary_id});
      }
    }
  }

  /// The node half way between two nodes of a cell, on the cell's own polynomials: those of both cells at a
  /// common face are the same there.
  std::int32_t middle(const std::int32_t* nodes, int a, int b) {
    const auto ends = std::minmax(nodes[a], nodes[b]);
    const auto [known, is_new] = middles_.try_emplace(ends, new_nodes_.next());
    if (is_new) new_nodes_.append(nodes, std::size_t(10 * a + b));
    return known->second;
  }

  const GridField& coarse_;
  NewNodes new_nodes_;
  std::vector<std::vector<BoundaryFace>> faces_;  // of each old cell
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles_;
  GridField fine_;
};

}  // namespace

GridField cut_tetrahedra(const GridField& coarse) {
  return TetrahedraCutter(coarse).cut();
}

}  // namespace fem

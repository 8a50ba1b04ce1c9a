#include "fem/submodel/cut_cells.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "fem/common/simplex.h"

namespace fem {
namespace {

using Corners = std::array<int, 4>;  // places among the 10 nodes of the old cell

/// Corners of a new cell and of its edges, in the order of grid.h.
constexpr std::array<std::array<std::size_t, 2>, 6> ends_of_edges = {
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

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

double volume(const std::vector<std::array<double, 3>>& points, const Corners& c) {
  const auto point = [&](int i) { return Eigen::Map<const Eigen::Vector3d>(points[std::size_t(i)].data()); };
  return (point(c[1]) - point(c[0])).cross(point(c[2]) - point(c[0])).dot(point(c[3]) - point(c[0]));
}

/// The eight new cells, all right-handed.
std::array<Corners, 8> parts_of(const Grid& grid, const std::int32_t* nodes,
                                const std::vector<std::array<double, 3>>& points) {
  const auto& [ends, ring] = shortest(grid, nodes);
  // Around the diagonal: neighbours in the ring of four share an edge of the octahedron.
  std::array<Corners, 8> parts = {{{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3}}};
  for (std::size_t i = 0; i < 4; ++i) parts[4 + i] = {ends[0], ends[1], ring[i], ring[(i + 1) % 4]};
  for (auto& part : parts)
    if (volume(points, part) < 0) std::swap(part[2], part[3]);
  return parts;
}

class TetrahedraCutter {
public:
  explicit TetrahedraCutter(const GridField& coarse) : coarse_(coarse), points_(tetrahedron_nodes()) {
    fine_.grid.kind = CellKind::tetrahedra;
    fine_.grid.degree = 2;
    fine_.grid.n_nodes = coarse.grid.n_nodes;
    fine_.grid.xyz_m = coarse.grid.xyz_m;
  }

  GridField cut() {
    faces_.resize(coarse_.grid.n_cells());
    for (const auto& face : coarse_.grid.boundary) faces_[std::size_t(face.cell)].push_back(face);
    for (std::size_t c = 0; c < coarse_.grid.n_cells(); ++c) cut(c);
    fine_.field = with_rows_below(coarse_.field, values_);
    return std::move(fine_);
  }

private:
  void cut(std::size_t c) {
    const auto* nodes = coarse_.grid.nodes_of(c);
    for (const auto& part : parts_of(coarse_.grid, nodes, points_)) {
      for (const int i : part) fine_.grid.cell_nodes.push_back(nodes[i]);
      for (const auto& edge : ends_of_edges)
        fine_.grid.cell_nodes.push_back(middle(nodes, part[edge[0]], part[edge[1]]));
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
    const auto [known, is_new] = middles_.try_emplace(ends, std::int32_t(fine_.grid.n_nodes));
    if (!is_new) return known->second;
    std::array<double, 3> point{};
    for (std::size_t d = 0; d < 3; ++d)
      point[d] = (points_[std::size_t(a)][d] + points_[std::size_t(b)][d]) / 2;
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    Eigen::RowVectorXd value = Eigen::RowVectorXd::Zero(coarse_.field.cols());
    const auto shapes = quadratic_tetrahedron(point);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      x += shapes[i].value * at(coarse_.grid, nodes[i]);
      value += shapes[i].value * coarse_.field.row(nodes[i]);
    }
    fine_.grid.xyz_m.insert(fine_.grid.xyz_m.end(), x.data(), x.data() + 3);
    values_.push_back(value);
    ++fine_.grid.n_nodes;
    return known->second;
  }

  const GridField& coarse_;
  std::vector<std::array<double, 3>> points_;
  std::vector<std::vector<BoundaryFace>> faces_;  // of each old cell
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles_;
  std::vector<Eigen::RowVectorXd> values_;  // at the new nodes
  GridField fine_;
};

}  // namespace

GridField cut_tetrahedra(const GridField& coarse) {
  return TetrahedraCutter(coarse).cut();
}

}  // namespace fem

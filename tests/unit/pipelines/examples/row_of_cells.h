/// A body whose zones can be written down.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "fem/base/values/vtk_order.h"
#include "pipelines/superpose/envelope/zones.h"

namespace examples {

/// Cells of 2 x 2 x 2 in a row along z, each with its 27 nodes as 3 layers of 9; neighbours share a layer.
struct Row {
  fem::Nodes nodes;
  pipelines::NodalMaximum envelope;
  std::vector<meshes::Feature> features{{"left", meshes::Feature::Kind::surface, 1, 0, 1},
                                        {"fillet", meshes::Feature::Kind::fillet, 2, 1, 2},
                                        {"seat", meshes::Feature::Kind::seat, 3, 2, 3}};
  std::vector<meshes::Port> ports{{"seat", meshes::Port::Kind::seat, 3, 2, 3, 1, 0, 0}};

  explicit Row(int n_cells) {
    nodes.n = 9 * (2 * std::size_t(n_cells) + 1);
    for (std::size_t i = 0; i < nodes.n; ++i) {
      nodes.xyz_m.insert(nodes.xyz_m.end(), {double(i % 3), double(i / 3 % 3), double(i / 9)});
    }
    for (int c = 0; c < n_cells; ++c) {
      for (const int v : fem::vtk_hexahedron_from_lexicographic) nodes.cells.push_back(18 * c + v);
      // x = 0: corners, edges and middle, round the normal outwards.
      for (const int v : {0, 6, 8, 2, 3, 7, 5, 1, 4}) nodes.faces.push_back(18 * c + 3 * v);
      nodes.face_boundary_id.push_back(std::min(c, 2) + 1);
    }
    envelope.value_Pa.assign(nodes.n, 0);
    envelope.instant.assign(nodes.n, 4);
    envelope.stress_Pa.assign(nodes.n, {});
  }
  void layer(std::size_t l, double value) {
    std::fill_n(envelope.value_Pa.begin() + std::ptrdiff_t(9 * l), 9, value);
  }
  pipelines::NodePlaces places(const std::vector<meshes::SharpEdge>& edges = {}) const {
    return pipelines::locate_nodes(nodes, features, ports, edges);
  }
};

/// An edge along straight lines from point to point.
inline meshes::SharpEdge edge_along(const std::vector<std::array<double, 3>>& points, double distance_m) {
  meshes::SharpEdge edge;
  edge.name = "edge";
  edge.distance_m = distance_m;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) edge.pieces.push_back({points[i], points[i + 1]});
  return edge;
}

}  // namespace examples

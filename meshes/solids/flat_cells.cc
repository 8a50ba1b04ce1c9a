#include "meshes/solids/flat_cells.h"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "meshes/values/constants.h"
#include "meshes/values/vectors.h"

namespace meshes {
namespace {

using Cell = std::array<std::size_t, 4>;
using Edge = std::pair<std::size_t, std::size_t>;
using Face = std::array<std::size_t, 3>;

constexpr double least_opening_cosine =
    -0.423;                  // faces that meet at more than 115 degrees may be one surface
constexpr int n_passes = 4;  // a cell with three such faces is split more than once

Edge edge(std::size_t a, std::size_t b) {
  return {std::min(a, b), std::max(a, b)};
}
Face face(std::size_t a, std::size_t b, std::size_t c) {
  Face f{a, b, c};
  std::sort(f.begin(), f.end());
  return f;
}

/// The cells of one volume of the model, and what is needed to write them back.
class Volume {
public:
  explicit Volume(int tag) : tag_(tag) {
    std::vector<double> x, parametric;
    gmsh::model::mesh::getNodes(own_nodes_, own_places_, parametric, 3, tag);
    std::vector<std::size_t> all;
    gmsh::model::mesh::getNodes(all, x, parametric);
    for (std::size_t i = 0; i < all.size(); ++i) place_[all[i]] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
    std::vector<std::size_t> elements, nodes;
    gmsh::model::mesh::getElementsByType(gmsh_tetrahedron, elements, nodes, tag);
    for (std::size_t i = 0; i < nodes.size(); i += 4)
      cells_.push_back({nodes[i], nodes[i + 1], nodes[i + 2], nodes[i + 3]});
    read_boundary();
  }

  /// @returns how many nodes it added
  int split() {
    int n_added = 0;
    for (int pass = 0; pass < n_passes; ++pass) {
      const auto chosen = edges_to_split();
      if (chosen.empty()) break;
      for (const auto& [e, around] : chosen) split_edge(e, around);
      n_added += int(chosen.size());
    }
    return n_added;
  }

  void write_back() const {
    gmsh::model::mesh::clear({{3, tag_}});
    gmsh::model::mesh::addNodes(3, tag_, own_nodes_, own_places_);
    std::vector<std::size_t> nodes;
    for (const auto& cell : cells_) nodes.insert(nodes.end(), cell.begin(), cell.end());
    gmsh::model::mesh::addElementsByType(tag_, gmsh_tetrahedron, {}, nodes);
  }

private:
  void read_boundary() {
    gmsh::vectorpair surfaces;
    gmsh::model::getBoundary({{3, tag_}}, surfaces, true, false);
    for (const auto& surface : surfaces) {
      std::vector<std::size_t> elements, nodes;
      gmsh::model::mesh::getElementsByType(gmsh_triangle, elements, nodes, surface.second);
      for (std::size_t i = 0; i < nodes.size(); i += 3)
        boundary_.insert(face(nodes[i], nodes[i + 1], nodes[i + 2]));
    }
  }

  /// Cosine of the angle inside the cell between its two faces at the edge a-b.
  double opening_cosine(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const {
    const Vector along = minus(place_.at(b), place_.at(a));
    const auto across = [&](std::size_t corner) {
      Vector v = minus(place_.at(corner), place_.at(a));
      const double share = dot(v, along) / dot(along, along);
      for (int i = 0; i < 3; ++i) v[i] -= share * along[i];
      return v;
    };
    const Vector u = across(c), v = across(d);
    return dot(u, v) / (length(u) * length(v));
  }

  /// Edges that are split, with the cells around each; no cell is at two of them.
  std::map<Edge, std::vector<std::size_t>> edges_to_split() const {
    static constexpr int opposite[6][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2},
                                           {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};
    std::map<Edge, std::vector<std::size_t>> cells_of;
    std::vector<Edge> wanted;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (const auto& o : opposite) {
        const std::size_t a = cells_[c][o[0]], b = cells_[c][o[1]], p = cells_[c][o[2]], q = cells_[c][o[3]];
        if (boundary_.count(face(a, b, p)) == 0 || boundary_.count(face(a, b, q)) == 0) continue;
        if (opening_cosine(a, b, p, q) < least_opening_cosine) wanted.push_back(edge(p, q));
      }
    const std::set<Edge> wanted_once(wanted.begin(), wanted.end());
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j)
          if (const Edge e = edge(cells_[c][i], cells_[c][j]); wanted_once.count(e) > 0)
            cells_of[e].push_back(c);
    std::set<std::size_t> taken;
    std::map<Edge, std::vector<std::size_t>> chosen;
    for (const auto& [e, around] : cells_of) {
      if (std::any_of(around.begin(), around.end(), [&](auto c) { return taken.count(c) > 0; })) continue;
      taken.insert(around.begin(), around.end());
      chosen[e] = around;
    }
    return chosen;
  }

  static double volume(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
    return dot(cross(minus(b, a), minus(c, a)), minus(d, a)) / 6;
  }

  /// Volume over the cube of the mean edge: 0 where flat; gmsh's cells have positive volume.
  double shape(const Vector& a, const Vector& b, const Vector& c, const Vector& d) const {
    const double squares = std::pow(length(minus(b, a)), 2) + std::pow(length(minus(c, a)), 2) +
                           std::pow(length(minus(d, a)), 2) + std::pow(length(minus(c, b)), 2) +
                           std::pow(length(minus(d, b)), 2) + std::pow(length(minus(d, c)), 2);
    return volume(a, b, c, d) / std::pow(squares / 6, 1.5);
  }

  void split_edge(const Edge& e, const std::vector<std::size_t>& around) {
    Vector ring{}, middle{};
    int n_ring = 0;
    for (const auto c : around)
      for (const auto node : cells_[c])
        if (node != e.first && node != e.second) {
          for (int i = 0; i < 3; ++i) ring[i] += place_.at(node)[i];
          ++n_ring;
        }
    for (int i = 0; i < 3; ++i) {
      ring[i] /= n_ring;
      middle[i] = (place_.at(e.first)[i] + place_.at(e.second)[i]) / 2;
    }
    // The new node moves from the edge towards the middle of the cells around it, as far as the worst of them
    // profits.
    Vector best = middle;
    double best_worst = -1;
    for (int step = 0; step <= 16; ++step) {
      Vector candidate;
      for (int i = 0; i < 3; ++i) candidate[i] = middle[i] + step / 8.0 * (ring[i] - middle[i]);
      double worst = 1;
      for (const auto c : around)
        for (const auto replaced : {e.first, e.second}) {
          std::array<Vector, 4> x;
          for (int i = 0; i < 4; ++i) x[i] = cells_[c][i] == replaced ? candidate : place_.at(cells_[c][i]);
          worst = std::min(worst, shape(x[0], x[1], x[2], x[3]));
        }
      if (worst > best_worst) best_worst = worst, best = candidate;
    }
    const std::size_t node = add_node(best);
    for (const auto c : around) {
      Cell other = cells_[c];
      std::replace(cells_[c].begin(), cells_[c].end(), e.first, node);
      std::replace(other.begin(), other.end(), e.second, node);
      cells_.push_back(other);
    }
  }

  std::size_t add_node(const Vector& place) {
    const std::size_t node = place_.rbegin()->first + 1;
    own_nodes_.push_back(node);
    own_places_.insert(own_places_.end(), place.begin(), place.end());
    place_[node] = place;
    return node;
  }

  int tag_;
  std::vector<std::size_t> own_nodes_;
  std::vector<double> own_places_;
  std::map<std::size_t, Vector> place_;
  std::vector<Cell> cells_;
  std::set<Face> boundary_;
};

}  // namespace

int split_flat_cells() {
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  int n_added = 0;
  for (const auto& [dimension, tag] : volumes) {
    Volume volume(tag);
    const int n = volume.split();
    if (n > 0) volume.write_back();
    n_added += n;
  }
  return n_added;
}

}  // namespace meshes

/// Between our 27-node hexahedra and those of 20 nodes that other codes have, which lack the middles of faces
/// and cells. On the reference cell the 20-node functions are among the 27-node ones: their values at the 27
/// nodes are a matrix P, so u27 = P u20 is the same field, and f20 = P' f27 does the same work on every field
/// of the 20 nodes. Of positions the same holds where cells are straight; curved faces lose their middle.
/// Quadratic tetrahedra have the same nodes in both: P is the identity.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fem/base/values/unit_responses.h"

namespace pipelines {

/// Nodes of a 20-node hexahedron: the first of VTK_TRIQUADRATIC_HEXAHEDRON, in the order of
/// VTK_QUADRATIC_HEXAHEDRON and of CalculiX's C3D20.
inline constexpr std::size_t n_serendipity_nodes = 20;

class Serendipity {
public:
  explicit Serendipity(const fem::Nodes& nodes);

  /// Whether the node belongs to the 20.
  bool keeps(std::size_t node) const { return kept_[node]; }
  std::size_t n_kept() const noexcept { return kept_.size() - dropped_.size(); }

  /// Forces or weights, P' f27: zero where nodes are dropped.
  /// @param values  n x `width`, in place
  void condense(double* values, std::size_t width) const;

  /// Displacements or positions, P u20: fills in where nodes are dropped.
  /// @param values  n x `width`, in place
  void extend(double* values, std::size_t width) const;

private:
  /// The middle of a face (8 parents) or of a cell (20).
  struct Dropped {
    std::int32_t node = 0;
    std::size_t n_parents = 0, n_corners = 0;  ///< corners first
    std::array<std::int32_t, n_serendipity_nodes> parents{};
    double edge_weight = 0;  ///< weight of the middles of edges; the corners' is -1/4
  };
  std::vector<char> kept_;
  std::vector<Dropped> dropped_;
};

}  // namespace pipelines

/// Quadratic cells cut into eight each. Internal to fem.
#pragma once

#include <vector>

#include "fem/mesh/grid/grid.h"
#include "fem/stress/cells/cell_stress.h"

namespace fem {

/// A grid and a field of its nodes.
struct GridField {
  Grid grid;
  RowMajor field;  ///< n_nodes x columns
};

/// Positions and field are the cells' own polynomials, so that neither shape nor field changes; the old nodes
/// keep their numbers, the eight parts of a cell follow each other, boundary faces keep their groups.
/// Hexahedra are halved in each direction. Of a tetrahedron there is one part at each corner, and four stand
/// around the shortest diagonal of the octahedron between them.
/// @param coarse  of degree 2
/// @throws std::invalid_argument if it is not
GridField cut_into_eight(const GridField& coarse);

// For cut_into_eight, by kind.
GridField cut_tetrahedra(const GridField& coarse);
GridField cut_hexahedra(const GridField& coarse);

/// The nodes that a cut makes, after those of the coarse grid.
class NewNodes {
public:
  /// @param places  where they may be in a cell
  NewNodes(const GridField& coarse, const ReferencePoints& places);

  /// The number of the node that append() makes.
  std::int32_t next() const { return std::int32_t(coarse_.grid.n_nodes + values_.size()); }
  /// By the polynomials of a cell with these nodes.
  void append(const std::int32_t* nodes, std::size_t place);
  /// With the coarse ones before them.
  void add_to(GridField& fine) const;

private:
  const GridField& coarse_;
  Tabulation at_;
  std::vector<double> xyz_m_;
  std::vector<Eigen::RowVectorXd> values_;
};

}  // namespace fem

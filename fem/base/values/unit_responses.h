/// Unit responses: displacement and recovered stress of a body for each unit load. Plain arrays, no deal.II.
/// Tensor components are ordered xx, yy, zz, xy, yz, xz (VTK's order); tensile stress is positive.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fem/base/values/cell_shape.h"
#include "fem/base/values/solver_choice.h"

namespace fem {

/// A plane z = const made of cell faces through a whole circular or annular cross-section.
struct SectionPlane {
  double z_m = 0;
  double radius_m = 0;
  double axis_x_m = 0, axis_y_m = 0;
  double inner_radius_m = 0;  ///< of a bore about the z axis; 0: solid
};

/// The nodes of one cell or face, looked at in place.
struct NodeList {
  const std::int32_t* first = nullptr;
  std::size_t n = 0;
  const std::int32_t* begin() const noexcept { return first; }
  const std::int32_t* end() const noexcept { return first + n; }
  std::size_t size() const noexcept { return n; }
  std::int32_t operator[](std::size_t i) const { return first[i]; }
};

/// The nodes of the solution on the body: every support point of the displacement space once.
struct Nodes {
  std::size_t n = 0;
  std::vector<double> xyz_m;  ///< n x 3
  /// n; integral of the node's shape function, sums to the body's volume. A weight of sums over nodes (mass,
  /// balance), no piece of the body: at the corners of quadratic tetrahedra it is negative. Volumes of
  /// regions: region_volume.h.
  std::vector<double> volume_m3;
  CellKind kind = CellKind::hexahedra;
  int degree = 2;  ///< of displacement and geometry; 2 for tetrahedra
  /// Cell after cell, in the order of VTK_HEXAHEDRON, VTK_TRIQUADRATIC_HEXAHEDRON or VTK_LAGRANGE_HEXAHEDRON
  /// (degrees 1 to 3), or of VTK_QUADRATIC_TETRA. Nodes of degree 3 lie at Gauss-Lobatto points of their
  /// cell.
  std::vector<std::int32_t> cells;
  std::vector<std::int32_t> cell_volume_id;  ///< one per cell: its volume group
  /// Boundary faces, in the order of VTK_QUAD, VTK_BIQUADRATIC_QUAD or VTK_LAGRANGE_QUADRILATERAL, or of
  /// VTK_QUADRATIC_TRIANGLE; corners counter-clockwise seen from outside.
  std::vector<std::int32_t> faces;
  std::vector<std::int32_t> face_boundary_id;  ///< one per face
  /// Nodes that were moved to where a largest stress lies, with the place where they stand in their cells.
  std::map<std::size_t, std::array<double, 3>> moved_from_m;

  CellShape shape() const noexcept { return {kind, degree}; }
  std::size_t nodes_per_cell() const noexcept { return std::size_t(shape().nodes_per_cell()); }
  std::size_t nodes_per_face() const noexcept { return std::size_t(shape().nodes_per_face()); }
  std::size_t n_cells() const noexcept { return cells.size() / nodes_per_cell(); }
  std::size_t n_faces() const noexcept { return faces.size() / nodes_per_face(); }
  NodeList cell(std::size_t i) const { return {cells.data() + i * nodes_per_cell(), nodes_per_cell()}; }
  NodeList face(std::size_t i) const { return {faces.data() + i * nodes_per_face(), nodes_per_face()}; }
};

/// What one unit load does to one section plane. Resultants of the traction sigma e_z: the action of the part
/// above the plane on the part below it (tension and right-handed torque positive), moments about (0, 0,
/// z_m).
struct SectionResponse {
  std::array<double, 6> resultant{};  ///< fx, fy, fz [N], mx, my, mz [N m], integrals of the recovered stress
  std::array<double, 2> mean_rim_shear_Pa{};  ///< means over the rim of sigma_r_theta and sigma_theta_z about
                                              ///< the section's axis
  std::array<double, 3>
      translation_m{};  ///< of the section's axis point, least-squares rigid motion of the section
  std::array<double, 3> rotation_rad{};
};

/// A ring of surface nodes at one (z, r) of a concentric surface: mean torsional shear over the ring.
struct RimRing {
  double z_m = 0, radius_m = 0;
  std::int32_t boundary_id = 0;
};

/// What the cells' own stress misses, by the recovered one (Zienkiewicz and Zhu 1987), in the norm of energy:
/// |s|^2 = integral of s : C^-1 s over the body, twice the strain energy. Any sum of channels has its error
/// from these: the products of two channels' fields are kept, in units of both norms.
struct EnergyError {
  std::vector<double> norm_sqrtJ;  ///< K; |stress of the cells|
  std::vector<double> energy;      ///< K x K; products of the channels' stresses, 1 on the diagonal
  std::vector<double> error;       ///< K x K; products of recovered minus cells' stresses
  std::vector<double> of_cells;    ///< n_cells x K; the cells' parts of the diagonal of `error`
};

struct EnergyNorms {
  double solution_sqrtJ = 0, error_sqrtJ = 0;
  /// Error relative to the exact solution, whose square is the sum of both squares: they are orthogonal in
  /// this norm. 0 without stress.
  double relative() const;
};

/// Norms of the sum of all channels times their factors (K).
EnergyNorms energy_norms(const EnergyError& channels, const std::vector<double>& factors);

/// Where body and loads are mirror images of themselves: the image of each node and cell. The stress at a
/// node's image is the mirrored one, to the last bit. Empty for other bodies.
struct MirrorImages {
  std::vector<std::int32_t> node, cell;
};

/// Whose rows the nodes of a body are, where several MPI ranks share it (mesh/ranks/shared_rows.cc).
struct SharedRows {
  MPI_Comm communicator;
  std::vector<int> rank_of_cell;
  std::vector<int> rank_of_node;   ///< n; the first of those of its cells
  std::vector<std::int32_t> node;  ///< this rank's own, ascending
  std::vector<std::int32_t> row;   ///< n: place in `node`; -1: another rank has it

  /// Rows of other ranks that UnitResponses::anywhere has brought here: K x 9, displacement and stress.
  std::map<std::int32_t, std::vector<double>> brought;
  std::vector<char> is_everywhere;  ///< n
};

struct UnitResponses {
  std::vector<std::string> channels;   ///< K names, the order of all arrays
  Nodes nodes;                         ///< of the whole body, on all ranks
  std::shared_ptr<SharedRows> shared;  ///< null: this rank has the rows of all nodes
  std::vector<double> displacement_m;  ///< n x K x 3; of a shared body the rows of SharedRows::node
  std::vector<double> stress_Pa;       ///< n x K x 6, likewise, recovered at the nodes
  std::vector<std::array<double, 6>>
      resultants;  ///< K; fx, fy, fz, mx, my, mz about the origin of the load vector as applied
  std::vector<SectionPlane> planes;
  std::vector<double> plane_area_m2;
  std::vector<SectionResponse> sections;  ///< n_planes x K
  std::vector<RimRing> rings;
  std::vector<std::array<double, 2>> ring_shear_Pa;  ///< n_rings x K; means of sigma_r_theta, sigma_theta_z
  EnergyError energy_error;                          ///< empty where no cells were solved (cheap models)
  MirrorImages images;
  /// Largest support reaction over all unit loads, relative to the load vector's largest entry: must be
  /// round-off. 0 if clamps hold the body, or the iteration leaves it free.
  double support_reaction = 0;
  /// Largest |K u - f| / |f| over all unit loads.
  double residual = 0;
  std::size_t n_dofs = 0;
  double factor_gigabytes = 0;  ///< 0: solved iteratively
  SolverReport solver;

  bool has(std::size_t node) const noexcept { return !shared || shared->row[node] >= 0; }
  std::size_t n_rows() const noexcept { return shared ? shared->node.size() : nodes.n; }
  std::size_t node_of_row(std::size_t row) const noexcept {
    return shared ? std::size_t(shared->node[row]) : row;
  }
  /// Row of a node that this rank has.
  std::size_t row_of(std::size_t node) const noexcept {
    return shared ? std::size_t(shared->row[node]) : node;
  }

  /// Rows of one node that this rank has, for every unit load: K x 6 [Pa], and K x 3 [m].
  const double* unit_stress_Pa(std::size_t node) const noexcept {
    return stress_Pa.data() + row_of(node) * channels.size() * 6;
  }
  const double* unit_displacement_m(std::size_t node) const noexcept {
    return displacement_m.data() + row_of(node) * channels.size() * 3;
  }

  /// The same of any node, on all ranks. Called on all ranks for the same nodes in the same order, on one
  /// thread.
  const double* stress_anywhere_Pa(std::size_t node) const {
    if (!shared) return unit_stress_Pa(node);
    return brought(node) + 3 * channels.size();
  }
  const double* displacement_anywhere_m(std::size_t node) const {
    return shared ? brought(node) : unit_displacement_m(node);
  }
  /// Brings rows of many nodes at once. Called as these.
  void bring(const std::vector<std::int32_t>& wanted) const;

  /// Sums over nodes, each taken by the rank that has it. Called on all ranks.
  void sum_over_ranks(double* values, std::size_t n) const;
  /// Values per node, zeros where another rank has the node: all of them. Called on all ranks.
  void complete(std::vector<double>& values) const;
  void complete(std::vector<float>& values) const;
  void complete(std::vector<std::int32_t>& values) const;

  // In the .cc file: else every file that copies one compiles the copies of all members anew.
  UnitResponses();
  UnitResponses(const UnitResponses&);
  UnitResponses(UnitResponses&&) noexcept;
  UnitResponses& operator=(const UnitResponses&);
  UnitResponses& operator=(UnitResponses&&) noexcept;
  ~UnitResponses();

private:
  const double* brought(std::size_t node) const;
};

}  // namespace fem

/// Bodies that are their own mirror image, solved on one half. Loads fall into an even part, whose
/// displacement is mirrored too, and an odd one, mirrored with the opposite sign. The plane between the
/// halves holds the half: even displacements do not cross it, odd ones do not move along it. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "fem/equations/operators/subdomain.h"
#include "fem/mesh/grid/mirror_plane.h"
#include "fem/solve/solvers/direct_solve.h"

namespace fem {

enum class Parity { even, odd };

/// The half above the plane, as a mesh of its own.
class MirroredHalf {
public:
  MirroredHalf(const Grid& whole, MirrorPlane plane);

  const MirrorPlane& plane() const noexcept { return plane_; }
  const Grid& grid() const noexcept { return half_.grid; }
  const CellsOfNodes& cells() const noexcept { return cells_; }
  const std::vector<std::vector<std::int32_t>>& colours() const noexcept { return colours_; }

  /// The half's share of one part of the forces.
  /// @param force  unknowns of the whole x loads
  /// @return unknowns of the half x loads
  Eigen::MatrixXd part(const Eigen::MatrixXd& force, Parity parity) const;

  /// Takes the odd part of forces on the whole away.
  void make_even(Eigen::MatrixXd& force) const;

  /// Adds displacements of the half and their images to those of the whole.
  /// @param columns  of `whole`, one for each column of `half`
  void add_to_whole(const Eigen::MatrixXd& half, Parity parity, const std::vector<Eigen::Index>& columns,
                    Eigen::MatrixXd& whole) const;

  /// Unknowns of the half that the plane holds, ascending.
  std::vector<std::int64_t> held_by_plane(Parity parity) const;

  /// Three further unknowns that take its rigid motions from the half, ascending.
  std::vector<std::int64_t> supports(Parity parity) const;

  /// The mirrored rows of nodes below the plane from those above it.
  /// @param sign  of each column's image
  template <typename Rows>
  void mirror_rows(const std::vector<double>& sign, Rows&& rows) const {
    for (std::size_t i = 0; i < half_.node.size(); ++i) {
      const auto node = half_.node[i], image = plane_.node[std::size_t(node)];
      if (image == node) continue;
      for (Eigen::Index k = 0; k < rows.cols(); ++k)
        rows(image, k) = sign[std::size_t(k) % sign.size()] * rows(node, k);
    }
  }

  /// Signs of symmetric tensors (xx, yy, zz, xy, yz, xz) of an even displacement.
  std::vector<double> signs_of_tensors() const;

  /// Nodes of the half, in the numbers of the whole.
  const std::vector<std::int32_t>& nodes() const noexcept { return half_.node; }

private:
  MirrorPlane plane_;
  Subdomain half_;
  CellsOfNodes cells_;
  std::vector<std::vector<std::int32_t>> colours_;
};

/// As solve_directly, one factorisation for each parity that the loads have a part of.
/// @param options  its plan, if any, of half.grid(); the kept factor leaves out what has a parity that no
/// load has
Solution solve_by_halves(const MirroredHalf& half, const PerCell<Lame>& elastic, const BalancedLoads& loads,
                         const StepReport& progress, DirectSolveOptions options = {});

}  // namespace fem

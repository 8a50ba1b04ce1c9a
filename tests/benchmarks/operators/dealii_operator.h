/// The same operator written with deal.II's MatrixFree, with one lane as the package is built, and with as
/// many as the machine has: what ours is compared with.
#pragma once

#include <memory>
#include <vector>

#include "fem/mesh/grid.h"
#include "fem/values/body.h"
#include "tests/benchmarks/operators/matrix_free_product.h"

namespace measure {

/// While it lives, deal.II works on one thread, and so do the loops of fem.
class OneThread {
public:
  OneThread();
  ~OneThread();
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

private:
  unsigned n_before_;
};

class DealiiOperator {
public:
  /// Reads the mesh of the body anew: hexahedra, degree 2.
  /// @param distorted  moves the inner vertices by up to a tenth of their shortest edge
  DealiiOperator(const fem::Body& body, bool distorted);
  ~DealiiOperator();

  /// Gives the nodes of the same body their places here: those of the distorted cells.
  void place_nodes(fem::Grid& grid) const;
  /// Number here of unknown d of node i, at 3 i + d.
  std::vector<std::size_t> unknowns_of(const fem::Grid& grid) const;

  /// As Debian builds deal.II. The operator outlives it, as it does the others.
  std::unique_ptr<MatrixFreeProduct> one_lane() const;
  /// With four lanes (AVX2) and eight (AVX-512): those that this machine has.
  /// @throws std::runtime_error if a shared object of the build cannot be loaded
  std::vector<std::unique_ptr<MatrixFreeProduct>> wide() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace measure

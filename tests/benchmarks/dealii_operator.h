/// The same operator written with deal.II's MatrixFree as the package is built: what ours is compared with.
#pragma once

#include <memory>

#include "fem/body.h"

namespace measure {

class DealiiOperator {
public:
  /// Reads the mesh of the body anew: hexahedra, degree 2.
  explicit DealiiOperator(const fem::Body& body);
  ~DealiiOperator();
  std::size_t n_dofs() const;
  int n_lanes() const;  ///< cells that it works on at once
  void apply();         ///< y = K x for one load case

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace measure

/// The same operator written with deal.II's MatrixFree as the package is built: what ours is compared with.
#pragma once

#include <memory>

#include "fem/values/body.h"

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
  std::size_t n_dofs() const;
  int n_lanes() const;  ///< cells that it works on at once
  void apply();         ///< y = K x for one load case

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace measure

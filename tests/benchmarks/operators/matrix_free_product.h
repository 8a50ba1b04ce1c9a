/// y = K x by deal.II's MatrixFree with one width of SIMD lanes, as its users see it. Without deal.II's
/// headers.
#pragma once

#include <cstddef>

namespace measure {

class MatrixFreeProduct {
public:
  MatrixFreeProduct() = default;
  MatrixFreeProduct(const MatrixFreeProduct&) = delete;
  MatrixFreeProduct& operator=(const MatrixFreeProduct&) = delete;
  virtual ~MatrixFreeProduct() = default;
  virtual int n_lanes() const = 0;  ///< cells that it works on at once
  virtual std::size_t n_dofs() const = 0;
  virtual double* x() = 0;  ///< n_dofs, in the order of the DoFHandler
  virtual const double* y() const = 0;
  virtual void apply() = 0;  ///< y = K x for one load case
};

}  // namespace measure

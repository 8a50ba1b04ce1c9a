/// The inner loops of the iterative solver on blocks of load cases: K x by sum factorisation and what a
/// smoother and conjugate gradients do to vectors. Internal to fem; plain arrays, as elastic_kernel.cc asks.
///
/// A block vector holds n_lanes load cases, cut into groups of one hardware register each. A group of width w
/// that begins at lane l lies at 3 n_nodes l; in it the three components of a node follow each other, w
/// numbers each. "Rows" are these components: 3 n_nodes of them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fem::kernel {

struct LaneGroup {
  std::size_t first_lane = 0;
  int width = 0;
};

struct LaneGroups {
  const LaneGroup* group = nullptr;
  int n = 0;
};

/// Cells begin .. end-1 of a mesh of Q_(n-1) hexahedra with n^3 Gauss points.
template <typename T>
struct CellRange {
  int n = 0;                 ///< nodes in each direction, 2 to 4
  const T* value = nullptr;  ///< [point][node] of the one-dimensional shape functions at the Gauss points
  const T* derivative = nullptr;       ///< [point][point] of the polynomials through the Gauss points, there
  const T* metric = nullptr;           ///< per cell and point [axis r][direction d]: sqrt(JxW) d xi_r / d x_d
  const T* elastic_Pa = nullptr;       ///< per cell: Lame's lambda and mu
  const std::int32_t* node = nullptr;  ///< n^3 per cell: where to read
  const std::int32_t* target = nullptr;  ///< n^3 per cell: where to add; see Target
  std::size_t begin = 0, end = 0;
  std::size_t n_nodes = 0, n_copies = 0;  ///< of x and y; of `copies`
};

/// Bit 0: the first to write there; bit 1: into the copies; the rest is the place.
inline constexpr int first_bit = 1, copy_bit = 2, place_shift = 2;

/// Rows of a sparse matrix between nodes: the same factor for the three components.
struct NodeRows {
  const std::int64_t* begin = nullptr;
  const std::int32_t* column = nullptr;
  const float* weight = nullptr;
};

/// Rows of a sparse matrix of small dense blocks, 3 x 3, 3 x 6 or 6 x 3, each row after row.
struct BlockRows {
  int height = 3, width = 3;  ///< of a block
  const std::int64_t* begin = nullptr;
  const std::int32_t* column = nullptr;
  const float* block = nullptr;
};

struct ChebyshevStep {
  float old_direction = 0, new_direction = 0;
  bool from_zero = false;  ///< x and K x are zero and not read
};

/// One instruction set. Ranges are of nodes; sums over the range go to one number per lane.
struct Kernels {
  int widths_double[2], widths_float[2];  ///< registers, large to small; 0: none

  void (*apply_double)(const CellRange<double>&, LaneGroups, const double* x, double* y, double* copies);
  void (*apply_float)(const CellRange<float>&, LaneGroups, const float* x, float* y, float* copies);

  /// d = old d + new B (b - kx);  x += d;  B: inverse diagonal blocks, 9 per node.
  void (*chebyshev)(LaneGroups, std::size_t n_nodes, std::size_t begin, std::size_t end, ChebyshevStep,
                    const float* blocks, const float* b, const float* kx, float* d, float* x);
  /// kx = b - kx
  void (*residual)(LaneGroups, std::size_t n_nodes, std::size_t begin, std::size_t end, const float* b,
                   float* kx);
  /// y = (keep ? y : 0) + rows x
  void (*combine)(LaneGroups, std::size_t n_rows, std::size_t n_columns, std::size_t begin, std::size_t end,
                  const NodeRows&, bool keep, const float* x, float* y);
  /// The same with blocks; n_rows and n_columns count blocks, of `height` and `width` rows of x and y.
  void (*combine_blocks)(LaneGroups, std::size_t n_rows, std::size_t n_columns, std::size_t begin,
                         std::size_t end, const BlockRows&, bool keep, const float* x, float* y);

  /// sum = a . b
  void (*dot)(LaneGroups, std::size_t n_nodes, std::size_t begin, std::size_t end, const double* a,
              const double* b, double* sum);
  /// x += step p;  r -= step q;  sum = r . r
  void (*advance)(LaneGroups, std::size_t n_nodes, std::size_t begin, std::size_t end, const double* step,
                  const double* p, const double* q, double* x, double* r, double* sum);
  /// rz = r . z;  qz = q . z
  void (*dots_with_float)(LaneGroups doubles, LaneGroups floats, std::size_t n_nodes, std::size_t begin,
                          std::size_t end, const double* r, const double* q, const float* z, double* rz,
                          double* qz);
  /// p = z + factor p
  void (*direction)(LaneGroups doubles, LaneGroups floats, std::size_t n_nodes, std::size_t begin,
                    std::size_t end, const double* factor, const float* z, double* p);
  /// z = scale r
  void (*to_float)(LaneGroups doubles, LaneGroups floats, std::size_t n_nodes, std::size_t begin,
                   std::size_t end, const double* scale, const double* r, float* z);
};

namespace generic {
extern const Kernels kernels;
}
namespace avx2 {
extern const Kernels kernels;
}
namespace avx512 {
extern const Kernels kernels;
}

/// The fastest variant that this machine can run.
const Kernels& kernels_for_this_machine();

}  // namespace fem::kernel

/// Compiled once per instruction set, with KERNEL_VARIANT naming the variant (fem/CMakeLists.txt). No other
/// header with inline code may be included here: the linker would keep one copy of it, for one instruction
/// set, for all callers.
#include "fem/common/elastic_registers.h"

namespace fem::kernel::KERNEL_VARIANT {
namespace {

/// n values `stride` apart, replaced by m v.
template <int n, int stride, typename V, typename T>
inline void interpolate(V* v, const T* m) {
  if constexpr (n == 3) {  // the middle Gauss point is the middle node
    const V shared = m[1] * v[stride];
    const V low = v[0], high = v[2 * stride];
    v[0] = m[0] * low + (m[2] * high + shared);
    v[2 * stride] = m[2] * low + (m[0] * high + shared);
  } else {
    V in[n];
#pragma GCC unroll 4
    for (int i = 0; i < n; ++i) in[i] = v[i * stride];
#pragma GCC unroll 4
    for (int o = 0; o < n; ++o) {
      V sum = m[o * n] * in[0];
#pragma GCC unroll 4
      for (int i = 1; i < n; ++i) sum += m[o * n + i] * in[i];
      v[o * stride] = sum;
    }
  }
}

/// ... by m' v.
template <int n, int stride, typename V, typename T>
inline void interpolate_back(V* v, const T* m) {
  if constexpr (n == 3) {
    const V low = v[0], high = v[2 * stride];
    v[0] = m[0] * low + m[2] * high;
    v[stride] += m[1] * (low + high);
    v[2 * stride] = m[2] * low + m[0] * high;
  } else {
    V in[n];
#pragma GCC unroll 4
    for (int i = 0; i < n; ++i) in[i] = v[i * stride];
#pragma GCC unroll 4
    for (int o = 0; o < n; ++o) {
      V sum = m[o] * in[0];
#pragma GCC unroll 4
      for (int i = 1; i < n; ++i) sum += m[i * n + o] * in[i];
      v[o * stride] = sum;
    }
  }
}

/// One component of a cell: nodal values to values at the Gauss points.
template <int n, typename V, typename T>
inline void to_points(V* u, const T* m) {
  for (int k = 0; k < n; ++k) {
    V* plane = u + k * n * n;
#pragma GCC unroll 4
    for (int j = 0; j < n; ++j) interpolate<n, 1>(plane + j * n, m);
#pragma GCC unroll 4
    for (int i = 0; i < n; ++i) interpolate<n, n>(plane + i, m);
  }
  for (int i = 0; i < n * n; ++i) interpolate<n, n * n>(u + i, m);
}

template <int n, typename V, typename T>
inline void from_points(V* u, const T* m) {
  for (int i = 0; i < n * n; ++i) interpolate_back<n, n * n>(u + i, m);
  for (int k = 0; k < n; ++k) {
    V* plane = u + k * n * n;
#pragma GCC unroll 4
    for (int i = 0; i < n; ++i) interpolate_back<n, n>(plane + i, m);
#pragma GCC unroll 4
    for (int j = 0; j < n; ++j) interpolate_back<n, 1>(plane + j * n, m);
  }
}

/// Fluxes (stress contracted with the metric) of the Gauss points (., j, k).
template <int n, typename V, typename T>
inline void stress_of_row(const V (*u)[n * n * n], V (*flux)[3][n * n * n], const T* derivative,
                          const T* metric, T lambda, T mu, int j, int k) {
#pragma GCC unroll 4
  for (int i = 0; i < n; ++i) {
    const int q = (k * n + j) * n + i;
    const T* a = metric + 9 * q;
    V h[3][3];
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      V g0 = {}, g1 = {}, g2 = {};
#pragma GCC unroll 4
      for (int l = 0; l < n; ++l) {
        if (n != 3 || l != 1 || i != 1) g0 += derivative[i * n + l] * u[c][(k * n + j) * n + l];
        g1 += derivative[j * n + l] * u[c][(k * n + l) * n + i];
        g2 += derivative[k * n + l] * u[c][(l * n + j) * n + i];
      }
#pragma GCC unroll 3
      for (int d = 0; d < 3; ++d) h[c][d] = a[d] * g0 + a[3 + d] * g1 + a[6 + d] * g2;
    }
    const V volume = lambda * (h[0][0] + h[1][1] + h[2][2]);
    const T twice = 2 * mu;
    const V xx = twice * h[0][0] + volume, yy = twice * h[1][1] + volume, zz = twice * h[2][2] + volume;
    const V xy = mu * (h[0][1] + h[1][0]), yz = mu * (h[1][2] + h[2][1]), xz = mu * (h[0][2] + h[2][0]);
#pragma GCC unroll 3
    for (int r = 0; r < 3; ++r) {
      const T x = a[3 * r], y = a[3 * r + 1], z = a[3 * r + 2];
      flux[0][r][q] = x * xx + y * xy + z * xz;
      flux[1][r][q] = x * xy + y * yy + z * yz;
      flux[2][r][q] = x * xz + y * yz + z * zz;
    }
  }
}

/// The transpose of taking derivatives.
template <int n, typename V, typename T>
inline void divergence(const V (*flux)[n * n * n], V* u, const T* derivative) {
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
#pragma GCC unroll 4
      for (int i = 0; i < n; ++i) {
        V sum = {};
#pragma GCC unroll 4
        for (int l = 0; l < n; ++l) {
          if (n != 3 || l != 1 || i != 1) sum += derivative[l * n + i] * flux[0][(k * n + j) * n + l];
          sum += derivative[l * n + j] * flux[1][(k * n + l) * n + i];
          sum += derivative[l * n + k] * flux[2][(l * n + j) * n + i];
        }
        u[(k * n + j) * n + i] = sum;
      }
}

template <typename T, int w, int n>
void apply_cell(const CellRange<T>& cells, std::size_t cell, std::size_t first_lane, const T* x, T* y,
                T* copies) {
  using V = typename Register<T, w>::Type;
  constexpr int n_local = n * n * n;
  V u[3][n_local], flux[3][3][n_local];
  const std::int32_t* node = cells.node + cell * n_local;
  const T* from = x + 3 * cells.n_nodes * first_lane;
  for (int i = 0; i < n_local; ++i)
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) u[c][i] = load<V>(from + (3 * std::size_t(node[i]) + c) * w);
  for (int c = 0; c < 3; ++c) to_points<n>(u[c], cells.value);
  const T* metric = cells.metric + cell * n_local * 9;
  const T lambda = cells.elastic_Pa[2 * cell], mu = cells.elastic_Pa[2 * cell + 1];
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j) stress_of_row<n>(u, flux, cells.derivative, metric, lambda, mu, j, k);
  for (int c = 0; c < 3; ++c) {
    divergence<n>(flux[c], u[c], cells.derivative);
    from_points<n>(u[c], cells.value);
  }
  const std::int32_t* target = cells.target + cell * n_local;
  T* into[2] = {y + 3 * cells.n_nodes * first_lane, copies + 3 * cells.n_copies * first_lane};
  for (int i = 0; i < n_local; ++i) {
    T* to = into[(target[i] & copy_bit) / copy_bit] + 3 * w * std::size_t(target[i] >> place_shift);
    if (target[i] & first_bit) {
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) store(to + c * w, u[c][i]);
    } else {
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) store(to + c * w, load<V>(to + c * w) + u[c][i]);
    }
  }
}

template <typename T, int n>
void apply_degree(const CellRange<T>& cells, LaneGroups groups, const T* x, T* y, T* copies) {
  for (std::size_t cell = cells.begin; cell < cells.end; ++cell)
    for (int g = 0; g < groups.n; ++g) {
      const auto& group = groups.group[g];
      if (small == 0 || group.width * sizeof(T) == large)
        apply_cell<T, large / sizeof(T), n>(cells, cell, group.first_lane, x, y, copies);
      else if constexpr (small != 0)
        apply_cell<T, small / sizeof(T), n>(cells, cell, group.first_lane, x, y, copies);
    }
}

template <typename T>
void apply(const CellRange<T>& cells, LaneGroups groups, const T* x, T* y, T* copies) {
  if (cells.n == 2) apply_degree<T, 2>(cells, groups, x, y, copies);
  if (cells.n == 3) apply_degree<T, 3>(cells, groups, x, y, copies);
  if (cells.n == 4) apply_degree<T, 4>(cells, groups, x, y, copies);
}

}  // namespace

void apply_double(const CellRange<double>& cells, LaneGroups groups, const double* x, double* y,
                  double* copies) {
  apply(cells, groups, x, y, copies);
}

void apply_float(const CellRange<float>& cells, LaneGroups groups, const float* x, float* y, float* copies) {
  apply(cells, groups, x, y, copies);
}

}  // namespace fem::kernel::KERNEL_VARIANT

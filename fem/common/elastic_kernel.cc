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

/// Metric and Lame's constants of the cell whose load cases fill a register.
template <typename T>
struct OneCell {
  using Factor = T;
  const T *metric, *elastic_Pa;
  Factor metric_at(int entry) const { return metric[entry]; }
  Factor lambda() const { return elastic_Pa[0]; }
  Factor mu() const { return elastic_Pa[1]; }
};

/// Of two cells: load cases of the first fill the lower half of a register, those of the next one the upper
/// half.
template <typename T, typename V>
struct TwoCells {
  using Factor = V;
  const T *metric, *next_metric, *elastic_Pa;
  static V both(T low, T high) {
    constexpr int width = sizeof(V) / sizeof(T);
    decltype(V{} < V{}) is_upper{};
#pragma GCC unroll 16
    for (int l = width / 2; l < width; ++l) is_upper[l] = -1;
    return is_upper ? high - V{} : low - V{};
  }
  Factor metric_at(int entry) const {
    return both(metric[entry], next_metric[entry]);
  }
  Factor lambda() const {
    return both(elastic_Pa[0], elastic_Pa[2]);
  }
  Factor mu() const {
    return both(elastic_Pa[1], elastic_Pa[3]);
  }
};

/// Fluxes (stress contracted with the metric) of the Gauss points (., j, k).
template <int n, typename V, typename T, typename Cells>
inline void stress_of_row(const V (*u)[n * n * n], V (*flux)[3][n * n * n], const T* derivative,
                          const Cells& cells, typename Cells::Factor lambda, typename Cells::Factor mu, int j,
                          int k) {
  using Factor = typename Cells::Factor;
#pragma GCC unroll 4
  for (int i = 0; i < n; ++i) {
    const int q = (k * n + j) * n + i;
    Factor a[9];
#pragma GCC unroll 9
    for (int e = 0; e < 9; ++e) a[e] = cells.metric_at(9 * q + e);
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
    const Factor twice = 2 * mu;
    const V xx = twice * h[0][0] + volume, yy = twice * h[1][1] + volume, zz = twice * h[2][2] + volume;
    const V xy = mu * (h[0][1] + h[1][0]), yz = mu * (h[1][2] + h[2][1]), xz = mu * (h[0][2] + h[2][0]);
#pragma GCC unroll 3
    for (int r = 0; r < 3; ++r) {
      const Factor x = a[3 * r], y = a[3 * r + 1], z = a[3 * r + 2];
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

/// Nodal displacements to nodal forces of the load cases in a register, of one or two cells.
template <int n, typename V, typename T, typename Cells>
inline void forces_of(V (*u)[n * n * n], const CellRange<T>& range, const Cells& cells) {
  V flux[3][3][n * n * n];
  for (int c = 0; c < 3; ++c) to_points<n>(u[c], range.value);
  const auto lambda = cells.lambda(), mu = cells.mu();
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j) stress_of_row<n>(u, flux, range.derivative, cells, lambda, mu, j, k);
  for (int c = 0; c < 3; ++c) {
    divergence<n>(flux[c], u[c], range.derivative);
    from_points<n>(u[c], range.value);
  }
}

/// Where forces are added: y and the copies, at the first lane of a group.
template <typename T>
struct Sums {
  T* into[2];
  Sums(const CellRange<T>& range, std::size_t first_lane, T* y, T* copies)
      : into{y + 3 * range.n_nodes * first_lane, copies + 3 * range.n_copies * first_lane} {}
};

/// w load cases of one node.
template <int w, typename V, typename T>
inline void add(const Sums<T>& sums, std::int32_t target, const V& x, const V& y, const V& z) {
  T* to = sums.into[(target & copy_bit) / copy_bit] + 3 * w * std::size_t(target >> place_shift);
  if (target & first_bit) {
    store(to, x);
    store(to + w, y);
    store(to + 2 * w, z);
  } else {
    store(to, load<V>(to) + x);
    store(to + w, load<V>(to + w) + y);
    store(to + 2 * w, load<V>(to + 2 * w) + z);
  }
}

template <typename T, int w, int n>
void apply_cell(const CellRange<T>& cells, std::size_t cell, std::size_t first_lane, const T* x, T* y,
                T* copies) {
  using V = typename Register<T, w>::Type;
  constexpr int n_local = n * n * n;
  V u[3][n_local];
  const std::int32_t* node = cells.node + cell * n_local;
  const T* from = x + 3 * cells.n_nodes * first_lane;
  for (int i = 0; i < n_local; ++i)
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) u[c][i] = load<V>(from + (3 * std::size_t(node[i]) + c) * w);
  forces_of<n>(u, cells, OneCell<T>{cells.metric + cell * n_local * 9, cells.elastic_Pa + 2 * cell});
  const std::int32_t* target = cells.target + cell * n_local;
  const Sums<T> sums(cells, first_lane, y, copies);
  for (int i = 0; i < n_local; ++i) add<w>(sums, target[i], u[0][i], u[1][i], u[2][i]);
}

/// A cell and the next one, with w load cases each in one register of 2 w.
template <typename T, int w, int n>
void apply_two_cells(const CellRange<T>& cells, std::size_t cell, std::size_t first_lane, const T* x, T* y,
                     T* copies) {
  using V = typename Register<T, 2 * w>::Type;
  using Half = typename Register<T, w>::Type;
  constexpr int n_local = n * n * n;
  V u[3][n_local];
  const std::int32_t* node = cells.node + cell * n_local;
  const T* from = x + 3 * cells.n_nodes * first_lane;
  for (int i = 0; i < n_local; ++i)
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      T* to = reinterpret_cast<T*>(&u[c][i]);
      store(to, load<Half>(from + (3 * std::size_t(node[i]) + c) * w));
      store(to + w, load<Half>(from + (3 * std::size_t(node[n_local + i]) + c) * w));
    }
  const T* metric = cells.metric + cell * n_local * 9;
  forces_of<n>(u, cells, TwoCells<T, V>{metric, metric + n_local * 9, cells.elastic_Pa + 2 * cell});
  const std::int32_t* target = cells.target + cell * n_local;
  const Sums<T> sums(cells, first_lane, y, copies);
  for (int half = 0; half < 2; ++half)  // one after the other: they may share nodes
    for (int i = 0; i < n_local; ++i) {
      Half force[3];
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) force[c] = load<Half>(reinterpret_cast<const T*>(&u[c][i]) + half * w);
      add<w>(sums, target[half * n_local + i], force[0], force[1], force[2]);
    }
}

/// Groups of half a register take two cells at once.
template <typename T, int n>
void apply_degree(const CellRange<T>& cells, LaneGroups groups, const T* x, T* y, T* copies) {
  for (std::size_t cell = cells.begin; cell < cells.end; cell += 2) {
    const bool two = cell + 1 < cells.end;
    for (int g = 0; g < groups.n; ++g) {
      const auto& group = groups.group[g];
      if (small == 0 || group.width * sizeof(T) == large) {
        apply_cell<T, large / sizeof(T), n>(cells, cell, group.first_lane, x, y, copies);
        if (two) apply_cell<T, large / sizeof(T), n>(cells, cell + 1, group.first_lane, x, y, copies);
      } else if constexpr (small != 0) {
        if (two)
          apply_two_cells<T, small / sizeof(T), n>(cells, cell, group.first_lane, x, y, copies);
        else
          apply_cell<T, small / sizeof(T), n>(cells, cell, group.first_lane, x, y, copies);
      }
    }
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

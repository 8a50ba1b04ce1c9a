/// Compiled once per instruction set, with KERNEL_VARIANT naming the variant (fem/CMakeLists.txt). No other
/// header with inline code may be included here: the linker would keep one copy of it, for one instruction
/// set, for all callers.
#include "fem/elastic_kernel.h"

namespace fem::kernel::KERNEL_VARIANT {
namespace {

#if defined(__AVX512F__)
constexpr int large = 64, small = 32;
#elif defined(__AVX__)
constexpr int large = 32, small = 16;
#else
constexpr int large = 16, small = 0;
#endif

template <typename T, int w>
struct Register {
  typedef T Type __attribute__((vector_size(w * sizeof(T))));
};

template <typename V, typename T>
inline V load(const T* from) {
  V v;
  __builtin_memcpy(&v, from, sizeof(V));
  return v;
}

template <typename V, typename T>
inline void store(T* to, const V& v) {
  __builtin_memcpy(to, &v, sizeof(V));
}

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
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      stress_of_row<n>(u, flux, cells.derivative, metric, cells.lambda_Pa, cells.mu_Pa, j, k);
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

/// Calls the body with each group and its width as a constant.
template <typename T, typename Body>
inline void for_groups(LaneGroups groups, const Body& body) {
  for (int g = 0; g < groups.n; ++g) {
    const auto& group = groups.group[g];
    if (small == 0 || group.width * sizeof(T) == large)
      body(group, Register<T, large / sizeof(T)>());
    else if constexpr (small != 0)
      body(group, Register<T, small / sizeof(T)>());
  }
}

template <typename T, int w>
constexpr int width_of(Register<T, w>) {
  return w;
}

void chebyshev(LaneGroups groups, std::size_t n_nodes, std::size_t begin, std::size_t end, ChebyshevStep step,
               const float* blocks, const float* b, const float* kx, float* d, float* x) {
  for_groups<float>(groups, [&](const LaneGroup& group, auto type) {
    using V = typename decltype(type)::Type;
    constexpr int w = width_of(decltype(type)());
    const std::size_t start = 3 * n_nodes * group.first_lane;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t at = start + 3 * w * i;
      const float* block = blocks + 9 * i;
      V r[3];
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) {
        r[c] = load<V>(b + at + c * w);
        if (!step.from_zero) r[c] -= load<V>(kx + at + c * w);
      }
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) {
        const V z = block[3 * c] * r[0] + block[3 * c + 1] * r[1] + block[3 * c + 2] * r[2];
        V direction = step.new_direction * z;
        if (step.old_direction != 0) direction += step.old_direction * load<V>(d + at + c * w);
        store(d + at + c * w, direction);
        store(x + at + c * w, step.from_zero ? direction : load<V>(x + at + c * w) + direction);
      }
    }
  });
}

void residual(LaneGroups groups, std::size_t n_nodes, std::size_t begin, std::size_t end, const float* b,
              float* kx) {
  for_groups<float>(groups, [&](const LaneGroup& group, auto type) {
    using V = typename decltype(type)::Type;
    constexpr int w = width_of(decltype(type)());
    const std::size_t start = 3 * n_nodes * group.first_lane;
    for (std::size_t at = start + 3 * w * begin; at < start + 3 * w * end; at += w)
      store(kx + at, load<V>(b + at) - load<V>(kx + at));
  });
}

void combine(LaneGroups groups, std::size_t n_rows, std::size_t n_columns, std::size_t begin, std::size_t end,
             const NodeRows& rows, bool keep, const float* x, float* y) {
  for_groups<float>(groups, [&](const LaneGroup& group, auto type) {
    using V = typename decltype(type)::Type;
    constexpr int w = width_of(decltype(type)());
    const float* from = x + 3 * n_columns * group.first_lane;
    float* to = y + 3 * n_rows * group.first_lane;
    for (std::size_t i = begin; i < end; ++i) {
      V sum[3] = {};
      if (keep)
        for (int c = 0; c < 3; ++c) sum[c] = load<V>(to + (3 * i + c) * w);
      for (auto k = rows.begin[i]; k < rows.begin[i + 1]; ++k)
#pragma GCC unroll 3
        for (int c = 0; c < 3; ++c)
          sum[c] += rows.weight[k] * load<V>(from + (3 * std::size_t(rows.column[k]) + c) * w);
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) store(to + (3 * i + c) * w, sum[c]);
    }
  });
}

void dot(LaneGroups groups, std::size_t n_nodes, std::size_t begin, std::size_t end, const double* a,
         const double* b, double* sum) {
  for_groups<double>(groups, [&](const LaneGroup& group, auto type) {
    using V = typename decltype(type)::Type;
    constexpr int w = width_of(decltype(type)());
    const std::size_t start = 3 * n_nodes * group.first_lane;
    V s = {};
    for (std::size_t at = start + 3 * w * begin; at < start + 3 * w * end; at += w)
      s += load<V>(a + at) * load<V>(b + at);
    store(sum + group.first_lane, s);
  });
}

void advance(LaneGroups groups, std::size_t n_nodes, std::size_t begin, std::size_t end, const double* step,
             const double* p, const double* q, double* x, double* r, double* sum) {
  for_groups<double>(groups, [&](const LaneGroup& group, auto type) {
    using V = typename decltype(type)::Type;
    constexpr int w = width_of(decltype(type)());
    const std::size_t start = 3 * n_nodes * group.first_lane;
    const V a = load<V>(step + group.first_lane);
    V s = {};
    for (std::size_t at = start + 3 * w * begin; at < start + 3 * w * end; at += w) {
      store(x + at, load<V>(x + at) + a * load<V>(p + at));
      const V rest = load<V>(r + at) - a * load<V>(q + at);
      store(r + at, rest);
      s += rest * rest;
    }
    store(sum + group.first_lane, s);
  });
}

/// The group of floats that holds a lane, and where in it row 0 of the lane is. Groups of doubles never cross
/// the border of a group of floats.
struct FloatPlace {
  std::size_t start;
  int width;
};
inline FloatPlace find_float(LaneGroups floats, std::size_t n_nodes, std::size_t lane) {
  int g = 0;
  while (floats.group[g].first_lane + floats.group[g].width <= lane) ++g;
  const auto& group = floats.group[g];
  return {3 * n_nodes * group.first_lane + (lane - group.first_lane), group.width};
}

/// w floats as doubles and back.
template <typename V, int w>
inline V widen(const float* from) {
  return __builtin_convertvector(load<typename Register<float, w>::Type>(from), V);
}

void dots_with_float(LaneGroups doubles, LaneGroups floats, std::size_t n_nodes, std::size_t begin,
                     std::size_t end, const double* r, const double* q, const float* z, double* rz,
                     double* qz) {
  for_groups<double>(doubles, [&](const LaneGroup& group, auto type) {
    using V = typename decltype(type)::Type;
    constexpr int w = width_of(decltype(type)());
    const std::size_t start = 3 * n_nodes * group.first_lane;
    const FloatPlace place = find_float(floats, n_nodes, group.first_lane);
    V s = {}, t = {};
    for (std::size_t row = 3 * begin; row < 3 * end; ++row) {
      const V from = widen<V, w>(z + place.start + row * place.width);
      s += load<V>(r + start + row * w) * from;
      t += load<V>(q + start + row * w) * from;
    }
    store(rz + group.first_lane, s);
    store(qz + group.first_lane, t);
  });
}

void direction(LaneGroups doubles, LaneGroups floats, std::size_t n_nodes, std::size_t begin, std::size_t end,
               const double* factor, const float* z, double* p) {
  for_groups<double>(doubles, [&](const LaneGroup& group, auto type) {
    using V = typename decltype(type)::Type;
    constexpr int w = width_of(decltype(type)());
    const std::size_t start = 3 * n_nodes * group.first_lane;
    const FloatPlace place = find_float(floats, n_nodes, group.first_lane);
    const V f = load<V>(factor + group.first_lane);
    for (std::size_t row = 3 * begin; row < 3 * end; ++row) {
      const V from = widen<V, w>(z + place.start + row * place.width);
      store(p + start + row * w, from + f * load<V>(p + start + row * w));
    }
  });
}

void to_float(LaneGroups doubles, LaneGroups floats, std::size_t n_nodes, std::size_t begin, std::size_t end,
              const double* scale, const double* r, float* z) {
  for_groups<double>(doubles, [&](const LaneGroup& group, auto type) {
    using V = typename decltype(type)::Type;
    constexpr int w = width_of(decltype(type)());
    const std::size_t start = 3 * n_nodes * group.first_lane;
    const FloatPlace place = find_float(floats, n_nodes, group.first_lane);
    const V s = load<V>(scale + group.first_lane);
    for (std::size_t row = 3 * begin; row < 3 * end; ++row)
      store(z + place.start + row * place.width,
            __builtin_convertvector(s * load<V>(r + start + row * w), typename Register<float, w>::Type));
  });
}

}  // namespace

extern const Kernels kernels;
const Kernels kernels = {{large / 8, small / 8},
                         {large / 4, small / 4},
                         apply<double>,
                         apply<float>,
                         chebyshev,
                         residual,
                         combine,
                         dot,
                         advance,
                         dots_with_float,
                         direction,
                         to_float};

}  // namespace fem::kernel::KERNEL_VARIANT

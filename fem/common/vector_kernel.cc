/// Compiled once per instruction set, with KERNEL_VARIANT naming the variant (fem/CMakeLists.txt). No other
/// header with inline code may be included here: the linker would keep one copy of it, for one instruction
/// set, for all callers.
#include "fem/common/elastic_registers.h"

namespace fem::kernel::KERNEL_VARIANT {

void apply_double(const CellRange<double>&, LaneGroups, const double*, double*, double*);
void apply_float(const CellRange<float>&, LaneGroups, const float*, float*, float*);

namespace {

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
      for (auto k = rows.begin[i]; k < rows.begin[i + 1]; ++k) {
#pragma GCC unroll 3
        for (int c = 0; c < 3; ++c)
          sum[c] += rows.weight[k] * load<V>(from + (3 * std::size_t(rows.column[k]) + c) * w);
      }
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) store(to + (3 * i + c) * w, sum[c]);
    }
  });
}

template <int height, int width>
void combine_blocks_of(LaneGroups groups, std::size_t n_rows, std::size_t n_columns, std::size_t begin,
                       std::size_t end, const BlockRows& rows, bool keep, const float* x, float* y) {
  for_groups<float>(groups, [&](const LaneGroup& group, auto type) {
    using V = typename decltype(type)::Type;
    constexpr int w = width_of(decltype(type)());
    const float* from = x + width * n_columns * group.first_lane;
    float* to = y + height * n_rows * group.first_lane;
    for (std::size_t i = begin; i < end; ++i) {
      V sum[height] = {};
      if (keep)
        for (int r = 0; r < height; ++r) sum[r] = load<V>(to + (height * i + r) * w);
      for (auto k = rows.begin[i]; k < rows.begin[i + 1]; ++k) {
        const float* block = rows.block + height * width * k;
        const float* at = from + width * w * std::size_t(rows.column[k]);
#pragma GCC unroll 6
        for (int c = 0; c < width; ++c) {
          const V value = load<V>(at + c * w);
#pragma GCC unroll 6
          for (int r = 0; r < height; ++r) sum[r] += block[r * width + c] * value;
        }
      }
#pragma GCC unroll 6
      for (int r = 0; r < height; ++r) store(to + (height * i + r) * w, sum[r]);
    }
  });
}

void combine_blocks(LaneGroups groups, std::size_t n_rows, std::size_t n_columns, std::size_t begin,
                    std::size_t end, const BlockRows& rows, bool keep, const float* x, float* y) {
  if (rows.height == 6)
    combine_blocks_of<6, 3>(groups, n_rows, n_columns, begin, end, rows, keep, x, y);
  else if (rows.width == 6)
    combine_blocks_of<3, 6>(groups, n_rows, n_columns, begin, end, rows, keep, x, y);
  else
    combine_blocks_of<3, 3>(groups, n_rows, n_columns, begin, end, rows, keep, x, y);
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
                         apply_double,
                         apply_float,
                         chebyshev,
                         residual,
                         combine,
                         combine_blocks,
                         dot,
                         advance,
                         dots_with_float,
                         direction,
                         to_float};

}  // namespace fem::kernel::KERNEL_VARIANT

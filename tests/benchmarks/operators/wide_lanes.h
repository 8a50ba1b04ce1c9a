/// deal.II's SIMD type with as many lanes as the compiler's target has: eight doubles or sixteen floats with
/// AVX-512, half as many with AVX2. Debian's deal.II is configured for one lane, and its own specialisations
/// are switched off; to switch them on by its macro would change the meaning of types that the library was
/// built with. These are types that the library does not have. Include before MatrixFree, in files compiled
/// for that target alone.
#pragma once

#include <deal.II/base/vectorization.h>
#include <immintrin.h>

#include <cmath>
#include <cstring>
#include <type_traits>

namespace measure {

#if defined(__AVX512F__)
constexpr std::size_t n_wide_bytes = 64;
#elif defined(__AVX2__)
constexpr std::size_t n_wide_bytes = 32;
#else
#error "wide_lanes.h is for x86-64 with AVX2 or AVX-512"
#endif
template <typename Number>
constexpr std::size_t n_wide_lanes = n_wide_bytes / sizeof(Number);

using Doubles = double __attribute__((vector_size(n_wide_bytes)));
using Floats = float __attribute__((vector_size(n_wide_bytes)));

template <typename Number>
using WideLanes = dealii::VectorizedArray<Number, n_wide_lanes<Number>>;

inline void gather(double* to, const double* base, const unsigned* offsets) {
#if defined(__AVX512F__)
  const __m256i at = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(offsets));
  _mm512_storeu_pd(to, _mm512_mask_i32gather_pd(_mm512_setzero_pd(), 0xFF, at, base, sizeof(double)));
#else
  const __m128i at = _mm_loadu_si128(reinterpret_cast<const __m128i*>(offsets));
  const __m256d all = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
  _mm256_storeu_pd(to, _mm256_mask_i32gather_pd(_mm256_setzero_pd(), base, at, all, sizeof(double)));
#endif
}

inline void gather(float* to, const float* base, const unsigned* offsets) {
#if defined(__AVX512F__)
  const __m512i at = _mm512_loadu_si512(offsets);
  _mm512_storeu_ps(to, _mm512_mask_i32gather_ps(_mm512_setzero_ps(), 0xFFFF, at, base, sizeof(float)));
#else
  const __m256i at = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(offsets));
  const __m256 all = _mm256_castsi256_ps(_mm256_set1_epi32(-1));
  _mm256_storeu_ps(to, _mm256_mask_i32gather_ps(_mm256_setzero_ps(), base, at, all, sizeof(float)));
#endif
}

inline void scatter(const double* from, double* base, const unsigned* offsets) {
#if defined(__AVX512F__)
  _mm512_i32scatter_pd(base, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(offsets)),
                       _mm512_loadu_pd(from), sizeof(double));
#else
  for (std::size_t i = 0; i < n_wide_lanes<double>; ++i) base[offsets[i]] = from[i];
#endif
}

inline void scatter(const float* from, float* base, const unsigned* offsets) {
#if defined(__AVX512F__)
  _mm512_i32scatter_ps(base, _mm512_loadu_si512(offsets), _mm512_loadu_ps(from), sizeof(float));
#else
  for (std::size_t i = 0; i < n_wide_lanes<float>; ++i) base[offsets[i]] = from[i];
#endif
}

/// As the specialisations of deal.II/base/vectorization.h. Of its transpositions the generic ones do: cells
/// of continuous elements gather and scatter.
template <typename Number>
class WideLanesOf : public dealii::VectorizedArrayBase<WideLanes<Number>, n_wide_lanes<Number>> {
public:
  using value_type = Number;
  static constexpr std::size_t n = n_wide_lanes<Number>;
  using Self = WideLanes<Number>;
  using Register = std::conditional_t<std::is_same_v<Number, double>, Doubles, Floats>;

  WideLanesOf() = default;
  DEAL_II_ALWAYS_INLINE WideLanesOf(Number scalar) : data(scalar - Register{}) {}
  template <typename U>
  WideLanesOf(const std::initializer_list<U>& list) : dealii::VectorizedArrayBase<Self, n>(list) {}

  DEAL_II_ALWAYS_INLINE Number& operator[](unsigned lane) {
    return *(reinterpret_cast<Number*>(&data) + lane);
  }
  DEAL_II_ALWAYS_INLINE const Number& operator[](unsigned lane) const {
    return *(reinterpret_cast<const Number*>(&data) + lane);
  }
  DEAL_II_ALWAYS_INLINE Self& operator+=(const Self& other) {
    data += other.data;
    return self();
  }
  DEAL_II_ALWAYS_INLINE Self& operator-=(const Self& other) {
    data -= other.data;
    return self();
  }
  DEAL_II_ALWAYS_INLINE Self& operator*=(const Self& other) {
    data *= other.data;
    return self();
  }
  DEAL_II_ALWAYS_INLINE Self& operator/=(const Self& other) {
    data /= other.data;
    return self();
  }

  DEAL_II_ALWAYS_INLINE void load(const Number* from) { std::memcpy(&data, from, sizeof data); }
  DEAL_II_ALWAYS_INLINE void store(Number* to) const { std::memcpy(to, &data, sizeof data); }
  DEAL_II_ALWAYS_INLINE void streaming_store(Number* to) const { store(to); }
  DEAL_II_ALWAYS_INLINE void gather(const Number* base, const unsigned* offsets) {
    measure::gather(reinterpret_cast<Number*>(&data), base, offsets);
  }
  DEAL_II_ALWAYS_INLINE void scatter(const unsigned* offsets, Number* base) const {
    measure::scatter(reinterpret_cast<const Number*>(&data), base, offsets);
  }

  Self get_sqrt() const {
    return each([&](std::size_t i) { return std::sqrt(data[i]); });
  }
  Self get_abs() const {
    return each([&](std::size_t i) { return std::abs(data[i]); });
  }
  Self get_max(const Self& other) const {
    return each([&](std::size_t i) { return std::max(data[i], other.data[i]); });
  }
  Self get_min(const Self& other) const {
    return each([&](std::size_t i) { return std::min(data[i], other.data[i]); });
  }

  Register data;

private:
  DEAL_II_ALWAYS_INLINE Self& self() { return static_cast<Self&>(*this); }
  template <typename Function>
  DEAL_II_ALWAYS_INLINE static Self each(const Function& function) {
    Self result;
    for (std::size_t i = 0; i < n; ++i) result.data[i] = function(i);
    return result;
  }
};

}  // namespace measure

namespace dealii {

template <>
class VectorizedArray<double, measure::n_wide_lanes<double>> : public measure::WideLanesOf<double> {
public:
  using measure::WideLanesOf<double>::WideLanesOf;
};

template <>
class VectorizedArray<float, measure::n_wide_lanes<float>> : public measure::WideLanesOf<float> {
public:
  using measure::WideLanesOf<float>::WideLanesOf;
};

}  // namespace dealii

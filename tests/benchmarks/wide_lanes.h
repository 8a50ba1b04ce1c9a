/// deal.II's SIMD type with as many lanes as the compiler's target has: eight doubles with AVX-512, four with
/// AVX2. Debian's deal.II is configured for one lane, and its own specialisations are switched off; to switch
/// them on by its macro would change the meaning of types that the library was built with. These are types
/// that the library does not have. Include before MatrixFree, in files compiled for that target alone.
#pragma once

#include <deal.II/base/vectorization.h>
#include <immintrin.h>

#include <cstring>

namespace measure {

#if defined(__AVX512F__)
constexpr std::size_t n_wide_lanes = 8;
#elif defined(__AVX2__)
constexpr std::size_t n_wide_lanes = 4;
#else
#error "wide_lanes.h is for x86-64 with AVX2 or AVX-512"
#endif

}  // namespace measure

namespace dealii {

/// As those of deal.II/base/vectorization.h. Of its transpositions the generic ones do: cells of continuous
/// elements gather and scatter.
template <>
class VectorizedArray<double, measure::n_wide_lanes>
    : public VectorizedArrayBase<VectorizedArray<double, measure::n_wide_lanes>, measure::n_wide_lanes> {
public:
  using value_type = double;
  static constexpr std::size_t n = measure::n_wide_lanes;
  using Register = double __attribute__((vector_size(n * sizeof(double))));

  VectorizedArray() = default;
  DEAL_II_ALWAYS_INLINE VectorizedArray(double scalar) { *this = scalar; }
  template <typename U>
  VectorizedArray(const std::initializer_list<U>& list) : VectorizedArrayBase<VectorizedArray, n>(list) {}

  DEAL_II_ALWAYS_INLINE VectorizedArray& operator=(double scalar) {
    data = scalar - Register{};
    return *this;
  }
  DEAL_II_ALWAYS_INLINE double& operator[](unsigned lane) {
    return *(reinterpret_cast<double*>(&data) + lane);
  }
  DEAL_II_ALWAYS_INLINE const double& operator[](unsigned lane) const {
    return *(reinterpret_cast<const double*>(&data) + lane);
  }
  DEAL_II_ALWAYS_INLINE VectorizedArray& operator+=(const VectorizedArray& other) {
    data += other.data;
    return *this;
  }
  DEAL_II_ALWAYS_INLINE VectorizedArray& operator-=(const VectorizedArray& other) {
    data -= other.data;
    return *this;
  }
  DEAL_II_ALWAYS_INLINE VectorizedArray& operator*=(const VectorizedArray& other) {
    data *= other.data;
    return *this;
  }
  DEAL_II_ALWAYS_INLINE VectorizedArray& operator/=(const VectorizedArray& other) {
    data /= other.data;
    return *this;
  }

  DEAL_II_ALWAYS_INLINE void load(const double* from) { std::memcpy(&data, from, sizeof data); }
  DEAL_II_ALWAYS_INLINE void store(double* to) const { std::memcpy(to, &data, sizeof data); }
  DEAL_II_ALWAYS_INLINE void streaming_store(double* to) const { store(to); }
#if defined(__AVX512F__)
  DEAL_II_ALWAYS_INLINE void gather(const double* base, const unsigned* offsets) {
    const __m256i at = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(offsets));
    data = _mm512_mask_i32gather_pd(Register{}, 0xFF, at, base, 8);
  }
  DEAL_II_ALWAYS_INLINE void scatter(const unsigned* offsets, double* base) const {
    _mm512_i32scatter_pd(base, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(offsets)), data, 8);
  }
#else
  DEAL_II_ALWAYS_INLINE void gather(const double* base, const unsigned* offsets) {
    const __m128i at = _mm_loadu_si128(reinterpret_cast<const __m128i*>(offsets));
    const __m256d all = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
    data = _mm256_mask_i32gather_pd(Register{}, base, at, all, 8);
  }
  DEAL_II_ALWAYS_INLINE void scatter(const unsigned* offsets, double* base) const {
    for (std::size_t i = 0; i < n; ++i) base[offsets[i]] = data[i];
  }
#endif

  Register data;

private:
  template <typename Function>
  DEAL_II_ALWAYS_INLINE static VectorizedArray each(const Function& function) {
    VectorizedArray result;
    for (std::size_t i = 0; i < n; ++i) result.data[i] = function(i);
    return result;
  }
  VectorizedArray get_sqrt() const {
    return each([&](std::size_t i) { return std::sqrt(data[i]); });
  }
  VectorizedArray get_abs() const {
    return each([&](std::size_t i) { return std::abs(data[i]); });
  }
  VectorizedArray get_max(const VectorizedArray& other) const {
    return each([&](std::size_t i) { return std::max(data[i], other.data[i]); });
  }
  VectorizedArray get_min(const VectorizedArray& other) const {
    return each([&](std::size_t i) { return std::min(data[i], other.data[i]); });
  }
  template <typename Number, std::size_t width>
  friend VectorizedArray<Number, width> std::sqrt(const VectorizedArray<Number, width>&);
  template <typename Number, std::size_t width>
  friend VectorizedArray<Number, width> std::abs(const VectorizedArray<Number, width>&);
  template <typename Number, std::size_t width>
  friend VectorizedArray<Number, width> std::max(const VectorizedArray<Number, width>&,
                                                 const VectorizedArray<Number, width>&);
  template <typename Number, std::size_t width>
  friend VectorizedArray<Number, width> std::min(const VectorizedArray<Number, width>&,
                                                 const VectorizedArray<Number, width>&);
};

}  // namespace dealii

namespace measure {

using WideLanes = dealii::VectorizedArray<double, n_wide_lanes>;

}  // namespace measure

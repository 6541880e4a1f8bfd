#pragma once
/// Four doubles that go through one instruction sequence together: an AVX register where the build targets it, two SSE2
/// registers on every other x86-64, a loop elsewhere. All three round alike, so answers are the same.
#include <array>
#include <cstddef>
#include <utility>

#ifdef __AVX__
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace shaolin {

#ifdef __AVX__

class Four {
 public:
  explicit Four(double all) : value_(_mm256_set1_pd(all)) {}
  explicit Four(const double* from) : value_(_mm256_loadu_pd(from)) {}
  Four(double a, double b, double c, double d) : value_(_mm256_setr_pd(a, b, c, d)) {}
  void store(double* to) const { _mm256_storeu_pd(to, value_); }

  friend Four operator+(Four a, Four b) { return Four(_mm256_add_pd(a.value_, b.value_)); }
  friend Four operator-(Four a, Four b) { return Four(_mm256_sub_pd(a.value_, b.value_)); }
  friend Four operator*(Four a, Four b) { return Four(_mm256_mul_pd(a.value_, b.value_)); }
  friend Four abs(Four a) { return Four(_mm256_andnot_pd(_mm256_set1_pd(-0.0), a.value_)); }
  /// a > b ? a : b, hence b where either is undefined (so does the instruction).
  friend Four larger(Four a, Four b) { return Four(_mm256_max_pd(a.value_, b.value_)); }
  /// a < b ? a : b, hence b where either is undefined.
  friend Four smaller(Four a, Four b) { return Four(_mm256_min_pd(a.value_, b.value_)); }
  /// Bit i is set where a <= b in place i.
  friend int at_most(Four a, Four b) { return _mm256_movemask_pd(_mm256_cmp_pd(a.value_, b.value_, _CMP_LE_OQ)); }
  /// (a1, a2, a3, a0).
  friend Four rotated(Four a) {
    return Four(_mm256_shuffle_pd(a.value_, _mm256_permute2f128_pd(a.value_, a.value_, 1), 0b0101));
  }
  /// (a1, a2, a0, a3): of a vector (x, y, z, ...), (y, z, x, ...).
  friend Four next_axes(Four a) {
#ifdef __AVX2__
    return Four(_mm256_permute4x64_pd(a.value_, _MM_SHUFFLE(3, 0, 2, 1)));
#else
    const __m256d swapped = _mm256_permute2f128_pd(a.value_, a.value_, 1);
    return Four(_mm256_blend_pd(_mm256_shuffle_pd(a.value_, swapped, 0b0001),
                                _mm256_shuffle_pd(swapped, a.value_, 0b1000), 0b1100));
#endif
  }
  /// The four sums (x0 + x1) + (x2 + x3).
  friend Four sums(Four a, Four b, Four c, Four d) {
    const __m256d ab = _mm256_hadd_pd(a.value_, b.value_), cd = _mm256_hadd_pd(c.value_, d.value_);
    return Four(_mm256_add_pd(_mm256_permute2f128_pd(ab, cd, 0x20), _mm256_permute2f128_pd(ab, cd, 0x31)));
  }
  /// Rows become columns.
  friend void transpose(Four& a, Four& b, Four& c, Four& d) {
    const __m256d ab_even = _mm256_unpacklo_pd(a.value_, b.value_), ab_odd = _mm256_unpackhi_pd(a.value_, b.value_);
    const __m256d cd_even = _mm256_unpacklo_pd(c.value_, d.value_), cd_odd = _mm256_unpackhi_pd(c.value_, d.value_);
    a = Four(_mm256_permute2f128_pd(ab_even, cd_even, 0x20));
    b = Four(_mm256_permute2f128_pd(ab_odd, cd_odd, 0x20));
    c = Four(_mm256_permute2f128_pd(ab_even, cd_even, 0x31));
    d = Four(_mm256_permute2f128_pd(ab_odd, cd_odd, 0x31));
  }

 private:
  explicit Four(__m256d value) : value_(value) {}
  __m256d value_;
};

#elif defined(__SSE2__)

class Four {
 public:
  explicit Four(double all) : low_(_mm_set1_pd(all)), high_(low_) {}
  explicit Four(const double* from) : low_(_mm_loadu_pd(from)), high_(_mm_loadu_pd(from + 2)) {}
  Four(double a, double b, double c, double d) : low_(_mm_setr_pd(a, b)), high_(_mm_setr_pd(c, d)) {}
  void store(double* to) const {
    _mm_storeu_pd(to, low_);
    _mm_storeu_pd(to + 2, high_);
  }

  friend Four operator+(Four a, Four b) { return {_mm_add_pd(a.low_, b.low_), _mm_add_pd(a.high_, b.high_)}; }
  friend Four operator-(Four a, Four b) { return {_mm_sub_pd(a.low_, b.low_), _mm_sub_pd(a.high_, b.high_)}; }
  friend Four operator*(Four a, Four b) { return {_mm_mul_pd(a.low_, b.low_), _mm_mul_pd(a.high_, b.high_)}; }
  friend Four abs(Four a) {
    const __m128d sign = _mm_set1_pd(-0.0);
    return {_mm_andnot_pd(sign, a.low_), _mm_andnot_pd(sign, a.high_)};
  }
  /// a > b ? a : b, hence b where either is undefined (so does the instruction).
  friend Four larger(Four a, Four b) { return {_mm_max_pd(a.low_, b.low_), _mm_max_pd(a.high_, b.high_)}; }
  /// a < b ? a : b, hence b where either is undefined.
  friend Four smaller(Four a, Four b) { return {_mm_min_pd(a.low_, b.low_), _mm_min_pd(a.high_, b.high_)}; }
  /// Bit i is set where a <= b in place i.
  friend int at_most(Four a, Four b) {
    return _mm_movemask_pd(_mm_cmple_pd(a.low_, b.low_)) | _mm_movemask_pd(_mm_cmple_pd(a.high_, b.high_)) << 2;
  }
  /// (a1, a2, a3, a0).
  friend Four rotated(Four a) { return {_mm_shuffle_pd(a.low_, a.high_, 0b01), _mm_shuffle_pd(a.high_, a.low_, 0b01)}; }
  /// (a1, a2, a0, a3): of a vector (x, y, z, ...), (y, z, x, ...).
  friend Four next_axes(Four a) {
    return {_mm_shuffle_pd(a.low_, a.high_, 0b01), _mm_shuffle_pd(a.low_, a.high_, 0b10)};
  }
  /// The four sums (x0 + x1) + (x2 + x3).
  friend Four sums(Four a, Four b, Four c, Four d) {
    const auto pairs = [](__m128d x, __m128d y) { return _mm_add_pd(_mm_unpacklo_pd(x, y), _mm_unpackhi_pd(x, y)); };
    return {_mm_add_pd(pairs(a.low_, b.low_), pairs(a.high_, b.high_)),
            _mm_add_pd(pairs(c.low_, d.low_), pairs(c.high_, d.high_))};
  }
  /// Rows become columns.
  friend void transpose(Four& a, Four& b, Four& c, Four& d) {
    const Four p(_mm_unpacklo_pd(a.low_, b.low_), _mm_unpacklo_pd(c.low_, d.low_));
    const Four q(_mm_unpackhi_pd(a.low_, b.low_), _mm_unpackhi_pd(c.low_, d.low_));
    const Four r(_mm_unpacklo_pd(a.high_, b.high_), _mm_unpacklo_pd(c.high_, d.high_));
    d = Four(_mm_unpackhi_pd(a.high_, b.high_), _mm_unpackhi_pd(c.high_, d.high_));
    a = p;
    b = q;
    c = r;
  }

 private:
  Four(__m128d low, __m128d high) : low_(low), high_(high) {}
  __m128d low_, high_;
};

#else

class Four {
 public:
  explicit Four(double all) { value_.fill(all); }
  explicit Four(const double* from) : value_{from[0], from[1], from[2], from[3]} {}
  Four(double a, double b, double c, double d) : value_{a, b, c, d} {}
  void store(double* to) const {
    for (std::size_t i = 0; i < 4; ++i) to[i] = value_[i];
  }

  friend Four operator+(Four a, Four b) {
    return each(a, b, [](double x, double y) { return x + y; });
  }
  friend Four operator-(Four a, Four b) {
    return each(a, b, [](double x, double y) { return x - y; });
  }
  friend Four operator*(Four a, Four b) {
    return each(a, b, [](double x, double y) { return x * y; });
  }
  friend Four abs(Four a) {
    return each(a, a, [](double x, double) { return x < 0 ? -x : x; });
  }
  friend Four larger(Four a, Four b) {
    return each(a, b, [](double x, double y) { return x > y ? x : y; });
  }
  friend Four smaller(Four a, Four b) {
    return each(a, b, [](double x, double y) { return x < y ? x : y; });
  }
  friend int at_most(Four a, Four b) {
    int bits = 0;
    for (std::size_t i = 0; i < 4; ++i) bits |= (a.value_[i] <= b.value_[i]) << i;
    return bits;
  }
  friend Four rotated(const Four& a) { return {a.value_[1], a.value_[2], a.value_[3], a.value_[0]}; }
  friend Four next_axes(const Four& a) { return {a.value_[1], a.value_[2], a.value_[0], a.value_[3]}; }
  friend Four sums(const Four& a, const Four& b, const Four& c, const Four& d) {
    const auto sum = [](const Four& x) { return (x.value_[0] + x.value_[1]) + (x.value_[2] + x.value_[3]); };
    return {sum(a), sum(b), sum(c), sum(d)};
  }
  friend void transpose(Four& a, Four& b, Four& c, Four& d) {
    const std::array<Four*, 4> rows{&a, &b, &c, &d};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) std::swap(rows[i]->value_[j], rows[j]->value_[i]);
  }

 private:
  template <class Operation>
  static Four each(const Four& a, const Four& b, Operation operation) {
    Four result(0.0);
    for (std::size_t i = 0; i < 4; ++i) result.value_[i] = operation(a.value_[i], b.value_[i]);
    return result;
  }
  std::array<double, 4> value_;
};

#endif

/// The cross product of the first three, and 0.
inline Four cross(Four a, Four b) { return next_axes(a * next_axes(b) - b * next_axes(a)); }

}  // namespace shaolin

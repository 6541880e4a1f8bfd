#pragma once
/// Eight floats that go through one instruction sequence together: an AVX register where the build targets it, two SSE
/// registers on every other x86-64, a loop elsewhere. For bounds only, which are rounded outward; all three round
/// alike.
#include <array>
#include <cstddef>

#ifdef __AVX__
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace shaolin {

#ifdef __AVX__

class Eight {
 public:
  explicit Eight(float all) : value_(_mm256_set1_ps(all)) {}
  explicit Eight(const float* from) : value_(_mm256_loadu_ps(from)) {}
  void store(float* to) const { _mm256_storeu_ps(to, value_); }

  friend Eight operator+(Eight a, Eight b) { return Eight(_mm256_add_ps(a.value_, b.value_)); }
  friend Eight operator*(Eight a, Eight b) { return Eight(_mm256_mul_ps(a.value_, b.value_)); }
  /// a > b ? a : b, hence b where either is undefined (so does the instruction).
  friend Eight larger(Eight a, Eight b) { return Eight(_mm256_max_ps(a.value_, b.value_)); }
  /// a < b ? a : b, hence b where either is undefined.
  friend Eight smaller(Eight a, Eight b) { return Eight(_mm256_min_ps(a.value_, b.value_)); }
  /// Bit i is set where a <= b in place i.
  friend unsigned at_most(Eight a, Eight b) {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a.value_, b.value_, _CMP_LE_OQ)));
  }

 private:
  explicit Eight(__m256 value) : value_(value) {}
  __m256 value_;
};

#elif defined(__SSE2__)

class Eight {
 public:
  explicit Eight(float all) : low_(_mm_set1_ps(all)), high_(low_) {}
  explicit Eight(const float* from) : low_(_mm_loadu_ps(from)), high_(_mm_loadu_ps(from + 4)) {}
  void store(float* to) const {
    _mm_storeu_ps(to, low_);
    _mm_storeu_ps(to + 4, high_);
  }

  friend Eight operator+(Eight a, Eight b) { return {_mm_add_ps(a.low_, b.low_), _mm_add_ps(a.high_, b.high_)}; }
  friend Eight operator*(Eight a, Eight b) { return {_mm_mul_ps(a.low_, b.low_), _mm_mul_ps(a.high_, b.high_)}; }
  /// a > b ? a : b, hence b where either is undefined (so does the instruction).
  friend Eight larger(Eight a, Eight b) { return {_mm_max_ps(a.low_, b.low_), _mm_max_ps(a.high_, b.high_)}; }
  /// a < b ? a : b, hence b where either is undefined.
  friend Eight smaller(Eight a, Eight b) { return {_mm_min_ps(a.low_, b.low_), _mm_min_ps(a.high_, b.high_)}; }
  /// Bit i is set where a <= b in place i.
  friend unsigned at_most(Eight a, Eight b) {
    return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(a.low_, b.low_)) |
                                 _mm_movemask_ps(_mm_cmple_ps(a.high_, b.high_)) << 4);
  }

 private:
  Eight(__m128 low, __m128 high) : low_(low), high_(high) {}
  __m128 low_, high_;
};

#else

class Eight {
 public:
  explicit Eight(float all) { value_.fill(all); }
  explicit Eight(const float* from) {
    for (std::size_t i = 0; i < 8; ++i) value_[i] = from[i];
  }
  void store(float* to) const {
    for (std::size_t i = 0; i < 8; ++i) to[i] = value_[i];
  }

  friend Eight operator+(Eight a, Eight b) {
    return each(a, b, [](float x, float y) { return x + y; });
  }
  friend Eight operator*(Eight a, Eight b) {
    return each(a, b, [](float x, float y) { return x * y; });
  }
  friend Eight larger(Eight a, Eight b) {
    return each(a, b, [](float x, float y) { return x > y ? x : y; });
  }
  friend Eight smaller(Eight a, Eight b) {
    return each(a, b, [](float x, float y) { return x < y ? x : y; });
  }
  friend unsigned at_most(Eight a, Eight b) {
    unsigned bits = 0;
    for (std::size_t i = 0; i < 8; ++i) bits |= static_cast<unsigned>(a.value_[i] <= b.value_[i]) << i;
    return bits;
  }

 private:
  template <class Operation>
  static Eight each(const Eight& a, const Eight& b, Operation operation) {
    Eight result(0.0F);
    for (std::size_t i = 0; i < 8; ++i) result.value_[i] = operation(a.value_[i], b.value_[i]);
    return result;
  }
  std::array<float, 8> value_;
};

#endif

}  // namespace shaolin

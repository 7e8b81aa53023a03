// Eight floats at a time: one AVX register if the including file is compiled for AVX2, else two SSE registers.
// Every operation is the plain IEEE one, lane by lane, so both variants give the same bits.
// Everything here is private to the including file: two such files may be compiled for different instruction sets.
#pragma once

#include <immintrin.h>

namespace skein::sim {
namespace {

#ifdef __AVX2__
struct Float8 {
  __m256 v;
};
inline Float8 all(float x) { return {_mm256_set1_ps(x)}; }
inline Float8 load(const float* p) { return {_mm256_load_ps(p)}; }
inline void store(float* p, Float8 a) { _mm256_store_ps(p, a.v); }
inline void store_whole(int* p, Float8 a) {
  _mm256_store_si256(reinterpret_cast<__m256i*>(p), _mm256_cvttps_epi32(a.v));
}
inline Float8 operator+(Float8 a, Float8 b) { return {_mm256_add_ps(a.v, b.v)}; }
inline Float8 operator-(Float8 a, Float8 b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline Float8 operator*(Float8 a, Float8 b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline Float8 operator/(Float8 a, Float8 b) { return {_mm256_div_ps(a.v, b.v)}; }
inline Float8 operator&(Float8 a, Float8 b) { return {_mm256_and_ps(a.v, b.v)}; }
inline Float8 operator^(Float8 a, Float8 b) { return {_mm256_xor_ps(a.v, b.v)}; }
inline Float8 operator>(Float8 a, Float8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ)}; }
inline Float8 operator>=(Float8 a, Float8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_GE_OQ)}; }
inline Float8 smaller(Float8 a, Float8 b) { return {_mm256_min_ps(a.v, b.v)}; }
inline Float8 larger(Float8 a, Float8 b) { return {_mm256_max_ps(a.v, b.v)}; }
inline Float8 without(Float8 a, Float8 mask) { return {_mm256_andnot_ps(mask.v, a.v)}; }
inline Float8 truncated(Float8 a) { return {_mm256_cvtepi32_ps(_mm256_cvttps_epi32(a.v))}; }
inline unsigned bits(Float8 mask) { return static_cast<unsigned>(_mm256_movemask_ps(mask.v)); }
#else
struct Float8 {
  __m128 v, w;
};
inline Float8 all(float x) { return {_mm_set1_ps(x), _mm_set1_ps(x)}; }
inline Float8 load(const float* p) { return {_mm_load_ps(p), _mm_load_ps(p + 4)}; }
inline void store(float* p, Float8 a) {
  _mm_store_ps(p, a.v);
  _mm_store_ps(p + 4, a.w);
}
inline void store_whole(int* p, Float8 a) {
  _mm_store_si128(reinterpret_cast<__m128i*>(p), _mm_cvttps_epi32(a.v));
  _mm_store_si128(reinterpret_cast<__m128i*>(p + 4), _mm_cvttps_epi32(a.w));
}
inline Float8 operator+(Float8 a, Float8 b) { return {_mm_add_ps(a.v, b.v), _mm_add_ps(a.w, b.w)}; }
inline Float8 operator-(Float8 a, Float8 b) { return {_mm_sub_ps(a.v, b.v), _mm_sub_ps(a.w, b.w)}; }
inline Float8 operator*(Float8 a, Float8 b) { return {_mm_mul_ps(a.v, b.v), _mm_mul_ps(a.w, b.w)}; }
inline Float8 operator/(Float8 a, Float8 b) { return {_mm_div_ps(a.v, b.v), _mm_div_ps(a.w, b.w)}; }
inline Float8 operator&(Float8 a, Float8 b) { return {_mm_and_ps(a.v, b.v), _mm_and_ps(a.w, b.w)}; }
inline Float8 operator^(Float8 a, Float8 b) { return {_mm_xor_ps(a.v, b.v), _mm_xor_ps(a.w, b.w)}; }
inline Float8 operator>(Float8 a, Float8 b) { return {_mm_cmpgt_ps(a.v, b.v), _mm_cmpgt_ps(a.w, b.w)}; }
inline Float8 operator>=(Float8 a, Float8 b) { return {_mm_cmpge_ps(a.v, b.v), _mm_cmpge_ps(a.w, b.w)}; }
inline Float8 smaller(Float8 a, Float8 b) { return {_mm_min_ps(a.v, b.v), _mm_min_ps(a.w, b.w)}; }
inline Float8 larger(Float8 a, Float8 b) { return {_mm_max_ps(a.v, b.v), _mm_max_ps(a.w, b.w)}; }
inline Float8 without(Float8 a, Float8 mask) { return {_mm_andnot_ps(mask.v, a.v), _mm_andnot_ps(mask.w, a.w)}; }
inline Float8 truncated(Float8 a) {
  return {_mm_cvtepi32_ps(_mm_cvttps_epi32(a.v)), _mm_cvtepi32_ps(_mm_cvttps_epi32(a.w))};
}
inline unsigned bits(Float8 mask) {
  return static_cast<unsigned>(_mm_movemask_ps(mask.v) | _mm_movemask_ps(mask.w) << 4);
}
#endif

inline Float8 sign_of(Float8 a) { return a & all(-0.0F); }
inline Float8 magnitude(Float8 a) { return without(a, all(-0.0F)); }

/// Eight points or directions.
struct Vector8 {
  Float8 x, y, z;
};
inline Vector8 operator+(const Vector8& a, const Vector8& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector8 operator-(const Vector8& a, const Vector8& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector8 operator*(const Vector8& a, Float8 s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vector8 operator^(const Vector8& a, Float8 s) { return {a.x ^ s, a.y ^ s, a.z ^ s}; }
inline Float8 dot(const Vector8& a, const Vector8& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector8 cross(const Vector8& a, const Vector8& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Sum of the magnitudes: an upper bound of the length that needs no square root.
inline Float8 extent(const Vector8& a) { return magnitude(a.x) + magnitude(a.y) + magnitude(a.z); }

}  // namespace
}  // namespace skein::sim

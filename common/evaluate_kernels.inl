// What every operation means, ties and NaN included, written once and compiled for each target.  The including file
// says which by SPACETIME_KERNELS, the function to define, SPACETIME_TARGET, its name, and SPACETIME_VECTOR_BYTES: 64,
// 32, or 16 for the generic target.
//
// The first two agree bit for bit: arithmetic and square roots are rounded once, as IEEE 754 has it, and every
// transcendental is the same four-lane function of libmvec, in the AVX-512 build too.  The generic target calls the C
// library.  Only a NaN's sign and payload are left open.
//
// All but the one function defined has internal linkage, and no inline function of the standard library is called:
// the linker must never take one target's copy for another's.

#include "common/evaluate_kernels.h"

#if SPACETIME_VECTOR_BYTES > 16
#include <immintrin.h>
extern "C" {
__m256d _ZGVdN4v_sin(__m256d);
__m256d _ZGVdN4v_cos(__m256d);
__m256d _ZGVdN4v_tan(__m256d);
__m256d _ZGVdN4v_asin(__m256d);
__m256d _ZGVdN4v_acos(__m256d);
__m256d _ZGVdN4v_atan(__m256d);
__m256d _ZGVdN4vv_atan2(__m256d, __m256d);
__m256d _ZGVdN4v_sinh(__m256d);
__m256d _ZGVdN4v_cosh(__m256d);
__m256d _ZGVdN4v_tanh(__m256d);
__m256d _ZGVdN4v_exp(__m256d);
__m256d _ZGVdN4v_log(__m256d);
__m256d _ZGVdN4vv_pow(__m256d, __m256d);
}
#define UNARY(name) call<lanes>(_ZGVdN4v_##name, d, a)
#define BINARY(name) call<lanes>(_ZGVdN4vv_##name, d, a, b)
#else
#include <math.h>
#define UNARY(name) call<lanes>(static_cast<double (*)(double)>(::name), d, a)
#define BINARY(name) call<lanes>(static_cast<double (*)(double, double)>(::name), d, a, b)
#endif

namespace spacetime {
namespace {

constexpr int width = SPACETIME_VECTOR_BYTES / sizeof(double);
typedef double Vector __attribute__((vector_size(SPACETIME_VECTOR_BYTES), may_alias));
typedef double Unaligned __attribute__((vector_size(SPACETIME_VECTOR_BYTES), aligned(8), may_alias));
typedef decltype(Vector{} < Vector{}) Mask;  // all bits of a lane set where true

inline Vector magnitude(Vector x) { return (Vector)((Mask)x & 0x7fff'ffff'ffff'ffff); }

#if SPACETIME_VECTOR_BYTES == 64
constexpr bool fused = true;
inline Vector multiply_add(Vector x, Vector y, Vector z) { return _mm512_fmadd_pd(x, y, z); }
inline Vector root(Vector x) { return _mm512_maskz_sqrt_pd(0xFF, x); }  // gcc 12 warns inside the one without mask
#elif SPACETIME_VECTOR_BYTES == 32
constexpr bool fused = true;
inline Vector multiply_add(Vector x, Vector y, Vector z) { return _mm256_fmadd_pd(x, y, z); }
inline Vector root(Vector x) { return _mm256_sqrt_pd(x); }
#else
#ifdef __FP_FAST_FMA
constexpr bool fused = true;
#else
constexpr bool fused = false;
#endif
inline Vector multiply_add(Vector x, Vector y, Vector z) {
  for (int k = 0; k < width; ++k) x[k] = __builtin_fma(x[k], y[k], z[k]);
  return x;
}
inline Vector root(Vector x) {
  for (int k = 0; k < width; ++k) x[k] = __builtin_sqrt(x[k]);
  return x;
}
#endif

// d[l] = function(operands[l]...) for every lane.  d may be an operand: lanes never look at one another.
template <int lanes, class Function, class... Operand>
inline void map(Function function, double* d, const Operand*... operands) {
  for (int l = 0; l < lanes; l += width) {
    *reinterpret_cast<Vector*>(d + l) = function(*reinterpret_cast<const Vector*>(operands + l)...);
  }
}

// The same for a function of the mathematical library.
template <int lanes, class Function, class... Operand>
inline void call(Function function, double* d, const Operand*... operands) {
#if SPACETIME_VECTOR_BYTES > 16
  for (int l = 0; l < lanes; l += 4) _mm256_store_pd(d + l, function(_mm256_load_pd(operands + l)...));
#else
  for (int l = 0; l < lanes; ++l) d[l] = function(operands[l]...);
#endif
}

template <int lanes>
inline void store(const Block& block, std::uint32_t row, const double* a) {
  double* const out = block.outputs + row * block.stride;
  if (block.valid == lanes) {
    for (int l = 0; l < lanes; l += width) {
      *reinterpret_cast<Unaligned*>(out + l) = *reinterpret_cast<const Vector*>(a + l);
    }
  } else {
    for (std::size_t l = 0; l < block.valid; ++l) out[l] = a[l];
  }
}

template <int lanes>
void run(const Instruction* begin, const Instruction* end, const Block& block) {
  using V = Vector;
  const V zero{}, one = zero + 1.0;
  for (const Instruction* i = begin; i != end; ++i) {
    const auto slot = [&](std::uint32_t s) { return block.slots + std::size_t{s} * lanes; };
    double* const d = slot(i->d);
    const double *const a = slot(i->a), *const b = slot(i->b), *const c = slot(i->c);
    if (fused && i->code == static_cast<std::uint32_t>(Op::multiply_add)) {  // nearly all: a branch that is foreseen
      map<lanes>(multiply_add, d, a, b, c);
      continue;
    }
    // clang-format off
#define OP(name) case static_cast<std::uint32_t>(Op::name)
    switch (i->code) {
      OP(add): map<lanes>([](V x, V y) { return x + y; }, d, a, b); break;
      OP(subtract): map<lanes>([](V x, V y) { return x - y; }, d, a, b); break;
      OP(multiply): map<lanes>([](V x, V y) { return x * y; }, d, a, b); break;
      OP(divide): map<lanes>([](V x, V y) { return x / y; }, d, a, b); break;
      OP(negate): map<lanes>([](V x) { return -x; }, d, a); break;
      OP(multiply_add): map<lanes>(multiply_add, d, a, b, c); break;
      OP(absolute): map<lanes>(magnitude, d, a); break;
      OP(sign): map<lanes>([=](V x) { return x > zero ? one : x < zero ? -one : zero; }, d, a); break;  // NaN: 0
      OP(square_root): map<lanes>(root, d, a); break;
      OP(minimum): map<lanes>([](V x, V y) { return y < x ? y : x; }, d, a, b); break;  // a tie, or a NaN on
      OP(maximum): map<lanes>([](V x, V y) { return y > x ? y : x; }, d, a, b); break;  // either side: the first
      OP(sine): UNARY(sin); break;
      OP(cosine): UNARY(cos); break;
      OP(tangent): UNARY(tan); break;
      OP(arc_sine): UNARY(asin); break;
      OP(arc_cosine): UNARY(acos); break;
      OP(arc_tangent): UNARY(atan); break;
      OP(arc_tangent2): BINARY(atan2); break;
      OP(hyperbolic_sine): UNARY(sinh); break;
      OP(hyperbolic_cosine): UNARY(cosh); break;
      OP(hyperbolic_tangent): UNARY(tanh); break;
      OP(exponential): UNARY(exp); break;
      OP(logarithm): UNARY(log); break;
      OP(power): BINARY(pow); break;
      OP(less): map<lanes>([=](V x, V y) { return x < y ? one : zero; }, d, a, b); break;  // false with a NaN
      OP(less_equal): map<lanes>([=](V x, V y) { return x <= y ? one : zero; }, d, a, b); break;
      OP(logical_and): map<lanes>([=](V x, V y) { return ((x != zero) & (y != zero)) ? one : zero; }, d, a, b); break;
      OP(logical_or): map<lanes>([=](V x, V y) { return ((x != zero) | (y != zero)) ? one : zero; }, d, a, b); break;
      OP(logical_not): map<lanes>([=](V x) { return x != zero ? zero : one; }, d, a); break;  // a NaN is true
      OP(select): map<lanes>([=](V x, V y, V z) { return x != zero ? y : z; }, d, a, b, c); break;
      case store_code: store<lanes>(block, i->d, a); break;
      default: __builtin_unreachable();
    }
#undef OP
    // clang-format on
  }
}

}  // namespace

Kernels SPACETIME_KERNELS() { return {SPACETIME_TARGET, fused, run<wide>, run<narrow>}; }

}  // namespace spacetime

#pragma once
/// One vocabulary for one lane and for many: the core is written over a real type F that is
/// `double` (the reference), `float`, or a SIMD batch with one pixel a lane. Only this header
/// includes the SIMD library.
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <xsimd/xsimd.hpp>

// Everything in the core lives in an inline namespace named after the instruction set it was
// compiled for, so that objects compiled for different ones can be linked into one program.
#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512DQ__)
#define AIRLIGHT_ISA avx512
#elif defined(__AVX2__) && defined(__FMA__)
#define AIRLIGHT_ISA avx2
#else
#define AIRLIGHT_ISA baseline
#endif

// For the few functions of the innermost loop: a call there would spill every vector register.
#define AIRLIGHT_INLINE [[gnu::always_inline]] inline

namespace airlight::inline AIRLIGHT_ISA {

/// As many floats as a register of this instruction set holds.
using FloatBatch = xsimd::batch<float>;

template <class F>
concept Real = std::same_as<F, double> || std::same_as<F, float> || std::same_as<F, FloatBatch>;

template <class F>
struct RealTraits {
  using Scalar = F;
  using Mask = bool;
  using UInt = std::uint32_t;
  static constexpr int lanes = 1;
};

template <>
struct RealTraits<FloatBatch> {
  using Scalar = float;
  using Mask = FloatBatch::batch_bool_type;
  using UInt = xsimd::batch<std::uint32_t>;
  static constexpr int lanes = int(FloatBatch::size);
};

template <Real F>
using Scalar = typename RealTraits<F>::Scalar;
/// What a comparison of two F gives.
template <Real F>
using Mask = typename RealTraits<F>::Mask;
/// 32 bit unsigned numbers, as many as F has lanes.
template <Real F>
using UInt = typename RealTraits<F>::UInt;
template <Real F>
inline constexpr int lanes = RealTraits<F>::lanes;

/// Stands for "beyond every scene", without the NaN that arithmetic on infinities brings.
inline constexpr double far_away = 1e18;
inline constexpr double pi = 3.14159265358979323846;

// --- one lane -----------------------------------------------------------------------------------

template <std::floating_point F>
constexpr F select(bool condition, F yes, F no) noexcept {
  return condition ? yes : no;
}
template <std::floating_point F>
constexpr F min(F a, F b) noexcept {
  return a < b ? a : b;
}
template <std::floating_point F>
constexpr F max(F a, F b) noexcept {
  return a > b ? a : b;
}
template <std::floating_point F>
F fma(F a, F b, F c) noexcept {
  return a * b + c;  // contracted where the machine has it; std::fma is a call where it has not
}
constexpr std::uint32_t min(std::uint32_t a, std::uint32_t b) noexcept { return a < b ? a : b; }
constexpr std::uint32_t max(std::uint32_t a, std::uint32_t b) noexcept { return a > b ? a : b; }
inline bool any(bool mask) noexcept { return mask; }
inline bool all(bool mask) noexcept { return mask; }
template <std::floating_point F>
F exp(F x) noexcept {
  return std::exp(x);
}
template <std::floating_point F>
F log(F x) noexcept {
  return std::log(x);
}
template <std::floating_point F>
F sqrt(F x) noexcept {
  return std::sqrt(x);
}
template <std::floating_point F>
F abs(F x) noexcept {
  return std::abs(x);
}

// --- many lanes ---------------------------------------------------------------------------------

inline FloatBatch select(Mask<FloatBatch> condition, FloatBatch yes, FloatBatch no) noexcept {
  return xsimd::select(condition, yes, no);
}
inline FloatBatch min(FloatBatch a, FloatBatch b) noexcept { return xsimd::min(a, b); }
inline FloatBatch max(FloatBatch a, FloatBatch b) noexcept { return xsimd::max(a, b); }
inline UInt<FloatBatch> min(UInt<FloatBatch> a, UInt<FloatBatch> b) noexcept {
  return xsimd::min(a, b);
}
inline UInt<FloatBatch> max(UInt<FloatBatch> a, UInt<FloatBatch> b) noexcept {
  return xsimd::max(a, b);
}
inline FloatBatch fma(FloatBatch a, FloatBatch b, FloatBatch c) noexcept {
  return xsimd::fma(a, b, c);
}
inline bool any(Mask<FloatBatch> mask) noexcept { return xsimd::any(mask); }
inline bool all(Mask<FloatBatch> mask) noexcept { return xsimd::all(mask); }
inline FloatBatch log(FloatBatch x) noexcept { return xsimd::log(x); }
inline FloatBatch sqrt(FloatBatch x) noexcept { return xsimd::sqrt(x); }
inline FloatBatch abs(FloatBatch x) noexcept { return xsimd::abs(x); }
inline FloatBatch exp(FloatBatch x) noexcept { return xsimd::exp(x); }

// --- all alike ----------------------------------------------------------------------------------

template <Real F>
F clamp(F x, F low, F high) noexcept {
  return min(max(x, low), high);
}

/// The scalar of a lane.
template <Real F>
Scalar<F> lane(F x, int i) noexcept {
  if constexpr (lanes<F> == 1)
    return x;
  else
    return x.get(std::size_t(i));
}

/// Reads `lanes<F>` scalars from memory.
template <Real F, class T>
F load(const T* values) noexcept {
  if constexpr (lanes<F> == 1)
    return F(*values);
  else
    return F::load_unaligned(values);
}

/// Reads `lanes<F>` unsigned numbers from memory.
template <Real F>
UInt<F> load_bits(const std::uint32_t* values) noexcept {
  if constexpr (lanes<F> == 1)
    return *values;
  else
    return UInt<F>::load_unaligned(values);
}

/// The scalars of a value in memory, a lane each, to be written one by one.
template <Real F>
Scalar<F>* scalars_of(F* values) noexcept {
  return reinterpret_cast<Scalar<F>*>(values);  // a register's type may alias its elements
}

/// Writes `lanes<F>` scalars to memory.
template <Real F, class T>
void store(F x, T* values) noexcept {
  if constexpr (lanes<F> == 1)
    *values = T(x);
  else
    x.store_unaligned(values);
}

/// Whether the instruction set keeps a mask of many lanes as a number.
inline constexpr bool masks_are_bits = sizeof(Mask<FloatBatch>) < sizeof(FloatBatch);

/// The bits of a mask, lane 0 lowest.
template <Real F>
std::uint32_t bits(Mask<F> mask) noexcept {
  if constexpr (lanes<F> == 1)
    return mask ? 1u : 0u;
  else if constexpr (masks_are_bits)
    return mask.data;
  else {
    alignas(64) float flags[lanes<F>];
    xsimd::select(mask, F(1.f), F(0.f)).store_aligned(flags);
    std::uint32_t result = 0;
    for (int i = 0; i < lanes<F>; ++i) result |= std::uint32_t(flags[i] != 0) << i;
    return result;
  }
}

/// A mask from its bits, lane 0 lowest.
template <Real F>
Mask<F> mask_from_bits(std::uint32_t mask) noexcept {
  if constexpr (lanes<F> == 1)
    return (mask & 1u) != 0;
  else if constexpr (masks_are_bits)
    return Mask<F>(static_cast<typename Mask<F>::register_type>(mask));
  else {
    alignas(64) float flags[lanes<F>];
    for (int i = 0; i < lanes<F>; ++i) flags[i] = float((mask >> i) & 1u);
    return F::load_aligned(flags) != F(0.f);
  }
}

/// Per lane, of unsigned numbers.
template <Real F>
UInt<F> select_bits(Mask<F> condition, UInt<F> yes, UInt<F> no) noexcept {
  if constexpr (lanes<F> == 1)
    return condition ? yes : no;
  else
    return xsimd::bitwise_cast<UInt<F>>(
        xsimd::select(condition, xsimd::bitwise_cast<F>(yes), xsimd::bitwise_cast<F>(no)));
}

/// Whether the lowest bit is set, lane by lane.
template <Real F>
Mask<F> is_odd(UInt<F> x) noexcept {
  if constexpr (lanes<F> == 1)
    return (x & 1u) != 0;
  else  // by the sign of a float, which every instruction set can test
    return xsimd::bitwise_cast<F>((x << 31) | UInt<F>(0x3f800000u)) < F(0);
}

/// Writes `lanes<F>` integers to memory: -1 where the mask is set, else 0.
template <Real F>
void store_mask(Mask<F> mask, std::int32_t* values) noexcept {
  if constexpr (lanes<F> == 1)
    *values = mask ? -1 : 0;
  else {
    using Int = xsimd::batch<std::int32_t>;
    const F ones = xsimd::bitwise_cast<F>(Int(-1));
    xsimd::bitwise_cast<Int>(xsimd::select(mask, ones, F(0.f))).store_unaligned(values);
  }
}

/// A number in [0, 1) from the upper 24 bits, the same in every arithmetic.
template <Real F>
F unit_interval(UInt<F> x) noexcept {
  if constexpr (lanes<F> == 1)
    return F(x >> 8) * F(0x1p-24);
  else {
    using Int = xsimd::batch<std::int32_t>;
    return xsimd::to_float(xsimd::bitwise_cast<Int>(x >> 8)) * F(0x1p-24f);
  }
}

/// x = 2^e (1 + f) for a normal x > 0, with 1 + f in [√½, √2). Returns e.
inline FloatBatch split_at_sqrt_half(FloatBatch x, FloatBatch& f) noexcept {
  using Int = xsimd::batch<std::int32_t>;
  const Int sqrt_half(0x3f3504f3);  // the bits of √½
  const Int bits = xsimd::bitwise_cast<Int>(x), e = (bits - sqrt_half) >> 23;
  f = xsimd::bitwise_cast<FloatBatch>(bits - (e << 23)) - FloatBatch(1.f);
  return xsimd::to_float(e);
}

/// Sums over lanes in a fixed order.
template <Real F>
double sum_lanes(F x) noexcept {
  double sum = 0;
  for (int i = 0; i < lanes<F>; ++i) sum += double(lane(x, i));
  return sum;
}

}  // namespace airlight::inline AIRLIGHT_ISA

#pragma once
/// Owen-scrambled Sobol points by hashing (Burley 2020, with Vegdahl's 2021 constants): sample i of
/// a pixel is point i of a sequence of its own, so that aligned blocks of a power of two are
/// jittered strata, wherever a render was cut.
#include "vec.h"

namespace airlight::inline AIRLIGHT_ISA {

/// A well mixed bijective hash of 32 bits (of the family of Wellons' lowbias32); U is std::uint32_t
/// or a batch of them.
template <class U>
constexpr U mix_bits(U x) noexcept {
  x = x ^ (x >> 16);
  x = x * U(0x21f0aaadu);
  x = x ^ (x >> 15);
  x = x * U(0x735a2d97u);
  return x ^ (x >> 15);
}

template <class U>
AIRLIGHT_INLINE U reverse_bits(U x) noexcept {
  x = ((x >> 1) & U(0x55555555u)) | ((x & U(0x55555555u)) << 1);
  x = ((x >> 2) & U(0x33333333u)) | ((x & U(0x33333333u)) << 2);
  x = ((x >> 4) & U(0x0f0f0f0fu)) | ((x & U(0x0f0f0f0fu)) << 4);
  x = ((x >> 8) & U(0x00ff00ffu)) | ((x & U(0x00ff00ffu)) << 8);
  return (x >> 16) | (x << 16);
}

/// Permutes so that a bit depends on the bits below it only (Laine and Karras 2011): between two
/// reversals, that is an Owen scramble.
template <class U>
AIRLIGHT_INLINE U laine_karras(U x, U seed) noexcept {
  x = x ^ (x * U(0x3d20adeau));
  x = x + seed;
  x = x * ((seed >> 16) | U(1u));
  x = x ^ (x * U(0x05526c56u));
  return x ^ (x * U(0x53a22864u));
}

/// Owen's nested uniform scramble of a 32 bit fraction.
template <class U>
U owen_scramble(U x, U seed) noexcept {
  return reverse_bits(laine_karras(reverse_bits(x), seed));
}

/// The second Sobol dimension of an index, its bits reversed; the first is the index itself,
/// reversed. Its generator matrix is Pascal's triangle modulo 2, whose row k takes the bits j that
/// contain k (Lucas): five steps.
template <class U>
constexpr U reversed_sobol_second(U index) noexcept {
  index = index ^ ((index >> 1) & U(0x55555555u));
  index = index ^ ((index >> 2) & U(0x33333333u));
  index = index ^ ((index >> 4) & U(0x0f0f0f0fu));
  index = index ^ ((index >> 8) & U(0x00ff00ffu));
  return index ^ ((index >> 16) & U(0x0000ffffu));
}

/// Whether an odd number of bits is set: 0 or 1.
template <class U>
constexpr U parity(U x) noexcept {
  x = x ^ (x >> 16), x = x ^ (x >> 8), x = x ^ (x >> 4), x = x ^ (x >> 2);
  return (x ^ (x >> 1)) & U(1u);
}

/// Which half of the samples one belongs to, by the parity of its bits: of every aligned block of
/// 2^k, each half is as well stratified as a block of 2^(k-1) in one dimension, and as one of
/// 2^(k-2) in two. The two halves tell the error of the whole.
constexpr int half_of(std::uint32_t index) noexcept { return int(parity(index)); }

/// One of the sequences of a packet of pixels: what its seeds cost is paid once.
template <Real F>
class Stream {
 public:
  Stream(UInt<F> hash, std::uint32_t id) noexcept
      : half_(id % 2 == 0 ? 0x6db6db6du : 0xdb6db6dbu),
        shuffle_(hash),
        one_(mix_bits(hash)),
        first_(mix_bits(hash ^ UInt<F>(0x9e3779b9u))),
        second_(mix_bits(hash ^ UInt<F>(0x7f4a7c15u))) {}

  /// Point i of a stratified sequence in [0, 1): any aligned block of 2^k indices has one point in
  /// each interval of length 2^-k.
  AIRLIGHT_INLINE F one(std::uint32_t index) const noexcept {
    return unit_interval<F>(bits(index));
  }
  /// The bits that it is made of, the upper 24: numbers in the same order.
  AIRLIGHT_INLINE UInt<F> bits(std::uint32_t index) const noexcept {
    // reverse(index) is the van der Corput point; its scramble reverses it once more.
    return scrambled(UInt<F>(index), one_);
  }
  /// Of another index in each lane, shuffled so that streams do not move together.
  AIRLIGHT_INLINE F one_each(UInt<F> index) const noexcept {
    return unit_interval<F>(bits_each(index));
  }
  AIRLIGHT_INLINE UInt<F> bits_each(UInt<F> index) const noexcept {
    return scrambled(owen_scramble(index, shuffle_), one_);
  }

  /// Point i of a (0, 2)-sequence in the square, shuffled so that streams do not move together.
  AIRLIGHT_INLINE Vec2<F> two(std::uint32_t index) const noexcept {
    return two_each(UInt<F>(index));
  }
  AIRLIGHT_INLINE Vec2<F> two_each(UInt<F> index) const noexcept {
    UInt<F> shuffled = owen_scramble(index, shuffle_);
    shuffled = shuffled ^ parity((shuffled & UInt<F>(half_)) ^ index);
    return {scramble(shuffled, first_), scramble(reversed_sobol_second(shuffled), second_)};
  }

 private:
  AIRLIGHT_INLINE static UInt<F> scrambled(UInt<F> reversed, UInt<F> seed) noexcept {
    return reverse_bits(laine_karras(reversed, seed));
  }
  AIRLIGHT_INLINE static F scramble(UInt<F> reversed, UInt<F> seed) noexcept {
    return unit_interval<F>(scrambled(reversed, seed));
  }

  /// The shuffle keeps to the halves: its last bit is such that the parity of these bits is that of
  /// the index. Parity of all bits would be the second dimension's first. Of the others those that
  /// leave out every third bit, and they alone, cut all blocks of 2^k into two (1, k-1, 2)-nets
  /// (found by trying all periods up to 8, k up to 16). Of the two that keep the last bit, even
  /// streams take one and odd ones the other: the first bits of their points are independent.
  std::uint32_t half_;
  UInt<F> shuffle_, one_, first_, second_;
};

/// The points of a packet of pixels. Each purpose draws from a stream of its own; streams are
/// independent.
template <Real F>
struct Sampler {
  UInt<F> pixel_hash;  ///< of (seed, pixel), a lane a pixel

  /// The streams' hashes are mixed again before they scramble: the low bits, which decide the
  /// stratum, of one mix of h ^ a and of h ^ b are not independent over h.
  Stream<F> stream(std::uint32_t id) const noexcept {
    return Stream<F>(mix_bits(pixel_hash ^ UInt<F>(mix_bits(id))), id);
  }

  F one(std::uint32_t index, std::uint32_t id) const noexcept { return stream(id).one(index); }
  Vec2<F> two(std::uint32_t index, std::uint32_t id) const noexcept {
    return stream(id).two(index);
  }
};

/// The points of a packet of paths at one vertex of each. A lane knows its pixel, the number of its
/// path and how far along it is, so a point is named by its stream alone: the index that an
/// estimator asks for, always 0 of one sample, does not count. All streams are shuffled: what moves
/// together at two vertices of a pixel's paths would never average out.
template <Real F>
struct PathSampler {
  UInt<F> pixel_hash;  ///< of (seed, pixel)
  UInt<F> index;       ///< of the path in its pixel
  UInt<F> vertex;      ///< segments of the path before this one

  struct Points {
    Stream<F> stream;
    UInt<F> index;

    F one(std::uint32_t) const noexcept { return stream.one_each(index); }
    UInt<F> bits(std::uint32_t) const noexcept { return stream.bits_each(index); }
    Vec2<F> two(std::uint32_t) const noexcept { return stream.two_each(index); }
  };

  Points stream(std::uint32_t id) const noexcept {
    const UInt<F> here = UInt<F>(id) + vertex * UInt<F>(0x9e3779b9u);
    return {Stream<F>(mix_bits(pixel_hash ^ mix_bits(here)), id), index};
  }

  F one(std::uint32_t, std::uint32_t id) const noexcept { return stream(id).one(0); }
  Vec2<F> two(std::uint32_t, std::uint32_t id) const noexcept { return stream(id).two(0); }
};

/// Where an estimator's random numbers come from: points in [0, 1) or in the square, by index and
/// stream.
template <class S, class F>
concept DrawsPoints = requires(const S sampler) {
  { sampler.stream(0u).one(0u) } -> std::same_as<F>;
  { sampler.stream(0u).bits(0u) } -> std::same_as<UInt<F>>;
  { sampler.stream(0u).two(0u) } -> std::same_as<Vec2<F>>;
  { sampler.two(0u, 0u) } -> std::same_as<Vec2<F>>;
};

/// The hash from which a pixel's samples follow, or those of a packet of pixels.
template <class U = std::uint32_t>
constexpr U pixel_hash(std::uint32_t seed, std::type_identity_t<U> x,
                       std::type_identity_t<U> y) noexcept {
  return mix_bits(mix_bits(U(mix_bits(seed ^ 0xa511e9b3u)) + x) + (y ^ U(0x63d83595u)));
}

}  // namespace airlight::inline AIRLIGHT_ISA

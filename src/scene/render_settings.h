#pragma once
#include <airlight/describe.h>

#include <cstdint>
#include <optional>
#include <string>

namespace airlight {

enum class Edges { cached, per_step };
enum class MixWith { equidistant, distance };
enum class Continuation { distance, mix, whole_volume, sample };
enum class SurfaceSums { split, ratio };
enum class LightSelection { all, unoccluded, uniform };
enum class PixelFilter { box, tent, gaussian };
enum class Noise { per_frame, still };
enum class Visibility { embree, analytic };
enum class InstructionSet { best, reference, scalar, baseline, avx2, avx512 };

template <>
inline constexpr Word<Edges> words<Edges>[] = {
    {"cached", Edges::cached, "the trapezoids of a ray are found once"},
    {"per_step", Edges::per_step,
     "the medium is intersected at every sample, as a plain march does"},
};
template <>
inline constexpr Word<MixWith> words<MixWith>[] = {
    {"equidistant", MixWith::equidistant, "samples spread evenly along the ray"},
    {"distance", MixWith::distance, "samples by what passes back to the camera"},
};
template <>
inline constexpr Word<Continuation> words<Continuation>[] = {
    {"distance", Continuation::distance, "from a free flight of its own: no weight ever grows"},
    {"mix", Continuation::mix,
     "from the sample that asks for light, half of them drawn by whole_volume, half by distance"},
    {"whole_volume", Continuation::whole_volume,
     "from the sample that asks for light, drawn by whole_volume: unbiased, but with rare "
     "fireflies in dense fog"},
    {"sample", Continuation::sample,
     "from the sample that asks for light, wherever the estimator draws it, as in Velinov 2021"},
};
template <>
inline constexpr Word<SurfaceSums> words<SurfaceSums>[] = {
    {"split", SurfaceSums::split, "light on surfaces is a plain sum beside the medium's"},
    {"ratio", SurfaceSums::ratio, "light on surfaces is folded into the estimator's form"},
};
template <>
inline constexpr Word<LightSelection> words<LightSelection>[] = {
    {"all", LightSelection::all, "every sample asks every light"},
    {"unoccluded", LightSelection::unoccluded,
     "every sample asks one light, picked by what it would give if nothing stood in its way"},
    {"uniform", LightSelection::uniform, "every sample asks one light, picked blindly"},
};
template <>
inline constexpr Word<PixelFilter> words<PixelFilter>[] = {
    {"box", PixelFilter::box, "the pixel's square"},
    {"tent", PixelFilter::tent, "a tent of radius one pixel"},
    {"gaussian", PixelFilter::gaussian, "standard deviation 0.5, cut at 1.5 pixels"},
};
template <>
inline constexpr Word<Noise> words<Noise>[] = {
    {"per_frame", Noise::per_frame, "new in every frame, as film grain is"},
    {"still", Noise::still, "the same in all frames, for pictures to be compared"},
};
template <>
inline constexpr Word<Visibility> words<Visibility>[] = {
    {"embree", Visibility::embree, "ray casting by Embree, in float"},
    {"analytic", Visibility::analytic,
     "every object in turn, in the kernel's own arithmetic; for exact tests"},
};
template <>
inline constexpr Word<InstructionSet> words<InstructionSet>[] = {
    {"best", InstructionSet::best, "the widest this machine has"},
    {"double", InstructionSet::reference, "one lane in double precision, the reference"},
    {"scalar", InstructionSet::scalar, "one lane in float"},
    {"baseline", InstructionSet::baseline, "4 lanes, any x86-64 (SSE2)"},
    {"avx2", InstructionSet::avx2, "8 lanes"},
    {"avx512", InstructionSet::avx512, "16 lanes"},
};

/// How a picture is made. Every number can stand in the scene file's [render] table and on the
/// command line.
struct RenderSettings {
  std::string estimator = "rewv";  ///< a short name, or placement+form
  Edges edges = Edges::cached;
  MixWith mix_with = MixWith::distance;
  double mix_weight = 0.5;
  std::int64_t max_depth = 1;
  Continuation continuation = Continuation::distance;
  SurfaceSums surface = SurfaceSums::split;
  LightSelection light_selection = LightSelection::all;
  std::int64_t spp = 16;
  std::int64_t samples_per_ray = 4;  ///< 0: all
  std::int64_t seed = 0;
  Noise noise = Noise::per_frame;
  std::optional<std::int64_t> first_sample;
  PixelFilter filter = PixelFilter::tent;
  Visibility visibility = Visibility::embree;
  InstructionSet isa = InstructionSet::best;
  std::int64_t threads = 0;
  std::int64_t frame = 0;
  double fps = 24;

  /// The moment that the frame shows.  [s]
  double seconds() const { return double(frame) / fps; }

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using S = RenderSettings;
    field("estimator", &S::estimator, unit::none, any_number(),
          "how light in the medium is summed: rm, mcds, mcwvds, rees, reds, rewv, closed_form, or "
          "placement+form");
    field("edges", &S::edges, unit::none, any_number(),
          "where a sample's way to the boundary comes from");
    field("mix_with", &S::mix_with, unit::none, any_number(),
          "the placement that placement mix combines with whole_volume");
    field("mix_weight", &S::mix_weight, unit::one, open(0, 1),
          "the part of the samples that mix_with draws");
    field("max_depth", &S::max_depth, unit::none, closed(1, 65536),
          "how often light may scatter in the medium or bounce off surfaces; 1: once");
    field("continuation", &S::continuation, unit::none, any_number(),
          "where a path of max_depth above 1 scatters next");
    field("surface", &S::surface, unit::none, any_number(),
          "how paths of max_depth above 1 sum the light on surfaces");
    field("light_selection", &S::light_selection, unit::none, any_number(),
          "which lights a visibility sample in the medium asks; surfaces ask all");
    field("spp", &S::spp, unit::none, closed(1, 1 << 28),
          "visibility samples a pixel gets, for each light unless light_selection says otherwise");
    field("samples_per_ray", &S::samples_per_ray, unit::none, closed(0, 1 << 28),
          "how many of them share a camera ray, a power of two; 0, or spp up to this without "
          "first_sample: all, through the pixel's centre, without filter");
    field("seed", &S::seed, unit::none, closed(0, 4294967295.), "another seed gives other noise");
    field("noise", &S::noise, unit::none, any_number(), "what noise does from frame to frame");
    field("first_sample", &S::first_sample, unit::none, closed(0, 1 << 28),
          "where a range of samples starts, for pictures to be merged");
    field("filter", &S::filter, unit::none, any_number(),
          "how camera rays spread about a pixel's centre");
    field("visibility", &S::visibility, unit::none, any_number(), "what answers shadow rays");
    field("isa", &S::isa, unit::none, any_number(),
          "the arithmetic and instruction set to compute with");
    field("threads", &S::threads, unit::none, closed(0, 4096), "worker threads; 0: one a core");
    field("frame", &S::frame, unit::none, closed(0, 1 << 24),
          "which moment of an animation is shown, counted from 0");
    field("fps", &S::fps, unit::none, closed(1e-3, 1e6), "frames a second of an animation");
  }
};

}  // namespace airlight

// Settings that don't fit each other, the scene or the machine are refused in the user's words,
// before a ray is traced; those that fit are taken.
#include <gmock/gmock.h>

#include <functional>

#include "error.h"
#include "render/prepare.h"
#include "render/render.h"

namespace airlight {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A cube of fog in the sun with a ball in it.
Scene scene() {
  Scene scene;
  scene.resolution = {6, 4};
  Medium medium;
  medium.sigma_s = Rgb<double>(0.5);
  medium.sigma_t = Rgb<double>(1.);
  scene.media = {medium};
  scene.lights = {Directional{}};
  scene.objects = {{"ball", Sphere{{0, 0, 0}, 0.5}, {}}};
  scene.render.threads = 1;
  scene.render.spp = 2;
  return scene;
}

/// What the scene is refused with; empty if it is rendered.
std::string refusal(const Scene& scene, const std::optional<PixelRect>& crop = {}) {
  RenderControl control;
  control.crop = crop;
  std::string checked, rendered;
  Renderer renderer(scene);
  try {
    renderer.check(scene.render);
  } catch (const Error& error) {
    checked = error.what();
  }
  try {
    renderer.render(scene.render, control);
  } catch (const Error& error) {
    rendered = error.what();
  }
  if (!crop) {
    EXPECT_EQ(checked, rendered);  // `check` says all that `render` would
  }
  EXPECT_THAT(rendered, Not(HasSubstr("\n")));
  return rendered;
}

/// The same after a change.
std::string refusal_of(const std::function<void(Scene&)>& change) {
  Scene changed = scene();
  change(changed);
  return refusal(changed);
}

TEST(Settings, that_fit_are_taken) {
  for (const ShortName& name : short_names)
    EXPECT_EQ(refusal_of([&](Scene& s) { s.render.estimator = name.name; }), "") << name.name;
  EXPECT_EQ(refusal_of([](Scene& s) { s.render.estimator = "closed_form"; }), "");
  for (const char* placement : {"equidistant", "distance", "whole_volume", "mix"})
    for (const char* form : {"monte_carlo", "ratio", "difference"})
      EXPECT_EQ(
          refusal_of([&](Scene& s) { s.render.estimator = std::string(placement) + "+" + form; }),
          "");
}

TEST(Settings, an_unknown_estimator_is_answered_by_those_there_are) {
  for (const char* name : {"", "rw", "REWV", "whole_volume", "ratio+whole_volume", "rewv+",
                           "whole_volume+ratio+ratio", "+", "rewv ", "equiangular+ratio"}) {
    const std::string said = refusal_of([&](Scene& s) { s.render.estimator = name; });
    EXPECT_THAT(said,
                AllOf(HasSubstr("render.estimator"), HasSubstr("\"" + std::string(name) + "\""),
                      HasSubstr("accepted: rm, mcds, mcwvds, rees, reds, rewv, closed_form"),
                      HasSubstr("distance, equidistant, mix, whole_volume"),
                      HasSubstr("difference, monte_carlo, ratio")))
        << name;
  }
}

TEST(Settings, samples_per_ray_is_a_power_of_two_or_all) {
  for (int n : {0, 1, 2, 4, 64, 1 << 28})
    EXPECT_EQ(refusal_of([&](Scene& s) { s.render.samples_per_ray = n; }), "") << n;
  for (int n : {3, 5, 6, 7, 12, 100, (1 << 28) - 1})
    EXPECT_THAT(refusal_of([&](Scene& s) { s.render.samples_per_ray = n; }),
                AllOf(HasSubstr("render.samples_per_ray = " + std::to_string(n)),
                      HasSubstr("power of two"), HasSubstr("accepted")))
        << n;
}

TEST(Settings, a_range_of_samples_ends_before_the_sequence_does) {
  EXPECT_EQ(refusal_of([](Scene& s) { s.render.first_sample = (1 << 29) - 2; }), "");
  EXPECT_THAT(refusal_of([](Scene& s) { s.render.first_sample = (1 << 29) - 1; }),
              AllOf(HasSubstr("render.first_sample"), HasSubstr("536870912")));
}

TEST(Settings, a_march_of_every_step_goes_with_rm_only) {
  EXPECT_EQ(refusal_of([](Scene& s) {
              s.render.estimator = "rm";
              s.render.edges = Edges::per_step;
            }),
            "");
  for (const char* other : {"rees", "mcds", "rewv", "mix+monte_carlo", "equidistant+difference"})
    EXPECT_THAT(
        refusal_of([&](Scene& s) {
          s.render.estimator = other;
          s.render.edges = Edges::per_step;
        }),
        AllOf(HasSubstr(other), HasSubstr("lights.0"), HasSubstr("per_step"), HasSubstr("rm")))
        << other;
}

TEST(Settings, paths_need_an_estimator_that_samples) {
  EXPECT_EQ(refusal_of([](Scene& s) { s.render.max_depth = 8; }), "");
  EXPECT_EQ(
      refusal_of([](Scene& s) {
        s.render.max_depth = 8;
        s.render.estimator = "closed_form";
      }),
      "render.max_depth = 8: estimator closed_form knows light that scatters once; accepted: 1, "
      "or an estimator that samples, such as rewv");
  EXPECT_EQ(refusal_of([](Scene& s) {
              s.render.max_depth = 2;
              s.render.estimator = "rm";
              s.render.edges = Edges::per_step;
            }),
            "render.max_depth = 2: edges = \"per_step\" is the plain march of light that scatters "
            "once; accepted: 1, or edges = \"cached\"");
}

TEST(Settings, paths_go_on_from_samples_of_the_whole_volume_only) {
  EXPECT_EQ(refusal_of([](Scene& s) {
              s.render.max_depth = 2;
              s.render.continuation = Continuation::mix;
            }),
            "");
  EXPECT_EQ(
      refusal_of([](Scene& s) {
        s.render.max_depth = 2;
        s.render.estimator = "reds";
        s.render.continuation = Continuation::whole_volume;
      }),
      "render.continuation = \"whole_volume\" goes on from samples of whole_volume, which "
      "estimator reds does not draw; accepted: \"distance\", \"sample\", or an estimator such "
      "as rewv or mcwvds");
}

TEST(Settings, the_closed_form_is_for_parallel_light_among_opaque_objects) {
  const auto exact = [](Scene& s) { s.render.estimator = "closed_form"; };
  EXPECT_THAT(refusal_of([&](Scene& s) {
                exact(s);
                s.lights.push_back(Directional{.angular_diameter = 0.53});
              }),
              AllOf(HasSubstr("closed_form"), HasSubstr("lights.1"), HasSubstr("parallel"),
                    HasSubstr("angular_diameter")));
  EXPECT_THAT(refusal_of([&](Scene& s) {
                exact(s);
                s.objects[0].material.opacity = 0.5;
              }),
              AllOf(HasSubstr("closed_form"), HasSubstr("opaque")));
  EXPECT_THAT(refusal_of([&](Scene& s) {
                exact(s);
                s.textures.push_back({1, 1, {255, 255, 255, 0}});
                s.objects[0].material.opacity_texture = 0;
                s.objects[0].material.opacity_from_alpha = true;
              }),
              AllOf(HasSubstr("closed_form"), HasSubstr("opaque")));
}

TEST(Settings, parallel_light_never_arrives_in_a_medium_without_end) {
  for (const char* estimator : {"rewv", "rm", "mix+difference", "closed_form"})
    EXPECT_THAT(refusal_of([&](Scene& s) {
                  s.render.estimator = estimator;
                  s.media[0].shape = Unbounded{};
                }),
                AllOf(HasSubstr(estimator), HasSubstr("lights.0"), HasSubstr("never arrives"),
                      HasSubstr("shape with an end")))
        << estimator;
  EXPECT_EQ(refusal_of([](Scene& s) {
              s.media[0].shape = Unbounded{};
              s.lights.clear();
            }),
            "");
}

TEST(Settings, without_a_medium_any_light_will_do) {
  for (const char* estimator : {"rewv", "closed_form"})
    EXPECT_EQ(refusal_of([&](Scene& s) {
                s.media.clear();
                s.render.estimator = estimator;
              }),
              "")
        << estimator;
}

TEST(Settings, instructions_that_the_machine_lacks_are_answered_by_those_it_has) {
  const auto machine = available_kernels();
  for (InstructionSet isa :
       {InstructionSet::reference, InstructionSet::scalar, InstructionSet::baseline,
        InstructionSet::avx2, InstructionSet::avx512}) {
    const bool runs =
        std::ranges::any_of(machine, [&](const Kernel* kernel) { return kernel->isa == isa; });
    const std::string said = refusal_of([&](Scene& s) { s.render.isa = isa; });
    if (runs)
      EXPECT_EQ(said, "");
    else
      EXPECT_THAT(said, AllOf(HasSubstr("isa"), HasSubstr("accepted here: best, double, scalar")));
  }
  // What no machine has.
  EXPECT_THAT(refusal_of([](Scene& s) { s.render.isa = InstructionSet(99); }),
              AllOf(HasSubstr("isa"), HasSubstr("accepted here: best, double, scalar, baseline")));
}

TEST(Settings, a_crop_lies_in_the_picture) {
  const Scene fog = scene();  // 6 x 4
  for (const PixelRect& good :
       {PixelRect{0, 0, 6, 4}, PixelRect{5, 3, 1, 1}, PixelRect{0, 3, 6, 1}})
    EXPECT_EQ(refusal(fog, good), "");
  for (const PixelRect& bad :
       {PixelRect{-1, 0, 2, 2}, PixelRect{0, -1, 2, 2}, PixelRect{0, 0, 7, 4},
        PixelRect{0, 0, 6, 5}, PixelRect{5, 3, 2, 1}, PixelRect{6, 0, 1, 1}, PixelRect{0, 0, 0, 1},
        PixelRect{0, 0, 1, -1}, PixelRect{2147483647, 0, 1, 1},
        PixelRect{1, 1, 2147483647, 2147483647}})
    EXPECT_THAT(refusal(fog, bad),
                AllOf(HasSubstr("crop " + std::to_string(bad.x0)), HasSubstr("6 x 4")));
}

TEST(Settings, films_of_other_parts_are_not_merged) {
  Film film({6, 4}, {0, 0, 3, 2});
  EXPECT_NO_THROW(film.merge(Film({6, 4}, {0, 0, 3, 2})));
  for (const Film& other : {Film({6, 4}, {0, 0, 2, 2}), Film({6, 4}, {0, 0, 3, 1}),
                            Film({6, 4}, {3, 2, 3, 2}), Film({6, 5}, {0, 0, 3, 2})})
    EXPECT_THAT([&] { film.merge(other); },
                testing::ThrowsMessage<Error>(
                    AllOf(HasSubstr("3 x 2 pixels at 0,0 of 6 x 4"), HasSubstr("accepted"))));
}

}  // namespace
}  // namespace airlight

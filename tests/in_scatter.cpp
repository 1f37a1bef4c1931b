// The call for a program that has a renderer of its own: in_scatter with a world of its own.

#include <airlight/in_scatter.h>
#include <gtest/gtest.h>

namespace airlight {
namespace {

Medium fog(Rgb<double> sigma_t) {
  Medium medium;
  medium.sigma_s = sigma_t * 0.8;
  medium.sigma_t = sigma_t;
  medium.phase = HenyeyGreenstein{0.3};
  medium.shape = Box{};
  return medium;
}

const Medium grey = fog(Rgb<double>(0.5));
const Medium chromatic = fog({0.3, 1, 3});
const Directional sun{.irradiance = {3, 2, 1}, .direction = normalize(Vec3<double>(1, -2, -0.5))};
const CameraRay<double> ray{.origin = {0.2, 0.1, 3}, .direction = {0, 0, -1}};
const Sampler<double> sampler{pixel_hash(1, 2, 3)};
const Sampled rewv{.placement = WholeVolume{}, .form = Ratio{}};
const Sampled mcwvds{.placement = WholeVolume{}, .form = MonteCarlo{}};

void expect_near(Rgb<double> found, Rgb<double> truth, double relative) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(found[c], truth[c], relative * std::abs(truth[c])) << "channel " << c;
}

TEST(InScatter, has_the_value_of_the_cube_of_fog) {
  // scenes/cube_of_fog.toml derives it: every way through the cube is 2 m long.
  Medium medium;
  medium.sigma_s = Rgb<double>(0.4), medium.sigma_t = Rgb<double>(0.5);
  const Directional behind{.direction = {0, 0, 1}};
  const Rgb<double> truth(0.4 / (4 * pi) * 2 * std::exp(-1.));
  expect_near(in_scatter(ClosedForm{}, medium, behind, ray, Unshadowed{}), truth, 1e-14);
}

TEST(InScatter, is_exact_without_shadows_where_the_placement_is) {
  const Rgb<double> truth = in_scatter(ClosedForm{}, grey, sun, ray, Unshadowed{});
  EXPECT_GT(truth.r, 0);
  expect_near(in_scatter(mcwvds, grey, sun, ray, 1, sampler, Unshadowed{}).radiance(), truth,
              1e-13);
  expect_near(in_scatter(rewv, chromatic, sun, ray, 1, sampler, Unshadowed{}).radiance(),
              in_scatter(ClosedForm{}, chromatic, sun, ray, Unshadowed{}), 1e-13);
}

TEST(InScatter, ends_at_a_surface_and_is_nothing_beside_the_medium) {
  CameraRay<double> halved = ray;
  halved.t_max = 3;  // the ray is in the box from 2 to 4
  const Rgb<double> whole = in_scatter(ClosedForm{}, grey, sun, ray, Unshadowed{});
  const Rgb<double> front = in_scatter(ClosedForm{}, grey, sun, halved, Unshadowed{});
  EXPECT_GT(front.r, 0);
  EXPECT_LT(front.r, whole.r);
  // The part behind the surface is what a ray from there adds, dimmed by the metre before it.
  CameraRay<double> behind = ray;
  behind.origin.z = 0;
  const Rgb<double> rest = in_scatter(ClosedForm{}, grey, sun, behind, Unshadowed{});
  expect_near(front + rest * std::exp(-0.5), whole, 1e-13);

  const CameraRay<double> beside{.origin = {5, 0, 3}, .direction = {0, 0, -1}};
  EXPECT_EQ(in_scatter(ClosedForm{}, grey, sun, beside, Unshadowed{}), Rgb<double>());
  EXPECT_EQ(in_scatter(rewv, grey, sun, beside, 4, sampler, Unshadowed{}).radiance(),
            Rgb<double>());
}

/// Dark behind z = 0 for the samples; what the closed form is told is the same.
struct DarkBehindZero {
  Rgb<double> transmit(Vec3<double> from, Vec3<double>, double, int, bool) const {
    return Rgb<double>(from.z > 0 ? 1. : 0.);
  }
  template <class Sink>
  void lit(Vec3<double> entry, Vec3<double> direction, double t_max, int, Sink&& sink) const {
    sink(0, std::min(t_max, -entry.z / direction.z));
  }
};

TEST(InScatter, meets_the_closed_form_among_shadows) {
  // One shadow edge: of n stratified samples one is in doubt, an error of about 1 / n of the
  // unshadowed radiance; more than a third of it is lit, and numerator and denominator both err.
  constexpr int n = 1 << 14;
  for (const Medium& medium : {grey, chromatic}) {
    const Rgb<double> truth = in_scatter(ClosedForm{}, medium, sun, ray, DarkBehindZero{});
    expect_near(in_scatter(rewv, medium, sun, ray, n, sampler, DarkBehindZero{}).radiance(), truth,
                4. / n);
  }
}

TEST(InScatter, is_nothing_without_samples) {
  for (const Sampled& estimator : {rewv, mcwvds}) {
    const auto none = in_scatter(estimator, grey, sun, ray, 0, sampler, Unshadowed{});
    EXPECT_EQ(none.radiance(), Rgb<double>());
    EXPECT_EQ(none.unoccluded, Rgb<double>());
  }
}

TEST(InScatter, sees_the_first_of_more_media_than_fit) {
  std::vector<Medium> media(40, grey);
  for (std::size_t i = 0; i < media.size(); ++i)
    media[i].shape = Box{.min = {-1, -1, -2. * double(i) - 2}, .max = {1, 1, -2. * double(i)}};
  const auto seen = [&](std::size_t count) {
    return in_scatter(ClosedForm{}, std::span<const Medium>(media).first(count), sun, ray,
                      Unshadowed{});
  };
  EXPECT_GT(seen(16).r, seen(15).r);
  EXPECT_EQ(seen(40), seen(16));
}

TEST(InScatter, takes_a_function_for_a_world) {
  const VisibleBy number{[](auto from, auto, auto) { return from.z > 0 ? 1. : 0.; }};
  const VisibleBy colour{
      [](auto from, auto, auto) { return from.z > 0 ? Rgb<double>(1, 0.5, 0) : Rgb<double>(); }};
  const Rgb<double> same =
      in_scatter(rewv, grey, sun, ray, 16, sampler, DarkBehindZero{}).radiance();
  expect_near(in_scatter(rewv, grey, sun, ray, 16, sampler, number).radiance(), same, 0);
  expect_near(in_scatter(rewv, grey, sun, ray, 16, sampler, colour).radiance(),
              same * Rgb<double>(1, 0.5, 0), 1e-15);
}

TEST(InScatter, says_the_same_in_every_lane) {
  using F = FloatBatch;
  const CameraRay<F> rays{.origin = Vec3<F>(ray.origin), .direction = Vec3<F>(ray.direction)};
  const Sampler<F> same_pixel{UInt<F>(pixel_hash(1, 2, 3))};
  const Rgb<F> found =
      in_scatter(rewv, chromatic, sun, rays, 4, same_pixel, Unshadowed{}).radiance();
  const Rgb<double> truth = in_scatter(ClosedForm{}, chromatic, sun, ray, Unshadowed{});
  for (int i = 0; i < lanes<F>; ++i)  // optical depths up to 10: (1 + depth) 2.5e-6
    expect_near({lane(found.r, i), lane(found.g, i), lane(found.b, i)}, truth, 3e-5);
}

}  // namespace
}  // namespace airlight

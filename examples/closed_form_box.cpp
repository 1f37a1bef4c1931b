// Light scattered once in a box of fog, along one ray: the closed form, and samples that ask a
// visibility of our own. Nothing but the headers of the papers is used; a renderer with rays of its
// own would do the same.
#include <airlight/in_scatter.h>

#include <cmath>
#include <cstdio>

using namespace airlight;

int main() {
  Medium fog;
  fog.sigma_s = Rgb<double>(0.4);  // [1/m]
  fog.sigma_t = Rgb<double>(0.5);
  fog.phase = HenyeyGreenstein{.g = 0.3};
  fog.shape = Box{.min = {-1, -1, -1}, .max = {1, 1, 1}};
  const Directional sun{.irradiance = Rgb<double>(10),
                        .direction = normalize(Vec3<double>(1, -2, -0.5))};
  const CameraRay<double> ray{.origin = {0.2, 0.1, 3}, .direction = {0, 0, -1}};

  // A ball between part of the ray and the sun: does a ray from a point towards the light meet it?
  const Vec3<double> centre = sun.toward() * 0.6;
  constexpr double radius = 0.4;
  const VisibleBy ball{[&](Vec3<double> from, Vec3<double> direction, double) {
    const Vec3<double> o = from - centre;
    const double b = dot(o, direction), c = dot(o, o) - radius * radius;
    return c > 0 && (b > 0 || b * b < c) ? 1. : 0.;
  }};

  const Sampled whole_volume{.placement = WholeVolume{}, .form = Ratio{}};
  const Sampled ray_marching{.placement = Equidistant{}, .form = MonteCarlo{}};
  const Sampler<double> sampler{pixel_hash(/*seed*/ 1, /*x*/ 0, /*y*/ 0)};
  const auto sampled = [&](const Sampled& how, std::uint32_t samples, const auto& world) {
    return in_scatter(how, fog, sun, ray, samples, sampler, world).radiance().r;
  };

  const double closed_form = in_scatter(ClosedForm{}, fog, sun, ray, Unshadowed{}).r;
  const double one_sample = sampled(whole_volume, 1, Unshadowed{});
  std::printf("unshadowed   closed form                 %.6f W/(m2 sr)\n", closed_form);
  std::printf("             whole volume,     1 sample  %.6f\n", one_sample);
  std::printf("             ray marching,    16 samples %.6f\n",
              sampled(ray_marching, 16, Unshadowed{}));
  std::printf("with a ball  whole volume,    16 samples %.6f\n", sampled(whole_volume, 16, ball));
  std::printf("             whole volume, 65536 samples %.6f\n",
              sampled(whole_volume, 65536, ball));
  std::printf("             ray marching,    16 samples %.6f\n", sampled(ray_marching, 16, ball));
  return std::abs(one_sample / closed_form - 1) < 1e-12 ? 0 : 1;
}

// The same text for every instruction set: the core's AIRLIGHT_ISA says which this is.

#include "box_transmittance_kernel.h"

#include <airlight/section.h>
#include <airlight/shapes/box.h>

namespace {

using namespace airlight;

template <Real F>
void integrate(const bench::BoxRays& rays) {
  const auto vec = [](const double* v) { return Vec3<F>(Vec3<double>(v[0], v[1], v[2])); };
  const Box::Space space = Box{}.space();
  const Vec3<F> eye = space.point(vec(rays.eye)), w = space.vector(vec(rays.toward_light));
  const Channels<F, 1> sigma_t = {F(float(rays.sigma_t))};
  for (int i = 0; i < rays.count; i += lanes<F>) {
    const Vec3<F> d =
        space.vector(Vec3<F>(load<F>(rays.x + i), load<F>(rays.y + i), load<F>(rays.z + i)));
    const LocalRay<F> ray{eye, d};
    const Interval<F> inside = space.clip(ray);
    const F t_max = max(inside.t_exit - inside.t_enter, F(0));
    Section<F, 1, Box::Space> section(space, {ray(inside.t_enter), d}, w, t_max, sigma_t);
    section.trace_way_out();
    store(section.integral[0], rays.integral + i);
  }
}

}  // namespace

#define AIRLIGHT_JOIN(name, isa) name##isa
#define AIRLIGHT_ENTRY(name, isa) AIRLIGHT_JOIN(name, isa)

extern "C" void AIRLIGHT_ENTRY(airlight_box_transmittance_,
                               AIRLIGHT_ISA)(const bench::BoxRays& rays, bool one_lane) {
  if (one_lane)
    integrate<float>(rays);
  else
    integrate<FloatBatch>(rays);
}

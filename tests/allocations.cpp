// A kernel asks for memory once a tile: never for a ray or a sample.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "render/prepare.h"
#include "render/render.h"
#include "support/brute_force.h"

namespace {
std::atomic<int> allocations = 0;
}

[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace airlight {
namespace {

/// A ball and a wall in fog.
Scene scene_of(const char* estimator, std::int64_t max_depth) {
  Scene scene;
  scene.resolution = {16, 16};
  scene.camera = {.position = {0.3, 0.2, 3.6}, .target = {0, 0, 0}, .up = {0, 1, 0}, .fov = 40};
  scene.media = {Medium{}};
  scene.media[0].sigma_s = {0.2, 0.4, 0.9}, scene.media[0].sigma_t = {0.3, 0.7, 1.6};
  scene.lights = {Directional{.direction = normalize(Vec3<double>(-0.4, -1, -0.3))}};
  const test::Sheet wall{.corner = {-3, -3, -1.5}, .right = {6, 0, 0}, .up = {0, 6, 0}};
  scene.objects = {{"ball", Sphere{{0, 0, 0}, 0.5}, {}}, wall.object("wall")};
  scene.render.estimator = estimator;
  scene.render.max_depth = max_depth;
  return scene;
}

/// While one tile is rendered.
int allocations_of(const Scene& scene, int width, std::int64_t spp, InstructionSet isa) {
  RenderSettings settings = scene.render;
  settings.spp = spp;
  settings.isa = isa;
  const World world(scene, Visibility::analytic);
  const Prepared prepared = prepare(scene, world, settings);
  Film film(scene.resolution, {0, 0, width, width}, prepared.frame.layout, {""});
  Tile tile{film.tile(0), prepared.samples, film};
  const int before = allocations;
  prepared.kernel.render(prepared.frame, tile);
  return allocations - before;
}

TEST(Kernels, ask_for_memory_by_the_tile_not_by_the_ray) {
  for (const auto& [estimator, max_depth] : std::initializer_list<std::pair<const char*, int>>{
           {"rewv", 1}, {"mcds", 1}, {"rm", 1}, {"closed_form", 1}, {"rewv", 3}, {"mcds", 3}})
    for (const Kernel* kernel : available_kernels()) {
      const Scene scene = scene_of(estimator, max_depth);
      EXPECT_EQ(allocations_of(scene, 16, 64, kernel->isa),
                allocations_of(scene, 1, 1, kernel->isa))
          << estimator << " to depth " << max_depth << ", " << kernel->name;
    }
}

}  // namespace
}  // namespace airlight

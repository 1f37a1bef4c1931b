// Loads a scene or a model, renders it small and prints the colour in the middle of the picture.
#include <airlight/error.h>
#include <airlight/render/render.h>
#include <airlight/scene/load_scene.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s SCENE\n", argv[0]);
    return 2;
  }
  try {
    const airlight::Scene scene =
        airlight::load_scene(argv[1], {"image.width=64", "image.height=64", "render.spp=16"});
    const airlight::Rendered picture = airlight::render(scene);
    const airlight::Rgb<double> middle = picture.film.radiance(32, 32);
    std::printf("%d x %d pixels in %.3f s (%s)\n", scene.resolution.width, scene.resolution.height,
                picture.seconds, picture.instruction_set);
    std::printf("pixel 32,32: %.5f %.5f %.5f W/(m2 sr)\n", middle.r, middle.g, middle.b);
  } catch (const airlight::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "image/metrics.h"
#include "image/output.h"
#include "render/render.h"
#include "scene/load_scene.h"
#include "study/reproduction.h"

namespace airlight::paper_000 {
namespace {

/// A room 5 m wide, 2.8 m high and 6 m deep; the sun comes in by three windows on the right.
constexpr const char* view = R"(
ambient = 0.25
background = [0.7, 0.78, 0.9]

[camera]
position = [0.5, 1.5, 5.7]
target = [3.1, 1.05, 1.3]
fov = 50

[image]
width = 384
height = 216

[render]
spp = 64

[[lights]]
type = "directional"
irradiance = [6, 5.4, 4.4]
azimuth = 72
elevation = 26
)";

constexpr const char* dust = R"(
[[media]]
albedo = 0.95
sigma_t = 0.12
phase = {type = "henyey-greenstein", g = 0.3}
shape = {type = "box", min = [0, 0, 0], max = [5, 2.8, 6]}
)";

/// What keeps the sun out, seen by the camera or not.
constexpr const char* walls = R"(
[[objects]]
type = "boxes"
name = "walls and ceiling"
boxes = [
  [-0.2, 0, -0.2, 5.2, 2.8, 0], [-0.2, 0, 0, 0, 2.8, 6], [-0.2, 0, 6, 5.2, 2.8, 6.2],
  [-0.2, 2.8, -0.2, 5.2, 3, 6.2],
]
albedo = [0.62, 0.6, 0.55]

[[objects]]
type = "wall"
name = "windows"
width = 6
height = 2.8
window_min = [0.5, 0.8]
window_max = [5.5, 2.4]
columns = 3
rows = 1
bar_width = 0.5
bar_depth = 0.12
rotate = [0, 90, 0]
translate = [5.15, 0, 6]
albedo = 0.6
)";

constexpr const char* furniture = R"(
[[objects]]
type = "boxes"
name = "floor"
boxes = [[-0.2, -0.2, -0.2, 5.2, 0, 6.2]]
albedo = [0.42, 0.3, 0.2]

[[objects]]
type = "boxes"
name = "table"
boxes = [
  [2.2, 0.7, 1.7, 3.6, 0.75, 2.6],
  [2.25, 0, 1.75, 2.32, 0.7, 1.82], [3.48, 0, 1.75, 3.55, 0.7, 1.82],
  [2.25, 0, 2.48, 2.32, 0.7, 2.55], [3.48, 0, 2.48, 3.55, 0.7, 2.55],
]
albedo = [0.4, 0.24, 0.13]

[[objects]]
type = "sphere"
name = "vase"
centre = [2.7, 0.95, 2.1]
radius = 0.2
albedo = [0.25, 0.4, 0.5]

[[objects]]
type = "boxes"
name = "shelf"
boxes = [[0.6, 0, 0, 1.8, 1.9, 0.35]]
albedo = [0.36, 0.38, 0.42]
)";

constexpr const char* seen_place = R"(
[[objects]]
type = "depth_image"
file = "depth.exr"
measure = "ray"
)";

/// Stands in the place of everything real: the photograph shows there.
Scene before_photograph(const std::string& text, const std::filesystem::path& folder) {
  Scene scene =
      parse_scene("background_image = \"photograph.exr\"\n" + text, (folder / "fig2").string());
  for (Object& object : scene.objects) object.holdout = true;
  return scene;
}

/// The layers over the photograph, with the shadow that they cast on it or without.
Image laid_over(const Film& light, const Image& photograph, bool with_shadow = true) {
  const Image in_scatter = light.layer("in_scatter"), surface = light.layer("surface"),
              transmittance = light.layer("transmittance"), shadow = light.layer("shadow");
  Image result = photograph;
  for (std::size_t i = 0; i < result.pixels.size(); ++i)
    result.pixels[i] =
        in_scatter.pixels[i] + surface.pixels[i] +
        transmittance.pixels[i] * (with_shadow ? shadow.pixels[i] : 1.F) * photograph.pixels[i];
  return result;
}

/// |a − b| / b, the largest; what is black does not count.
double largest_relative_difference(const Image& a, const Image& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    if (b.pixels[i] > 0)
      worst = std::max(worst, double(std::abs(a.pixels[i] - b.pixels[i]) / b.pixels[i]));
  return worst;
}

/// Near is bright.
Image shown(const Image& depth) {
  float nearest = 1e30F;
  for (const float d : depth.pixels)
    if (d > 0) nearest = std::min(nearest, d);
  Image image(depth.width, depth.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (const float d = depth.pixels[i / 3]; d > 0) image.pixels[i] = std::pow(nearest / d, 2.F);
  return image;
}

}  // namespace

/// Figure 2: virtual light laid over a real room.
void fig2(Reproduced& out) {
  const std::string room = std::string(view) + walls + furniture;
  Scene real = parse_scene(room, "000/fig2");
  const Image photograph = render(real).film.layer("beauty");
  RenderSettings centres = real.render;
  centres.spp = 1, centres.samples_per_ray = 0;
  const Film depth_camera = Renderer(real).render(centres).film;
  write_exr(out.folder / "photograph.exr", picture_of(photograph), ExrType::single);
  write_exr(out.folder / "depth.exr", depth_camera.picture(), ExrType::half);

  const Scene dusty = parse_scene(room + dust, "000/fig2");
  const Film direct = render(dusty).film;
  const Image exact = direct.layer("beauty");
  const Image by_surfaces = render(before_photograph(room + dust, out.folder)).film.layer("beauty");
  Scene scene = before_photograph(std::string(view) + walls + seen_place + dust, out.folder);
  const Film veiled = render(scene).film;
  scene.background_image = {}, scene.background = {};
  const Film light = render(scene).film;
  const Image composite = laid_over(light, photograph);

  // The mean square error of one code of 8 bits.
  const double one_code = 20 * std::log10(255);
  constexpr double any = std::numeric_limits<double>::infinity();
  out.rows = {
      {"layers over the photograph, against the render before it: largest relative difference",
       {},
       largest_relative_difference(composite, veiled.layer("beauty")),
       0,
       2e-6},
      {"depth image, against the room's own surfaces as holdouts: PSNR [dB]",
       {},
       compare(composite, by_surfaces).psnr,
       one_code,
       any},
      {"in-scatter, against the direct render's: PSNR [dB]",
       {},
       compare(light.layer("in_scatter"), direct.layer("in_scatter")).psnr,
       one_code,
       any},
      {"composite, against the direct render: PSNR [dB]",
       {},
       compare(composite, exact).psnr,
       one_code,
       any},
      {"the same without the layer shadow: PSNR [dB]",
       {},
       compare(laid_over(light, photograph, false), exact).psnr,
       36,
       40},
  };

  out.page.paragraph(
      "The paper shows a photograph through a see-through headset and prints no numbers: virtual "
      "sun falls through virtual windows into a real room. Here the real room is a render without "
      "dust, taken for a photograph, and its depth image, so that there is a true picture to "
      "compare with: the same room rendered with the dust.");
  out.page.figures(
      std::vector<Figure>{
          out.picture("photograph", photograph, "the photograph: no dust"),
          out.picture("depth", shown(depth_camera.layer("depth")),
                      "the depth image, near is bright; black: nothing is there"),
          out.picture("light", light.layer("in_scatter"), "light of the dust, to be added"),
          out.picture("composite", composite, "laid over the photograph"),
          out.picture("direct", exact, "rendered with the dust"),
          out.picture("difference", difference_image(composite, exact, 4), "4 × |difference|")},
      3, "Dust and sun laid over a photograph by holdouts and a depth image.");
  out.page.paragraph(
      "The depth image and the walls, which the camera sees in part, are holdouts: they shadow the "
      "dust and end the camera's rays, and what is real shows in their place. The composite is "
      "in-scatter + surface + transmittance × shadow × photograph.");
  out.page.paragraph(
      "The dust takes light from the sun on its way to a surface, too, and the photograph, taken "
      "without dust, cannot know: its patches of sun are too bright. The layer shadow is what is "
      "left of the light that falls on each holdout, and with it they are as dark as in the direct "
      "render. That needs a sun and an ambient light as strong as those of the real place.");
  out.page.checks(
      out.rows, fmt::format("{:.1f} dB is the error of one code of an 8 bit picture. The range of "
                            "the PSNR without shadow is about what was measured, 38 dB.",
                            one_code));
}

}  // namespace airlight::paper_000

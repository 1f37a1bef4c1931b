#include "study/reproductions.h"

#include <fmt/format.h>

#include "error.h"

namespace airlight {

/// Velinov and Mitchell 2021, "Collimated Whole Volume Light Scattering in Homogeneous Finite
/// Media".
namespace paper_000 {
void fig1a(Reproduced& out);
void fig1b(Reproduced& out);
void fig2(Reproduced& out);
void fig4(Reproduced& out);
void fig5(Reproduced& out);
void fig6_multiple(Reproduced& out);
void fig6_single(Reproduced& out);
void fig7_multiple(Reproduced& out);
void fig7_single(Reproduced& out);
void fig8(Reproduced& out);
void fig9(Reproduced& out);
void fig11(Reproduced& out);
void rgb(Reproduced& out);
void table2(Reproduced& out);
}  // namespace paper_000

namespace {

constexpr Reproduction all[] = {
    {"000/fig1a", "A sunlit room at four samples a pixel",
     "Sun through windows into the fog of a furnished room, by every estimator at 4 spp.",
     paper_000::fig1a},
    {"000/fig1b", "Ten beams of light at four samples a pixel",
     "A gallery in haze: samples that ask the beam that matters, against blind ones and all beams.",
     paper_000::fig1b},
    {"000/fig2", "Shafts of light laid over a photograph",
     "Dust and sun added to the picture of a real room, by holdouts and its depth image.",
     paper_000::fig2},
    {"000/fig4", "Where whole-volume samples go: one trapezoid",
     "The samples' histogram against their density where the way through the medium has one piece.",
     paper_000::fig4},
    {"000/fig5", "Where whole-volume samples go: two and three trapezoids",
     "The samples' histogram against their density where the way through the medium has kinks.",
     paper_000::fig5},
    {"000/fig6-single", "Five estimators of single scattering at four samples a pixel",
     "A black ball in a box of fog, and how far each estimator at 4 spp is from the exact picture.",
     paper_000::fig6_single},
    {"000/fig6-multiple", "Five estimators of multiple scattering at four samples a pixel",
     "Black balls in boxes of fog that scatter light up to twelve times.",
     paper_000::fig6_multiple},
    {"000/fig7-single", "How fast five estimators of single scattering converge",
     "The scenes of 000/fig6-single from 1 to 256 samples a pixel.", paper_000::fig7_single},
    {"000/fig7-multiple", "How fast five estimators of multiple scattering converge",
     "The scenes of 000/fig6-multiple from 1 to 128 samples a pixel.", paper_000::fig7_multiple},
    {"000/fig8", "A wall that breaks, at four samples a pixel",
     "RM and MCWVDS at 4 spp in dust, seen from where the light comes.", paper_000::fig8},
    {"000/fig9", "Ray marching and whole-volume samples in a room",
     "RM and MCWVDS at 48 spp in a room with windows, and where they err.", paper_000::fig9, true},
    {"000/fig11", "Media with twelve and twenty faces",
     "A dodecahedron and an icosahedron of fog: the closed form against quadrature, and pictures.",
     paper_000::fig11},
    {"000/rgb", "Whole-volume samples in coloured fog",
     "What the ratio form gains over Monte Carlo where the channels are extinguished differently.",
     paper_000::rgb},
    {"000/table2", "What ray marching and whole-volume samples cost",
     "Times of RM and MCWVDS at equal samples and at equal error.", paper_000::table2, true},
};

}  // namespace

std::span<const Reproduction> reproductions() { return all; }

std::vector<const Reproduction*> reproductions_named(std::string_view name) {
  std::vector<const Reproduction*> found;
  std::string accepted;
  const std::string below = std::string(name) + "/";
  for (const Reproduction& r : all) {
    if (r.name == name || std::string_view(r.name).starts_with(below)) found.push_back(&r);
    accepted += fmt::format("{}{}", accepted.empty() ? "" : ", ", r.name);
  }
  if (found.empty())
    throw Error(fmt::format("{}: is no reproduction; accepted: {}, or what some begin with: 000",
                            name, accepted));
  return found;
}

void check_take_scene(std::span<const Reproduction* const> chosen) {
  std::string accepted;
  for (const Reproduction& r : all)
    if (r.takes_scene) accepted += fmt::format("{}{}", accepted.empty() ? "" : ", ", r.name);
  for (const Reproduction* r : chosen)
    if (!r->takes_scene)
      throw Error(fmt::format("--scene: {} shows a scene of its own; accepted with it: {}", r->name,
                              accepted));
}

}  // namespace airlight

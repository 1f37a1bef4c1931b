#include "scene/objects/tree.h"

#include <airlight/math/rotation.h>

#include "scene/dice.h"
#include "scene/direction.h"
#include "scene/objects/build.h"

namespace airlight {
namespace {

using Vec = Vec3<double>;

/// A cone cut at both ends, open, between two points.
void add_limb(Mesh& mesh, Vec from, Vec to, double radius_from, double radius_to) {
  constexpr std::uint32_t sides = 7;
  Vec u, v;
  orthonormal_basis(normalize(to - from), u, v);
  const auto first = std::uint32_t(mesh.positions.size());
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * pi * i / sides;
    const Vec out = u * std::cos(angle) + v * std::sin(angle);
    mesh.positions.emplace_back(from + out * radius_from);
    mesh.positions.emplace_back(to + out * radius_to);
    const std::uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % sides);
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
  }
}

/// The distance of a point from the middle line of a leaf at its height, over the leaf's half
/// width; below 1 is inside. The leaf runs from the origin along +y, 1 long.
double leaf_distance(double x, double y, double width) {
  if (y <= 0 || y >= 1) return 2;
  return std::abs(x) / (width * std::sin(pi * std::pow(y, 0.8)));
}

/// A twig with seven leaves on a transparent ground; alpha is 0 or 255.
Texture leaf_texture() {
  constexpr int size = 128;
  Texture texture;
  texture.width = texture.height = size;
  texture.wrap_u = texture.wrap_v = Wrap::clamp;
  texture.srgb = false;
  struct Leaf {
    double x, y, angle, length;
  };
  constexpr Leaf leaves[] = {{0.5, 0.62, 0, 0.37},  {0.5, 0.55, 50, 0.34}, {0.5, 0.5, -52, 0.35},
                             {0.5, 0.36, 66, 0.36}, {0.5, 0.3, -64, 0.36}, {0.5, 0.14, 75, 0.32},
                             {0.5, 0.1, -72, 0.32}};
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const double x = (column + 0.5) / size, y = 1 - (row + 0.5) / size;
      bool inside = std::abs(x - 0.5) < 0.012 && y < 0.65;
      double shade = 0.6;
      for (const Leaf& leaf : leaves) {
        const double a = leaf.angle * (pi / 180), c = std::cos(a), s = std::sin(a);
        const double dx = (x - leaf.x) / leaf.length, dy = (y - leaf.y) / leaf.length;
        const double d = leaf_distance(c * dx - s * dy, s * dx + c * dy, 0.24);
        if (d >= 1) continue;
        inside = true;
        shade = d < 0.08 ? 0.75 : 1;  // the vein
      }
      const auto grey = std::uint8_t(255 * shade);
      const std::uint8_t texel[] = {grey, grey, grey, std::uint8_t(inside ? 255 : 0)};
      texture.rgba.insert(texture.rgba.end(), std::begin(texel), std::end(texel));
    }
  return texture;
}

/// A branch that leaves carry on grows from the trunk: a polyline in two pieces.
struct Branch {
  Vec root, elbow, tip;

  Vec operator()(double t) const {
    return t < 0.5 ? root + (elbow - root) * (2 * t) : elbow + (tip - elbow) * (2 * t - 1);
  }
};

std::vector<Branch> grow_branches(const TreeObject& tree, Dice& dice) {
  constexpr int count = 26;
  constexpr double golden_angle = 2.399963;  // spreads neighbours
  std::vector<Branch> branches;
  for (int i = 0; i < count; ++i) {
    const double up = (i + dice()) / count;  // 0 at the crown's start, 1 at the top
    const double y = tree.height * (tree.crown_start + (0.98 - tree.crown_start) * up);
    const double azimuth = golden_angle * i + dice.between(-0.4, 0.4);
    const double reach =
        tree.crown_radius * std::sqrt(std::max(0.02, 1 - up * up)) * dice.between(0.75, 1.1);
    const Vec out{std::cos(azimuth), 0, std::sin(azimuth)};
    const Vec root{0, y - 0.15 * reach, 0};
    const Vec elbow = root + out * (0.5 * reach) + Vec{0, 0.22 * reach, 0};
    branches.push_back({root, elbow, elbow + out * (0.5 * reach) + Vec{0, 0.05 * reach, 0}});
  }
  return branches;
}

Mesh grow_wood(const TreeObject& tree, const std::vector<Branch>& branches) {
  Mesh mesh;
  const auto radius_at = [&](double y) {
    return tree.trunk_radius * std::max(0.08, 1 - 0.9 * y / tree.height);
  };
  constexpr int pieces = 6;
  for (int i = 0; i < pieces; ++i) {
    const double low = tree.height * i / pieces * 0.95,
                 high = tree.height * (i + 1) / pieces * 0.95;
    add_limb(mesh, {0, low, 0}, {0, high, 0}, radius_at(low), radius_at(high));
  }
  for (const Branch& branch : branches) {
    const double thick = 0.45 * radius_at(branch.root.y);
    add_limb(mesh, branch.root, branch.elbow, thick, 0.7 * thick);
    add_limb(mesh, branch.elbow, branch.tip, 0.7 * thick, 0.2 * thick);
  }
  return mesh;
}

Mesh grow_leaves(const TreeObject& tree, const std::vector<Branch>& branches, Dice& dice) {
  Mesh mesh;
  for (std::int64_t i = 0; i < tree.leaves; ++i) {
    const Branch& branch = branches[std::size_t(i) % branches.size()];
    const double t = std::sqrt(dice.between(0.04, 1));
    const double spread = tree.crown_radius * 0.32 * std::cbrt(dice());
    const double c = dice.between(-1, 1), azimuth = dice.between(0, 2 * pi);
    const double s = std::sqrt(1 - c * c);
    const Vec away{s * std::cos(azimuth), 0.7 * c, s * std::sin(azimuth)};
    const Vec at = branch(t) + away * spread;
    const Rotation turn({dice.between(-50, 50), dice.between(0, 360), dice.between(-50, 50)});
    const double size = tree.leaf_size * dice.between(0.7, 1.3);
    const Vec u = turn({size, 0, 0}), v = turn({0, 0, size});
    add_parallelogram(mesh, at - (u + v) * 0.5, u, v);
  }
  return mesh;
}

}  // namespace

Parts TreeObject::build(const Cursor&) const {
  Dice dice{std::uint32_t(seed)};
  const std::vector<Branch> branches = grow_branches(*this, dice);
  Parts parts;
  parts.objects.push_back({"wood", grow_wood(*this, branches), {.albedo = bark_albedo}});
  if (leaves > 0) {
    const Material leaf{.albedo = leaf_albedo,
                        .albedo_texture = 0,
                        .opacity_texture = 0,
                        .opacity_from_alpha = true,
                        .cutoff = 0.5};
    parts.objects.push_back({"leaves", grow_leaves(*this, branches, dice), leaf});
    parts.textures.push_back(leaf_texture());
  }
  return parts;
}

}  // namespace airlight

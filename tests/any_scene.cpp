// Scenes drawn at random, and what their pictures do not depend on: the unit of length, which way
// the axes point, which colour comes first.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <random>

#include "render/render.h"
#include "scene/load_scene.h"
#include "support/program.h"

namespace airlight::test {
namespace {

using Triple = std::array<double, 3>;
using Order = std::array<std::size_t, 3>;

/// How a scene is written down.
struct Writing {
  double scale = 1;           ///< lengths are multiplied by it
  Order axes = {0, 1, 2};     ///< which of the scene's axes is x, y, z: a rotation
  Order colours = {0, 1, 2};  ///< which of the scene's colours is red, green, blue
};

/// A scene file of media of every shape, lights of every kind and objects, and how to render it.
class AnyScene {
 public:
  AnyScene(unsigned seed, const Folder& folder) : random_(seed), folder_(folder) { draw(); }

  Scene scene(const Writing& writing) {
    writing_ = writing;
    text_.clear();
    say();
    return parse_scene(text_, folder_ / "scene.toml");
  }

  /// Whether all of it turns with the axes: directions that are drawn have axes of their own.
  bool turns() const { return depth_ == 1 && !disc_ && shape_ != 1; }

  /// Whether no step on the way depends on all colours together.
  bool recolours() const { return depth_ == 1; }

  friend std::ostream& operator<<(std::ostream& out, const AnyScene& any) {
    return out << any.text_;
  }

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution(low, high)(random_);
  }
  int up_to(int n) { return std::uniform_int_distribution(0, n)(random_); }
  Triple triple(double low, double high) {
    return {between(low, high), between(low, high), between(low, high)};
  }

  void draw() {
    shape_ = up_to(4), parts_ = shape_ == 4 ? 2 : 1;
    lights_ = 1 + up_to(1), objects_ = up_to(2), depth_ = up_to(2) == 0 ? 3 : 1;
    disc_ = up_to(2) == 0;
    grey_ = up_to(1) == 0;
    density_ = std::pow(10, between(-1.5, 1.2));
    rest_ = random_();
  }

  std::string point(Triple p) const {
    for (double& x : p) x *= writing_.scale;
    return direction(p);
  }
  std::string direction(const Triple& d) const {
    const auto [x, y, z] = writing_.axes;
    return fmt::format("[{}, {}, {}]", d[x], d[y], d[z]);
  }
  std::string colour(const Triple& c) const {
    const auto [r, g, b] = writing_.colours;
    return fmt::format("[{}, {}, {}]", c[r], c[g], c[b]);
  }
  double length(double x) const { return x * writing_.scale; }

  template <class... Values>
  void line(fmt::format_string<Values...> format, Values&&... values) {
    text_ += fmt::format(format, std::forward<Values>(values)...) + "\n";
  }

  /// Everything after `draw` comes from the same numbers, however it is written.
  void say() {
    random_.seed(rest_);
    static const char* const estimators[] = {"rm",   "mcds", "mcwvds",    "rees",
                                             "reds", "rewv", "mix+ratio", "mix+difference"};
    line("background = {}", colour(triple(0, 0.2)));
    line("render = {{estimator = \"{}\", spp = 8, max_depth = {}}}", estimators[up_to(7)], depth_);
    line("image = {{width = 12, height = 8}}");
    const bool from_inside = up_to(2) == 0;
    const Triple position = from_inside ? triple(-0.4, 0.4) : triple(1.2, 2);
    line("camera = {{position = {}, target = {}, up = {}, fov = {}}}", point(position),
         point(triple(-0.3, 0.3)), direction({0.2, 0.9, -0.3}), from_inside ? 80 : 50);
    for (int i = 0; i < parts_; ++i) say_medium(i);
    for (int i = 0; i < lights_; ++i) say_light();
    for (int i = 0; i < objects_; ++i) say_object();
  }

  void say_medium(int part) {
    const auto alike = [&](Triple c) { return grey_ ? Triple{c[0], c[0], c[0]} : c; };
    Triple sigma = alike(triple(0.2, 1.5));
    for (double& x : sigma) x *= density_ / writing_.scale;
    line("[[media]]");
    line("sigma_t = {}", colour(sigma));
    line("albedo = {}", colour(alike(triple(0.3, 1))));
    const int phase = up_to(2);
    const double g = between(-0.8, 0.9);
    if (phase == 0)
      line("phase = {{type = \"henyey-greenstein\", g = {}}}", g);
    else
      line("phase = {{type = \"{}\"}}", phase == 1 ? "isotropic" : "rayleigh");
    say_shape(part);
  }

  void say_shape(int part) {
    const Triple low = triple(-1.5, -0.5), high = triple(0.5, 1.5), turn = triple(0, 90);
    if (shape_ <= 1) {
      line("shape = {{type = \"box\", min = {}, max = {}, rotation = {}}}", point(low), point(high),
           shape_ == 1 ? direction(turn) : "[0, 0, 0]");
    } else if (shape_ == 2) {
      std::vector<std::string> points;
      for (int i = 0; i < 8; ++i) points.push_back(point(triple(-1, 1)));
      line("shape = {{type = \"convex\", points = [{}]}}", fmt::join(points, ", "));
    } else if (shape_ == 3) {
      write_l();
      line("shape = {{type = \"mesh\", file = \"l.obj\"}}");
    } else {
      line("shape = {{type = \"box\", min = {}, max = {}}}", point({part ? 0.1 : -1., -1, -1}),
           point({part ? 1 : 0.1, 1, part ? 0.6 : 1}));
    }
  }

  /// A prism over an L.
  void write_l() const {
    constexpr double outline[6][2] = {{-1, -1}, {-1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, -1}};
    std::string obj;
    for (const double y : {-1., 1.})
      for (const auto& [x, z] : outline) {
        const Triple p{x, y, z};
        const auto [i, j, k] = writing_.axes;
        obj += fmt::format("v {} {} {}\n", length(p[i]), length(p[j]), length(p[k]));
      }
    obj += "f 4 3 2 1\nf 6 5 4 1\nf 7 8 9 10\nf 7 10 11 12\n";
    for (int i = 0; i < 6; ++i) {
      const int next = (i + 1) % 6;
      obj += fmt::format("f {} {} {} {}\n", i + 1, next + 1, next + 7, i + 7);
    }
    write_bytes(folder_ / "l.obj", obj);
  }

  void say_light() {
    const Triple way = triple(-1, 1), aim = triple(-0.4, 0.4);
    const double away = between(0.5, 4), size = between(0.2, 1);
    line("[[lights]]");
    line("irradiance = {}", colour(triple(1, 10)));
    line("direction = {}", direction(way));
    if (up_to(1) == 0) {
      line("type = \"directional\"");
      if (disc_) line("angular_diameter = 3");
      return;
    }
    line("type = \"collimated\"");
    line("up = {}", direction({0.3, 0.5, -0.9}));
    Triple position;
    for (std::size_t k = 0; k < 3; ++k) position[k] = aim[k] - away * way[k];
    line("position = {}", point(position));
    const int outline = up_to(2);
    if (outline == 0)
      line("cross_section = {{type = \"circle\", radius = {}}}", length(size));
    else if (outline == 1)
      line("cross_section = {{type = \"rectangle\", width = {}, height = {}}}", length(size),
           length(2 * size));
    else
      line("cross_section = {{type = \"polygon\", corners = [[0, 0], [{0}, 0], [0, {0}]]}}",
           length(size));
  }

  void say_object() {
    const Triple middle = triple(-0.6, 0.6);
    const double size = between(0.15, 0.5);
    line("[[objects]]");
    line("albedo = {}", between(0, 0.8));
    if (up_to(1) == 0) {
      line("type = \"sphere\"\ncentre = {}\nradius = {}", point(middle), length(size));
      return;
    }
    Triple corner = middle;
    for (double& x : corner) x += size;
    line("type = \"box\"\nmin = {}\nmax = {}", point(middle), point(corner));
  }

  std::mt19937 random_;
  const Folder& folder_;
  int shape_, parts_, lights_, objects_, depth_;
  bool disc_, grey_;
  double density_;  ///< [1/m]
  unsigned rest_;   ///< seed of everything else
  Writing writing_;
  std::string text_;
};

Image picture_of(AnyScene& any, const Writing& writing) {
  const Rendered rendered = render(any.scene(writing));
  EXPECT_EQ(rendered.rejected, 0);
  return rendered.film.layer("beauty");
}

constexpr int scenes = 100;

/// The largest difference of two pictures, and that of their means, relative to the brightest value
/// and to the mean.
struct Difference {
  double largest = 0, of_means = 0;

  Difference(const Image& a, const Image& b, const Order& colours) {
    double brightest = 0, sum_a = 0, sum_b = 0;
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x)
        for (int c = 0; c < 3; ++c) {
          const double one = a.at(x, y, int(colours[std::size_t(c)])), other = b.at(x, y, c);
          largest = std::max(largest, std::abs(one - other));
          brightest = std::max(brightest, one);
          sum_a += one, sum_b += other;
        }
    if (brightest == 0) return;
    largest /= brightest, of_means = std::abs(sum_a - sum_b) / sum_a;
  }
};

TEST(AnyScene, looks_the_same_in_any_unit_of_length) {
  const Folder folder;
  for (unsigned seed = 0; seed < scenes; ++seed) {
    AnyScene any(seed, folder);
    const Image metres = picture_of(any, {});
    for (const double scale : {64., 1. / 64}) {  // powers of two: nothing is rounded otherwise
      const Image scaled = picture_of(any, {.scale = scale});
      ASSERT_LT(Difference(metres, scaled, {0, 1, 2}).largest, 1e-6) << seed << "\n" << any;
    }
  }
}

// Rounding is another then, which a few samples at the edge of a shadow may notice.
constexpr double rounding = 1e-3;

TEST(AnyScene, looks_the_same_with_other_axes) {
  const Folder folder;
  int turned = 0;
  for (unsigned seed = 0; seed < scenes; ++seed) {
    AnyScene any(seed, folder);
    if (!any.turns()) continue;
    const Image upright = picture_of(any, {}), lying = picture_of(any, {.axes = {1, 2, 0}});
    ASSERT_LT(Difference(upright, lying, {0, 1, 2}).of_means, rounding) << seed << "\n" << any;
    ++turned;
  }
  EXPECT_GT(turned, scenes / 4);
}

TEST(AnyScene, looks_the_same_with_colours_exchanged) {
  const Folder folder;
  int exchanged = 0;
  for (unsigned seed = 0; seed < scenes; ++seed) {
    AnyScene any(seed, folder);
    if (!any.recolours()) continue;
    const Order order = {2, 0, 1};
    const Image before = picture_of(any, {}), after = picture_of(any, {.colours = order});
    ASSERT_LT(Difference(before, after, order).of_means, rounding) << seed << "\n" << any;
    ++exchanged;
  }
  EXPECT_GT(exchanged, scenes / 2);
}

}  // namespace
}  // namespace airlight::test

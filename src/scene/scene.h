#pragma once
#include <airlight/lights.h>
#include <airlight/medium.h>

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "image/image.h"
#include "image/texture.h"
#include "scene/render_settings.h"
#include "scene/room_behind.h"

namespace airlight {

/// A pinhole camera.
struct Camera {
  Vec3<double> position{0, 0, 5};  ///< [m]
  Vec3<double> target{0, 0, 0};    ///< the point in the middle of the picture  [m]
  Vec3<double> up{0, 1, 0};  ///< need not be perpendicular to the view, only not parallel to it
  double fov = 40;           ///< vertical  [degrees]

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    field("position", &Camera::position, unit::metre, any_number(), "where the camera is");
    field("target", &Camera::target, unit::metre, any_number(),
          "the point in the middle of the picture");
    field("up", &Camera::up, unit::none, any_number(),
          "what is up in the picture; not parallel to the view");
    field("fov", &Camera::fov, unit::degree, open(0, 180), "vertical field of view");
  }
};

/// Size of a picture in pixels.
struct Resolution {
  int width = 640;
  int height = 360;

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    field("width", &Resolution::width, unit::pixel, closed(1, 65535), "of the picture");
    field("height", &Resolution::height, unit::pixel, closed(1, 65535), "of the picture");
  }
};

/// How a surface reflects and filters light. Both sides are alike. Light that crosses the surface
/// is multiplied by (1 − opacity) · tint; what it reflects diffusely is multiplied by opacity.
struct Material {
  Rgb<double> albedo{0.5, 0.5, 0.5};  ///< diffuse, multiplied by the texture if there is one
  int albedo_texture = -1;            ///< index into Scene::textures, −1 without
  double opacity = 1;                 ///< multiplied by the texture's if there is one
  int opacity_texture = -1;           ///< index into Scene::textures
  bool opacity_from_alpha = false;    ///< the opacity texture's alpha counts, else its red
  double cutoff = -1;         ///< if not negative, opacity below it counts as 0, from it on as 1
  Rgb<double> tint{1, 1, 1};  ///< of the light let through

  bool is_opaque() const { return opacity >= 1 && opacity_texture < 0; }
};

/// Triangles in world space.
struct Mesh {
  std::vector<Vec3<float>, RoomBehind<Vec3<float>>> positions;  ///< [m]
  std::vector<Vec3<float>> normals;  ///< one a position, or none: the triangles' own then count
  std::vector<std::array<float, 2>> uvs;  ///< one a position, or none; v points up
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// An exact sphere.
struct Sphere {
  Vec3<double> centre;  ///< [m]
  double radius = 1;    ///< [m]
};

/// Something light meets. Objects keep the order of the file: their index is their id in a
/// picture's layer.
struct Object {
  std::string name;
  std::variant<Mesh, Sphere> geometry;
  Material material;
  /// Stands for a thing of the background's picture: in the place of its own light, the camera sees
  /// the background there, as far as the surface is opaque.
  bool holdout = false;
};

/// What a scene file means: plain data, in double where it is not bulk, SI units.
struct Scene {
  Camera camera;
  Resolution resolution;
  Rgb<double> background{0, 0, 0};  ///< radiance behind everything  [W/(m2 sr)]
  Image background_image;  ///< seen instead, pixel by pixel; of the picture's size, or empty
  bool background_is_seen = true;  ///< by the camera; or its place stays black, to be filled later
  Rgb<double> ambient{0, 0, 0};    ///< radiance around surfaces; lights surfaces only  [W/(m2 sr)]
  std::vector<Texture> textures;
  std::vector<Object> objects;
  std::vector<Medium> media;  ///< apart from each other
  std::vector<Lights> lights;
  std::vector<std::string>
      light_groups;  ///< of each light; empty: none, as for lights beyond its end
  RenderSettings render;
  std::vector<std::string>
      assumptions;  ///< what a model left open and was filled in, a sentence each
};

}  // namespace airlight

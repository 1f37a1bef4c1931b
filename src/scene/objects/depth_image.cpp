#include "scene/objects/depth_image.h"

#include <fmt/format.h>

#include "error.h"
#include "image/input.h"
#include "scene/objects/depth_surface.h"
#include "scene/proportions.h"

namespace airlight {

Parts DepthImageObject::build(const Cursor& at, const Files& files, const View& view) const {
  const Cursor at_file = at.at_or_here("file");
  const std::filesystem::path path = files.path(*file, at_file);
  Numbers numbers;
  try {
    numbers = read_numbers(path, channel);
  } catch (const Error& error) {
    at_file.complain(std::string("names a depth image that is not to be had: ") + error.what());
  }
  Image& depths = numbers.image;
  if (numbers.are_codes && !unit)
    at.lacks("unit", "a number above 0 m: what one code of a PNG stands for, such as 0.001");
  if (camera)
    check_camera(*camera, at.at_or_here("camera"));
  else if (!have_same_proportions(depths, view.resolution))
    at_file.complain(fmt::format(
        "names a depth image of other proportions: {} is {} x {} pixels; accepted: {} x {}, the "
        "picture's, a size of the same proportions, or a camera of its own",
        path.string(), depths.width, depths.height, view.resolution.width, view.resolution.height));

  const CameraFrame frame =
      camera_frame(camera.value_or(view.camera), {depths.width, depths.height});
  bool any = false;
  for (int y = 0; y < depths.height; ++y)
    for (int x = 0; x < depths.width; ++x) {
      float& value = depths.at(x, y, 0);
      const double depth = double(value) * unit.value_or(1);
      const bool is_there = depth > 0 && depth < farthest.value_or(far_away);
      // The frame's directions are as long as a depth of 1 along the axis is far along the ray.
      const double longer =
          measure == DepthMeasure::ray ? length(frame.direction(x + 0.5, y + 0.5)) : 1;
      value = is_there ? float(depth / longer) : 0;
      any = any || is_there;
    }
  if (!any)
    at_file.complain(
        fmt::format("names a depth image without any depth: {}; accepted: at least "
                    "one pixel above 0",
                    path.string()));
  return single_part(depth_surface(depths, frame, discontinuity));
}

}  // namespace airlight

#include "image/resize.h"

#include "error.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_RESIZE_STATIC
#define STB_IMAGE_RESIZE_IMPLEMENTATION
#include <stb/stb_image_resize.h>
#pragma GCC diagnostic pop

namespace airlight {

Image resized(const Image& image, int width, int height) {
  Image result(width, height, image.channels);
  if (stbir_resize_float_generic(image.pixels.data(), image.width, image.height, 0,
                                 result.pixels.data(), width, height, 0, image.channels,
                                 STBIR_ALPHA_CHANNEL_NONE, 0, STBIR_EDGE_CLAMP,
                                 STBIR_FILTER_TRIANGLE, STBIR_COLORSPACE_LINEAR, nullptr) == 0)
    throw Error("there is not enough memory to resize a picture");
  return result;
}

}  // namespace airlight

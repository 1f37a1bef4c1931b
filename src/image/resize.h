#pragma once
#include "image/image.h"

namespace airlight {

/// The picture at another size: every pixel is the mean of what lies around it, weighted by a tent
/// as wide as two pixels of the larger grid, so that no value leaves the range of those it is made
/// of. Sizes are at least 1 x 1, numbers finite. Throws Error if memory does not suffice.
Image resized(const Image& image, int width, int height);

}  // namespace airlight

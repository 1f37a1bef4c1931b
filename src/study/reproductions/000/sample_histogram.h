#pragma once
#include <airlight/math/vec.h>

#include "scene/scene.h"
#include "study/reproduction.h"

namespace airlight::paper_000 {

/// A camera ray from inside the box [-1, 1]³ m and where light comes from.
struct BoxRay {
  const char* name;
  Vec3<double> origin, direction, toward;  ///< any length but 0
  double sigma_t;                          ///< [1/m]
  int trapezoids;                          ///< pieces that the way through the box must have
};

/// Draws whole-volume samples along the ray and holds their histogram to the density by Pearson's
/// test: adds a plot and three rows. The density is integrated by brute force.
void sample_along(const BoxRay& ray, Reproduced& out);

/// A box of fog without anything in it, to be sampled in every pixel.
Scene empty_box(Vec3<double> camera, double fov, Vec3<double> toward, double sigma_t);

/// Takes the samples that `mcwvds` takes in every pixel of a picture, as the probe tells them, and
/// tests whether what lies below each of them of its own ray's distribution is uniform: adds a
/// plot, a picture of the number of trapezoids, and a row.
void sample_in_picture(const Scene& scene, Reproduced& out);

/// Ends the page with the rows of both and what they mean.
void show_checks(Reproduced& out);

}  // namespace airlight::paper_000

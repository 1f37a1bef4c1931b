#include "study/reproductions/000/sample_histogram.h"

namespace airlight::paper_000 {

/// Figure 4: samples and density where light and camera ray leave the box through one face.
void fig4(Reproduced& out) {
  out.page.paragraph(
      "The paper draws stratified samples in proportion to transmittance along the whole way, from "
      "the camera to a point and on to where light enters, and counts them in 256 bins. In its "
      "figure 4 the camera ray leaves the box through the face by which light enters: the way has "
      "one piece, and where it gets shorter along the ray, samples crowd at the far end. Sampling "
      "by distance would put them at the near one.");
  sample_along({"One trapezoid", {-0.3, -0.2, -0.8}, {-0.1, 0.05, 1}, {0.5, 0.3, 0.7}, 2.5, 1},
               out);
  sample_in_picture(empty_box({-0.4, -0.3, -0.9}, 80, {0.5, 0.3, 0.7}, 2), out);
  show_checks(out);
}

}  // namespace airlight::paper_000

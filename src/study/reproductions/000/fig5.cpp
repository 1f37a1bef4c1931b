#include "study/reproductions/000/sample_histogram.h"

namespace airlight::paper_000 {

/// Figure 5: samples and density where the way through the box has a kink; here also with two.
void fig5(Reproduced& out) {
  out.page.paragraph(
      "As 000/fig4, along rays for which light enters by several faces: where the face changes, "
      "the way through the medium has a kink, and so has the density. The paper's figure 5 has two "
      "trapezoids; a box has three at most, and the second plot has all three.");
  sample_along({"Two trapezoids", {0.3, 0, -0.6}, {-0.36, 0, 0.933}, {0.6, 0.05, 0.8}, 2, 2}, out);
  sample_along(
      {"Three trapezoids", {0.76, 0.53, -0.21}, {-0.54, 0.15, 0.812}, {0.6, 0.5, 0.6245}, 2, 3},
      out);
  sample_in_picture(empty_box({1.2, -1.6, -3}, 36, {0.6, 0.5, 0.6245}, 1.2), out);
  show_checks(out);
}

}  // namespace airlight::paper_000

#include "checkpoints.h"
#include "closed_form.h"
#include "convergence.h"
#include "light_selection.h"
#include "loading.h"
#include "memory.h"
#include "paths.h"
#include "quality.h"
#include "row.h"
#include "shadow_rays.h"
#include "threads.h"

namespace airlight::bench {

std::vector<Bench> benches() {
  return {
      // First those that measure processes of their own: a fork after threads have started would
      // not be safe.
      {"memory", "beyond the scene and its BVH, 1920 x 1080", memory},
      {"threads", "two threads against two processes", threads},
      {"closed_form", "the closed-form integral of a box, one core", closed_form},
      {"shadow_rays", "shadow rays of a whole render against bare Embree, one core", shadow_rays},
      {"paths", "multiple scattering against bare Embree, and its lanes, one core", paths},
      {"convergence", "time to 40 dB on the sphere in fog, one core", convergence},
      {"quality", "time to usable pictures of the sunroom, 640 x 360, two threads", quality},
      {"light_selection", "noise of samples that ask one of five suns each, closed form over blind",
       light_selection},
      {"checkpoints", "a render that keeps its sums in a file against one that does not",
       checkpoints},
      {"loading", "an OBJ of 270 000 triangles to the first ray", loading},
  };
}

}  // namespace airlight::bench

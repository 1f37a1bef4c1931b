#pragma once
#include "study/reproductions/000/views.h"

namespace airlight::paper_000 {

/// Ray marching beside whole-volume samples at the same number of samples, as means over seeds.
struct MarchAndWholeVolume {
  double march, whole_volume;            ///< PSNR, peak 1  [dB]
  double march_rmse, whole_volume_rmse;  ///< [W/(m2 sr)]

  double gap() const { return whole_volume - march; }  ///< [dB]
};

/// Measures both in one view, and adds their pictures and four times their errors to the page.
MarchAndWholeVolume march_against_whole_volume(Reproduced& out, const View& view, std::int64_t spp,
                                               int seeds, std::int64_t reference_spp);

}  // namespace airlight::paper_000

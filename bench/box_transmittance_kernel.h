#pragma once

namespace airlight::bench {

/// Camera rays from one point to the box [-1, 1]^3, light from one direction, and where the answers
/// go.
struct BoxRays {
  double eye[3];           ///< [m]
  double toward_light[3];  ///< unit length
  double sigma_t;          ///< [1/m]
  const float* x;          ///< directions of unit length, component by component
  const float* y;
  const float* z;
  int count;        ///< of rays, a multiple of 16
  float* integral;  ///< T of each ray, 0 where it misses  [m]
};

}  // namespace airlight::bench

/// The closed form for every ray, one lane at a time or in as many as the instruction set has.
extern "C" {
using BoxTransmittance = void(const airlight::bench::BoxRays& rays, bool one_lane);
BoxTransmittance airlight_box_transmittance_baseline;
BoxTransmittance airlight_box_transmittance_avx2;
BoxTransmittance airlight_box_transmittance_avx512;
}

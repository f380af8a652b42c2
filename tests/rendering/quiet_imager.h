// An imager without noise.
#pragma once

#include "rendering/imager_params.h"

namespace rockyard::rendering {

// Everything that disturbs an image but the shot noise is off, and counts are fine.
inline void Quieten(ImagerParams& imager) {
  DetectorParams& ccd = imager.ccd;
  ccd.read_noise_e = 0.0;
  ccd.dark_current_e_s = 0.0;
  ccd.response_nonuniformity = 0.0;
  ccd.offset_nonuniformity_e = 0.0;
  ccd.adc_bits = 16;
  imager.exposure.repeatability = 0.0;
}

inline ImagerParams QuietImager() {
  ImagerParams imager;
  Quieten(imager);
  return imager;
}

}  // namespace rockyard::rendering

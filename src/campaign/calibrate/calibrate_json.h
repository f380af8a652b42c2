// What came out of a calibration, for programs.
#pragma once

#include "campaign/calibrate/calibrate_cameras.h"
#include "core/json_value.h"

namespace rockyard::campaign {

// The file calibration.json: described in src/campaign/README.md.
core::JsonValue CalibrateJson(const CalibrateRequest& request, const CalibrateResult& result);

struct PredictedPixel {
  vision::Pixel at;
  double error_px = 0.0;
};

// The predicted error of a camera (vision::PredictedError) at 5 x 5 pixels over the image, corners
// and middle included, for points at the targets' median distance. Pixels without a ray are left
// out.
std::vector<PredictedPixel> PredictedErrors(const CalibrateRequest& request,
                                            const CalibrateResult& result, std::size_t camera);

}  // namespace rockyard::campaign

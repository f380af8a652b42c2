// The images of a calibration, down to corners.
#pragma once

#include <string>
#include <vector>

#include "campaign/calibrate/calibrate_request.h"
#include "vision/calibration/calibration_data.h"

namespace rockyard::campaign {

struct CalibrateInput {
  vision::CalibrationData data;
  std::vector<std::vector<std::string>> read;  // by camera, by image: what was read
  std::string advice;                          // of image_files::ToGray, on the first that has any
};

// Throws core::UserError: a target file that is none, another number of right images or of poses
// than of images, one file twice, files that cannot be read, images of another size than the first,
// images without the board.
CalibrateInput ReadCalibrateInput(const CalibrateRequest& request);

}  // namespace rockyard::campaign

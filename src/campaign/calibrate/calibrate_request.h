// What `rockyard calibrate` is asked for, and what comes out.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "campaign/output_folder.h"
#include "vision/calibration/calibrate.h"
#include "vision/cameras/camera_model.h"

namespace rockyard::campaign {

struct CalibrateRequest {
  std::vector<std::filesystem::path> images;  // of the camera, or of the left one of a pair
  std::vector<std::filesystem::path> right;   // of the right one, in the same order; empty: none
  std::filesystem::path target;               // vision/calibration/target_file.h
  std::filesystem::path out;                  // a folder, which is made
  ExistingFiles existing = ExistingFiles::kRefuse;
  vision::EstimatedLens lens = vision::EstimatedLens::kCahvor;
  std::optional<int> white;  // the sample that becomes 255 (image_files/luminance.h)
};

struct CalibrateResult {
  vision::ChessboardParams board;
  bool surveyed = false;
  vision::ImageSize size;
  std::vector<std::vector<std::string>> read;  // by camera, by image: what was read
  vision::Calibration calibration;
  std::vector<std::string> notes;  // what a user should know before believing it

  std::vector<OutputFile> files;

  // Root mean square of the distances in one image, px; of one camera. NaN where all corners are
  // outliers.
  double ImageRms(std::size_t camera, std::size_t image) const;
};

// "camera", or "left" and "right" of a pair.
std::string CameraName(const CalibrateResult& result, std::size_t camera);

// The image that a corner belongs to.
const std::filesystem::path& ImageOf(const CalibrateRequest& request,
                                     const vision::CornerResidual& corner);

}  // namespace rockyard::campaign

// What `rockyard calibrate` does, for that command: images of a chessboard to a camera, or to the
// two of a pair (Goldberg 2002 section 2, Gennery 2001). No drive calibrates, so that no record
// depends on it. Must stay: calibration.json, and camera files that vision/cameras/camera_file.h
// reads, for `stereo`, `vo` and `cylinder`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "campaign/output_folder.h"
#include "core/json_value.h"
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
  std::optional<int> white;  // the sample that becomes 255 (image_files::ToGray)
};

struct CalibrateResult {
  vision::ChessboardParams board;
  bool surveyed = false;
  vision::ImageSize size;
  std::vector<std::vector<std::string>> read;  // by camera, by image: what was read
  vision::Calibration calibration;
  std::vector<std::string> notes;  // what a user should know before believing it

  std::vector<OutputFile> files;

  // Returns the root mean square of the distances in one image of one camera, px; NaN where all
  // corners are outliers.
  double ImageRms(std::size_t camera, std::size_t image) const;
};

// Returns "camera", or "left" and "right" for the cameras of a pair.
std::string CameraName(const CalibrateResult& result, std::size_t camera);

// Returns the image that a corner belongs to.
const std::filesystem::path& ImageOf(const CalibrateRequest& request,
                                     const vision::CornerResidual& corner);

// Reads the images, finds the board, estimates and writes into the folder (OutputFolder), which is
// claimed first and filled last: camera.json and camera.txt (cameras.json and cameras.txt of a
// pair), calibration.json. Throws core::UserError, before anything is written, for whatever is
// wrong with the input: everything that can be told at once, such as all images without a board.
CalibrateResult CalibrateCameras(const CalibrateRequest& request);

// Returns what came out of a calibration as the file calibration.json, described in
// src/campaign/README.md. Programs read it (--json). Must stay: its members; others may only be
// added.
core::JsonValue CalibrateJson(const CalibrateRequest& request, const CalibrateResult& result);

// The predicted error of a camera at one pixel.
struct PredictedPixel {
  vision::Pixel at;
  double error_px = 0.0;
};

}  // namespace rockyard::campaign

#include "campaign/calibrate/calibrate_cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "campaign/calibrate/calibrate_input.h"
#include "campaign/calibrate/calibrate_json.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/numbers.h"
#include "vision/cameras/camera_file.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

// A predicted error above this says where corners are missing, px.
constexpr double kLargeError_px = 0.5;
constexpr double kManyOutliers = 0.02;

void NoteCalibrationDoubts(const CalibrateRequest& request, CalibrateResult& result) {
  for (std::size_t i = 0; i < result.calibration.cameras.size(); ++i) {
    const std::vector<PredictedPixel> pixels = PredictedErrors(request, result, i);
    const auto worst =
        std::max_element(pixels.begin(), pixels.end(),
                         [](const auto& a, const auto& b) { return a.error_px < b.error_px; });
    if (worst == pixels.end() || worst->error_px <= kLargeError_px) continue;
    result.notes.push_back(fmt::format(
        "{}: predicted to {:.2f} px only at column {:.0f}, row {:.0f}: show the target there too",
        CameraName(result, i), worst->error_px, worst->at.x(), worst->at.y()));
  }
  const auto out = static_cast<double>(result.calibration.outliers.size());
  if (out > kManyOutliers * static_cast<double>(result.calibration.corners)) {
    result.notes.push_back(fmt::format(
        "{:.0f} corners are outliers: look at their images before believing the rest", out));
  }
}

void WriteCameras(const CalibrateRequest& request, const CalibrateResult& result,
                  OutputFolder& folder) {
  const std::string comment = fmt::format("rockyard calibrate: {} corners, rms {:.4f} px",
                                          result.calibration.corners, result.calibration.rms_px);
  const auto model = [&](std::size_t camera) {
    return vision::ModelOf(result.calibration, camera, result.size, request.lens);
  };
  if (result.calibration.cameras.size() == 1) {
    folder.Write("camera", "camera.json", core::DumpJson(vision::CameraJson(model(0))));
    folder.Write("camera_text", "camera.txt", vision::CameraText(model(0), comment));
    return;
  }
  const vision::CameraPair pair{model(0), model(1)};
  folder.Write("cameras", "cameras.json", core::DumpJson(vision::CameraPairJson(pair)));
  folder.Write("cameras_text", "cameras.txt", vision::CameraPairText(pair, comment));
}

std::vector<fs::path> InputsOf(const CalibrateRequest& request) {
  std::vector<fs::path> inputs = request.images;
  inputs.insert(inputs.end(), request.right.begin(), request.right.end());
  inputs.push_back(request.target);
  return inputs;
}

}  // namespace

double CalibrateResult::ImageRms(std::size_t camera, std::size_t image) const {
  double sum = 0.0;
  double count = 0.0;
  for (const vision::CornerResidual& corner : calibration.residuals) {
    if (corner.camera != camera || corner.image != image) continue;
    sum += corner.residual_px.squaredNorm();
    count += 1.0;
  }
  return count == 0.0 ? core::kNaN : std::sqrt(sum / count);
}

std::string CameraName(const CalibrateResult& result, std::size_t camera) {
  if (result.calibration.cameras.size() == 1) return "camera";
  return camera == 0 ? "left" : "right";
}

const fs::path& ImageOf(const CalibrateRequest& request, const vision::CornerResidual& corner) {
  return corner.camera == 0 ? request.images[corner.image] : request.right[corner.image];
}

CalibrateResult CalibrateCameras(const CalibrateRequest& request) {
  OutputFolder folder(
      request.out, request.existing,
      {.command = "calibrate",
       .names = {"camera.json", "camera.txt", "cameras.json", "cameras.txt", "calibration.json"},
       .inputs = InputsOf(request)});
  const CalibrateInput input = ReadCalibrateInput(request);
  CalibrateResult result;
  result.board = input.data.board;
  result.surveyed = !input.data.surveyed_X_AT.empty();
  result.size = input.data.size;
  result.read = input.read;
  result.calibration = vision::Calibrate(input.data, {.lens = request.lens}).OrThrow();
  if (!input.advice.empty()) result.notes.push_back(input.advice);
  NoteCalibrationDoubts(request, result);
  WriteCameras(request, result, folder);
  result.files = folder.files();
  folder.Write("report", "calibration.json", core::DumpJson(CalibrateJson(request, result)));
  folder.Finish();
  result.files = folder.files();
  return result;
}

}  // namespace rockyard::campaign

#include "campaign/calibrate/calibrate_cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "campaign/calibrate/calibrate_json.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/numbers.h"
#include "image_files/raw_image.h"
#include "image_files/read_image.h"
#include "vision/calibration/bundle.h"
#include "vision/calibration/find_chessboard.h"
#include "vision/calibration/target_file.h"
#include "vision/cameras/camera_file.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;
using core::Problem;

struct CalibrateInput {
  vision::CalibrationData data;
  std::vector<std::vector<std::string>> read;  // by camera, by image: what was read
  std::string advice;                          // of image_files::ToGray, on the first that has any
};

void CheckCounts(const CalibrateRequest& request, const vision::Target& target) {
  const std::size_t images = request.images.size();
  if (!request.right.empty() && request.right.size() != images) {
    throw core::UserError(
        "--right",
        fmt::format("names {} images, the left camera has {}", request.right.size(), images),
        "give the right image of each left one, in the same order");
  }
  if (!target.surveyed_X_AT.empty() && target.surveyed_X_AT.size() != images) {
    throw core::UserError(
        request.target.string(),
        fmt::format("has {} poses, there are {} images", target.surveyed_X_AT.size(), images),
        "give one pose for each image, in their order, or leave poses out");
  }
  std::set<fs::path> seen;
  for (const auto* paths : {&request.images, &request.right}) {
    for (const fs::path& path : *paths) {
      if (seen.insert(path).second) continue;
      throw core::UserError(path.string(), "is named twice",
                            "give each image once: it adds nothing the second time");
    }
  }
}

// Reads one camera's images; what is wrong with them goes to `problems`.
class CornerReader {
 public:
  CornerReader(const CalibrateRequest& request, CalibrateInput& input,
               std::vector<Problem>& problems)
      : request_(request), input_(input), problems_(problems) {}

  void Read(const std::vector<fs::path>& paths) {
    input_.data.corners.emplace_back();
    input_.read.emplace_back();
    for (const fs::path& path : paths) {
      try {
        ReadOne(path);
      } catch (const core::UserError& error) {
        problems_.insert(problems_.end(), error.problems().begin(), error.problems().end());
      }
    }
  }

 private:
  void ReadOne(const fs::path& path) {
    const image_files::RawImage raw = image_files::ReadImage(path);
    const image_files::GrayConversion gray = image_files::ToGray(raw, {.white = request_.white});
    input_.read.back().push_back(
        fmt::format("{}; {}", image_files::DescribeImage(raw), gray.what_was_done));
    if (input_.advice.empty()) input_.advice = gray.advice;
    CheckSize(path, gray.image);
    core::Result<std::vector<vision::Pixel>> corners =
        vision::FindChessboard(gray.image, input_.data.board);
    if (!corners.ok()) {
      Problem problem = corners.problems().front();
      throw core::UserError(path.string(), problem.reason,
                            gray.advice.empty() ? problem.suggestion : gray.advice);
    }
    input_.data.corners.back().push_back(*corners);
  }

  void CheckSize(const fs::path& path, const vision::GrayImage& image) {
    vision::ImageSize& size = input_.data.size;
    if (size.columns == 0) {
      size = {image.width(), image.height()};
      first_ = path;
    }
    if (image.width() == size.columns && image.height() == size.rows) return;
    throw core::UserError(path.string(),
                          fmt::format("has {} x {} pixels, {} has {} x {}", image.width(),
                                      image.height(), first_.string(), size.columns, size.rows),
                          "give images of one size, as the cameras took them");
  }

  const CalibrateRequest& request_;
  CalibrateInput& input_;
  std::vector<Problem>& problems_;
  fs::path first_;
};

// Throws core::UserError: a target file that is none, another number of right images or of poses
// than of images, one file twice, files that cannot be read, images of another size than the first,
// images without the board.
CalibrateInput ReadCalibrateInput(const CalibrateRequest& request) {
  const vision::Target target = vision::LoadTarget(request.target);
  CheckCounts(request, target);
  CalibrateInput input;
  input.data.board = target.board;
  input.data.surveyed_X_AT = target.surveyed_X_AT;
  std::vector<Problem> problems;
  CornerReader reader(request, input, problems);
  reader.Read(request.images);
  if (!request.right.empty()) reader.Read(request.right);
  if (!problems.empty()) throw core::UserError(std::move(problems));
  return input;
}

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

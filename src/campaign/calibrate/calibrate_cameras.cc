#include "campaign/calibrate/calibrate_cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/numbers.h"
#include "core/provenance.h"
#include "image_files/raw_image.h"
#include "image_files/read_image.h"
#include "report/result_table.h"
#include "vision/calibration/bundle.h"
#include "vision/calibration/find_chessboard.h"
#include "vision/calibration/target_file.h"
#include "vision/cameras/camera_file.h"

namespace rockyard::campaign {
namespace {

using core::JsonValue;
using vision::Pixel;

JsonValue EstimateJson(const vision::Estimate& estimate) {
  return report::ObjectTree("value", estimate.value, "sd", estimate.sd);
}

JsonValue CovarianceJson(const vision::CameraCovariance& covariance, vision::EstimatedLens lens) {
  const Eigen::Index size = lens == vision::EstimatedLens::kCahv ? 12 : vision::kCameraNumbers;
  JsonValue::List rows;
  for (Eigen::Index row = 0; row < size; ++row) {
    JsonValue::List values;
    for (Eigen::Index column = 0; column < size; ++column) {
      values.emplace_back(covariance(row, column));
    }
    rows.emplace_back(std::move(values));
  }
  return JsonValue(std::move(rows));
}

// Returns the median distance between the camera and the middles of the targets, m.
double MedianDistance(const CalibrateResult& result, std::size_t camera) {
  std::vector<double> distances_m;
  for (const math::Transform& X_AT : result.calibration.X_AT) {
    const math::Vector3 middle =
        0.5 * vision::CornerPosition(result.board, result.board.corners() - 1);
    distances_m.push_back((X_AT * middle - result.calibration.cameras[camera].linear.C).norm());
  }
  const auto middle = distances_m.begin() + static_cast<std::ptrdiff_t>(distances_m.size() / 2);
  std::nth_element(distances_m.begin(), middle, distances_m.end());
  return *middle;
}

// Returns the predicted errors of a camera (vision::PredictedError) at 5 x 5 pixels over the image,
// corners and middle included, for points at the targets' median distance. Pixels without a ray are
// left out.
std::vector<PredictedPixel> PredictedErrors(const CalibrateRequest& request,
                                            const CalibrateResult& result, std::size_t camera) {
  const vision::CameraModel model =
      vision::ModelOf(result.calibration, camera, result.size, request.lens);
  const vision::CameraCovariance covariance = vision::CovarianceOf(result.calibration, camera);
  const double distance_m = MedianDistance(result, camera);
  std::vector<PredictedPixel> pixels;
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 5; ++column) {
      const Pixel at(0.25 * column * (result.size.columns - 1),
                     0.25 * row * (result.size.rows - 1));
      const auto ray = vision::BackProject(model, at);
      if (!ray) continue;
      const auto error_px = vision::PredictedError(result.calibration.cameras[camera], covariance,
                                                   ray->origin + distance_m * ray->direction);
      if (error_px) pixels.push_back({at, *error_px});
    }
  }
  return pixels;
}

JsonValue CameraPartJson(const CalibrateRequest& request, const CalibrateResult& result,
                         std::size_t camera) {
  const vision::CameraCovariance covariance = vision::CovarianceOf(result.calibration, camera);
  const vision::Intrinsics found =
      vision::IntrinsicsOf(result.calibration.cameras[camera], covariance);
  JsonValue json = report::ObjectTree(
      "name", CameraName(result, camera), "camera",
      vision::CameraJson(vision::ModelOf(result.calibration, camera, result.size, request.lens)),
      "focal_h_px", EstimateJson(found.focal_h_px), "focal_v_px", EstimateJson(found.focal_v_px),
      "centre_h_px", EstimateJson(found.centre_h_px), "centre_v_px",
      EstimateJson(found.centre_v_px), "covariance", CovarianceJson(covariance, request.lens));
  const auto pixel_json = [](const PredictedPixel& pixel) {
    return report::ObjectTree("column", pixel.at.x(), "row", pixel.at.y(), "error_px",
                              pixel.error_px);
  };
  report::SetMembers(json, "predicted_error_distance_m", MedianDistance(result, camera),
                     "predicted_error",
                     core::ListOf(PredictedErrors(request, result, camera), pixel_json));
  return json;
}

JsonValue ImagesJson(const CalibrateRequest& request, const CalibrateResult& result) {
  JsonValue::List images;
  for (std::size_t camera = 0; camera < result.read.size(); ++camera) {
    const auto& paths = camera == 0 ? request.images : request.right;
    for (std::size_t image = 0; image < paths.size(); ++image) {
      images.push_back(report::ObjectTree("camera", CameraName(result, camera), "file",
                                          paths[image].string(), "what", result.read[camera][image],
                                          "rms_px",
                                          core::NumberOrNull(result.ImageRms(camera, image))));
    }
  }
  return JsonValue(std::move(images));
}

JsonValue PoseJson(const math::Transform& X_AT) {
  const Eigen::Quaterniond q(X_AT.linear());
  const math::Vector3& p = X_AT.translation();
  return report::ObjectTree("position_m", core::ListOf(std::vector<double>{p.x(), p.y(), p.z()}),
                            "rotation_wxyz",
                            core::ListOf(std::vector<double>{q.w(), q.x(), q.y(), q.z()}));
}

JsonValue OutliersJson(const CalibrateRequest& request, const CalibrateResult& result) {
  const auto columns = static_cast<std::size_t>(result.board.columns);
  return core::ListOf(result.calibration.outliers, [&](const vision::CornerResidual& corner) {
    return report::ObjectTree(
        "file", ImageOf(request, corner).string(), "row", corner.corner / columns, "column",
        corner.corner % columns, "residual_px",
        core::ListOf(std::vector<double>{corner.residual_px.x(), corner.residual_px.y()}));
  });
}

JsonValue FitJson(const vision::Calibration& calibration) {
  return report::ObjectTree("corners", calibration.corners, "degrees_of_freedom",
                            calibration.degrees_of_freedom, "rms_px", calibration.rms_px,
                            "sigma_px", calibration.sigma_px);
}

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

// Reads the images of one camera; what is wrong with them goes to `problems`.
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

// Reads all input. Throws core::UserError: a target file that is none, another number of right
// images or of poses than of images, one file twice, files that cannot be read, images of another
// size than the first, images without the board.
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

// A predicted error above this is noted, px: corners are missing there.
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

JsonValue CalibrateJson(const CalibrateRequest& request, const CalibrateResult& result) {
  JsonValue json = report::ObjectTree(
      "schema_version", 1, "target", core::WriteParams(result.board), "size",
      report::ObjectTree("columns", result.size.columns, "rows", result.size.rows), "frame",
      result.surveyed ? "survey" : "first camera", "fit", FitJson(result.calibration), "numbers",
      request.lens == vision::EstimatedLens::kCahv ? "C A H V" : "C A H V O R");
  JsonValue::List cameras;
  for (std::size_t i = 0; i < result.calibration.cameras.size(); ++i) {
    cameras.push_back(CameraPartJson(request, result, i));
  }
  report::SetMembers(json, "cameras", std::move(cameras), "baseline_m",
                     result.calibration.cameras.size() == 2
                         ? EstimateJson(vision::BaselineOf(result.calibration))
                         : JsonValue(),
                     "images", ImagesJson(request, result), "poses",
                     core::ListOf(result.calibration.X_AT, PoseJson), "outliers",
                     OutliersJson(request, result), "notes", core::ListOf(result.notes), "files",
                     FilesJson(result.files), "program", core::VersionLine());
  return json;
}

}  // namespace rockyard::campaign

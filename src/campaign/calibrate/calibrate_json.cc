#include "campaign/calibrate/calibrate_json.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/archive.h"
#include "core/provenance.h"
#include "report/json_members.h"
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

// Between the camera and the middle of each target, m.
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

}  // namespace

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

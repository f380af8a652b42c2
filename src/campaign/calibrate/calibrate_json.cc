#include "campaign/calibrate/calibrate_json.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "core/archive.h"
#include "core/provenance.h"
#include "vision/cameras/camera_file.h"

namespace rockyard::campaign {
namespace {

using core::JsonValue;
using vision::Pixel;

JsonValue EstimateJson(const vision::Estimate& estimate) {
  return JsonValue::Object({{"value", estimate.value}, {"sd", estimate.sd}});
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
  JsonValue json = JsonValue::Object();
  json.Set("name", JsonValue(CameraName(result, camera)));
  json.Set("camera", vision::CameraJson(
                         vision::ModelOf(result.calibration, camera, result.size, request.lens)));
  json.Set("focal_h_px", EstimateJson(found.focal_h_px));
  json.Set("focal_v_px", EstimateJson(found.focal_v_px));
  json.Set("centre_h_px", EstimateJson(found.centre_h_px));
  json.Set("centre_v_px", EstimateJson(found.centre_v_px));
  json.Set("covariance", CovarianceJson(covariance, request.lens));
  const auto pixel_json = [](const PredictedPixel& pixel) {
    return JsonValue::Object(
        {{"column", pixel.at.x()}, {"row", pixel.at.y()}, {"error_px", pixel.error_px}});
  };
  json.Set("predicted_error_distance_m", JsonValue(MedianDistance(result, camera)));
  json.Set("predicted_error", core::ListOf(PredictedErrors(request, result, camera), pixel_json));
  return json;
}

JsonValue ImagesJson(const CalibrateRequest& request, const CalibrateResult& result) {
  JsonValue::List images;
  for (std::size_t camera = 0; camera < result.read.size(); ++camera) {
    const auto& paths = camera == 0 ? request.images : request.right;
    for (std::size_t image = 0; image < paths.size(); ++image) {
      images.push_back(
          JsonValue::Object({{"camera", CameraName(result, camera)},
                             {"file", paths[image].string()},
                             {"what", result.read[camera][image]},
                             {"rms_px", core::NumberOrNull(result.ImageRms(camera, image))}}));
    }
  }
  return JsonValue(std::move(images));
}

JsonValue PoseJson(const math::Transform& X_AT) {
  const Eigen::Quaterniond q(X_AT.linear());
  const math::Vector3& p = X_AT.translation();
  return JsonValue::Object(
      {{"position_m", core::ListOf(std::vector<double>{p.x(), p.y(), p.z()})},
       {"rotation_wxyz", core::ListOf(std::vector<double>{q.w(), q.x(), q.y(), q.z()})}});
}

JsonValue OutliersJson(const CalibrateRequest& request, const CalibrateResult& result) {
  const auto columns = static_cast<std::size_t>(result.board.columns);
  return core::ListOf(result.calibration.outliers, [&](const vision::CornerResidual& corner) {
    return JsonValue::Object(
        {{"file", ImageOf(request, corner).string()},
         {"row", corner.corner / columns},
         {"column", corner.corner % columns},
         {"residual_px",
          core::ListOf(std::vector<double>{corner.residual_px.x(), corner.residual_px.y()})}});
  });
}

JsonValue FitJson(const vision::Calibration& calibration) {
  return JsonValue::Object({{"corners", calibration.corners},
                            {"degrees_of_freedom", calibration.degrees_of_freedom},
                            {"rms_px", calibration.rms_px},
                            {"sigma_px", calibration.sigma_px}});
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
  JsonValue json = JsonValue::Object();
  json.Set("schema_version", JsonValue(std::int64_t{1}));
  json.Set("target", core::WriteParams(result.board));
  json.Set("size",
           JsonValue::Object({{"columns", result.size.columns}, {"rows", result.size.rows}}));
  json.Set("frame", JsonValue(result.surveyed ? "survey" : "first camera"));
  json.Set("fit", FitJson(result.calibration));
  json.Set("numbers",
           JsonValue(request.lens == vision::EstimatedLens::kCahv ? "C A H V" : "C A H V O R"));
  JsonValue::List cameras;
  for (std::size_t i = 0; i < result.calibration.cameras.size(); ++i) {
    cameras.push_back(CameraPartJson(request, result, i));
  }
  json.Set("cameras", JsonValue(std::move(cameras)));
  json.Set("baseline_m", result.calibration.cameras.size() == 2
                             ? EstimateJson(vision::BaselineOf(result.calibration))
                             : JsonValue());
  json.Set("images", ImagesJson(request, result));
  json.Set("poses", core::ListOf(result.calibration.X_AT, PoseJson));
  json.Set("outliers", OutliersJson(request, result));
  json.Set("notes", core::ListOf(result.notes));
  json.Set("files", FilesJson(result.files));
  json.Set("program", JsonValue(core::VersionLine()));
  return json;
}

}  // namespace rockyard::campaign

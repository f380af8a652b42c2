#include "trial/eyes/stereo_eyes.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "sensing/stereo_view.h"
#include "trial/eyes/onboard_calibration.h"
#include "vision/cameras/cahv.h"
#include "vision/stereo/disparity.h"

namespace rockyard::trial {

using messages::LookDirection;

namespace {

perception::StereoSearch SearchOf(const sensing::StereoParams& params) {
  return {.pyramid_level = static_cast<int>(params.images.pyramid_level),
          .min_disparity_px = params.min_disparity_px,
          .max_disparity_px = params.max_disparity_px,
          .max_range_m = params.max_range_m};
}

sensing::DepthImage InPixels(const vision::DisparityImage& disparities) {
  sensing::DepthImage image = sensing::DepthImage::Zero(disparities.height(), disparities.width());
  for (int row = 0; row < disparities.height(); ++row) {
    for (int column = 0; column < disparities.width(); ++column) {
      const std::int16_t disparity = disparities.At(column, row);
      if (vision::IsValid(disparity)) image(row, column) = vision::DisparityPx(disparity);
    }
  }
  return image;
}

}  // namespace

StereoEyes::StereoEyes(const DriveParams& drive, core::TrialKey key, StereoWatcher watcher)
    : params_(drive.sensors.stereo),
      key_(key),
      watcher_(std::move(watcher)),
      misplaced_ahead_(StereoMisplacement(drive.sensors.stereo, drive.perception.calibration,
                                          LookDirection::kAhead)),
      misplaced_behind_(StereoMisplacement(drive.sensors.stereo, drive.perception.calibration,
                                           LookDirection::kBehind)) {
  if (params_.fidelity == sensing::StereoFidelity::kImage) {
    cameras_ = MakeCameras(drive);
  } else {
    rays_.emplace(params_, sensing::SunShade(drive.sensors.sun, drive.rover.geometry));
  }
}

StereoEyes::Cameras StereoEyes::MakeCameras(const DriveParams& drive) const {
  sensing::StereoImager imager(params_, drive.sensors.sun, drive.sensors.look, drive.rover.geometry,
                               key_);
  const perception::StereoSearch search = SearchOf(params_);
  perception::StereoPoints ahead(drive.perception.stereo, search,
                                 imager.rig(LookDirection::kAhead));
  perception::StereoPoints behind(drive.perception.stereo, search,
                                  imager.rig(LookDirection::kBehind));
  return {std::move(imager), std::move(ahead), std::move(behind)};
}

StereoSeen StereoEyes::See(const terrain::Terrain& terrain, const math::Transform& X_WR,
                           std::int64_t look_number, LookDirection direction) const {
  if (!rays_) return Match(terrain, X_WR, look_number, direction);
  StereoSeen seen;
  seen.disparities_px = rays_->InverseDepths(terrain, X_WR, key_, look_number, direction);
  seen.cloud = rays_->PointsOf(seen.disparities_px, look_number, direction);
  // d = f b / Z.
  seen.disparities_px *= params_.focal_columns_px() * params_.baseline_m;
  Misplace(seen.cloud);
  return seen;
}

void StereoEyes::Misplace(messages::PointCloud& cloud) const {
  const std::optional<math::Transform>& misplaced = Misplaced(cloud.direction);
  if (!misplaced) return;
  for (math::Vector3& p_RoP_R : cloud.points_R) p_RoP_R = *misplaced * p_RoP_R;
}

void StereoEyes::Show(const math::Transform& X_WR, const perception::StereoSight& sight,
                      const perception::StereoPoints& eyes,
                      const messages::PointCloud& cloud) const {
  vision::RectifiedPair pair = eyes.pair();
  if (const std::optional<math::Transform>& misplaced = Misplaced(cloud.direction)) {
    pair.left = vision::Moved(*misplaced, pair.left);
    pair.right = vision::Moved(*misplaced, pair.right);
  }
  watcher_({X_WR, sight, pair, eyes.params(), cloud});
}

StereoSeen StereoEyes::Match(const terrain::Terrain& terrain, const math::Transform& X_WR,
                             std::int64_t look_number, LookDirection direction) const {
  const sensing::StereoImages images =
      cameras_->imager.Expose(terrain, X_WR, look_number, direction);
  const perception::StereoPoints& eyes =
      direction == LookDirection::kAhead ? cameras_->ahead : cameras_->behind;
  const perception::StereoSight sight = eyes.See(images.left, images.right);
  StereoSeen seen{InPixels(sight.disparities),
                  {.number = look_number, .direction = direction, .points_R = {}}};
  seen.cloud.points_R.reserve(sight.points_R.size());
  std::copy_if(
      sight.points_R.begin(), sight.points_R.end(), std::back_inserter(seen.cloud.points_R),
      [&](const math::Vector3& p_RoP_R) { return sensing::IsWanted(params_, p_RoP_R, direction); });
  Misplace(seen.cloud);
  if (watcher_) Show(X_WR, sight, eyes, seen.cloud);
  return seen;
}

}  // namespace rockyard::trial

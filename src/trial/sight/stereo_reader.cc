#include "trial/sight/stereo_reader.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>
#include <variant>

#include "sensing/stereo_rig.h"
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

messages::LookImage AsMessage(const vision::GrayImage& image,
                              const messages::LinearCamera& camera) {
  return {image.width(), image.height(), {image.values().begin(), image.values().end()}, camera};
}

}  // namespace

StereoReader::Pair::Pair(const DriveParams& drive, LookDirection direction)
    : view_R(sensing::MakeStereoView(drive.sensors.stereo, direction)),
      cameras(OnboardCameras(drive.sensors.stereo, drive.perception.calibration, direction)),
      misplaced(StereoMisplacement(drive.sensors.stereo, drive.perception.calibration, direction)) {
  if (drive.sensors.stereo.fidelity != sensing::StereoFidelity::kImage) return;
  match.emplace(drive.perception.stereo, SearchOf(drive.sensors.stereo),
                sensing::CalibratedRig(drive.sensors.stereo, drive.rover.geometry, direction));
}

void StereoReader::Pair::Misplace(messages::PointCloud& cloud) const {
  if (!misplaced) return;
  for (math::Vector3& p_RoP_R : cloud.points_R) p_RoP_R = *misplaced * p_RoP_R;
}

StereoReader::StereoReader(const DriveParams& drive,
                           std::function<void(const StereoSightView&)> watcher)
    : params_(drive.sensors.stereo),
      elevations_(drive.perception.cloud_elevations),
      ahead_(drive, LookDirection::kAhead),
      behind_(drive, LookDirection::kBehind),
      watcher_(std::move(watcher)) {}

StereoSeen StereoReader::See(const LookOrder& order, const LookData& data) const {
  if (PairOf(order.direction).match) return Match(order, std::get<sensing::StereoImages>(data));
  // d = f b / Z.
  const double scale_px_m = params_.focal_columns_px() * params_.baseline_m;
  return {std::get<ModelledStereo>(data).inverse_depths * scale_px_m, Points(order, data)};
}

messages::PointCloud StereoReader::Points(const LookOrder& order, const LookData& data) const {
  const Pair& pair = PairOf(order.direction);
  if (pair.match) return Match(order, std::get<sensing::StereoImages>(data)).cloud;
  messages::PointCloud cloud =
      PointsOf(params_, pair.view_R, std::get<ModelledStereo>(data).inverse_depths, order.number,
               order.direction);
  pair.Misplace(cloud);
  return cloud;
}

std::optional<messages::LookImages> StereoReader::Images(const LookOrder& order,
                                                         const LookData& data) const {
  const auto* images = std::get_if<sensing::StereoImages>(&data);
  if (images == nullptr) return std::nullopt;
  const BelievedCameras& cameras = PairOf(order.direction).cameras;
  return messages::LookImages{order.number, order.direction, AsMessage(images->left, cameras.left),
                              AsMessage(images->right, cameras.right)};
}

StereoSeen StereoReader::Match(const LookOrder& order, const sensing::StereoImages& images) const {
  const Pair& pair = PairOf(order.direction);
  const perception::StereoSight sight = pair.match->See(images.left, images.right);
  StereoSeen seen{InPixels(sight.disparities),
                  {.number = order.number, .direction = order.direction, .points_R = {}}};
  seen.cloud.points_R.reserve(sight.points_R.size());
  std::copy_if(sight.points_R.begin(), sight.points_R.end(),
               std::back_inserter(seen.cloud.points_R), [&](const math::Vector3& p_RoP_R) {
                 return sensing::IsWanted(params_, p_RoP_R, order.direction);
               });
  pair.Misplace(seen.cloud);
  if (watcher_) Show(pair, sight, seen.cloud);
  return seen;
}

void StereoReader::Show(const Pair& pair, const perception::StereoSight& sight,
                        const messages::PointCloud& cloud) const {
  vision::RectifiedPair believed = pair.match->pair();
  if (pair.misplaced) {
    believed.left = vision::Moved(*pair.misplaced, believed.left);
    believed.right = vision::Moved(*pair.misplaced, believed.right);
  }
  watcher_({sight, believed, pair.match->params(), cloud});
}

}  // namespace rockyard::trial

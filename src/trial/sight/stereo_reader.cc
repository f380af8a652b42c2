#include "trial/sight/stereo_reader.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <iterator>
#include <utility>
#include <variant>
#include <vector>

#include "core/check.h"
#include "navigation/navigator_fault.h"
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

// Stands for a reader that could not begin, and is made where its fault is caught: says so at the
// first look, when there is a drive that can end by it.
class FailedStart final : public perception::PointReader {
 public:
  std::vector<math::Vector3> Points(const messages::LookImages& /*images*/) const override {
    std::rethrow_exception(fault_);
  }

 private:
  std::exception_ptr fault_ = std::current_exception();
};

std::unique_ptr<perception::PointReader> ReaderOf(const DriveParams& drive) {
  if (drive.sensors.stereo.fidelity != sensing::StereoFidelity::kImage) return nullptr;
  const navigation::LimitParams& limits = drive.navigation.limits;
  try {
    return drive.perception.readers.chosen().Make(
        {.rover = OnboardRoverBelief(drive.rover, drive.perception.calibration.drive,
                                     drive.perception.vehicle_hazard),
         .max_range_m = drive.sensors.stereo.max_range_m,
         .look_cpu_s = limits.decision_cpu_s,
         .drive_cpu_s = limits.drive_cpu_s});
  } catch (const navigation::NavigatorFault&) {
    return std::make_unique<FailedStart>();
  }
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
      reader_(ReaderOf(drive)),
      ahead_(drive, LookDirection::kAhead),
      behind_(drive, LookDirection::kBehind),
      watcher_(std::move(watcher)) {}

StereoSeen StereoReader::See(const LookOrder& order, const LookData& data) const {
  EXPECT(reader_ == nullptr);
  if (PairOf(order.direction).match) return Match(order, std::get<sensing::StereoImages>(data));
  // d = f b / Z.
  const double scale_px_m = params_.focal_columns_px() * params_.baseline_m;
  return {std::get<ModelledStereo>(data).inverse_depths * scale_px_m, Points(order, data)};
}

messages::PointCloud StereoReader::Points(const LookOrder& order, const LookData& data) const {
  const Pair& pair = PairOf(order.direction);
  if (reader_ != nullptr) return Read(order, data);
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

messages::PointCloud StereoReader::Read(const LookOrder& order, const LookData& data) const {
  messages::PointCloud cloud{order.number, order.direction,
                             reader_->Points(Images(order, data).value())};
  // As with rockyard's own, the window is where the cameras are meant to be, whatever is believed.
  const auto& misplaced = PairOf(order.direction).misplaced;
  const math::Transform as_meant =
      misplaced ? misplaced->inverse() : math::Transform(math::Transform::Identity());
  std::erase_if(cloud.points_R, [&](const math::Vector3& p_RoP_R) {
    return !sensing::IsWanted(params_, as_meant * p_RoP_R, order.direction);
  });
  return cloud;
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

#include "trial/sight/terrain_sensing.h"

#include <variant>

namespace rockyard::trial {

using messages::LookDirection;

TerrainSensing::TerrainSensing(const DriveParams& drive, const SightWatchers& watchers)
    : takes_image_sets_(drive.sensors.terrain_sensors.chosen().takes_image_sets()),
      reads_points_(drive.navigation.navigators.chosen().traits().reads ==
                    navigation::LookReading::kPoints),
      wants_images_(drive.navigation.navigators.chosen().traits().images),
      reads_images_alone_(ReadsImagesAlone(drive)),
      reader_(drive.sensors.terrain_sensors.chosen().MakeReader(drive, watchers)),
      hazard_detector_(drive.perception.hazard),
      look_time_(MakeLookTime(drive)) {}

LookOrder TerrainSensing::Order(LookDirection direction,
                                const messages::AttitudeEstimate& attitude) {
  if (looks_again_) ++rescans_;
  return {direction, attitude, looks_, reads_points_};
}

Percept TerrainSensing::Take(const LookOrder& order, const LookData& data) {
  if (std::holds_alternative<std::monostate>(data)) {
    return {.cloud = messages::PointCloud{order.number, order.direction, {}}};
  }
  ++looks_;
  if (order.direction == LookDirection::kBehind) ++looks_behind_;
  Percept percept = reads_images_alone_ ? Percept{.time = look_time_} : Read(order, data);
  if (wants_images_) percept.images = reader_->Images(order, data);
  return percept;
}

Percept TerrainSensing::Read(const LookOrder& order, const LookData& data) {
  if (order.points) return {.time = look_time_, .cloud = reader_->Points(order, data)};
  return Judge(reader_->Elevations(order, data));
}

Percept TerrainSensing::Judge(const messages::ElevationScan& elevations) {
  const perception::HazardDetector::Verdict verdict = hazard_detector_.Process(elevations);
  looks_again_ = verdict.scan_again;
  return {.look_again = verdict.scan_again, .time = look_time_, .report = verdict.report};
}

}  // namespace rockyard::trial

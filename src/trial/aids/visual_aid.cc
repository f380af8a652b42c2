#include "trial/aids/visual_aid.h"

#include <cmath>
#include <utility>

#include "core/check.h"
#include "math/angles.h"
#include "perception/visual_motion.h"
#include "trial/clock/compute_profile.h"

namespace rockyard::trial {
namespace {

math::Transform OdometryPose(const messages::PoseEstimate& odometry,
                             const messages::AttitudeEstimate& attitude) {
  return math::MakePose({odometry.x_m, odometry.y_m, attitude.z_m}, odometry.heading_rad,
                        attitude.pitch_rad, attitude.roll_rad);
}

}  // namespace

VisualAid::VisualAid(const DriveParams& drive, CaptureCounter& captures)
    : params_(drive.sensors.visual_odometry),
      slip_params_(drive.perception.visual_odometry.slip_check),
      tilt_sd_rad_(drive.perception.visual_odometry.tilt_sd_rad),
      imaging_s_(VisualTimeOf(drive.clock.compute).imaging_s),
      computing_s_(VisualTimeOf(drive.clock.compute).computing_s),
      captures_(&captures) {}

bool VisualAid::IsDue(const messages::LocalizationEstimate& believed, double time_s) const {
  if (!params_.enabled || waiting_) return false;
  if (!keyframe_) return true;
  const sensing::VisualScheduleParams& every = params_.schedule;
  const auto passed = [](double value, double limit) { return limit > 0.0 && value >= limit; };
  const messages::PoseEstimate& odometry = believed.odometry;
  return passed(odometry.distance_m - last_odometry_.distance_m, every.every_m) ||
         passed(std::abs(math::WrapAngle(odometry.heading_rad - last_odometry_.heading_rad)),
                every.every_rad) ||
         passed(time_s - last_time_s_, every.every_s);
}

math::Transform VisualAid::Expected(const messages::LocalizationEstimate& believed) const {
  if (!keyframe_) return math::Transform::Identity();
  return OdometryPose(keyframe_->odometry, keyframe_->attitude).inverse() *
         OdometryPose(believed.odometry, believed.attitude);
}

bool VisualAid::Take(const VisualStep& step, double time_s, double ready_s,
                     localization::Estimator& estimator) {
  EXPECT(params_.enabled && !waiting_);
  const messages::LocalizationEstimate& believed = estimator.estimate();
  const Moment now{.look = step.number,
                   .capture = captures_->Next(),
                   .attitude = believed.attitude,
                   .odometry = believed.odometry};
  estimator.Capture(now.capture);
  last_odometry_ = now.odometry;
  last_time_s_ = time_s;
  if (step.keyframe) ++counts_.keyframes;
  if (!keyframe_) {
    ENSURE(step.keyframe);
    keyframe_ = now;
    return false;
  }
  ENSURE(step.reference == keyframe_->look);
  waiting_ = Waiting{ready_s, step, *keyframe_, now};
  if (step.keyframe) keyframe_ = now;
  ++counts_.steps;
  if (!step.result.motion) ++counts_.failures;
  return true;
}

bool VisualAid::Tick(double time_s, localization::Estimator& estimator) {
  if (!waiting_ || waiting_->ready_s > time_s) return false;
  const Waiting ready = *waiting_;
  waiting_.reset();
  const bool corrected = HandIn(ready, estimator);
  // The estimator forgets moments that nothing will be compared with any more.
  for (const Moment* moment : {&ready.from, &ready.to}) {
    if (moment->look != keyframe_->look) estimator.Forget(moment->capture);
  }
  return corrected;
}

bool VisualAid::HandIn(const Waiting& waiting, localization::Estimator& estimator) {
  if (!waiting.step.result.motion) return false;
  messages::RelativeMotion motion = perception::LevelledMotion(
      *waiting.step.result.motion, {waiting.from.attitude, tilt_sd_rad_});
  motion.from = waiting.from.capture;
  motion.to = waiting.to.capture;
  CheckSlip(waiting, motion);
  switch (estimator.Update(motion)) {
    case localization::AidUse::kUsed:
    case localization::AidUse::kUsedInDoubt:
      ++counts_.used;
      return true;
    case localization::AidUse::kGatedOut:
      ++counts_.gated_out;
      return false;
    case localization::AidUse::kUnknown:
    case localization::AidUse::kNoInterest:
      return false;
  }
  return false;
}

void VisualAid::CheckSlip(const Waiting& waiting, const messages::RelativeMotion& seen) {
  if (!slip_params_.enabled) return;
  const Eigen::Vector2d rolled = perception::RolledWay(waiting.from.odometry, waiting.to.odometry);
  const auto measured = perception::SlipOf(rolled, seen, slip_params_);
  if (!measured) return;
  slip_ = SlipReading{*measured, rolled, waiting.from.look, waiting.to.look};
}

std::optional<SlipReading> VisualAid::TakeSlip() { return std::exchange(slip_, std::nullopt); }

void VisualAid::BeginAnew(localization::Estimator& estimator) {
  EXPECT(params_.enabled && !waiting_);
  if (keyframe_) estimator.Forget(keyframe_->capture);
  keyframe_.reset();
}

void VisualAid::OnPlaced() {
  keyframe_.reset();
  waiting_.reset();
}

}  // namespace rockyard::trial

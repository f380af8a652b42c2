/// @file
/// Where the rover believes to be, whatever it is worked out from.
#pragma once

#include <optional>

#include "localization/error_state.h"
#include "math/pose.h"
#include "messages/aids.h"
#include "messages/estimates.h"
#include "messages/measurements.h"
#include "messages/vehicle_state.h"

namespace rockyard::localization {

/// What an estimator of the same kind begins with when the computer is switched on again, at the
/// place where the rover stood. Odometer, roll, pitch and height begin anew, and data that aids
/// took before are of no use any more.
struct EstimatorMemory {
  math::Pose2 pose;  ///< as believed, in the frame in which goals are told
  /// Of estimators that keep account of their error; empty for others.
  std::optional<ErrorMatrix> covariance;  ///< rows as in error_state.h
  double gyro_scale = 1.0;                ///< measured over true turn, as believed
  double wheel_scale = 1.0;               ///< true over rolled way, as believed
  double pan_rad = 0.0;                   ///< by which the lander's frame is turned, as believed
};

/// What became of an aid's data.
enum class AidUse {
  kUsed,         ///< it corrected the estimate
  kGatedOut,     ///< too far from what was believed to be true
  kUsedInDoubt,  ///< as far off, but not the first in a row: the estimator doubted itself instead
  kUnknown,      ///< of a moment that is not kept, or is kept no more
  kNoInterest    ///< the estimator takes no aids
};

/// An estimator of one drive. Wheels and gyro carry it on; aids correct it, perhaps late: it keeps
/// the pose of each moment at which an aid took its data until these have arrived (stochastic
/// cloning; Roumeliotis and Burdick 2002). It is a pure function of these calls, as trials repeat
/// bit for bit.
class Estimator {
 public:
  virtual ~Estimator() = default;

  /// One on-board tick of wheels and gyro; a rover that stands has one too.
  virtual void Propagate(const messages::MotionMeasurement& motion) = 0;

  /// What the rover felt over the last `duration_s` > 0, after Propagate.
  virtual void Feel(const messages::VehicleState& felt, double duration_s) = 0;

  /// Operators moved the rover by hand, and say where it is: both frames begin anew there. What an
  /// aid took before is of no use any more.
  virtual void Place(const messages::PoseUpdate& update) = 0;

  /// An aid takes its data now. `capture` is larger than every one before.
  virtual void Capture(messages::CaptureNumber /*capture*/) {}
  /// Its data will not come.
  virtual void Forget(messages::CaptureNumber /*capture*/) {}

  /// Corrects the estimate of now by what was measured then. A moment that was used is kept until
  /// Forget: a motion may begin where another one ended.
  virtual AidUse Update(const messages::PoseFix& /*fix*/) { return AidUse::kNoInterest; }
  virtual AidUse Update(const messages::RelativeMotion& /*motion*/) { return AidUse::kNoInterest; }

  /// Returns what it believes now. Valid until the next call that changes it.
  virtual const messages::LocalizationEstimate& estimate() const = 0;

  /// What is kept while the computer is off (EstimatorSetup::memory).
  virtual EstimatorMemory Remember() const {
    const messages::PoseEstimate& pose = estimate().pose;
    return {.pose = {pose.x_m, pose.y_m, pose.heading_rad}, .covariance = std::nullopt};
  }
};

}  // namespace rockyard::localization

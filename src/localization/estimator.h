/// @file
/// The interface of every estimator: where the rover believes to be, whatever it is worked out
/// from. The on-board side of a drive carries one estimator on, aids correct it, and missions keep
/// its memory from sol to sol. Programs that bring an estimator of their own derive from it.
#pragma once

#include <optional>
#include <span>

#include "localization/error_state.h"
#include "math/pose.h"
#include "messages/aids.h"
#include "messages/estimates.h"
#include "messages/measurements.h"
#include "messages/vehicle_state.h"

namespace rockyard::localization {

/// What an estimator keeps while the computer is off; an estimator of the same kind begins with it
/// (EstimatorSetup::memory) at the place where the rover stood. Odometer, roll, pitch and height
/// begin anew, and data that aids took before are of no use any more.
struct EstimatorMemory {
  math::Pose2 pose;  ///< as believed, in the frame in which goals are told
  /// Covariance of the error, with the rows of error_state.h; empty where the estimator keeps no
  /// account of it.
  std::optional<ErrorMatrix> covariance;
  double gyro_scale = 1.0;   ///< measured over true turn, as believed
  double wheel_scale = 1.0;  ///< true over rolled way, as believed
  double pan_rad = 0.0;      ///< angle by which the lander's frame is turned, as believed
};

/// What became of the data of an aid.
enum class AidUse {
  kUsed,         ///< they corrected the estimate
  kGatedOut,     ///< they were too far from what is believed, and were turned away
  kUsedInDoubt,  ///< they were too far off, but the estimator doubted itself and used them
  kUnknown,      ///< they are of a moment that is not kept, or not kept any more
  kNoInterest    ///< the estimator does not take such data
};

/// An estimator of one drive. Wheels and gyro carry it on. Aids correct it, perhaps late: it keeps
/// the pose of each moment at which an aid took its data until the data have arrived (stochastic
/// cloning; Roumeliotis and Burdick 2002). Must stay: the estimate is a pure function of the calls
/// below, as trials repeat bit for bit.
class Estimator {
 public:
  virtual ~Estimator() = default;

  /// Takes one on-board tick of wheels and gyro; a rover that stands has ticks, too.
  virtual void Propagate(const messages::MotionMeasurement& motion) = 0;

  /// Takes what the rover felt over the last `duration_s` > 0; called after Propagate.
  virtual void Feel(const messages::VehicleState& felt, double duration_s) = 0;

  /// Takes where operators say that they moved the rover by hand: pose and odometry begin anew
  /// there. Data that an aid took before are of no use any more.
  virtual void Place(const messages::PoseUpdate& update) = 0;

  /// Keeps the present moment, at which an aid takes its data. `capture` is larger than every
  /// number before.
  virtual void Capture(messages::CaptureNumber /*capture*/) {}
  /// Forgets a moment: no more of its data will come.
  virtual void Forget(messages::CaptureNumber /*capture*/) {}

  /// Correct the present estimate by what was measured at kept moments. A moment is kept until
  /// Forget, also when it was used: a motion may begin where another one ended.
  virtual AidUse Update(const messages::PoseFix& /*fix*/) { return AidUse::kNoInterest; }
  virtual AidUse Update(const messages::RelativeMotion& /*motion*/) { return AidUse::kNoInterest; }

  /// Returns what is believed now. The reference is valid until the next call that is not const.
  virtual const messages::LocalizationEstimate& estimate() const = 0;

  /// Returns what is kept while the computer is off.
  virtual EstimatorMemory Remember() const {
    const messages::PoseEstimate& pose = estimate().pose;
    return {.pose = {pose.x_m, pose.y_m, pose.heading_rad}, .covariance = std::nullopt};
  }

  /// Returns what it counts for itself, as its description declares it: columns of the record. Read
  /// at the end of a drive; NaN: none.
  virtual std::span<const double> own_values() const { return {}; }
};

}  // namespace rockyard::localization

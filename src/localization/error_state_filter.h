// Error-state extended Kalman filter: dead reckoning as flown carries the pose on, the filter keeps
// account of the pose's error, and aids correct pose and sensors by what they tell of that error.
// Of rockyard's own estimators it alone takes fixes. Records depend on it, and on where stretches
// end, only in scenarios with localization.estimator error_state.
//
// Believed are position, attitude, gyro bias and scale, and wheel scale; their errors
// (error_state.h) grow as error_stretch.h says. The covariance is carried on every `stretch_m` of
// way and before a measurement, not each tick, so that estimate().covariance is that of the last
// such moment. A measurement of moments that were captured (one, or two with a motion between them)
// corrects the present state and every kept moment (cloned_covariance.h). aid_fixes.h says which
// measurements are believed.
//
// Goals, and the fixes of the mast that designates them, are wrong by one pan angle, which is one
// of the errors. A fix in the lander's frame tells of pose and pan together, a fix in W (sun,
// beacon) of the pose alone, so that both at once tell the pan. estimate().pose is the rover's pose
// in the lander's frame, in which its goal was told; estimate().world is its pose in W.
//
// Roll and pitch come from accelerometers; a correction of roll and pitch fades along the way as
// their errors do. Corrections of bias and scales bend the way that is driven afterwards, in the
// odometry frame as well, which never jumps.
//
// Limits: errors are small (heading errors below some 0.5 rad: the equations are linear in them,
// and a filter that is further off is overconfident); the gyro's turn is taken as that of the
// heading, though on a tilted rover it is about its own axis; scrapes and slip are noise of a
// stated rate, while in truth they come singly. Cost: results/localization.md.
#pragma once

#include <map>
#include <optional>

#include "localization/aid_fixes.h"
#include "localization/cloned_covariance.h"
#include "localization/dead_reckoning.h"
#include "localization/error_state.h"
#include "localization/error_state_filter_params.h"
#include "localization/error_stretch.h"
#include "localization/estimator.h"
#include "localization/estimator_set_params.h"

namespace rockyard::localization {

// The filter as an estimator.
class ErrorStateFilter final : public Estimator {
 public:
  ErrorStateFilter(const ErrorStateFilterParams& params, const EstimatorSetup& setup);

  void Propagate(const messages::MotionMeasurement& motion) override;
  void Feel(const messages::VehicleState& felt, double duration_s) override;
  // A told place is as good as the prior says; a mirrored place has the mirrored error. What is
  // known of the sensors stays.
  void Place(const messages::PoseUpdate& update) override;

  void Capture(messages::CaptureNumber capture) override;
  void Forget(messages::CaptureNumber capture) override;
  AidUse Update(const messages::PoseFix& fix) override;
  AidUse Update(const messages::RelativeMotion& motion) override;

  const messages::LocalizationEstimate& estimate() const override { return estimate_; }
  EstimatorMemory Remember() const override;

  // Return what is believed of the sensors.
  double gyro_bias_rad_s() const { return gyro_bias_rad_s_; }
  double gyro_scale() const { return gyro_scale_; }    // measured over true turn
  double wheel_scale() const { return wheel_scale_; }  // true over rolled way
  double pan_rad() const { return pan_rad_; }          // of the lander's frame, in W
  // Returns the covariance of all rows of the error, at the end of the last stretch.
  ErrorMatrix covariance() const { return errors_.now(); }

 private:
  // What is kept of one kind of fix.
  struct Kind {
    Gate gate;
    double believed_at_m = 0.0;  // way_m_ at the last fix that was believed
  };
  // One measurement: r = sum of the parts' jacobians times errors, and noise.
  struct Residual {
    std::vector<ClonedCovariance::Part> parts;
    Eigen::VectorXd values;
    Eigen::MatrixXd noise;
    bool of_place = false;  // x or y are among the values
    Kind* kind = nullptr;
  };

  // Begins with what was known of pan, scales and the errors of place and heading. A gyro that is
  // switched on has a new bias; roll, pitch and height begin anew.
  void Recall(const EstimatorMemory& memory);
  messages::PoseVector PoseNow() const;
  // A pose of W in the frame of a fix, and how an error of pose and pan shows there.
  struct InFrame {
    messages::PoseVector pose;
    Eigen::Matrix<double, messages::kPoseCoordinates, kErrorCoordinates> by_error;
  };
  InFrame InWorld(const messages::PoseVector& pose_W) const;
  InFrame InLanderFrame(const messages::PoseVector& pose_W) const;
  TickNoise NoiseOf(const messages::MotionMeasurement& motion, double forward_m) const;
  // Carries the covariance on over the stretch so far.
  void EndStretch();
  AidUse Take(const Residual& residual, const messages::PoseVector& doubt);
  // Takes a motion whose residual in W is `difference`.
  AidUse TakeMotion(const messages::RelativeMotion& motion, const Residual& residual,
                    const messages::PoseVector& difference);
  // Makes the errors larger: between the two moments the pose may have gone wrong by `difference`.
  void DoubtWheels(const messages::RelativeMotion& motion, const messages::PoseVector& difference);
  void Correct(const Eigen::MatrixXd& changes);
  // Bring estimate() up to date: its poses, and its covariance at the end of the last stretch.
  void TellPose();
  void TellCovariance();

  ErrorStateFilterParams params_;
  messages::DriveCalibration calibration_;
  DeadReckoningParams dead_reckoning_;
  std::optional<LanderFrame> lander_;
  AttitudeEstimator attitude_;
  // Kinds of fixes, by what they measure in which frame: a sun that is right about the heading must
  // not excuse a wrong place, nor a coarse beacon the mast.
  std::map<unsigned long, Kind> kinds_;
  Kind motions_;

  messages::PoseEstimate pose_W_;
  double pan_rad_ = 0.0;
  double gyro_bias_rad_s_ = 0.0;
  double gyro_scale_ = 1.0;
  double wheel_scale_ = 1.0;
  // What aids added to the attitude that accelerometers and odometry tell.
  double roll_correction_rad_ = 0.0;
  double pitch_correction_rad_ = 0.0;
  double z_correction_m_ = 0.0;
  messages::PoseEstimate felt_odometry_;  // at the last Feel

  ErrorStretch stretch_;
  ClonedCovariance errors_;
  std::map<messages::CaptureNumber, messages::PoseVector> moments_;  // believed poses of clones
  double way_m_ = 0.0;  // since the beginning or the last Place

  messages::LocalizationEstimate estimate_;
};

// Describes the estimator that scenarios name error_state.
EstimatorDescription<ErrorStateFilterParams> DescribeErrorStateFilter();

}  // namespace rockyard::localization

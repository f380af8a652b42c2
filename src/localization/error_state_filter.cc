#include "localization/error_state_filter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "localization/dead_reckoning.h"
#include "math/angles.h"
#include "math/functions.h"

namespace rockyard::localization {
namespace {

using messages::kPoseCoordinates;
using messages::PoseVector;

double Squared(double value) { return value * value; }

// The deviations are listed in the order of error::Row.
ErrorMatrix PriorCovariance(const ErrorStateFilterParams& params,
                            const std::optional<LanderFrame>& lander) {
  const PriorParams& prior = params.prior;
  ErrorVector deviations;
  deviations << prior.position_sd_m, prior.position_sd_m, prior.position_sd_m,
      params.drift.tilt_sd_rad, params.drift.tilt_sd_rad, prior.heading_sd_rad,
      prior.gyro_bias_sd_rad_s, prior.gyro_scale_sd, prior.wheel_scale_sd,
      lander ? lander->pan_sd_rad : 0.0;
  return deviations.cwiseAbs2().asDiagonal();
}

// Brings the angles of a difference within [-pi, pi].
PoseVector Wrapped(PoseVector difference) {
  for (const int angle : {error::kRoll, error::kPitch, error::kHeading}) {
    difference[angle] = math::WrapAngle(difference[angle]);
  }
  return difference;
}

void Add(const PoseVector& change, PoseVector& pose) { pose = Wrapped(pose + change); }

// Returns the covariance after a night: `remembered` for the errors that a night leaves as they
// were, `prior` for the errors that begin anew, which are independent of all others.
ErrorMatrix AfterNight(const ErrorMatrix& remembered, const ErrorMatrix& prior) {
  constexpr std::array kKept{error::kX,         error::kY,          error::kHeading,
                             error::kGyroScale, error::kWheelScale, error::kPan};
  ErrorMatrix covariance = prior;
  for (const int row : kKept) {
    for (const int column : kKept) covariance(row, column) = remembered(row, column);
  }
  return covariance;
}

}  // namespace

ErrorStateFilter::ErrorStateFilter(const ErrorStateFilterParams& params,
                                   const EstimatorSetup& setup)
    : params_(params),
      calibration_(setup.calibration),
      dead_reckoning_(setup.dead_reckoning),
      lander_(setup.lander),
      attitude_(setup.attitude),
      motions_{.gate = Gate(params.gate)},
      errors_(PriorCovariance(params, setup.lander)) {
  if (setup.memory) Recall(*setup.memory);
  math::Pose2 start_W = setup.start;
  if (lander_) start_W = math::TurnedAbout(start_W, lander_->x_m, lander_->y_m, -pan_rad_);
  pose_W_ = {start_W.x_m, start_W.y_m, math::WrapAngle(start_W.heading_rad)};
  estimate_.odometry = {setup.start.x_m, setup.start.y_m, math::WrapAngle(setup.start.heading_rad)};
  felt_odometry_ = estimate_.odometry;
  TellPose();
  TellCovariance();
}

void ErrorStateFilter::Recall(const EstimatorMemory& memory) {
  gyro_scale_ = memory.gyro_scale;
  wheel_scale_ = memory.wheel_scale;
  pan_rad_ = memory.pan_rad;
  if (!memory.covariance) return;
  errors_ = ClonedCovariance(AfterNight(*memory.covariance, PriorCovariance(params_, lander_)));
}

TickNoise ErrorStateFilter::NoiseOf(const messages::MotionMeasurement& motion,
                                    double forward_m) const {
  const DriftParams& drift = params_.drift;
  const double way_m = std::abs(forward_m);
  const bool moves = std::any_of(motion.wheel_turn_rad.begin(), motion.wheel_turn_rad.end(),
                                 [](double turn_rad) { return turn_rad != 0.0; });
  const double drifting_s = moves || drift.drifts_at_rest ? motion.duration_s : 0.0;
  return {.heading_rad2 = drift.heading_variance_rad2_per_s() * drifting_s +
                          drift.scrapes_per_m * Squared(drift.scrape_jump_rad) * way_m,
          .distance_m2 = drift.distance_variance_m2_per_m * way_m,
          .height_m2 = drift.height_variance_m2_per_m * way_m,
          .bias_rad2_s2 = Squared(drift.gyro_bias_walk_rad_s) * motion.duration_s,
          .tilt_kept = math::Exp(-way_m / drift.tilt_length_m),
          .tilt_rad2 = Squared(drift.tilt_sd_rad)};
}

void ErrorStateFilter::Propagate(const messages::MotionMeasurement& motion) {
  const double forward_m = ForwardIncrement(motion, calibration_, dead_reckoning_) * wheel_scale_;
  // The gyro's model is reading = scale * true turn + bias * time. Scales of 1 and a bias of 0, as
  // before the first aid, leave every bit of dead reckoning.
  const double turn_rad = (motion.turn_rad - gyro_bias_rad_s_ * motion.duration_s) / gyro_scale_;
  const double share = dead_reckoning_.step_heading == StepHeading::kMidpoint ? 0.5 : 0.0;
  const TickNoise noise = NoiseOf(motion, forward_m);
  stretch_.Add({.forward_m = forward_m,
                .turn_rad = turn_rad,
                .along_rad = pose_W_.heading_rad + share * turn_rad,
                .turn_share = share,
                .pitch_rad = estimate_.attitude.pitch_rad,
                .duration_s = motion.duration_s,
                .gyro_scale = gyro_scale_,
                .wheel_scale = wheel_scale_},
               noise);
  Advance(forward_m, turn_rad, dead_reckoning_.step_heading, pose_W_);
  Advance(forward_m, turn_rad, dead_reckoning_.step_heading, estimate_.odometry);
  TellPose();
  roll_correction_rad_ *= noise.tilt_kept;
  pitch_correction_rad_ *= noise.tilt_kept;
  way_m_ += std::abs(forward_m);
  if (stretch_.way_m() >= params_.stretch_m) EndStretch();
}

void ErrorStateFilter::Feel(const messages::VehicleState& felt, double duration_s) {
  attitude_.Integrate(felt, ForwardStep(felt_odometry_, estimate_.odometry), duration_s);
  felt_odometry_ = estimate_.odometry;
  estimate_.attitude = attitude_.estimate();
  estimate_.attitude.roll_rad += roll_correction_rad_;
  estimate_.attitude.pitch_rad += pitch_correction_rad_;
  estimate_.attitude.z_m += z_correction_m_;
}

void ErrorStateFilter::Place(const messages::PoseUpdate& update) {
  EndStretch();
  ErrorMatrix before = errors_.now();
  if (update.mirrored) {
    // Errors of y, roll and heading change their sign against all others; what the sensors get
    // wrong stays as it is.
    ErrorVector sign = ErrorVector::Ones();
    for (const int mirrored : {error::kY, error::kRoll, error::kHeading}) sign[mirrored] = -1.0;
    before = sign.asDiagonal() * before * sign.asDiagonal();
  } else {
    ErrorMatrix told = PriorCovariance(params_, lander_);
    constexpr int kSensors = kErrorCoordinates - kPoseCoordinates;
    told.bottomRightCorner<kSensors, kSensors>() = before.bottomRightCorner<kSensors, kSensors>();
    before = told;
  }
  errors_ = ClonedCovariance(before);
  moments_.clear();
  kinds_.clear();
  motions_.gate.Restart();
  way_m_ = 0.0;
  pose_W_.x_m = update.x_m;
  pose_W_.y_m = update.y_m;
  pose_W_.heading_rad = math::WrapAngle(update.heading_rad);
  TellPose();
  estimate_.odometry = estimate_.pose;
  attitude_.Restart();
  felt_odometry_ = estimate_.odometry;
  TellCovariance();
}

EstimatorMemory ErrorStateFilter::Remember() const {
  ErrorMatrix covariance = errors_.now();
  if (!stretch_.empty()) {
    // What the stretch so far adds, which errors_ gets only at its end.
    const ErrorMatrix& transition = stretch_.transition();
    covariance = transition * covariance * transition.transpose() + stretch_.noise();
  }
  return {.pose = {estimate_.pose.x_m, estimate_.pose.y_m, estimate_.pose.heading_rad},
          .covariance = covariance,
          .gyro_scale = gyro_scale_,
          .wheel_scale = wheel_scale_,
          .pan_rad = pan_rad_};
}

void ErrorStateFilter::Capture(messages::CaptureNumber capture) {
  // A clone has to be of this moment, not of the last stretch's end.
  EndStretch();
  errors_.Clone(capture);
  moments_[capture] = PoseNow();
}

void ErrorStateFilter::Forget(messages::CaptureNumber capture) {
  errors_.Forget(capture);
  moments_.erase(capture);
}

AidUse ErrorStateFilter::Update(const messages::PoseFix& fix) {
  const auto moment = moments_.find(fix.capture);
  if (moment == moments_.end()) return AidUse::kUnknown;
  const auto values = static_cast<Eigen::Index>(fix.measured.count());
  if (values == 0) return AidUse::kNoInterest;
  EndStretch();
  // The rows that pick the measured coordinates.
  Eigen::MatrixXd picks = Eigen::MatrixXd::Zero(values, kPoseCoordinates);
  Eigen::Index row = 0;
  for (int coordinate = 0; coordinate < kPoseCoordinates; ++coordinate) {
    if (fix.measured[static_cast<std::size_t>(coordinate)]) picks(row++, coordinate) = 1.0;
  }
  const InFrame believed =
      fix.in_lander_frame && lander_ ? InLanderFrame(moment->second) : InWorld(moment->second);
  const PoseVector difference = Wrapped(fix.pose - believed.pose);
  const unsigned long kind =
      fix.measured.to_ulong() | (fix.in_lander_frame ? 1UL << kPoseCoordinates : 0UL);
  auto of_kind = kinds_.find(kind);
  if (of_kind == kinds_.end()) {
    of_kind = kinds_.emplace(kind, Kind{.gate = Gate(params_.gate)}).first;
  }
  return Take({.parts = {{fix.capture, picks * believed.by_error}},
               .values = picks * difference,
               .noise = picks * fix.covariance * picks.transpose(),
               .of_place = fix.measured[error::kX] || fix.measured[error::kY],
               .kind = &of_kind->second},
              picks.transpose() * (picks * difference));
}

AidUse ErrorStateFilter::Update(const messages::RelativeMotion& motion) {
  const auto from = moments_.find(motion.from);
  const auto to = moments_.find(motion.to);
  if (from == moments_.end() || to == moments_.end()) return AidUse::kUnknown;
  EndStretch();
  // In the levelled frame F of the first moment, R = Rz(h1): d_F = R' (p2 - p1), and differences of
  // angles as they are. d d_F / d h1 = (d_y, -d_x).
  const auto [s, c] = math::SinCos(from->second[error::kHeading]);
  messages::PoseCovariance to_F = messages::PoseCovariance::Identity();
  to_F.topLeftCorner<2, 2>() << c, s, -s, c;
  const PoseVector believed = to_F * Wrapped(to->second - from->second);
  messages::PoseCovariance of_first = -to_F;
  of_first(error::kX, error::kHeading) += believed[error::kY];
  of_first(error::kY, error::kHeading) -= believed[error::kX];
  Eigen::MatrixXd H_from = Eigen::MatrixXd::Zero(kPoseCoordinates, kErrorCoordinates);
  Eigen::MatrixXd H_to = H_from;
  H_from.leftCols<kPoseCoordinates>() = of_first;
  H_to.leftCols<kPoseCoordinates>() = to_F;
  const PoseVector difference = Wrapped(motion.motion_F - believed);
  return TakeMotion(motion,
                    {.parts = {{motion.from, H_from}, {motion.to, H_to}},
                     .values = difference,
                     .noise = motion.covariance,
                     .of_place = false,
                     .kind = &motions_},
                    to_F.transpose() * difference);
}

AidUse ErrorStateFilter::TakeMotion(const messages::RelativeMotion& motion,
                                    const Residual& residual, const PoseVector& difference) {
  const double distance =
      errors_.MahalanobisSquared(residual.parts, residual.values, residual.noise);
  const bool believed = residual.kind->gate.Ask(
                            distance, static_cast<int>(residual.values.size())) == GateAnswer::kIn;
  if (!believed) {
    if (params_.motion_disagreement == MotionDisagreement::kTurnAway) return AidUse::kGatedOut;
    DoubtWheels(motion, difference);
  }
  Correct(errors_.Update(residual.parts, residual.values, residual.noise).changes);
  return believed ? AidUse::kUsed : AidUse::kUsedInDoubt;
}

// A motion says nothing of where the rover was at its first moment, which is not doubted. A heading
// that went wrong by e_h leads the way since the second moment, d, astray: e_x = -d_y e_h,
// e_y = d_x e_h.
void ErrorStateFilter::DoubtWheels(const messages::RelativeMotion& motion,
                                   const PoseVector& difference) {
  const PoseVector& second = moments_.at(motion.to);
  const auto by_error = [&](const PoseVector& pose) {
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(kErrorCoordinates, kPoseCoordinates);
    jacobian.topRows<kPoseCoordinates>().setIdentity();
    jacobian(error::kX, error::kHeading) = second[error::kY] - pose[error::kY];
    jacobian(error::kY, error::kHeading) = pose[error::kX] - second[error::kX];
    return jacobian;
  };
  std::vector<ClonedCovariance::Part> parts{{std::nullopt, by_error(PoseNow())}};
  for (const auto& [capture, pose] : moments_) {
    // Numbers rise with time: a motion puts no moment before it in doubt.
    if (capture > motion.from) parts.push_back({capture, by_error(pose)});
  }
  errors_.Inflate(parts, difference.cwiseAbs2().asDiagonal().toDenseMatrix());
}

AidUse ErrorStateFilter::Take(const Residual& residual, const PoseVector& doubt) {
  const double distance =
      errors_.MahalanobisSquared(residual.parts, residual.values, residual.noise);
  AidUse use = AidUse::kUsed;
  switch (residual.kind->gate.Ask(distance, static_cast<int>(residual.values.size()))) {
    case GateAnswer::kIn:
      break;
    case GateAnswer::kOut:
      return AidUse::kGatedOut;
    case GateAnswer::kDoubtYourself: {
      use = AidUse::kUsedInDoubt;
      PoseVector variances = doubt.cwiseAbs2();
      // A place is mostly wrong because the heading was wrong on the way to it.
      const double way_m = way_m_ - residual.kind->believed_at_m;
      if (residual.of_place && way_m > 0.0) {
        const double off_rad = math::Hypot(doubt[error::kX], doubt[error::kY]) / way_m;
        variances[error::kHeading] += Squared(std::min(off_rad, std::numbers::pi));
      }
      ErrorVector all = ErrorVector::Zero();
      all.head<kPoseCoordinates>() = variances;
      errors_.Inflate(all.asDiagonal());
      break;
    }
  }
  residual.kind->believed_at_m = way_m_;
  Correct(errors_.Update(residual.parts, residual.values, residual.noise).changes);
  return use;
}

void ErrorStateFilter::Correct(const Eigen::MatrixXd& changes) {
  const ErrorVector now = changes.col(0);
  PoseVector pose = PoseNow();
  Add(now.head<kPoseCoordinates>(), pose);
  pose_W_.x_m = pose[error::kX];
  pose_W_.y_m = pose[error::kY];
  pose_W_.heading_rad = pose[error::kHeading];
  z_correction_m_ += now[error::kZ];
  roll_correction_rad_ += now[error::kRoll];
  pitch_correction_rad_ += now[error::kPitch];
  estimate_.attitude.z_m += now[error::kZ];
  estimate_.attitude.roll_rad += now[error::kRoll];
  estimate_.attitude.pitch_rad += now[error::kPitch];
  gyro_bias_rad_s_ += now[error::kGyroBias];
  gyro_scale_ += now[error::kGyroScale];
  wheel_scale_ += now[error::kWheelScale];
  pan_rad_ += now[error::kPan];
  Eigen::Index column = 1;
  for (const std::int64_t clone : errors_.clones()) {
    Add(changes.col(column++).head<kPoseCoordinates>(), moments_.at(clone));
  }
  TellPose();
  TellCovariance();
}

PoseVector ErrorStateFilter::PoseNow() const {
  PoseVector pose;
  pose << pose_W_.x_m, pose_W_.y_m, estimate_.attitude.z_m, estimate_.attitude.roll_rad,
      estimate_.attitude.pitch_rad, pose_W_.heading_rad;
  return pose;
}

ErrorStateFilter::InFrame ErrorStateFilter::InWorld(const PoseVector& pose_W) const {
  InFrame world;
  world.pose = pose_W;
  world.by_error.setIdentity();
  return world;
}

// p_L = l + R(pan) (p_W - l), and the heading is turned as well, so that an error of the pan angle
// shows as dp_L = across(p_L - l) e_pan and dh_L = e_pan.
ErrorStateFilter::InFrame ErrorStateFilter::InLanderFrame(const PoseVector& pose_W) const {
  InFrame lander = InWorld(pose_W);
  const math::Pose2 turned =
      math::TurnedAbout({pose_W[error::kX], pose_W[error::kY], pose_W[error::kHeading]},
                        lander_->x_m, lander_->y_m, pan_rad_);
  lander.pose[error::kX] = turned.x_m;
  lander.pose[error::kY] = turned.y_m;
  lander.pose[error::kHeading] = turned.heading_rad;
  const auto [s, c] = math::SinCos(pan_rad_);
  lander.by_error.topLeftCorner<2, 2>() << c, -s, s, c;
  lander.by_error(error::kX, error::kPan) = lander_->y_m - turned.y_m;
  lander.by_error(error::kY, error::kPan) = turned.x_m - lander_->x_m;
  lander.by_error(error::kHeading, error::kPan) = 1.0;
  return lander;
}

void ErrorStateFilter::EndStretch() {
  if (stretch_.empty()) return;
  errors_.Propagate(stretch_.transition(), stretch_.noise());
  stretch_.Restart();
  TellCovariance();
}

void ErrorStateFilter::TellPose() {
  estimate_.pose = pose_W_;
  if (!lander_) return;
  const math::Pose2 turned = math::TurnedAbout({pose_W_.x_m, pose_W_.y_m, pose_W_.heading_rad},
                                               lander_->x_m, lander_->y_m, pan_rad_);
  estimate_.pose.x_m = turned.x_m;
  estimate_.pose.y_m = turned.y_m;
  estimate_.pose.heading_rad = turned.heading_rad;
  if (estimate_.world) estimate_.world->pose = pose_W_;
}

void ErrorStateFilter::TellCovariance() {
  const ErrorMatrix errors = errors_.now();
  estimate_.covariance = errors.topLeftCorner<kPoseCoordinates, kPoseCoordinates>();
  if (!lander_) return;
  estimate_.world = {.pose = pose_W_, .covariance = *estimate_.covariance};
  const auto by_error = InLanderFrame(PoseNow()).by_error;
  estimate_.covariance = by_error * errors * by_error.transpose();
}

EstimatorDescription<ErrorStateFilterParams> DescribeErrorStateFilter() {
  return {.name = "error_state",
          .doc = "dead reckoning that keeps account of its error and is corrected by aids",
          .make = [](const ErrorStateFilterParams& params,
                     const EstimatorSetup& setup) -> std::unique_ptr<Estimator> {
            return std::make_unique<ErrorStateFilter>(params, setup);
          },
          .takes_fixes = true,
          .takes_motions = true};
}

}  // namespace rockyard::localization

#include "trial/drive/onboard.h"

#include <utility>

#include "perception/tracked_feature.h"
#include "trial/sight/onboard_calibration.h"

namespace rockyard::trial {
namespace {

// Returns the distance at which a corner of a route is passed; nothing for places that somebody
// named, at which the rover arrives.
std::optional<double> PassingOf(const DriveParams& drive) {
  const RouteMapParams& map = drive.course.route_map;
  if (map.use != RouteUse::kWaypoints) return std::nullopt;
  return map.passing_m;
}

// Returns what the rover drives to: the designated places, then the places of a local search.
std::vector<messages::Goal> WithSearch(std::vector<messages::Goal> goals,
                                       const GoalRockParams& rock) {
  if (!rock.enabled) return goals;
  const std::vector<messages::Goal> places = rock.search.Places(goals.back());
  goals.insert(goals.end(), places.begin(), places.end());
  return goals;
}

Locomotion LocomotionOf(const DriveParams& drive, double ramp_s) {
  return {{drive.rover.drive.speed_m_s, ramp_s},
          {OnboardDriveCalibration(drive.rover, drive.perception.calibration.drive),
           drive.navigation.wheel_driver, drive.clock.overlap.steering}};
}

}  // namespace

StuckWatch::StuckWatch(const DriveParams& drive) {
  if (drive.navigation.on_board_stuck.reaction == navigation::StuckResponse::kOff) return;
  detector_.emplace(drive.perception.stuck_detector,
                    OnboardDriveCalibration(drive.rover, drive.perception.calibration.drive));
}

std::optional<perception::StuckSign> StuckWatch::Observe(const messages::WheelCommand& command,
                                                         const messages::MotionMeasurement& motion,
                                                         const messages::VehicleState& felt) {
  if (!detector_) return std::nullopt;
  const auto sign = detector_->Observe(command, motion, felt);
  noticed_ = sign.has_value();
  return sign;
}

void StuckWatch::OnPlaced() {
  if (detector_) detector_->Restart();
  noticed_ = false;
}

Onboard::Onboard(const DriveParams& drive, core::TrialKey key, std::vector<messages::Goal> goals,
                 std::unique_ptr<navigation::Navigator> navigator, double ramp_s,
                 const SightWatchers& watchers)
    : navigator_(WithSearch(std::move(goals), drive.course.goal_rock), std::move(navigator),
                 PassingOf(drive)),
      terrain_sensing_(drive, watchers),
      parts_(LocomotionOf(drive, ramp_s), VehicleGuard(drive), StuckWatch(drive),
             SlipAlarms(drive.navigation.on_slip), AidSuite(drive.sensors.aids, captures_),
             VisualAid(drive, captures_), VisualReader(drive, key)) {}

void Onboard::Place(const messages::PoseUpdate& update) {
  const messages::PoseEstimate before = estimate().pose;
  estimator_->Place(update);
  parts_.OnPlaced();
  navigator_.OnPoseUpdate(before, estimate().pose);
}

Decided Onboard::Decide(double time_s, const SeenLook* seen) {
  const std::optional<ToldSlip> slip = parts_.get<SlipAlarms>().Take();
  const std::size_t reached = navigator_.reached();
  Decided decided;
  navigation::Events events;
  if (std::exchange(ended_plan_, false)) events.Add(navigation::Event::kEndOfPlan);
  decided.decision = navigator_.Decide(
      {.time_s = time_s,
       .events = events,
       .estimate = estimate().pose,
       .attitude = estimate().attitude,
       .odometry = estimate().odometry,
       .report = seen != nullptr ? seen->report() : nullptr,
       .cloud = seen != nullptr ? seen->cloud() : nullptr,
       .look = seen != nullptr ? &seen->moment : nullptr,
       .vehicle_hazard = slip && slip->hazard ? &*slip->hazard : guard().hazard(),
       .touches_behind = guard().touches_behind(),
       .notices_stuck = parts_.get<StuckWatch>().noticed() || (slip && slip->as_stuck),
       .covariance = estimate().covariance ? &*estimate().covariance : nullptr,
       .felt = feels_ ? &guard().measured() : nullptr,
       .images = seen != nullptr ? seen->images() : nullptr});
  decided.told_slip = slip.has_value();
  decided.passed = navigator_.reached() - reached;
  return decided;
}

messages::MotionCommand Onboard::Follow(const messages::MotionCommand& told, double tick_s) {
  const messages::MotionCommand motion =
      parts_.get<Locomotion>().follower.Follow(told, estimate().pose.distance_m, tick_s);
  const bool rests = motion.kind == messages::MotionKind::kStop;
  const bool rests_early = rests && told.kind != messages::MotionKind::kStop;
  ended_plan_ = rests_early && !rests_early_;
  rests_early_ = rests_early;
  return motion;
}

messages::WheelCommand Onboard::Drive(const messages::MotionCommand& motion, double tick_s) {
  return parts_.get<Locomotion>().driver.Tick(motion, tick_s);
}

std::vector<messages::VehicleHazard> Onboard::Feel(const messages::VehicleState& felt,
                                                   const messages::WheelCommand& command,
                                                   const messages::MotionMeasurement& motion) {
  feels_ = true;
  return parts_.get<VehicleGuard>().Feel(felt, command, motion);
}

std::optional<perception::StuckSign> Onboard::NoticeStuck(
    const messages::WheelCommand& command, const messages::MotionMeasurement& motion) {
  return parts_.get<StuckWatch>().Observe(command, motion, guard().measured());
}

void Onboard::FeelStance(double duration_s) { estimator_->Feel(guard().measured(), duration_s); }

std::unique_ptr<SeenLook> Onboard::TakeLook(const LookOrder& order, const LookData& data,
                                            double time_s) {
  auto seen = std::make_unique<SeenLook>();
  seen->percept = terrain_sensing_.Take(order, data);
  const messages::LocalizationEstimate& believed = estimate();
  seen->moment = {order.number, time_s, believed.pose, believed.odometry, believed.attitude};
  return seen;
}

AidNews Onboard::TakeAids(const AidRequest& request, const AidAnswer& answer, double time_s) {
  const messages::PoseEstimate before = estimate().pose;
  VisualAid& vision = parts_.get<VisualAid>();
  const bool fixed = parts_.get<AidSuite>().Take(request, answer, time_s, *estimator_);
  AidNews news{.saw_motion = vision.Tick(time_s, *estimator_)};
  if (fixed || news.saw_motion) navigator_.OnCorrection(before, estimate().pose);
  news.slip = vision.TakeSlip();
  if (news.slip && news.slip->seen.exceeded) {
    parts_.get<SlipAlarms>().Raise();
    vision.BeginAnew(*estimator_);
    parts_.get<VisualReader>().Renew();
  }
  return news;
}

messages::Goal Onboard::TakeSighting(const messages::FeatureSighting& sighting, bool leaves_rest) {
  const messages::Goal goal = perception::PlaceOf(sighting, estimate().pose);
  if (leaves_rest) {
    navigator_.DriveTo(goal);
  } else {
    navigator_.SetGoal(goal, navigation::GoalChange::kMoved);
  }
  return goal;
}

}  // namespace rockyard::trial

// What runs on board: measurements in, commands out. Drive asks it for every decision; observer and
// tracer read what it believes. Must stay: nothing here ever sees a truth.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "localization/estimator.h"
#include "messages/commands.h"
#include "messages/estimates.h"
#include "messages/measurements.h"
#include "messages/vehicle_state.h"
#include "navigation/route_follower.h"
#include "navigation/waypoint_sequence.h"
#include "navigation/wheel_driver.h"
#include "perception/stuck_detector.h"
#include "trial/aids/aid_suite.h"
#include "trial/aids/slip_alarms.h"
#include "trial/aids/visual_aid.h"
#include "trial/drive/part_set.h"
#include "trial/drive/timeline.h"
#include "trial/drive/vehicle_guard.h"
#include "trial/drive_params.h"
#include "trial/onboard_end.h"
#include "trial/sight/terrain_sensing.h"
#include "trial/sight/visual_reader.h"

namespace rockyard::trial {

// Turns motions into wheel commands.
struct Locomotion {
  navigation::MotionFollower follower;
  navigation::WheelDriver driver;

  void OnPlaced() { driver.Straighten(); }
};

// Watches whether the rover is stuck, where navigation.on_board_stuck asks for that.
class StuckWatch {
 public:
  explicit StuckWatch(const DriveParams& drive);

  std::optional<perception::StuckSign> Observe(const messages::WheelCommand& command,
                                               const messages::MotionMeasurement& motion,
                                               const messages::VehicleState& felt);
  bool noticed() const { return noticed_; }  // at the last tick
  void OnPlaced();

 private:
  std::optional<perception::StuckDetector> detector_;
  bool noticed_ = false;
};

// What the navigator decided.
struct Decided {
  navigation::NavigatorDecision decision;
  bool told_slip = false;  // whether it was told of an alarm of slip
  std::size_t passed = 0;  // how many goals it has done with at this decision
};

// What aids and visual odometry brought at one tick.
struct AidNews {
  bool saw_motion = false;  // visual odometry corrected the estimate
  std::optional<SlipReading> slip = {};
};

// The on-board side of one drive. Records depend on the order in which the estimator is fed: at a
// tick wheels and gyro, what was felt, fixes of aids, a motion seen. Parts keep the address of
// captures_, so that an Onboard cannot be moved.
class Onboard {
 public:
  // `drive` outlives it. `goals`: what the rover is told to drive to, in the order of driving;
  // `navigator` has the first for its goal. ramp_s: the ramp of the motors. `key`: names the random
  // numbers that are drawn on board, the samples of visual odometry. `watchers` are shown what is
  // made of a look.
  Onboard(const DriveParams& drive, core::TrialKey key, std::vector<messages::Goal> goals,
          std::unique_ptr<navigation::Navigator> navigator, double ramp_s,
          const SightWatchers& watchers = {});
  Onboard(const Onboard&) = delete;
  Onboard& operator=(const Onboard&) = delete;

  // Sets the estimator, which begins where the rover believes to stand.
  void Begin(std::unique_ptr<localization::Estimator> estimator) {
    estimator_ = std::move(estimator);
  }
  // Takes where operators say that they moved the rover by hand.
  void Place(const messages::PoseUpdate& update);

  const messages::LocalizationEstimate& estimate() const { return estimator_->estimate(); }

  // Returns the decision of a control tick; `seen` answers the oldest look without an answer, or is
  // null.
  Decided Decide(double time_s, const SeenLook* seen);
  // Returns the motion of the next tick: along the command, and to rest before the command's end.
  messages::MotionCommand Follow(const messages::MotionCommand& told, double tick_s);
  // Returns the wheel command of the next tick.
  messages::WheelCommand Drive(const messages::MotionCommand& motion, double tick_s);
  const navigation::WheelDriver& wheel_driver() const { return parts_.get<Locomotion>().driver; }

  // Takes what was measured over one tick. A rover that stands has ticks, too, but feels nothing.
  void Propagate(const messages::MotionMeasurement& motion) { estimator_->Propagate(motion); }
  // Takes what was felt over the tick. Returns the hazards that appeared.
  std::vector<messages::VehicleHazard> Feel(const messages::VehicleState& felt,
                                            const messages::WheelCommand& command,
                                            const messages::MotionMeasurement& motion);
  // Returns the sign by which the rover notices that it is stuck, if it does.
  std::optional<perception::StuckSign> NoticeStuck(const messages::WheelCommand& command,
                                                   const messages::MotionMeasurement& motion);
  // Hands what was felt last to the estimator.
  void FeelStance(double duration_s);

  TerrainSensing& terrain_sensing() { return terrain_sensing_; }
  const TerrainSensing& terrain_sensing() const { return terrain_sensing_; }
  // Return the order of a look, and what came of a look that was taken now.
  LookOrder OrderLook(messages::LookDirection direction) {
    return terrain_sensing_.Order(direction, estimate().attitude);
  }
  std::unique_ptr<SeenLook> TakeLook(const LookOrder& order, const LookData& data, double time_s);

  // Returns what aids are to measure now.
  AidRequest DueAids(double time_s) { return parts_.get<AidSuite>().Due(*estimator_, time_s); }
  // Takes what aids measured, and hands the estimator what is ready, motions seen included.
  AidNews TakeAids(const AidRequest& request, const AidAnswer& answer, double time_s);

  // Returns whether visual odometry takes images now.
  bool SeesMotionNow(double time_s) const { return vision().IsDue(estimate(), time_s); }
  // Returns what a look of visual odometry adds. It is worked out at once, though the computer has
  // it ready later (ready_s).
  VisualStep ReadMotion(const MotionData& data) {
    return parts_.get<VisualReader>().Read(data, vision().Expected(estimate()));
  }
  bool TakeMotion(const VisualStep& step, double time_s, double ready_s) {
    return parts_.get<VisualAid>().Take(step, time_s, ready_s, *estimator_);
  }

  // Takes where the goal is seen. Returns where the goal is believed to be. With `leaves_rest`, as
  // a rover that recognizes a rock at its goal, it leaves out the places on the way.
  messages::Goal TakeSighting(const messages::FeatureSighting& sighting, bool leaves_rest);

  bool EndsBySlip() const { return parts_.get<SlipAlarms>().EndsDrive(); }

  const navigation::WaypointSequence& navigator() const { return navigator_; }
  // Returns what is left at the end of a drive: own values, or as many as there are, and what the
  // estimator keeps. May throw navigation::NavigatorFault.
  OnboardEnd AtEnd() const {
    const auto copied = [](std::span<const double> values) {
      return std::vector<double>(values.begin(), values.end());
    };
    return {{copied(navigator_.own_values()), copied(estimator_->own_values())},
            estimator_->Remember()};
  }
  const VehicleGuard& guard() const { return parts_.get<VehicleGuard>(); }
  const AidSuite& aids() const { return parts_.get<AidSuite>(); }
  const VisualAid& vision() const { return parts_.get<VisualAid>(); }

 private:
  std::unique_ptr<localization::Estimator> estimator_;  // from Begin on
  navigation::WaypointSequence navigator_;
  TerrainSensing terrain_sensing_;
  CaptureCounter captures_;
  bool feels_ = false;        // whether vehicle sensors have measured
  bool rests_early_ = false;  // at the end of a plan, before its command's end
  bool ended_plan_ = false;   // came to rest so at the last tick
  PartSet<Locomotion, VehicleGuard, StuckWatch, SlipAlarms, AidSuite, VisualAid, VisualReader>
      parts_;
};

}  // namespace rockyard::trial

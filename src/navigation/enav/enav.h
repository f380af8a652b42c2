// "ENav/ACE from its published description": the navigator `enav`. The rover looks, takes what it
// sees into its maps, and chooses the best path of a tree that ACE passes (planner.h). It drives
// the first 1 m of its arc, or turns by the first 30 deg of its turn, and plans again. With
// continuous.cycle csod it looks while it drives an arc and plans from that arc's end.
//
// Sources: Abcouwer et al. 2020 (arXiv:2011.06022) and Toupet et al. 2020 by their abstracts and
// what others report of them, whose bodies could not be read; ACE by ace.h. No body of either tells
// the parameters of flight: this is what the description says, and not ENav.
//
// Cycles without a path: the rover turns on and looks again, and gives up after max_retries of them
// in a row. A hazard that it feels ends a motion: it backs off by what it drove of it, and no path
// leads near the place until there is progress.
//
// All of this goes on in the frame of odometry, D, in which the rover's path is smooth: a
// correction of the estimate moves the goal there, and neither map nor motion.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "navigation/enav/enav_params.h"
#include "navigation/enav/planner.h"
#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"

namespace rockyard::navigation {

class EnavNavigator final : public Navigator {
 public:
  // `rover` as AceLinkage takes it. `full_speed_m_s` is that of the fastest rim.
  EnavNavigator(const EnavParams& params, const messages::Goal& goal,
                const messages::RoverBelief& rover, double full_speed_m_s);

  NavigatorDecision Decide(const NavigatorInput& input) override;
  // The map lies where the rover no longer stands: it is forgotten, and the motion ends.
  void OnPoseUpdate(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override;
  void OnCorrection(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal& goal, GoalChange change) override;

  PlanCounts plan_counts() const override { return counts_; }
  const messages::Overlay* overlay() const override { return &overlay_; }
  std::span<const double> own_values() const override;

  const EnavPlanner& planner() const { return planner_; }
  const EnavPlan& plan() const { return plan_; }  // the last one

 private:
  enum class Stage { kLooking, kTurning, kDriving, kBackingOff };

  NavigatorDecision LookAtRest();
  NavigatorDecision PlanAtRest(const NavigatorInput& input);
  NavigatorDecision Execute(const EnavPlan& plan, const NavigatorInput& input);
  NavigatorDecision Begin(Stage stage, const messages::MotionCommand& motion, double leg,
                          const NavigatorInput& input);
  NavigatorDecision GoOn(const NavigatorInput& input);
  NavigatorDecision DriveOnTheMove(const NavigatorInput& input);
  NavigatorDecision OnFelt(const NavigatorInput& input);

  void See(const NavigatorInput& input);
  // Plans from a pose in D; false where the rover gives up.
  bool MakePlan(const math::Pose2& from, const NavigatorInput& input);
  messages::Goal GoalInD(const NavigatorInput& input) const;
  void Show(const NavigatorInput& input);
  double WorkSince();
  bool plans_on_the_move() const { return params_.continuous.cycle == EnavCycle::kCsod; }

  EnavParams params_;
  messages::Goal goal_;
  double length_m_;
  double width_m_;
  EnavPlanner planner_;
  Stage stage_ = Stage::kLooking;
  EnavPlan plan_;
  messages::Overlay overlay_;
  PlanCounts counts_;

  // The motion under way.
  messages::MotionCommand motion_;
  double leg_ = 0.0;       // m, or rad
  double measured_ = 0.0;  // of it
  double began_m_ = 0.0;   // the odometer
  double heading_rad_ = 0.0;
  bool feels_old_ = false;
  bool asked_ = false;            // for a look on the move, that is not answered
  bool late_ = false;             // the motion ended before
  std::optional<EnavPlan> next_;  // made on the move, from the end of the motion
  std::int64_t moves_ = 0;

  double best_m_ = std::numeric_limits<double>::infinity();
  std::int64_t fruitless_ = 0;
  std::int64_t retries_ = 0;
  int retry_side_ = 0;
  std::int64_t felt_ = 0;

  std::int64_t cycles_ = 0;
  std::int64_t checks_ = 0;
  std::int64_t without_path_ = 0;
  std::int64_t worked_ = 0;  // checks that a decision has told the cost of
  mutable std::array<double, 4> own_values_{};
};

// Describes the navigator `enav`, for a set of navigators.
NavigatorDescription<EnavParams> DescribeEnav();

}  // namespace rockyard::navigation

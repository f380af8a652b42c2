#include "trial/drive/make_navigator.h"

#include <exception>
#include <utility>

#include "navigation/navigator_fault.h"
#include "navigation/stuck_reaction.h"
#include "trial/course/goal_designation.h"
#include "trial/course/site_map.h"
#include "trial/sight/onboard_calibration.h"

namespace rockyard::trial {
namespace {

// Stands for a navigator that could not begin, and is made where its fault is caught: says so when
// it is first asked, when there is a drive that can end by it.
class FailedStart final : public navigation::Navigator {
 public:
  navigation::NavigatorDecision Decide(const navigation::NavigatorInput&) override {
    std::rethrow_exception(fault_);
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal&, navigation::GoalChange) override {}

 private:
  std::exception_ptr fault_ = std::current_exception();
};

std::unique_ptr<navigation::Navigator> Begun(const navigation::NavigatorKind& kind,
                                             const navigation::NavigatorSetup& setup) {
  try {
    return kind.Make(setup);
  } catch (const navigation::NavigatorFault&) {
    return std::make_unique<FailedStart>();
  }
}

}  // namespace

std::unique_ptr<navigation::Navigator> MakeNavigator(
    const DriveParams& drive, const terrain::Terrain& terrain, core::TrialKey key,
    const std::vector<messages::Goal>& goals, double tick_s, navigation::AskedListener on_asked,
    std::function<void(const messages::NavigatorUse&)> on_end) {
  const navigation::NavigatorKind& chosen = drive.navigation.navigators.chosen();
  navigation::NavigatorSetup setup{
      .goal = goals.front(),
      .judges_hazards = drive.perception.hazard.enabled,
      .full_speed_m_s = drive.rover.drive.speed_m_s,
      .places = goals,
      .rover = OnboardRoverBelief(drive.rover, drive.perception.calibration.drive,
                                  drive.perception.vehicle_hazard),
      .site_map = MakeSiteMap(drive.course, terrain, key),
      .random_seed = core::RandomStream(key, core::Purpose::kNavigator).NextU64(),
      .operations_per_s = drive.clock.compute.operations_per_s,
      .control_period_s = tick_s,
      .limits = drive.navigation.limits,
      .on_end = std::move(on_end)};
  if (chosen.traits().follows_route) setup.route = ToldRoute(drive, terrain, key, goals.front());
  std::unique_ptr<navigation::Navigator> navigator = std::make_unique<navigation::EventGate>(
      Begun(chosen, setup), goals.front(), std::move(on_asked));
  const navigation::StuckReactionParams& stuck = drive.navigation.on_board_stuck;
  if (stuck.reaction == navigation::StuckResponse::kOff) return navigator;
  return std::make_unique<navigation::StuckReaction>(stuck, std::move(navigator));
}

}  // namespace rockyard::trial

#include "trial/drive_parts.h"

#include <utility>

#include "navigation/stuck_reaction.h"
#include "terrain/arena.h"
#include "trial/goal_designation.h"
#include "trial/layout.h"
#include "trial/make_estimator.h"
#include "trial/onboard_calibration.h"

namespace rockyard::trial {
namespace {

// Open fields go on; every other arena ends where its layout ends.
std::optional<ArenaBounds> Bounds(const terrain::ArenaParams& arena) {
  if (arena.kind == terrain::ArenaKind::kOpen) return std::nullopt;
  const terrain::Rectangle bounds = terrain::DrivableBounds(arena);
  return ArenaBounds{bounds.x_min_m, bounds.x_max_m};
}

std::unique_ptr<navigation::Navigator> MakePathSelection(const DriveParams& drive,
                                                         const terrain::Terrain& terrain,
                                                         core::TrialKey key,
                                                         const messages::Goal& goal) {
  const navigation::NavigatorKind& chosen = drive.navigation.navigators.chosen();
  navigation::NavigatorSetup setup{.goal = goal,
                                   .judges_hazards = drive.perception.hazard.enabled,
                                   .full_speed_m_s = drive.rover.drive.speed_m_s};
  if (chosen.traits().follows_route) setup.route = ToldRoute(drive, terrain, key, goal);
  return chosen.Make(setup);
}

bool LooksForStuck(const DriveParams& drive) {
  return drive.navigation.on_board_stuck.reaction != navigation::StuckResponse::kOff;
}

std::unique_ptr<navigation::Navigator> MakeNavigator(const DriveParams& drive,
                                                     const terrain::Terrain& terrain,
                                                     core::TrialKey key,
                                                     const messages::Goal& goal) {
  std::unique_ptr<navigation::Navigator> navigator = MakePathSelection(drive, terrain, key, goal);
  if (!LooksForStuck(drive)) return navigator;
  return std::make_unique<navigation::StuckReaction>(drive.navigation.on_board_stuck,
                                                     std::move(navigator));
}

// Corners of a route are passed, places that somebody named are arrived at.
std::optional<double> PassingOf(const DriveParams& drive) {
  const RouteMapParams& map = drive.course.route_map;
  if (map.use != RouteUse::kWaypoints) return std::nullopt;
  return map.passing_m;
}

// What the rover drives to: the designated places, then those of a local search.
std::vector<messages::Goal> WithSearch(std::vector<messages::Goal> goals,
                                       const GoalRockParams& rock) {
  if (!rock.enabled) return goals;
  const std::vector<messages::Goal> places = rock.search.Places(goals.back());
  goals.insert(goals.end(), places.begin(), places.end());
  return goals;
}

// A goal rock is recognized by what would track a goal.
bool TracksGoal(const CourseParams& course) {
  return course.tracking.enabled ||
         (course.goal_rock.enabled && course.goal_rock.recognition_m > 0.0);
}

std::unique_ptr<rover::Rover> MakeTrialRover(const DriveParams& drive, terrain::Terrain& terrain) {
  const terrain::RockFieldParams& rocks = drive.terrain.rocks;
  if (rocks.mobility == terrain::RockMobility::kFixed) {
    return rover::MakeRover(drive.rover, terrain);
  }
  return rover::MakeRover(drive.rover, rocks.holding, terrain);
}

}  // namespace

DriveParts::DriveParts(const DriveParams& drive, core::TrialKey trial_key, const Watchers& watchers,
                       const DriveStart* from)
    : params(drive),
      key(trial_key),
      start(from),
      field(from != nullptr ? from->field
                            : terrain::BuildField(drive.terrain, LayoutKey(drive, trial_key),
                                                  TerrainCourse(drive.course))),
      told_places(ToldPlaces(drive, field.terrain, trial_key)),
      rover(MakeTrialRover(drive, field.terrain)),
      tick(WholeSteps(1.0 / drive.clock.control_rate_hz, rover->step_s())),
      stop(WholeSteps(rover->ramp_s() + drive.clock.stop_time_s, rover->step_s())),
      terrain_sensing(drive, trial_key, watchers),
      guard(drive, trial_key),
      aids(drive, trial_key, field.terrain, captures),
      vision(drive, trial_key, field.terrain, captures),
      navigator(WithSearch(told_places, drive.course.goal_rock),
                MakeNavigator(drive, field.terrain, trial_key, told_places.front()),
                PassingOf(drive)),
      follower(drive.rover.drive.speed_m_s, rover->ramp_s()),
      wheel_driver(OnboardDriveCalibration(drive.rover, drive.perception.calibration.drive),
                   drive.navigation.wheel_driver, drive.clock.overlap.steering),
      ledger(MakePowerBudget(drive), drive.energy.battery_wh,
             from != nullptr ? from->sun : std::nullopt),
      timeline(drive.clock.overlap, ledger),
      referee(drive.referee, drive.course, told_places.front(), Bounds(drive.terrain.arena),
              drive.rover.geometry.wheel_radius_m) {
  if (drive.terrain.arena.kind == terrain::ArenaKind::kVirtualReflected) {
    mirror.emplace(drive.terrain.arena.MirrorLine());
  }
  if (LooksForStuck(drive)) {
    stuck_detector.emplace(
        drive.perception.stuck_detector,
        OnboardDriveCalibration(drive.rover, drive.perception.calibration.drive));
  }
  if (TracksGoal(drive.course)) feature_tracker.emplace(drive.course.tracking, key);
  if (drive.course.goal_rock.enabled) {
    // Terrains list it last.
    goal_rock.emplace(field.terrain, static_cast<int>(field.terrain.rocks().size()) - 1,
                      drive.sensors.terrain_sensors.chosen().reported_zone(drive),
                      drive.rover.geometry);
  }
}

void DriveParts::Begin() {
  rover->Place(params.course.Start());
  motion_sensors.emplace(params.sensors.gyro, params.sensors.encoders,
                         params.rover.geometry.wheel_radius_m, key, state());
  start_z_m = state().X_WR.translation().z();
  estimator = MakeEstimator(params, *rover, start != nullptr ? &start->memory : nullptr);
}

}  // namespace rockyard::trial

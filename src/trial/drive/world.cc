#include "trial/drive/world.h"

#include "trial/course/layout.h"

namespace rockyard::trial {
namespace {

// Rocks that can move are moved in the terrain itself, where sensors see them.
std::unique_ptr<rover::Rover> MakeTrialRover(const DriveParams& drive, terrain::Terrain& terrain) {
  const terrain::RockFieldParams& rocks = drive.terrain.rocks;
  if (rocks.mobility == terrain::RockMobility::kFixed) {
    return rover::MakeRover(drive.rover, terrain);
  }
  return rover::MakeRover(drive.rover, rocks.holding, terrain);
}

// Returns whether the drive has a tracker: to track a goal, or to recognize a rock at the goal.
bool TracksGoal(const CourseParams& course) {
  return course.tracking.enabled ||
         (course.goal_rock.enabled && course.goal_rock.recognition_m > 0.0);
}

}  // namespace

MotionPart::MotionPart(const DriveParams& drive, core::TrialKey key)
    : feels_(drive.sensors.vehicle.any()), vehicle_(drive.sensors.vehicle, drive.rover, key) {}

void MotionPart::Begin(const DriveParams& drive, core::TrialKey key,
                       const truth::RoverState& state) {
  motion_.emplace(drive.sensors.gyro, drive.sensors.encoders, drive.rover.geometry.wheel_radius_m,
                  key, state);
}

void MotionPart::OnPlaced(const truth::RoverState& state) {
  motion_->Restart(state);
  if (feels_) vehicle_.Restart(state);
}

bool MotionPart::Observe(const truth::RoverState& state, double time_s) {
  if (feels_) vehicle_.Observe(state);
  const std::int64_t before = scrapes().episodes();
  motion_->Observe(state, time_s);
  return scrapes().episodes() != before;
}

messages::VehicleState MotionPart::Feel(const truth::RoverState& state,
                                        const messages::WheelCommand& command, double duration_s) {
  if (!feels_) return {};
  return vehicle_.Measure(state, command, duration_s);
}

// A given field is copied, so that rocks that are pushed move in this drive alone. What keeps
// references to field_ is declared after it.
World::World(const DriveParams& drive, core::TrialKey key, const terrain::Field* given)
    : params_(drive),
      key_(key),
      field_(given != nullptr ? *given
                              : terrain::BuildField(drive.terrain, LayoutKey(drive, key),
                                                    TerrainCourse(drive.course))),
      rover_(MakeTrialRover(drive, field_.terrain)),
      cameras_(drive, key),
      terrain_sensor_(drive.sensors.terrain_sensors.chosen().MakeSensor(drive, key, cameras_)),
      aids_(drive, key, field_.terrain),
      parts_(MotionPart(drive, key), VisualEyes(drive, key, field_.terrain, cameras_)),
      goal_rock_(GoalRockOf(drive, field_.terrain)) {
  if (TracksGoal(drive.course)) tracker_.emplace(drive.course.tracking, key);
}

void World::Begin() {
  rover_->Place(params_.course.Start());
  parts_.get<MotionPart>().Begin(params_, key_, state());
  // After the rover has settled: errors of height count from here.
  start_z_m_ = state().X_WR.translation().z();
}

void World::Place(const math::Pose2& X_WR) {
  rover_->Place(X_WR);
  parts_.OnPlaced(state());
}

bool World::Step(const messages::WheelCommand& command, double time_s) {
  rover_->Step(command);
  return parts_.get<MotionPart>().Observe(state(), time_s);
}

std::optional<GoalLook> World::LookForGoal(double time_s) {
  const auto number = static_cast<std::int64_t>(time_s / params_.course.tracking.period_s);
  if (number < next_sighting_) return std::nullopt;
  next_sighting_ = number + 1;
  const math::Pose2 rover = math::ToPose2(state().X_WR);
  if (!goal_rock_) {
    const messages::Goal target = params_.course.GoalAt(time_s);
    return GoalLook{tracker_->Observe(rover, target.x_m, target.y_m, number)};
  }
  if (goal_rock_->FrontDistance_m(state().X_WR) > params_.course.goal_rock.recognition_m) {
    return GoalLook{};
  }
  const math::Vector3 center_W = goal_rock_->center_W();
  return GoalLook{tracker_->Observe(rover, center_W.x(), center_W.y(), number)};
}

}  // namespace rockyard::trial

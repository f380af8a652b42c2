#include "campaign/step_scene.h"

#include <algorithm>

#include "sensing/stereo_view.h"
#include "terrain/rock.h"
#include "trial/drive_params.h"
#include "trial/terrain_sensor_set_params.h"

namespace rockyard::campaign {
namespace {

// The left camera of the pair ahead, to which its points belong.
report::PinholeCamera LeftFrontCamera(const sensing::StereoParams& params) {
  const sensing::StereoView view = sensing::MakeStereoView(params, messages::LookDirection::kAhead);
  // Pixels are counted at their middles there, from the image's corner here.
  return {.eye = view.eye,
          .axis = view.Ray(0.5 * (view.columns - 1), 0.5 * (view.rows - 1)),
          .right = view.along_row.normalized(),
          .down = view.along_column.normalized(),
          .focal_columns_px = params.focal_columns_px(),
          .focal_rows_px = params.focal_rows_px(),
          .columns_px = static_cast<double>(view.columns),
          .rows_px = static_cast<double>(view.rows)};
}

// Dark is what the rover cannot pass beneath its belly.
report::SceneRock SceneRockOf(const terrain::Rock& rock, const terrain::Ground& ground,
                              double clearance_m) {
  const double ground_m = ground.Height(rock.center_W.x(), rock.center_W.y());
  return {terrain::PlanOutline(rock), terrain::PointsAbove(rock, ground_m),
          std::clamp(rock.height_m / clearance_m, 0.0, 1.0)};
}

}  // namespace

report::StepScene SceneOf(const trial::WatchedStep& watched, const truth::Trace& trace) {
  const trial::DriveParams& drive = watched.drive;
  const trial::CourseParams& course = drive.course;
  report::StepScene scene{.X_WR = watched.X_WR,
                          .believed = course.Start(),
                          .rover_length_m = drive.rover.geometry.length_m,
                          .rover_width_m = drive.rover.geometry.width_m,
                          .start = course.Start(),
                          .waypoints = course.waypoints.Places(),
                          .goal = course.GoalAt(trace.now_s()),
                          .goal_radius_m = course.goal_radius_m,
                          .rocks = {},
                          .true_path = report::TruePath(trace),
                          .believed_path = report::BelievedPath(trace),
                          .camera = {}};
  // The rover rests while it looks and decides.
  if (!trace.rests.empty()) scene.believed = report::BelievedPose(trace.rests.back().sample);
  for (const terrain::Rock& rock : watched.terrain.rocks()) {
    scene.rocks.push_back(
        SceneRockOf(rock, watched.terrain.ground(), drive.rover.geometry.belly_clearance_m));
  }
  const auto* cameras = drive.sensors.terrain_sensors.chosen().cameras(drive);
  if (cameras != nullptr) scene.camera = LeftFrontCamera(*cameras);
  return scene;
}

}  // namespace rockyard::campaign

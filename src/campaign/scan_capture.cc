#include "campaign/scan_capture.h"

#include <algorithm>
#include <numbers>
#include <set>
#include <utility>

#include "math/functions.h"
#include "perception/hazard_detector.h"
#include "perception/stripe_finder.h"
#include "perception/triangulation.h"
#include "rover/rover_layout_params.h"
#include "sensing/stereo_view.h"
#include "sensing/stripe_imager.h"
#include "terrain/rock.h"
#include "trial/drive_params.h"
#include "trial/eyes/terrain_sensor_set_params.h"
#include "trial/sight/onboard_calibration.h"

namespace rockyard::campaign {
namespace {

constexpr double kShownAround_m = 1.5;
constexpr int kOutlineCorners = 24;

// Returns the outline of a rock seen from above, in R: the horizontal axes of the ellipsoid, as the
// plans of the terrain show it.
report::GroundOutline RockOutline(const terrain::Rock& rock, const math::Transform& X_RW) {
  report::GroundOutline outline;
  for (int corner = 0; corner < kOutlineCorners; ++corner) {
    const double angle_rad = 2.0 * std::numbers::pi * corner / kOutlineCorners;
    const math::Vector3 on_axes(rock.semi_axes_m.x() * math::Cos(angle_rad),
                                rock.semi_axes_m.y() * math::Sin(angle_rad), 0.0);
    const math::Vector3 p_R =
        X_RW *
        (rock.center_W + math::RotationAbout(rock.yaw_rad, math::Vector3::UnitZ()) * on_axes);
    outline.emplace_back(p_R.x(), p_R.y());
  }
  return outline;
}

std::vector<report::GroundOutline> RocksAround(const trial::WatchedScan& watched) {
  const math::Vector3 p_WR = watched.X_WR.translation();
  std::vector<int> near;
  watched.terrain.RocksNear(p_WR.x(), p_WR.y(), kShownAround_m, near);
  std::vector<report::GroundOutline> outlines;
  outlines.reserve(near.size());
  for (const int index : near) {
    outlines.push_back(RockOutline(watched.terrain.rocks()[static_cast<std::size_t>(index)],
                                   watched.X_WR.inverse()));
  }
  return outlines;
}

// Returns the pairs of a camera and a group of lasers that find a stripe.
std::set<std::pair<int, int>> ExposuresOf(const messages::StripeCalibration& calibration) {
  std::set<std::pair<int, int>> exposures;
  for (const messages::StripeLaser& laser : calibration.lasers) {
    exposures.emplace(laser.camera, laser.group);
  }
  return exposures;
}

messages::StripeCalibration CalibrationOf(const trial::DriveParams& drive) {
  return trial::OnboardStripeCalibration(drive.sensors.light_stripe, drive.perception.calibration);
}

// The geometry that the rover believes, and what follows from it.
struct Believed {
  explicit Believed(const trial::DriveParams& drive)
      : calibration(CalibrationOf(drive)), triangulator(calibration), searches(calibration) {}

  messages::StripeCalibration calibration;
  perception::Triangulator triangulator;
  perception::StripeSearches searches;
};

report::ShownPoint ShowPoint(const Believed& believed, const messages::StripePixel& pixel,
                             std::size_t row, std::size_t stripe) {
  const perception::StripeSearch& search =
      believed.searches.At(believed.calibration.lasers[stripe].camera, row, stripe);
  const perception::Triangulator& triangulator = believed.triangulator;
  report::ShownPoint point;
  point.pixel = pixel;
  point.searched_first_px = search.columns.first;
  point.searched_last_px = search.columns.last;
  point.expected_R =
      triangulator.Point(row, stripe, search.datum_column).value_or(math::Vector3::Zero());
  if (!pixel.detected) return point;
  point.elevation = triangulator.Elevation(row, stripe, pixel.column_px);
  point.p_RoP_R = triangulator.Point(row, stripe, pixel.column_px).value_or(math::Vector3::Zero());
  return point;
}

report::ScanView View(const trial::WatchedScan& watched) {
  const Believed believed(watched.drive);
  const messages::StripeArraySize size = watched.scan.pixels.size();
  report::ScanView view;
  view.calibration = believed.calibration;
  view.points = messages::StripeArray<report::ShownPoint>(size);
  for (std::size_t row = 0; row < size.rows; ++row) {
    for (std::size_t stripe = 0; stripe < size.stripes; ++stripe) {
      view.points[row][stripe] = ShowPoint(believed, watched.scan.pixels[row][stripe], row, stripe);
    }
  }
  view.hazards = HazardsOf(watched);
  view.rover = rover::BodyOutline(watched.drive.rover.geometry);
  view.rocks = RocksAround(watched);
  return view;
}

// Returns the averaged difference of whole images, line by line, as the stripe finder sees it.
std::vector<double> Difference(const messages::StripeExposure& frames, int window_px) {
  const messages::ImageBand& lit = frames.lit.front();
  std::vector<double> difference;
  difference.reserve(lit.counts.size());
  for (int row = lit.first_row; row < lit.first_row + lit.rows; ++row) {
    const auto profile = perception::AverageDifference(frames, row, window_px);
    const std::vector<double>& values = profile.value().difference;
    difference.insert(difference.end(), values.begin(), values.end());
  }
  return difference;
}

// Returns the left camera of the pair ahead, to which the points of that pair belong.
report::PinholeCamera LeftFrontCamera(const sensing::StereoParams& params) {
  const sensing::StereoView view = sensing::MakeStereoView(params, messages::LookDirection::kAhead);
  // StereoView counts pixels from the middle of the first one, PinholeCamera from the corner of the
  // image.
  return {.eye = view.eye,
          .axis = view.Ray(0.5 * (view.columns - 1), 0.5 * (view.rows - 1)),
          .right = view.along_row.normalized(),
          .down = view.along_column.normalized(),
          .focal_columns_px = params.focal_columns_px(),
          .focal_rows_px = params.focal_rows_px(),
          .columns_px = static_cast<double>(view.columns),
          .rows_px = static_cast<double>(view.rows)};
}

// Returns a rock for the drawing, in which dark is what the rover cannot pass beneath its belly.
report::SceneRock SceneRockOf(const terrain::Rock& rock, const terrain::Ground& ground,
                              double clearance_m) {
  const double ground_m = ground.Height(rock.center_W.x(), rock.center_W.y());
  return {terrain::PlanOutline(rock), terrain::PointsAbove(rock, ground_m),
          std::clamp(rock.height_m / clearance_m, 0.0, 1.0)};
}

}  // namespace

messages::HazardReport HazardsOf(const trial::WatchedScan& watched) {
  const perception::Triangulator triangulator(CalibrationOf(watched.drive));
  return perception::ReportHazards(triangulator.Elevations(watched.scan),
                                   watched.drive.perception.hazard);
}

CapturedScan Capture(const trial::WatchedScan& watched) {
  const trial::DriveParams& drive = watched.drive;
  const sensing::StripeImager imager(drive.sensors.light_stripe, drive.sensors.sun,
                                     drive.rover.geometry);
  const auto window_px = static_cast<int>(drive.perception.stripe_finder.averaging_px);
  CapturedScan captured{View(watched), {}};
  for (const auto& [camera, group] : ExposuresOf(captured.view.calibration)) {
    messages::StripeExposure frames = imager.FullFrame(watched.terrain, watched.X_WR, watched.key,
                                                       watched.scan.number, camera, group);
    std::vector<double> difference = Difference(frames, window_px);
    captured.exposures.push_back({std::move(frames), std::move(difference)});
  }
  return captured;
}

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

#include "experiments/designation/designation.h"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/random.h"
#include "math/functions.h"
#include "trial/course/goal_designation.h"
#include "vision/cameras/rectification.h"

namespace rockyard::experiments {

using math::Vector3;

LanderPair::LanderPair(const LanderCameras& cameras, const Vector3& p_goal_L) {
  const Vector3 top_L(0.0, 0.0, cameras.mast_height_m);
  const Vector3 ahead_L = (p_goal_L - top_L).normalized();
  // The cameras pan and do not roll: rows of the images are level.
  const double along_m = math::Hypot(ahead_L.x(), ahead_L.y());
  const Vector3 right_L = along_m > 0.0
                              ? Vector3(ahead_L.y() / along_m, -ahead_L.x() / along_m, 0.0)
                              : Vector3(0.0, -1.0, 0.0);
  const double focal_px = 1.0 / cameras.pixel_rad;
  const double middle_px = 0.5 * (cameras.image_side_px - 1);
  left_.A = ahead_L;
  left_.H = focal_px * right_L + middle_px * ahead_L;
  left_.V = focal_px * ahead_L.cross(right_L) + middle_px * ahead_L;
  right_ = left_;
  left_.C = top_L - 0.5 * cameras.baseline_m * right_L;
  right_.C = top_L + 0.5 * cameras.baseline_m * right_L;
}

std::optional<StereoPick> LanderPair::See(const Vector3& p_L) const {
  const auto left_px = vision::Project(left_, p_L);
  const auto right_px = vision::Project(right_, p_L);
  if (!left_px || !right_px) return std::nullopt;
  return StereoPick{*left_px, left_px->x() - right_px->x()};
}

std::optional<Vector3> LanderPair::Place(const StereoPick& pick) const {
  const auto point = vision::Triangulate(left_, right_, pick.left_px, pick.disparity_px);
  if (!point) return std::nullopt;
  return point->p_A;
}

Vector3 Panned(const Vector3& p_L, double pan_rad) {
  return math::RotationAbout(pan_rad, Vector3::UnitZ()) * p_L;
}

const truth::RecordSchema& DesignationColumns() {
  using enum truth::ColumnRole;
  static const truth::RecordSchema kColumns{
      {"range_m", "m", "true range along the ground, from the lander's mast", kFactor},
      {"designations", "1", "goals that operators designated", kTrials},
      {"beyond", "1", "with a disparity of 0 or less: no place is told", kCount, "designations"},
      {"found", "1", "with a place", kMainCount, "designations"},
      {"near_enough", "1", "told within near_enough_m along the ground, pan error included", kCount,
       "designations"},
      {"doubled", "1", "told at more than twice the true range", kCount, "designations"},
      {"downrange_m", "m", "told less true place, away from the lander", kSum, "found"},
      {"downrange_error_m", "m", "the same", kSquares, "found"},
      {"downrange_cubes_m3", "m3", "its third powers, for the skewness", kSum, "found"},
      {"downrange_spread_m", "m",
       "its magnitude times the root of pi/2: the standard deviation of a normal error", kSum,
       "found"},
      {"crossrange_m", "m", "told less true place, to the left", kSum, "found"},
      {"crossrange_error_m", "m", "the same", kSquares, "found"},
      {"crossrange_spread_m", "m", "its magnitude times the root of pi/2", kSum, "found"},
      {"height_m", "m", "told less true height", kSum, "found"},
      {"height_error_m", "m", "the same", kSquares, "found"},
      {"panned_downrange_m", "m", "downrange error, pan error included", kSum, "found"},
      {"panned_downrange_error_m", "m", "the same", kSquares, "found"},
      {"panned_crossrange_m", "m", "crossrange error, pan error included", kSum, "found"},
      {"panned_crossrange_error_m", "m", "the same", kSquares, "found"},
      {"miss_m", "m", "from the true to the told place along the ground, pan error included", kSum,
       "found"},
      {"course_downrange_error_m", "m", "downrange error that course.designation draws", kSquares,
       "designations"},
      {"course_crossrange_m", "m", "crossrange error that it draws, pan error included", kSum,
       "designations"},
      {"course_crossrange_error_m", "m", "the same", kSquares, "designations"},
      {"equation_1_m", "m", "random crossrange error by Matthies 1995 eq. (1)", kSum,
       "designations"},
      {"equation_2_m", "m", "random downrange error by eq. (2)", kSum, "designations"},
      {"equation_3_m", "m", "systematic crossrange error by eq. (3)", kSum, "designations"},
  };
  return kColumns;
}

namespace {

using enum DesignationColumn;
using core::SampleNormal;

// What operators, correlation and the pan axis do to one goal.
struct PickErrors {
  double column_px = 0.0;
  double row_px = 0.0;
  double disparity_px = 0.0;
  double pan_rad = 0.0;
};

// Records depend on the order of the draws; that of the pan axis is made where its error is fixed,
// too.
PickErrors Draw(const trial::DesignationParams& errors, core::TrialKey key) {
  core::RandomStream stream(key, core::Purpose::kExperiment);
  PickErrors drawn;
  drawn.column_px = SampleNormal(stream, 0.0, errors.pixel_sd_px);
  drawn.row_px = SampleNormal(stream, 0.0, errors.pixel_sd_px);
  drawn.disparity_px = SampleNormal(stream, 0.0, errors.disparity_sd_px);
  const double share = core::SampleUniform(stream, -1.0, 1.0);
  const bool fixed = errors.pan_kind == trial::PanError::kFixed;
  drawn.pan_rad = errors.pan_error_rad * (fixed ? 1.0 : share);
  return drawn;
}

// Returns an estimate of the standard deviation of a normal error, whose mean magnitude is the root
// of 2/pi standard deviations.
double Spread(double error_m) { return std::sqrt(0.5 * std::numbers::pi) * std::abs(error_m); }

void AddPlace(const Vector3& error_m, DesignationSums& sums) {
  const double downrange_m = error_m.x();
  const double crossrange_m = error_m.y();
  sums.Add(kDownrange, downrange_m);
  sums.Add(kDownrangeSquares, downrange_m * downrange_m);
  sums.Add(kDownrangeCubes, downrange_m * downrange_m * downrange_m);
  sums.Add(kDownrangeSpread, Spread(downrange_m));
  sums.Add(kCrossrange, crossrange_m);
  sums.Add(kCrossrangeSquares, crossrange_m * crossrange_m);
  sums.Add(kCrossrangeSpread, Spread(crossrange_m));
  sums.Add(kHeight, error_m.z());
  sums.Add(kHeightSquares, error_m.z() * error_m.z());
}

void AddPanned(const Vector3& error_m, double near_enough_m, DesignationSums& sums) {
  const double miss_m = math::Hypot(error_m.x(), error_m.y());
  if (miss_m < near_enough_m) sums.Add(kNearEnough, 1.0);
  sums.Add(kPannedDownrange, error_m.x());
  sums.Add(kPannedDownrangeSquares, error_m.x() * error_m.x());
  sums.Add(kPannedCrossrange, error_m.y());
  sums.Add(kPannedCrossrangeSquares, error_m.y() * error_m.y());
  sums.Add(kMiss, miss_m);
}

// Adds what a drive's course would have told for the same goal.
void AddCourse(const trial::CourseParams& course, core::TrialKey key, DesignationSums& sums) {
  const messages::Goal told = trial::DesignatedGoal(course, key);
  const double downrange_m = told.x_m - course.goal_x_m;
  const double crossrange_m = told.y_m - course.goal_y_m;
  sums.Add(kCourseDownrangeSquares, downrange_m * downrange_m);
  sums.Add(kCourseCrossrange, crossrange_m);
  sums.Add(kCourseCrossrangeSquares, crossrange_m * crossrange_m);
  const trial::DesignationErrors errors = course.designation.ErrorsAt(course.goal_x_m);
  sums.Add(kEquation1, errors.crossrange_sd_m);
  sums.Add(kEquation2, errors.downrange_sd_m);
  sums.Add(kEquation3, errors.crossrange_bias_m);
}

}  // namespace

LanderCameras CamerasOf(const DesignationStudyParams& study,
                        const trial::DesignationParams& designation) {
  return {designation.pixel_rad, designation.baseline_m, study.mast_height_m,
          static_cast<int>(study.image_side_px)};
}

DesignationExperiment::DesignationExperiment(const DesignationStudyParams& params,
                                             const trial::DriveParams& drive)
    : CellExperiment(params.Factors(), DesignationColumns()),
      params_(params),
      course_(drive.course),
      cameras_(CamerasOf(params, drive.course.designation)) {}

trial::CourseParams DesignationExperiment::CourseOf(double range_m) const {
  trial::CourseParams course = course_;
  course.start_x_m = 0.0;
  course.start_y_m = 0.0;
  course.goal_x_m = range_m;
  course.goal_y_m = 0.0;
  course.waypoints = {};
  course.designation.enabled = true;
  course.designation.lander_ahead_m = 0.0;
  course.designation.lander_left_m = 0.0;
  return course;
}

std::vector<double> DesignationExperiment::Measure(std::size_t cell, core::TrialKey key) const {
  const double range_m = table().Values(cell).front();
  const Vector3 p_goal_L(range_m, 0.0, params_.goal_height_m);
  const LanderPair pair(cameras_, p_goal_L);
  const trial::CourseParams course = CourseOf(range_m);
  // RequireDesignable refuses ranges at which a camera does not image the goal.
  const StereoPick seen = pair.See(p_goal_L).value();
  DesignationSums sums;
  for (std::int64_t i = 0; i < params_.designations_per_run; ++i) {
    const core::TrialKey scene = SceneKey(key, params_.designations_per_run, i);
    const PickErrors errors = Draw(course.designation, scene);
    sums.Add(kDesignations, 1.0);
    AddCourse(course, scene, sums);
    const auto place = pair.Place({seen.left_px + vision::Pixel(errors.column_px, errors.row_px),
                                   seen.disparity_px + errors.disparity_px});
    sums.Add(place ? kFound : kBeyond, 1.0);
    if (!place) continue;
    if (place->head<2>().norm() > 2.0 * range_m) sums.Add(kDoubled, 1.0);
    AddPlace(*place - p_goal_L, sums);
    AddPanned(Panned(*place, errors.pan_rad) - p_goal_L, params_.near_enough_m, sums);
  }
  return {sums.values().begin(), sums.values().end()};
}

}  // namespace rockyard::experiments

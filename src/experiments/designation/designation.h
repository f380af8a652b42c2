// The experiment "designation" (make_experiment.cc): where operators put goals in the lander's
// stereo images. A cell is a range of the goal along the ground; a scene is one designation of a
// goal at it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/random.h"
#include "experiments/cell_experiment.h"
#include "experiments/designation/designation_study_params.h"
#include "experiments/experiment.h"
#include "math/pose.h"
#include "trial/course/course_params.h"
#include "truth/record.h"
#include "vision/cameras/cahv.h"
#include "vision/cameras/camera_types.h"

namespace rockyard::experiments {

// The lander's stereo cameras on their mast, turned towards a goal.
//
// Frame L: origin on the ground under the mast, x along the ground towards the goal, y to the left,
// z up. The cameras stand half a baseline to the left and right of the mast's top, look in parallel
// down the line from there to the goal, and image by a pinhole whose middle pixels cover pixel_rad.
struct LanderCameras {
  double pixel_rad = 0.001;
  double baseline_m = 0.15;
  double mast_height_m = 1.5;
  int image_side_px = 256;
};

// A place as it is measured in the images.
struct StereoPick {
  vision::Pixel left_px = vision::Pixel::Zero();  // column, row
  double disparity_px = 0.0;                      // column_left - column_right
};

class LanderPair {
 public:
  // The pair is turned towards p_goal_L, which is not the mast's top.
  LanderPair(const LanderCameras& cameras, const math::Vector3& p_goal_L);

  // Returns where both cameras image a place; nothing where one of them has it behind its back.
  std::optional<StereoPick> See(const math::Vector3& p_L) const;

  // Returns the place in L that a measurement stands for, by triangulation. Nothing where its
  // disparity is not positive, so that the place lies at infinity or beyond.
  std::optional<math::Vector3> Place(const StereoPick& pick) const;

 private:
  vision::Cahv left_;
  vision::Cahv right_;
};

// Returns the place as a pan axis tells it in the lander's frame whose angle is wrong by pan_rad,
// positive to the left.
math::Vector3 Panned(const math::Vector3& p_L, double pan_rad);

// The columns after the range. Must stay in the order of DesignationColumns, whose values
// DesignationSums holds by these numbers.
enum class DesignationColumn : std::size_t {
  kDesignations,
  kBeyond,
  kFound,
  kNearEnough,
  kDoubled,
  kDownrange,
  kDownrangeSquares,
  kDownrangeCubes,
  kDownrangeSpread,
  kCrossrange,
  kCrossrangeSquares,
  kCrossrangeSpread,
  kHeight,
  kHeightSquares,
  kPannedDownrange,
  kPannedDownrangeSquares,
  kPannedCrossrange,
  kPannedCrossrangeSquares,
  kMiss,
  kCourseDownrangeSquares,
  kCourseCrossrange,
  kCourseCrossrangeSquares,
  kEquation1,
  kEquation2,
  kEquation3,
  kColumns
};

class DesignationSums {
 public:
  static constexpr std::size_t kSize = static_cast<std::size_t>(DesignationColumn::kColumns);

  void Add(DesignationColumn column, double value) {
    values_[static_cast<std::size_t>(column)] += value;
  }
  const std::array<double, kSize>& values() const { return values_; }

 private:
  std::array<double, kSize> values_{};
};

// Returns every column but the number of the cell: the range that names a cell, then those of
// DesignationColumn, in its order.
const truth::RecordSchema& DesignationColumns();

class DesignationExperiment final : public CellExperiment {
 public:
  // `drive` holds the errors (course.designation). Cost: below 1 us a designation. Randomness:
  // kExperiment, and kGoalDesignation for the errors that course.designation draws, under a key of
  // each designation.
  DesignationExperiment(const DesignationStudyParams& params, const trial::DriveParams& drive);

 private:
  // Returns the course with its start under the mast and its goal at that range.
  trial::CourseParams CourseOf(double range_m) const;
  std::vector<double> Measure(std::size_t cell, core::TrialKey key) const override;

  DesignationStudyParams params_;
  trial::CourseParams course_;
  LanderCameras cameras_;
};

// Returns the cameras that a scenario gives the lander.
LanderCameras CamerasOf(const DesignationStudyParams& study,
                        const trial::DesignationParams& designation);

}  // namespace rockyard::experiments

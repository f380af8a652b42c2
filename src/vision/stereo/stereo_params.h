// Parameters of the stereo pipeline (Goldberg 2002 section 2): from a pair of images to
// disparities. Scenarios with stereo or visual odometry and the commands that match pairs have
// them; meaning, unit and origin of each stand in Visit.
//
// The paper names the stages, the window of 7 x 7, images reduced from 1024 to 256 pixels, 32
// disparities. What it leaves open (sizes of the filters, thresholds) is a parameter here. The
// defaults were chosen on synthetic pairs alone and fixed before real pairs were run with them:
// tuned to real pairs, they would make the comparison with OpenCV on these worthless. Records of
// drives with stereo depend on the defaults; the ranges in Visit only refuse files.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"

namespace rockyard::vision {

// The curve through the scores at the best disparity and its two neighbours, whose lowest point is
// the sub-pixel disparity.
enum class Interpolation {
  kQuadratic,    // a parabola
  kEquiangular,  // two lines of opposite slope, the steeper of the two through the neighbours
};

// How the two Gaussians of the difference lie (dog.h).
enum class DogKind {
  kLaplacian,    // a narrow one on a wide one, as Goldberg 2002 has it
  kRowGradient,  // two alike, side by side along the row
};

// Difference of Gaussians, each approximated by a mean over few pixels. The sides belong to the
// squares of the Laplacian; the row gradient ignores them.
struct DogParams {
  DogKind kind = DogKind::kRowGradient;
  std::int64_t narrow_side_px = 1;
  std::int64_t wide_side_px = 11;
  double gain = 4.0;
  std::int64_t limit = 20;

  void Visit(core::FieldVisitor& v);
};

// The correlator: the window that is compared, and the range of disparities that is searched.
struct CorrelatorParams {
  std::int64_t window_side_px = 7;
  std::int64_t min_disparity_px = 0;
  std::int64_t disparities = 32;

  void Visit(core::FieldVisitor& v);
};

// The checks after the correlation, and the sub-pixel interpolation.
struct StereoFilterParams {
  Interpolation interpolation = Interpolation::kEquiangular;
  double line_of_sight_px = 1.0;
  double min_curvature = 0.6;
  double min_curvature_ratio = 0.2;
  std::int64_t blob_min_px = 100;
  double blob_max_step_px = 1.0;

  void Visit(core::FieldVisitor& v);
};

struct StereoPipelineParams {
  std::int64_t pyramid_level = 0;
  DogParams dog = {};
  CorrelatorParams correlator = {};
  StereoFilterParams filters = {};

  void Visit(core::FieldVisitor& v);
};

// Returns whether every score of the correlator fits its 16 bits with two bits to spare, and no
// candidate's key is kNoKey (correlator.h): the largest sum of absolute differences, side^2 * 2
// limit, is below 2^14 - 1.
bool ScoresFit(const DogParams& dog, const CorrelatorParams& correlator);

// A rectified pair: parallel axes, rows aligned, one focal length.
struct StereoGeometry {
  double focal_px = 0.0;    // at the pyramid level that is correlated
  double baseline_m = 0.0;  // from the left to the right camera, positive
  double offset_px = 0.0;   // disparity of what is infinitely far: c_left - c_right of the columns
};

// Returns `correlator` with the range that depths ask for (Goldberg 2002 section 2 stage 4:
// "derived geometrically from the input range of depth values"): the disparities
//   d = focal baseline / depth + offset
// of points from nearest_m to farthest_m before the cameras (along their axes; farthest_m may be
// infinite), rounded outwards, and one disparity more on either side, which the peak filter needs.
// 0 < nearest_m <= farthest_m. Throws core::UserError where the range has more than 512 disparities
// or begins more than 480 px from 0. For `rockyard stereo`: rovers are given disparities.
CorrelatorParams SearchDepths(const StereoGeometry& pair, double nearest_m, double farthest_m,
                              CorrelatorParams correlator);

}  // namespace rockyard::vision

template <>
struct rockyard::core::EnumNames<rockyard::vision::DogKind> {
  static constexpr std::array<std::string_view, 2> kNames{"laplacian", "row_gradient"};
};

template <>
struct rockyard::core::EnumNames<rockyard::vision::Interpolation> {
  static constexpr std::array<std::string_view, 2> kNames{"quadratic", "equiangular"};
};

// Parameters of visual odometry, stage by stage (Howard 2012 section 2; Matthies 1989), for
// VisualOdometer. Meaning, unit and origin of each stand in Visit. Records of drives depend on the
// defaults, which `rockyard vo` shares. EstimationParams::max_fit, PlacementParams::noise_px and
// PlacementParams::max_residual_ratio were chosen with KITTI's excerpt known: do not take the
// results on it for a test of these.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"
#include "vision/odometry/feature_params.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// How the disparity map is made (vision/stereo), and how well its disparities are known.
struct DisparityMapParams {
  DogParams dog;
  std::int64_t window_side_px = 7;
  StereoFilterParams filters;
  double noise_px = 0.15;
  double max_step_px = 1.0;

  void Visit(core::FieldVisitor& v);
};

enum class PlaceSource {
  kRightEye,      // the feature itself is found in the right image
  kDisparityMap,  // dense stereo of both images, interpolated at the feature
};

// How a feature's place is found.
struct PlacementParams {
  PlaceSource source = PlaceSource::kRightEye;
  double min_disparity_px = 1.0;
  double max_disparity_px = 96.0;
  std::int64_t window_px = 15;
  double noise_px = 0.025;
  double ambiguity = 0.9;
  bool slanted = true;
  double slope_sd = 0.3;
  double max_slope = 0.5;
  double max_residual_ratio = 2.0;
  std::int64_t min_kept = 50;
  DisparityMapParams map = {};

  std::size_t side() const { return static_cast<std::size_t>(window_px); }

  void Visit(core::FieldVisitor& v);
};

enum class SelectionMethod {
  kRansac,    // motions of three points, judged by where they put the others
  kRigidity,  // distances between points that did not change
};

// How the largest set of points that moved as one is found.
struct SelectionParams {
  SelectionMethod method = SelectionMethod::kRansac;
  double inlier_px = 1.5;
  double miss_probability = 1e-4;
  std::int64_t max_draws = 1000;
  double rigidity_sigma = 3.0;
  std::int64_t min_consistent = 12;
  double min_share = 0.3;

  void Visit(core::FieldVisitor& v);
};

enum class RobustWeights {
  kNone,
  kHuber,   // 1 up to `robust_sigma`, then as its inverse
  kCauchy,  // 1 / (1 + (r / robust_sigma)^2)
};

// Least squares, and which of its results are no motion.
struct EstimationParams {
  RobustWeights weights = RobustWeights::kHuber;
  double robust_sigma = 2.0;
  std::int64_t max_iterations = 30;
  double tolerance = 0.01;
  double max_fit = 10.0;
  double max_position_sd_m = 0.1;
  double max_rotation_sd_rad = math::DegToRad(2.0);

  void Visit(core::FieldVisitor& v);
};

// When a pair takes the keyframe's place.
struct KeyframeParams {
  double max_way_m = 0.5;
  double max_turn_rad = math::DegToRad(10.0);
  double min_share = 0.4;
  std::int64_t failures = 1;

  void Visit(core::FieldVisitor& v);
};

struct OdometerParams {
  FeatureDetectorParams detector;
  FeatureMatcherParams matcher;
  PlacementParams placement;
  SelectionParams selection;
  EstimationParams estimation;
  KeyframeParams keyframe;
  double variance_factor = 3.5;
  std::int64_t rounds = 2;
  double round_way_m = 0.1;
  double round_turn_rad = math::DegToRad(3.0);

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::vision

template <>
struct rockyard::core::EnumNames<rockyard::vision::PlaceSource> {
  static constexpr std::array<std::string_view, 2> kNames{"right_eye", "disparity_map"};
};

template <>
struct rockyard::core::EnumNames<rockyard::vision::SelectionMethod> {
  static constexpr std::array<std::string_view, 2> kNames{"ransac", "rigidity"};
};

template <>
struct rockyard::core::EnumNames<rockyard::vision::RobustWeights> {
  static constexpr std::array<std::string_view, 3> kNames{"none", "huber", "cauchy"};
};

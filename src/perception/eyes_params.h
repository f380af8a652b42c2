// Parameters of on-board stereo (perception.stereo), of what a controller for light stripes makes
// of range points (perception.cloud_elevations), and of what on-board software makes of motions
// that it sees (perception.visual_odometry). Defaults decide records and baselines of drives by
// stereo; bounds only refuse files.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"
#include "vision/odometry/odometer_params.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::perception {

// The pipeline of vision/stereo, without reduction and range of disparities, which come from
// sensors.stereo (StereoSearch in stereo_points.h).
struct StereoMatchingParams {
  vision::DogParams dog;
  std::int64_t window_side_px = 7;
  vision::StereoFilterParams filters;

  void Visit(core::FieldVisitor& v);
};

// The frame in which heights count.
enum class ElevationFrame {
  kRover,  // R, as the light stripe sensor has it: a rover that tilts sees the ground tilted
  kLevel,  // R turned level by the attitude estimate
  kPlane,  // from the plane of the ground ahead: a smooth slope is no step
};

struct CloudElevationParams {
  std::int64_t rows = 4;
  std::int64_t stripes = 5;
  double near_m = 0.425;
  double far_m = 1.425;
  double half_width_m = 0.6;
  double quantile = 1.0;
  std::int64_t min_points = 3;
  ElevationFrame frame = ElevationFrame::kLevel;
  double plane_outlier_m = 0.1;
  double max_plane_rad = math::DegToRad(25.0);

  void Visit(core::FieldVisitor& v);
};

struct SlipCheckParams {
  bool enabled = false;
  double limit = 0.5;
  double sigma = 2.0;
  double min_way_m = 0.2;

  void Visit(core::FieldVisitor& v);
};

struct VisualMotionParams {
  double tilt_sd_rad = math::DegToRad(1.0);
  SlipCheckParams slip_check;
  vision::OdometerParams odometer;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::perception

template <>
struct rockyard::core::EnumNames<rockyard::perception::ElevationFrame> {
  static constexpr std::array<std::string_view, 3> kNames{"rover", "level", "plane"};
};

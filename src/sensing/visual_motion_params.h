// Parameters of visual odometry as a sensor of a trial (scenario group sensors.visual_odometry):
// when it takes images, and what comes out where none are matched. The trial keeps the schedule and
// the keyframes; VisualMotion (visual_motion.h) takes the errors. The numbers of the error model
// are one fit to rendered images (fit_visual_motion.py) and must be changed together.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::sensing {

enum class VisualFidelity {
  kErrorModel,  // the true motion with errors fitted to images
  kImage,       // images are rendered, and their features matched on board
};

// When images are taken: at whichever of these comes first since the last images.
struct VisualScheduleParams {
  double every_m = 0.75;
  double every_rad = math::DegToRad(18.0);
  double every_s = 0.0;  // 0: not by time

  void Visit(core::FieldVisitor& v);
};

// A standard deviation that grows with a motion of length d and angle a:
//   sd^2 = still^2 + (per_m d)^2 + (per_rad a)^2
struct MotionErrorParams {
  double still = 0.0;    // m, or rad
  double per_m = 0.0;    // the same, a metre
  double per_rad = 0.0;  // the same, a radian

  double Variance(double way_m, double angle_rad) const;
};

struct PlaceErrorParams : MotionErrorParams {
  void Visit(core::FieldVisitor& v);
};
struct TurnErrorParams : MotionErrorParams {
  void Visit(core::FieldVisitor& v);
};

// Chance that no motion is found: 1 / (1 + exp(-(intercept + per_m d + per_rad a))).
struct VisualFailureParams {
  double intercept = -11.7;
  double per_m = 7.51;
  double per_rad = 4.83;

  double Probability(double way_m, double angle_rad) const;

  void Visit(core::FieldVisitor& v);
};

// The errors of a measured motion, in the axes of the first moment's rover frame.
struct VisualErrorModelParams {
  double keyframe_m = 0.5;
  double keyframe_rad = math::DegToRad(10.0);
  VisualFailureParams failure;
  PlaceErrorParams along{{.still = 1.21e-5, .per_m = 0.00172, .per_rad = 8.83e-5}};
  PlaceErrorParams across{{.still = 2.25e-5, .per_m = 0.00125, .per_rad = 0.000183}};
  PlaceErrorParams up{{.still = 5.22e-5, .per_m = 0.00138, .per_rad = 0.000305}};
  // Errors of the turns about x and y, each, and about z.
  TurnErrorParams tilt{
      {.still = math::DegToRad(0.00291), .per_m = math::DegToRad(0.0282), .per_rad = 0.000384}};
  TurnErrorParams heading{
      {.still = math::DegToRad(0.00168), .per_m = math::DegToRad(0.0189), .per_rad = 0.000201}};

  void Visit(core::FieldVisitor& v);
};

struct VisualMotionParams {
  bool enabled = false;
  VisualFidelity fidelity = VisualFidelity::kErrorModel;
  VisualScheduleParams schedule;
  std::int64_t pyramid_level = 0;
  VisualErrorModelParams error_model;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::sensing

template <>
struct rockyard::core::EnumNames<rockyard::sensing::VisualFidelity> {
  static constexpr std::array<std::string_view, 2> kNames{"error_model", "image"};
};

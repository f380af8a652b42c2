// Parameters of how the lander finds the coloured cylinder on the rover (sensing/cylinder_law.h).
#pragma once

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::sensing {

// Log odds of a chance: intercept + width ln(m / 20) + no_blue [no blue is seen] + pink_aside
// sin(2 theta) + light sin(e), of a cylinder m pixels wide under a sun at elevation e.
struct CylinderChanceParams {
  double intercept = 0.0;
  double width = 0.0;
  double no_blue = 0.0;
  double pink_aside = 0.0;
  double light = 0.0;

  void Visit(core::FieldVisitor& v);
};

// A deviation: sd^2 = least^2 + (pixels times what one pixel is worth)^2.
struct CylinderDeviationParams {
  double least = 0.0;  // rad, or a share of the range
  double pixels = 0.0;
};
struct CylinderAngleDeviationParams : CylinderDeviationParams {
  void Visit(core::FieldVisitor& v);
};
struct CylinderRangeDeviationParams : CylinderDeviationParams {
  void Visit(core::FieldVisitor& v);
};

struct CylinderLawParams {
  double image_width_px = 512.0;
  double field_of_view_rad = math::DegToRad(29.33);
  double nearest_m = 0.838;
  double mounting_rad = 0.0;
  double sun_elevation_rad = math::DegToRad(60.0);
  // Of the published finder.
  CylinderChanceParams found{
      .intercept = 2.53, .width = 0.355, .no_blue = 0.255, .pink_aside = 0.576, .light = -0.891};
  CylinderChanceParams wrong{
      .intercept = -1.06, .width = -0.318, .no_blue = 0.348, .pink_aside = -0.658, .light = 1.67};
  CylinderAngleDeviationParams heading{{.least = math::DegToRad(3.25), .pixels = 1.41}};
  CylinderRangeDeviationParams range{{.least = 0.0105, .pixels = 0.471}};
  CylinderAngleDeviationParams bearing{{.pixels = 1.46}};
  double heading_bias_rad = 0.0;
  double range_bias = 0.0;
  double wrong_turn_rad = math::DegToRad(141.0);
  double wrong_range = 0.436;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::sensing

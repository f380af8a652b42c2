// Sunlight (or a lamp) on the terrain, and how much of it the terrain sends back (scenario group
// sensors.sun): for the images and shadows of every sensor that sees terrain. The aid
// sensors.aids.sun has a sun of its own.
#pragma once

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::rendering {

struct SunParams {
  double elevation_rad = math::DegToRad(60.0);
  double azimuth_rad = math::DegToRad(90.0);
  double irradiance_w_m2_nm = 0.97;
  double distance_au = 1.524;
  double optical_depth = 0.5;
  double diffuse_share = 0.7;
  double ground_albedo = 0.35;
  double rock_albedo = 0.20;
  double rover_albedo = 0.30;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::rendering

// What stands before the lander's colour cameras: the cylinder of Matthies 1995, section 5, its
// light, its surroundings, and the cameras themselves. The parameters of the study of
// cylinder finders contain these.
//
// Colours, light, response and surroundings are assumed, each with its range of studies: they were
// written down before any finder was run on an image. Drives render none of these images. The
// numbers of the lander's fix (CylinderLawParams in sensing/aid_params.h) were fitted to such
// images, and must be fitted anew where the images change.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::rendering {

// The quadrant between the two pink ones, opposite to the blue one.
enum class ThirdColour { kOrange, kGreen };
// What the cylinder stands on.
enum class CylinderStand { kTurntable, kRover };
// Where the cameras look: along the ground, or down to the height of the cylinder.
enum class CameraPointing { kLevel, kAtCylinder };

}  // namespace rockyard::rendering

template <>
struct rockyard::core::EnumNames<rockyard::rendering::ThirdColour> {
  static constexpr std::array<std::string_view, 2> kNames{"orange", "green"};
};
template <>
struct rockyard::core::EnumNames<rockyard::rendering::CylinderStand> {
  static constexpr std::array<std::string_view, 2> kNames{"turntable", "rover"};
};
template <>
struct rockyard::core::EnumNames<rockyard::rendering::CameraPointing> {
  static constexpr std::array<std::string_view, 2> kNames{"level", "at_cylinder"};
};

namespace rockyard::rendering {

// Red, green, blue.
using ColourValues = std::array<double, 3>;

struct CylinderTargetParams {
  double diameter_m = 0.192;
  double height_m = 0.10;
  double middle_height_m = 1.0;  // above the ground
  ThirdColour third_colour = ThirdColour::kOrange;
  ColourValues blue{0.12, 0.30, 0.85};
  ColourValues pink{0.95, 0.25, 0.60};
  ColourValues orange{1.00, 0.35, 0.10};
  ColourValues green{0.15, 0.80, 0.25};
  ColourValues top{0.55, 0.53, 0.50};
  CylinderStand stand = CylinderStand::kTurntable;

  void Visit(core::FieldVisitor& v);
};

struct ColourCameraParams {
  std::int64_t columns = 512;
  std::int64_t rows = 480;
  double field_of_view_rad = math::DegToRad(29.33);  // of the columns
  double baseline_m = 0.12;
  double front_m = 0.076;
  double height_m = 1.0;
  CameraPointing pointing = CameraPointing::kLevel;
  double crosstalk = 0.15;
  double blur_px = 0.5;
  double colour_blur_px = 1.0;
  double full_well_e = 30000.0;
  double read_noise_counts = 1.0;
  double exposure_level = 0.35;
  double balance_elevation_rad = math::DegToRad(45.0);
  double gamma = 1.0;

  void Visit(core::FieldVisitor& v);
};

struct CylinderLightParams {
  double elevation_rad = math::DegToRad(45.0);
  double azimuth_rad = math::DegToRad(150.0);
  double optical_depth = 0.5;
  double diffuse_share = 0.7;
  ColourValues sun{1.00, 0.95, 0.88};
  ColourValues sky{1.00, 0.78, 0.55};

  void Visit(core::FieldVisitor& v);
};

struct BackdropParams {
  ColourValues ground{0.45, 0.27, 0.16};
  double contrast = 0.15;
  double hue_contrast = 0.04;
  double horizon_elevation_rad = math::DegToRad(20.0);
  double horizon_distance_m = 60.0;
  double horizon_relief_m = 1.0;

  void Visit(core::FieldVisitor& v);
};

struct ClutterParams {
  double rocks = 0.0;
  double hardware = 0.0;
  double smallest_m = 0.05;
  double largest_m = 0.5;
  ColourValues rock{0.25, 0.19, 0.15};
  double rock_brightness_spread = 0.3;
  double red_share = 0.2;
  ColourValues red_rock{0.50, 0.22, 0.20};
  double hardware_largest_m = 0.15;
  double clear_m = 0.5;
  double nearest_m = 1.2;
  double farthest_m = 25.0;

  void Visit(core::FieldVisitor& v);
};

struct CylinderPictureParams {
  CylinderTargetParams target = {};
  ColourCameraParams cameras = {};
  CylinderLightParams light = {};
  BackdropParams backdrop = {};
  ClutterParams clutter = {};
  std::int64_t edge_samples = 6;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::rendering

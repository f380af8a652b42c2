// Parameters of the light stripe hazard sensor of Matthies 1995, section 6, table 3 and figure 13
// (scenario group sensors.light_stripe): light emitters and imager, then the sensor itself. Both
// fidelities of the sensor read them, and the rover's calibration starts from them. Defaults decide
// records and baselines; bounds only refuse files. Chances of errors may be fitted to images
// (fit_stripe_errors.py) and then belong to one light and one layout.
//
// Figure 13 is lost; the text fixes the farthest central point, the outermost points, the optics,
// the camera separation and the range of the baselines. The rest of the layout is assumed: cameras
// and emitters share one lateral axis below the front edge of the solar panel, the fans are
// vertical planes in R, and the four scanlines are placed by where they meet flat ground.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/fields.h"
#include "math/angles.h"
#include "messages/calibration.h"
#include "rendering/imager_params.h"

namespace rockyard::sensing {

// How the light of one emitter is spread within its plane.
enum class BeamFan {
  kFull,            // evenly over fan_rad: about 300 scanlines, of which 4 are measured
  kThreeScanlines,  // over three scanlines around each measured point, an emitter for each point
};

// Cross section of the beam, square to the light plane.
enum class BeamProfile { kGaussian, kTopHat };

struct LaserParams {
  double input_power_w = 0.66;
  double optical_efficiency = 0.10;
  double wavelength_m = 850e-9;
  double beam_width_rad = 0.003;
  BeamProfile profile = BeamProfile::kGaussian;
  BeamFan fan = BeamFan::kFull;
  double speckle_contrast = 0.1;

  void Visit(core::FieldVisitor& v);
};

struct StripeImagerParams : rendering::ImagerParams {
  std::int64_t averaging_rows = 5;
  std::int64_t margin_rows = 0;

  void Visit(core::FieldVisitor& v);
};

// How much of the sensor is simulated.
enum class Fidelity {
  kGeometric,  // where rays meet, with a measured error model
  kImage,      // images of the scene, and the software that finds stripes in them
};

// Where a point that is detected in the wrong place appears.
enum class WrongPlace {
  kSearchedPart,   // any column that the search for this stripe covers, all equally likely
  kWholeScanline,  // any column of the camera
};

struct LightStripeParams {
  Fidelity fidelity = Fidelity::kGeometric;

  // Optics, table 3; Rocky 3.2 has the 4.8 mm lens.
  std::int64_t columns = 768;
  std::int64_t rows = 484;
  double active_width_m = 0.0089;
  double active_height_m = 0.0066;
  double focal_length_m = 0.0048;
  messages::Lens lens = messages::Lens::kEquidistantRows;
  double fan_rad = 1.0;
  std::int64_t lasers_per_image = 2;

  // Where cameras and emitters sit, in R.
  double camera_separation_m = 0.12;
  double camera_x_m = 0.27;
  double camera_height_m = 0.25;
  double camera_pitch_rad = math::DegToRad(45.0);
  double emitter_x_m = 0.27;
  double emitter_height_m = 0.25;
  double inner_emitter_y_m = 0.11;
  double outer_emitter_y_m = 0.14;

  // Where the array lands on flat ground.
  double front_x_m = 0.325;
  double datum_z_m = 0.0;
  std::array<double, messages::kStripeRows> row_ahead_m{0.10, 0.1667, 0.2333, 0.30};
  double inner_stripe_y_m = 0.185;
  double outer_stripe_y_m = 0.37;
  // Denser arrays: the published rows and stripes with others evenly between them.
  std::int64_t row_subdivision = 1;
  std::int64_t stripe_subdivision = 1;

  // Detection.
  double search_low_m = -0.30;
  double search_high_m = 0.20;
  double max_range_m = 1.0;
  double wrong_place_probability = 0.01;
  WrongPlace wrong_place = WrongPlace::kSearchedPart;
  double missed_probability = 0.0;
  std::vector<double> missed_at{};  // one for each point, row by row; empty: missed_probability
  double outlier_persistence = 0.0;
  double column_noise_px = 0.0;

  // Light and imager of the image fidelity; the geometric fidelity does not read them.
  LaserParams laser{};
  StripeImagerParams imager{};

  double column_pitch_rad() const {
    return active_width_m / static_cast<double>(columns) / focal_length_m;
  }
  // Returns the area of a pixel.
  double pixel_m2() const {
    return active_width_m / static_cast<double>(columns) * active_height_m /
           static_cast<double>(rows);
  }
  double row_pitch_rad() const {
    return active_height_m / static_cast<double>(rows) / focal_length_m;
  }

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::sensing

template <>
struct rockyard::core::EnumNames<rockyard::sensing::BeamFan> {
  static constexpr std::array<std::string_view, 2> kNames{"full", "three_scanlines"};
};

template <>
struct rockyard::core::EnumNames<rockyard::sensing::BeamProfile> {
  static constexpr std::array<std::string_view, 2> kNames{"gaussian", "top_hat"};
};

template <>
struct rockyard::core::EnumNames<rockyard::messages::Lens> {
  static constexpr std::array<std::string_view, 3> kNames{"equidistant_rows", "equidistant",
                                                          "pinhole"};
};

template <>
struct rockyard::core::EnumNames<rockyard::sensing::Fidelity> {
  static constexpr std::array<std::string_view, 2> kNames{"geometric", "image"};
};

template <>
struct rockyard::core::EnumNames<rockyard::sensing::WrongPlace> {
  static constexpr std::array<std::string_view, 2> kNames{"searched_part", "whole_scanline"};
};

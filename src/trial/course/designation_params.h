// How goals are designated in the images of the lander's cameras (Matthies 1995, section 4), and
// what these show of the rocks.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::trial {

// What the calibration of the pan axis leaves wrong.
enum class PanError {
  kFixed,    // pan_error itself, in every trial
  kUniform,  // uniform from -pan_error to +pan_error, drawn once a trial
};

// What is expected of goals at one range from the lander's cameras.
struct DesignationErrors {
  double crossrange_sd_m = 0.0;    // random
  double downrange_sd_m = 0.0;     // random
  double crossrange_bias_m = 0.0;  // systematic; with PanError::kUniform the bound of its size
};

struct DesignationParams {
  bool enabled = false;
  double lander_ahead_m = 0.0;  // of the start, along the line from the start to the goal
  double lander_left_m = 0.0;   // of that line
  double pixel_sd_px = 1.0;
  double disparity_sd_px = 0.1;
  double pixel_rad = 0.001;
  double baseline_m = 0.15;
  PanError pan_kind = PanError::kFixed;
  double pan_error_rad = math::DegToRad(1.0);
  // No parameter: of a course whose pan error was drawn elsewhere, what is known of it all the
  // same. A drawn error must not tell the rover's filter how large it is.
  std::optional<double> stated_pan_sd_rad = std::nullopt;

  // What the calibration states of the pan error, a standard deviation: of a fixed one its size, of
  // a uniform one its bound over the root of 3.
  double PanSd_rad() const;

  // Matthies 1995, eqs. (1) to (3), for pixels of pixel_rad, goals picked to pixel_sd_px and
  // disparities known to disparity_sd_px:
  //   sigma_crossrange = pixel_sd pixel_rad R              (published: 0.001 R)
  //   sigma_downrange  = disparity_sd pixel_rad R^2 / B    (published: 0.0001 R^2 / B)
  //   Delta_crossrange = Delta_theta R
  // First order in the errors: where sigma_downrange is no longer small against R (as published 7 %
  // of it at 100 m), true downrange errors are skewed, these are not. range_m >= 0.
  DesignationErrors ErrorsAt(double range_m) const;

  void Visit(core::FieldVisitor& v);
};

// What the lander's stereo pair shows of the rocks (Matthies 1995, sections 2.1.1 and 4). The
// cameras themselves, and where they stand, are those that designate goals: angle of a pixel,
// baseline, pan error.
struct LanderMapParams {
  double mast_height_m = 1.5;
  double edge_sd_px = 1.0;
  double disparity_sd_px = 0.1;
  double resolved_px = 3.0;
  double reach_m = 40.0;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::trial

template <>
struct rockyard::core::EnumNames<rockyard::trial::PanError> {
  static constexpr std::array<std::string_view, 2> kNames{"fixed", "uniform"};
};

// How goals are designated in the images of the lander's cameras (Matthies 1995, section 4), and
// what the cameras show of the rocks. goal_designation.h tells goals and maps rocks by it, the
// error-state filter is told how well the pan angle is known, and the experiment on designation
// measures it. Meanings and sources stand in the .cc.
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

// Errors of a designated place at one range from the lander's cameras.
struct DesignationErrors {
  double crossrange_sd_m = 0.0;    // random
  double downrange_sd_m = 0.0;     // random
  double crossrange_bias_m = 0.0;  // systematic; with PanError::kUniform the bound of its size
};

// How goals are designated.
struct DesignationParams {
  bool enabled = false;
  double lander_ahead_m = 0.0;  // lander ahead of the start, along the line from start to goal
  double lander_left_m = 0.0;   // lander left of that line
  double pixel_sd_px = 1.0;
  double disparity_sd_px = 0.1;
  double pixel_rad = 0.001;
  double baseline_m = 0.15;
  PanError pan_kind = PanError::kFixed;
  double pan_error_rad = math::DegToRad(1.0);
  // No parameter of scenarios: what PanSd_rad returns for a course whose pan error was drawn
  // elsewhere, as missions do. A drawn error must not tell the rover's filter how large it is.
  std::optional<double> stated_pan_sd_rad = std::nullopt;

  // Returns the standard deviation of the pan error that the calibration states: the size of a
  // fixed error, the bound of a uniform error over the root of 3.
  double PanSd_rad() const;

  // Returns the errors at the range R from the lander's cameras (Matthies 1995, eqs. 1 to 3), for
  // pixels of pixel_rad, goals picked with pixel_sd_px and disparities known with disparity_sd_px:
  //   sigma_crossrange = pixel_sd pixel_rad R              (published: 0.001 R)
  //   sigma_downrange  = disparity_sd pixel_rad R^2 / B    (published: 0.0001 R^2 / B)
  //   Delta_crossrange = Delta_theta R
  // They are of first order: where sigma_downrange is no longer small against R (as published 7 %
  // of R at 100 m), true downrange errors are skewed, these are not. range_m >= 0.
  DesignationErrors ErrorsAt(double range_m) const;

  void Visit(core::FieldVisitor& v);
};

// What the lander's stereo pair shows of the rocks (Matthies 1995, sections 2.1.1 and 4). The
// cameras and their place are those of DesignationParams: angle of a pixel, baseline, pan error.
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

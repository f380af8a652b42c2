// Parameters of range sensing by stereo cameras at the rover's front and rear (scenario group
// sensors.stereo). All fidelities of the sensor read them. Defaults decide records and baselines;
// bounds only refuse files. Where images are matched on board, the matching takes pyramid_level,
// min_ and max_disparity_px and max_range_m from here. Noise, mismatches and dropouts belong to the
// error model alone, and may be fitted to images (fit_stereo_errors.py).
//
// `rows` and `columns` count the pixels of the reduced images, one range point each at most. Ranges
// are distances along the ray; a depth is taken along the optical axis.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"
#include "rendering/picture/picture_params.h"
#include "vision/cameras/rig_drift_params.h"

namespace rockyard::sensing {

enum class StereoFidelity {
  kIdeal,       // the first surface on every ray from the middle of the pair, without error
  kErrorModel,  // what stereo matching makes of those surfaces, by a model of its errors
  kImage,       // images of the pair are rendered, and matched on board
};

enum class StereoFieldOfView {
  kFull,    // all that the cameras see
  kStripe,  // only points over the ground that a light stripe sensor scans (StripeWindowParams)
};

// Where a pair of cameras sits, seen along its own viewing direction.
struct StereoMountParams {
  double ahead_m = 0.40;
  double height_m = 0.45;
  double pitch_rad = math::DegToRad(45.0);

  void Visit(core::FieldVisitor& v);
};

// Rectangle of the ground, in the viewing direction from R's origin.
struct StripeWindowParams {
  double near_m = 0.425;
  double far_m = 0.625;
  double half_width_m = 0.37;

  void Visit(core::FieldVisitor& v);
};

// The images that a pair takes where fidelity is image.
struct StereoImageParams {
  std::int64_t pyramid_level = 2;
  vision::RigDriftParams drift;
  rendering::PictureCameraParams camera;

  void Visit(core::FieldVisitor& v);
};

struct StereoParams {
  StereoFidelity fidelity = StereoFidelity::kErrorModel;
  StereoFieldOfView field_of_view = StereoFieldOfView::kFull;
  std::int64_t columns = 128;
  std::int64_t rows = 128;
  double horizontal_fov_rad = math::DegToRad(110.0);
  double vertical_fov_rad = math::DegToRad(90.0);
  double baseline_m = 0.12;
  StereoMountParams front{};
  StereoMountParams rear{};
  double max_range_m = 4.0;
  double disparity_noise_px = 0.18;
  std::int64_t noise_window_px = 1;
  double disparity_step_px = 0.0;
  double min_disparity_px = 0.5;
  double max_disparity_px = 16.0;
  double mismatch_probability = 0.0;
  double dropout_probability = 0.05;
  double edge_dropout_probability = 0.5;
  std::int64_t edge_reach_px = 3;
  double edge_disparity_px = 1.0;
  double edge_mismatch_probability = 0.0;
  double shadow_dropout_probability = 0.0;
  std::int64_t margin_px = 0;
  StripeWindowParams stripe_window{};
  StereoImageParams images{};

  // Return the focal length along an image row and along a column, in pixels of the reduced images.
  double focal_columns_px() const;
  double focal_rows_px() const;

  // Return the size of the images as the cameras take them, before they are reduced, px.
  std::int64_t image_columns() const { return columns << images.pyramid_level; }
  std::int64_t image_rows() const { return rows << images.pyramid_level; }

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::sensing

template <>
struct rockyard::core::EnumNames<rockyard::sensing::StereoFidelity> {
  static constexpr std::array<std::string_view, 3> kNames{"ideal", "error_model", "image"};
};

template <>
struct rockyard::core::EnumNames<rockyard::sensing::StereoFieldOfView> {
  static constexpr std::array<std::string_view, 2> kNames{"full", "stripe"};
};

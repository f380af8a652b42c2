// Study "precision" against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/hazard_scenarios.h"
#include "sensing/stripe_layout_params.h"

namespace rockyard::experiments {
namespace {

// Uniform rounding of a column: the error's root mean square is one pixel's range over the root of
// 12. One pixel's range is pitch r^2 / baseline within the obliqueness of the fans.
TEST(HazardPrecisionTest, RangeErrorsAreThoseOfRoundedColumns) {
  const auto experiment = MakeExperiment(HazardScenario(
      "precision",
      {"hazard_detection.baselines_m=[0.05, 0.12]", "hazard_detection.rows=[0, 3]",
       "hazard_detection.plane_heights_m=[0]", "hazard_detection.scenes_per_run=2000"}));
  const truth::RecordSchema& schema = experiment->schema();
  for (std::uint64_t cell = 0; cell < 4; ++cell) {
    const truth::Record record = experiment->Run(1, cell);
    const double found = ValueOf(schema, record, "found");
    EXPECT_EQ(found, ValueOf(schema, record, "points"));
    const double rms = std::sqrt(ValueOf(schema, record, "range_error_m") / found);
    const double step = ValueOf(schema, record, "range_step_m") / found;
    EXPECT_NEAR(rms * std::sqrt(12.0) / step, 1.0, 0.05) << "cell " << cell;
    const double bias = ValueOf(schema, record, "range_bias_m") / found;
    EXPECT_LT(std::abs(bias), 0.05 * step) << "cell " << cell;
    EXPECT_GT(step, 0.0);
  }
}

// Range that one column stands for, brought to 0.3 m: in the triangle of camera, emitter and lit
// point a turn dt of the camera's ray moves the point along the light by r dt / sin g, of which
// dr = r dt / tan g lies along the ray, g the angle at the point. With a column of `pitch`,
// (0.3 m / r)^2 dr = pitch (0.3 m)^2 / (r tan g); for light square to the baseline B that is
// equation 2's pitch (0.3 m)^2 / B. Positions follow from the layout alone.
double ColumnAt30Centimetres(const sensing::LightStripeParams& params, std::size_t row,
                             std::size_t stripe, double ground_z_m, double pitch_rad) {
  const messages::StripeCalibration layout = sensing::TrueCalibration(params);
  const messages::StripeLaser& laser = layout.lasers[stripe];
  const math::Vector3 camera =
      layout.cameras[static_cast<std::size_t>(laser.camera)].X_RC.translation();
  const double depression_rad =
      params.camera_pitch_rad + layout.scanline_px[row] * params.row_pitch_rad();
  math::Vector3 point(camera.x() + (camera.z() - ground_z_m) / std::tan(depression_rad), 0.0,
                      ground_z_m);
  point.y() =
      laser.p_RoE_R.y() - laser.normal_R.x() / laser.normal_R.y() * (point.x() - laser.p_RoE_R.x());
  const math::Vector3 to_camera = camera - point;
  const math::Vector3 to_emitter = laser.p_RoE_R - point;
  const double tan_apex = to_camera.cross(to_emitter).norm() / to_camera.dot(to_emitter);
  return pitch_rad * 0.09 / (to_camera.norm() * tan_apex);
}

// Mean over the stripes but the centre one and over ground at -w / 2 to w / 2.
double MeanColumnAt30Centimetres(sensing::LightStripeParams params, std::size_t row,
                                 double baseline_m, double width_m, double pitch_rad) {
  params.inner_emitter_y_m = 0.5 * params.camera_separation_m + baseline_m;
  params.outer_emitter_y_m = params.inner_emitter_y_m;
  constexpr int kHeights = 200;
  double sum_m = 0.0;
  for (int i = 0; i < kHeights; ++i) {
    const double ground_z_m = width_m * ((i + 0.5) / kHeights - 0.5);
    for (const std::size_t stripe : {0u, 1u, 3u, 4u}) {
      sum_m += ColumnAt30Centimetres(params, row, stripe, ground_z_m, pitch_rad);
    }
  }
  return sum_m / (4.0 * kHeights);
}

// Measured errors of 2000 scans against the closed form. Four times the magnitude of a rounding
// error has mean 1 and deviation 0.58 columns; stripes on both sides mirror each other, so that
// 4000 are independent and 3.9 standard errors (1e-4 two-sided) are 0.036. A plane over 19 columns
// or more leaves parts of two columns that hold up to 1/8 column too much each: 0.013.
TEST(HazardPrecisionTest, ResolutionAtThirtyCentimetres) {
  constexpr double kBound = 0.05;
  const double width_m = 0.1;
  const double pitch_rad = 0.0089 / 768.0 / 0.004;  // table 3: 2.897 mrad
  const double baselines_m[] = {0.05, 0.1, 0.12};
  const std::size_t rows[] = {0, 3};
  const std::vector<std::string> cells{
      "hazard_detection.baselines_m=[0.05, 0.1, 0.12]", "hazard_detection.rows=[0, 3]",
      "hazard_detection.plane_heights_m=[0]", "hazard_detection.plane_width_m=0.1",
      "hazard_detection.scenes_per_run=2000"};
  const scenario::Scenario table_3 = HazardScenario("precision", cells);
  const scenario::Scenario rocky =
      HazardScenario("precision", With(cells, {"sensors.light_stripe.focal_length_m=0.0048"}));
  for (std::uint64_t cell = 0; cell < 6; ++cell) {
    const auto ratio = [&](const scenario::Scenario& scenario) {
      const double expected_m =
          MeanColumnAt30Centimetres(scenario.drive.sensors.light_stripe, rows[cell % 2],
                                    baselines_m[cell / 2], width_m, pitch_rad);
      return Count(scenario, "resolution_30cm_m", cell) / Count(scenario, "found", cell) /
             expected_m;
    };
    EXPECT_NEAR(ratio(table_3), 1.0, kBound) << "cell " << cell;
    // Negative control: with Rocky's 4.8 mm lens the same scans show columns of 4 / 4.8 of it.
    EXPECT_NEAR(ratio(rocky), 4.0 / 4.8, kBound) << "cell " << cell;
    EXPECT_LT(ratio(rocky), 1.0 - kBound) << "cell " << cell;
  }
}

}  // namespace
}  // namespace rockyard::experiments

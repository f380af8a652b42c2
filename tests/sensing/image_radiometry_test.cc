// Electrons against closed forms, without noise.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "image_kit.h"
#include "vision/lens.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;

constexpr double kPi = std::numbers::pi;

// N = pi A T eta lambda / (4 N^2 h c) times the radiance of the ground, on the axis.
TEST(Radiometry, FlatGroundInTheSun) {
  LineView line{QuietParams(), SunParams{}};
  line.sun.azimuth_rad = 0.0;  // the rover's shadow falls behind it
  const RenderedRow row = line.Render(FlatWith({}), PoseAt(0, 0, 0), 0, 0);

  const double up = std::sin(math::DegToRad(60.0));
  const double above = 0.97 / (1.524 * 1.524) * 40.0;  // W/m2 within 40 nm
  const double direct = above * std::exp(-0.5 / up);
  const double sky = 0.7 * (above - direct) * up;
  const double radiance = 0.35 / kPi * (direct * up + sky);
  const double pixel_m2 = 0.0089 / 768 * 0.0066 / 484;
  const double photon_j = 6.62607015e-34 * 299792458.0 / 850e-9;
  const double rate = kPi * radiance / (4.0 * 16.0) * pixel_m2 * 0.8 * 0.7 * 0.15 * 0.4 / photon_j;
  // Column 0 is on the axis; the camera's nadir columns fade with the lens.
  EXPECT_NEAR(row.sun_e_s[384] / rate, 1.0, 1e-5);
}

// The beam carries the power 1, whatever its profile.
TEST(BeamCrossSection, CarriesAllLight) {
  for (const BeamProfile profile : {BeamProfile::kGaussian, BeamProfile::kTopHat}) {
    const BeamCrossSection beam(profile, 0.003);
    constexpr int kSteps = 20000;
    double sum = 0.0;
    const double step = 0.02 / kSteps;
    for (int i = 0; i < kSteps; ++i) sum += step * beam.Density(-0.01 + (i + 0.5) * step);
    EXPECT_NEAR(sum, 1.0, 1e-5);
    EXPECT_NEAR(beam.Mean(-0.001, 0.0005) * 0.0015,
                beam.Cumulative(0.0005) - beam.Cumulative(-0.001), 1e-15);
    EXPECT_NEAR(beam.Mean(0.0004, 0.0004), beam.Density(0.0004), 1e-12);
  }
  // The Gaussian has fallen to 1/e2 half of its width from the middle.
  const BeamCrossSection gaussian(BeamProfile::kGaussian, 0.003);
  EXPECT_NEAR(gaussian.Density(0.0015) / gaussian.Density(0.0), std::exp(-2.0), 1e-12);
}

// Across the stripe, the irradiance of the pixels times the angle that each spans, as the emitter
// sees it, is what the fan sends in that direction: P / (F r^2) cos(i).
TEST(Radiometry, StripeHoldsItsShareOfThePower) {
  const LineView line{QuietParams(), Darkness()};
  const math::Transform X_WR = PoseAt(0, 0, 0);
  for (int laser = 0; laser < 5; ++laser) {
    const messages::StripeLaser& fan = line.calibration.lasers[static_cast<std::size_t>(laser)];
    for (const int row_px : line.calibration.scanline_px) {
      const ViewRow view = line.View(fan.camera, row_px);
      const auto rates = LampRates(line.Render(FlatWith({}), X_WR, fan.camera, row_px), laser);
      const Vector3 eye = line.Camera(fan.camera).X_RC.translation();
      const auto on_ground = [&](std::size_t edge) {
        return Vector3(eye - eye.z() / view.edge_R[edge].z() * view.edge_R[edge] - fan.p_RoE_R);
      };
      double power = 0.0;     // albedo / pi E dpsi, as electrons on the axis
      double expected = 0.0;  // the same of the closed form, where the pixel lies
      double weight = 0.0;
      for (std::size_t i = 0; i < rates.size(); ++i) {
        if (rates[i] == 0.0) continue;
        const Vector3 left = on_ground(i);
        const Vector3 right = on_ground(i + 1);
        const double span = std::asin(fan.normal_R.dot(right.normalized())) -
                            std::asin(fan.normal_R.dot(left.normalized()));
        power += rates[i] / view.gain[i] * std::abs(span);
        const double range = 0.5 * (left.norm() + right.norm());
        expected += rates[i] * 0.25 / (range * range * range);  // P / F cos(i) / r^2, i from z
        weight += rates[i];
      }
      ASSERT_GT(weight, 0.0) << laser << " " << row_px;
      const double closed_form =
          0.35 / kPi * FanPower(line.params) * expected / weight * line.ElectronsPerRadiance();
      EXPECT_NEAR(power / closed_form, 1.0, 0.003) << laser << " " << row_px;
    }
  }
}

// All light of a fan that lands within the image: P times the share of the fan.
TEST(Radiometry, WholeImageHoldsTheWholePower) {
  const LineView line{QuietParams(), Darkness()};
  constexpr int kLaser = 2;
  const messages::StripeLaser& fan = line.calibration.lasers[kLaser];
  const messages::Camera& camera = line.Camera(fan.camera);
  const Vector3 eye = camera.X_RC.translation();
  const rendering::RowRenderer renderer = line.Renderer();
  const rendering::SunLight light =
      rendering::MakeSunLight(line.sun, line.params.imager.filter_width_m);
  const terrain::Terrain terrain = FlatWith({});
  const rendering::ImageScene scene(terrain, PoseAt(0, 0, 0), light, line.sun, line.body,
                                    SightOf(line.params));
  const StripeLight lasers(line.params, line.calibration);
  const LitStripes stripes = lasers.Meet(scene);
  double power_w = 0.0;
  // These lines see the ground and neither the rover nor the end of the fan.
  constexpr int kFirst = -120;
  constexpr int kLast = 150;
  for (int row_px = kFirst; row_px <= kLast; ++row_px) {
    const ViewRow view = line.View(fan.camera, row_px);
    const auto rates = LampRates(renderer.Render(scene, stripes, eye, view), kLaser);
    for (std::size_t i = 0; i < rates.size(); ++i) {
      if (rates[i] == 0.0) continue;
      const double column = view.first_column + static_cast<double>(i);
      const Vector3 ray =
          camera.X_RC.linear() * vision::PixelRay(camera, {column, static_cast<double>(row_px)});
      const double range = -eye.z() / ray.z();
      const double solid_angle = view.gain[i] * camera.column_pitch_rad * camera.row_pitch_rad /
                                 (camera.X_RC.linear().transpose() * ray).x();
      const double area = solid_angle * range * range / -ray.z();
      const double radiance = rates[i] / (view.gain[i] * line.ElectronsPerRadiance());
      power_w += radiance * kPi / 0.35 * area;
    }
  }
  // Depression of the fan's rays, which start on the camera's lateral axis, as the lines see them.
  const auto depression = [&](double row_px) {
    return line.params.camera_pitch_rad + row_px * camera.row_pitch_rad;
  };
  const double lit_rad = depression(kLast + 0.5) - depression(kFirst - 0.5);
  ASSERT_LT(std::abs(depression(kLast + 0.5) + std::asin(fan.axis_R.z())), fan.half_fan_rad);
  ASSERT_LT(std::abs(depression(kFirst - 0.5) + std::asin(fan.axis_R.z())), fan.half_fan_rad);
  const LaserParams& laser = line.params.laser;
  const double expected_w =
      laser.input_power_w * laser.optical_efficiency * lit_rad / line.params.fan_rad;
  EXPECT_NEAR(power_w / expected_w, 1.0, 0.002);
}

// Three scanlines instead of a fan of 1 rad: the same light on 1 / 117 of the angle.
TEST(Radiometry, ThinBeamIsAHundredTimesBrighter) {
  LineView full{QuietParams(), Darkness()};
  LineView thin = full;
  thin.params.laser.fan = BeamFan::kThreeScanlines;
  const auto total = [](const LineView& line, int laser, int row_px) {
    const int camera = line.calibration.lasers[static_cast<std::size_t>(laser)].camera;
    const auto rates = LampRates(line.Render(FlatWith({}), PoseAt(0, 0, 0), camera, row_px), laser);
    return std::accumulate(rates.begin(), rates.end(), 0.0);
  };
  const double gain = full.params.fan_rad / (3.0 * full.params.row_pitch_rad());
  EXPECT_GT(gain, 100.0);
  for (int laser = 0; laser < 5; ++laser) {
    for (const int row_px : full.calibration.scanline_px) {
      EXPECT_NEAR(total(thin, laser, row_px) / total(full, laser, row_px), gain, 1e-9 * gain);
      // Nothing between the measured points.
      EXPECT_EQ(total(thin, laser, row_px + 4), 0.0);
      EXPECT_EQ(total(thin, laser, row_px - 4), 0.0);
      EXPECT_GT(total(full, laser, row_px + 4), 0.0);
    }
  }
}

}  // namespace
}  // namespace rockyard::sensing

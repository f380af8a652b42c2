#include "rendering/radiometry.h"

#include <algorithm>
#include <functional>
#include <numbers>

#include "math/functions.h"
#include "vision/lens.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

constexpr double kPlanck_j_s = 6.62607015e-34;     // SI, exact
constexpr double kSpeedOfLight_m_s = 299792458.0;  // SI, exact
constexpr double kNanometres = 1e9;                // per metre

}  // namespace

SunLight MakeSunLight(const SunParams& sun, double filter_width_m) {
  const double sine = math::Sin(sun.elevation_rad);
  SunLight light;
  light.toward_sun_W = Vector3(math::Cos(sun.elevation_rad) * math::Cos(sun.azimuth_rad),
                               math::Cos(sun.elevation_rad) * math::Sin(sun.azimuth_rad), sine);
  if (sine <= 0.0) return light;
  // Above the air, on a surface that faces the sun: E0 / d^2 w, with the inverse square of the
  // distance.
  const double above_w_m2 =
      sun.irradiance_w_m2_nm * filter_width_m * kNanometres / (sun.distance_au * sun.distance_au);
  // Beer-Lambert over the air mass 1 / sin h, good down to a sun some degrees above
  // the horizon.
  light.direct_w_m2 = above_w_m2 * math::Exp(-sun.optical_depth / sine);
  light.sky_w_m2 = sun.diffuse_share * (above_w_m2 - light.direct_w_m2) * sine;
  return light;
}

double SunRadiance(const SunLight& sun, double albedo, const Vector3& normal_W, bool sunlit) {
  // A plane tilted by t sees (1 + cos t) / 2 of an even sky.
  double irradiance_w_m2 = sun.sky_w_m2 * 0.5 * (1.0 + normal_W.z());
  if (sunlit) irradiance_w_m2 += sun.direct_w_m2 * std::max(0.0, normal_W.dot(sun.toward_sun_W));
  return albedo * std::numbers::inv_pi * irradiance_w_m2;
}

double ElectronsPerRadiance(const ImagerParams& imager, double pixel_m2, double wavelength_m) {
  const DetectorParams& detector = imager.detector();
  // Photons per joule: lambda / (h c).
  const double electrons_per_j = detector.quantum_efficiency * detector.fill_factor * wavelength_m /
                                 (kPlanck_j_s * kSpeedOfLight_m_s);
  // E = pi L T / (4 N^2) on the axis, times the pixel's area.
  return 0.25 * std::numbers::pi * pixel_m2 * imager.lens_transmission *
         imager.filter_transmission * electrons_per_j / (imager.f_number * imager.f_number);
}

double RelativeIllumination(const messages::Camera& camera, double column_px, double row_px) {
  const auto ray = [&](double column_shift, double row_shift) {
    return vision::PixelRay(camera, {column_px + column_shift, row_px + row_shift});
  };
  // Solid angle of a small pixel: area spanned by its unit rays' differences, |d_column x d_row|.
  const Vector3 across = ray(0.5, 0.0) - ray(-0.5, 0.0);
  const Vector3 down = ray(0.0, 0.5) - ray(0.0, -0.5);
  const double solid_angle = across.cross(down).norm();
  const double cosine = std::max(0.0, ray(0.0, 0.0).x());
  return solid_angle * cosine / (camera.column_pitch_rad * camera.row_pitch_rad);
}

double ExposureTime(const ImagerParams& imager, std::vector<double> rates_e_s) {
  const ExposureParams& exposure = imager.exposure;
  if (rates_e_s.empty()) return exposure.longest_s;
  const auto brighter =
      static_cast<std::size_t>(exposure.brightest_share * static_cast<double>(rates_e_s.size()));
  const auto nth = rates_e_s.begin() + static_cast<std::ptrdiff_t>(brighter);
  std::nth_element(rates_e_s.begin(), nth, rates_e_s.end(), std::greater<>());
  // t = target_fill W / (R + D), with R exceeded by brightest_share of the pixels.
  const double rate_e_s = *nth + imager.detector().dark_current_e_s;
  const double target_e = exposure.target_fill * imager.detector().full_well_e;
  // Written so that darkness divides nothing by zero.
  if (target_e >= rate_e_s * exposure.longest_s) return exposure.longest_s;
  return std::max(exposure.shortest_s, target_e / rate_e_s);
}

}  // namespace rockyard::rendering

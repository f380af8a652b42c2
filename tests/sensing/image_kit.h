// What the tests of the image formation share.
#pragma once

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"
#include "sensing/row_renderer.h"
#include "sensing/stripe_imager.h"
#include "sensing/stripe_layout_params.h"
#include "sensing/stripe_view_params.h"
#include "stripe_scene.h"

namespace rockyard::sensing {

// Everything that disturbs an image but the shot noise is off, and counts are fine.
inline LightStripeParams QuietParams() {
  LightStripeParams params;
  params.laser.speckle_contrast = 0.0;
  DetectorParams& ccd = params.imager.ccd;
  ccd.read_noise_e = 0.0;
  ccd.dark_current_e_s = 0.0;
  ccd.response_nonuniformity = 0.0;
  ccd.offset_nonuniformity_e = 0.0;
  ccd.adc_bits = 16;
  params.imager.exposure.repeatability = 0.0;
  return params;
}

inline SunParams Darkness() {
  SunParams sun;
  sun.irradiance_w_m2_nm = 0.0;
  return sun;
}

// What one line of a camera receives, without noise.
struct LineView {
  LightStripeParams params;
  SunParams sun;
  messages::StripeCalibration calibration = TrueCalibration(params);
  RoverBody body{rover::RoverGeometryParams{}};

  const messages::Camera& Camera(int camera) const {
    return calibration.cameras[static_cast<std::size_t>(camera)];
  }
  ViewRow View(int camera, int row) const {
    const messages::Camera& eye = Camera(camera);
    return MakeViewRow(eye, body, row, -eye.columns / 2, eye.columns);
  }
  RenderedRow Render(const terrain::Terrain& terrain, const math::Transform& X_WR, int camera,
                     int row) const {
    const SunLight light = MakeSunLight(sun, params.imager.filter_width_m);
    const ImageScene scene(terrain, X_WR, light, sun, body, SightOf(params));
    const RowRenderer renderer(params, calibration);
    return renderer.Render(renderer.Prepare(scene), Camera(camera).X_RC.translation(),
                           View(camera, row));
  }
};

// Light of one laser on each pixel of a line, electrons per second.
inline std::vector<double> LaserRates(const RenderedRow& row, int laser) {
  std::vector<double> rates(row.sun_e_s.size());
  for (const RenderedRow::LaserPixel& pixel : row.lasers) {
    if (pixel.laser == laser) rates[static_cast<std::size_t>(pixel.pixel)] += pixel.rate_e_s;
  }
  return rates;
}

// Every refusal names the field.
inline void ExpectRefused(const std::string& json, const std::string& field) {
  LightStripeParams params;
  try {
    core::ReadParams(core::ParseJson(json, "test"), params);
    FAIL() << "accepted " << json;
  } catch (const core::UserError& error) {
    EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
  }
}

}  // namespace rockyard::sensing

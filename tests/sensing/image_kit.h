// What the tests of the image formation share.
#pragma once

#include <gmock/gmock.h>

#include <string>

#include "core/archive.h"
#include "core/params_text.h"
#include "rendering/line_kit.h"
#include "rendering/quiet_imager.h"
#include "rendering/row_renderer.h"
#include "sensing/rover_parts.h"
#include "sensing/stripe_imager.h"
#include "sensing/stripe_layout_params.h"
#include "stripe_scene.h"

namespace rockyard::sensing {

using rendering::LampRates;
using rendering::RenderedRow;
using rendering::SunParams;
using rendering::ViewRow;

// Everything that disturbs an image but the shot noise is off, and counts are fine.
inline LightStripeParams QuietParams() {
  LightStripeParams params{.laser = {.speckle_contrast = 0.0}};
  rendering::Quieten(params.imager);
  return params;
}

inline SunParams Darkness() { return {.irradiance_w_m2_nm = 0.0}; }

// What one line of a camera receives, without noise.
struct LineView {
  LightStripeParams params;
  SunParams sun;
  messages::StripeCalibration calibration = TrueCalibration(params);
  rendering::RoverBody body = MakeRoverBody(rover::RoverGeometryParams{});

  const messages::Camera& Camera(int camera) const {
    return calibration.cameras[static_cast<std::size_t>(camera)];
  }
  ViewRow View(int camera, int row) const {
    const messages::Camera& eye = Camera(camera);
    return rendering::MakeViewRow(eye, body, row, -eye.columns / 2, eye.columns);
  }
  RenderedRow Render(const terrain::Terrain& terrain, const math::Transform& X_WR, int camera,
                     int row) const {
    const rendering::SunLight light = rendering::MakeSunLight(sun, params.imager.filter_width_m);
    const rendering::ImageScene scene(terrain, X_WR, light, sun, body, SightOf(params));
    const StripeLight lasers(params, calibration);
    return Renderer().Render(scene, lasers.Meet(scene), Camera(camera).X_RC.translation(),
                             View(camera, row));
  }
  rendering::RowRenderer Renderer() const {
    return {params.imager, params.pixel_m2(), params.laser.wavelength_m};
  }
  double ElectronsPerRadiance() const {
    return rendering::ElectronsPerRadiance(params.imager, params.pixel_m2(),
                                           params.laser.wavelength_m);
  }
};

// Every refusal names the field.
inline void ExpectRefused(const std::string& json, const std::string& field) {
  EXPECT_THAT(core::ProblemsOf<LightStripeParams>(json), testing::HasSubstr(field)) << json;
}

}  // namespace rockyard::sensing

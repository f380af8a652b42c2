#include "sensing/stripe_imager.h"

#include <algorithm>

#include "core/check.h"
#include "rendering/radiometry.h"
#include "sensing/rover_parts.h"
#include "sensing/stripe_layout_params.h"

namespace rockyard::sensing {
namespace {

// Of the middle line of each band, one pixel in so many is metered.
constexpr std::size_t kMeteredPixels = 8;

// Exposure control looks at sunlight alone: the image without lasers.
void Meter(const rendering::RenderedRow& row, std::vector<double>& rates_e_s) {
  for (std::size_t pixel = 0; pixel < row.sun_e_s.size(); pixel += kMeteredPixels) {
    rates_e_s.push_back(row.sun_e_s[pixel]);
  }
}

}  // namespace

StripeImager::StripeImager(const LightStripeParams& params, const rendering::SunParams& sun,
                           const rover::RoverGeometryParams& rover)
    : params_(params),
      sun_(sun),
      light_(rendering::MakeSunLight(sun, params.imager.filter_width_m)),
      body_(MakeRoverBody(rover)),
      calibration_(TrueCalibration(params)),
      stripe_light_(params, calibration_),
      renderer_(params.imager, params.pixel_m2(), params.laser.wavelength_m),
      readout_(params.imager, params.laser.speckle_contrast) {
  // Lines read on both sides of a scanline: half of those that are averaged, and a margin.
  const auto around = static_cast<int>(params.imager.averaging_rows / 2 +  //
                                       params.imager.margin_rows);
  for (int camera = 0; camera < 2; ++camera) {
    for (const int row : calibration_.scanline_px) {
      views_[static_cast<std::size_t>(camera)].push_back(
          MakeView(camera, row - around, row + around));
    }
  }
}

// Returns those of the lines from first_row to last_row that the image has.
StripeImager::View StripeImager::MakeView(int camera, int first_row, int last_row) const {
  const messages::Camera& eye = calibration_.cameras[static_cast<std::size_t>(camera)];
  View view;
  const int last = std::min(last_row, eye.last_row());
  for (int row = std::max(first_row, eye.first_row()); row <= last; ++row) {
    view.push_back(rendering::MakeViewRow(eye, body_, row, eye.image_columns().first, eye.columns));
  }
  ENSURE(!view.empty());
  return view;
}

math::Vector3 StripeImager::EyeOf(int camera) const {
  return calibration_.cameras[static_cast<std::size_t>(camera)].X_RC.translation();
}

// Returns the light on each line, and the pattern of its pixels, which stays for the trial.
StripeImager::Light StripeImager::Render(const rendering::ImageScene& scene,
                                         const LitStripes& stripes, int camera, const View& view,
                                         core::TrialKey key) const {
  Light light;
  for (const rendering::ViewRow& row : view) {
    light.rows.push_back(renderer_.Render(scene, stripes, EyeOf(camera), row));
    light.patterns.push_back(
        readout_.Pattern(camera, row.row, row.first_column, row.columns(), key));
  }
  return light;
}

messages::ImageBand StripeImager::Read(const Light& light, double exposure_s, core::TrialKey key,
                                       const StripeImageName& name) const {
  const messages::Camera& eye = calibration_.cameras[static_cast<std::size_t>(name.camera)];
  messages::ImageBand band;
  band.first_row = light.rows.front().row;
  band.first_column = eye.image_columns().first;
  band.rows = static_cast<int>(light.rows.size());
  band.columns = eye.columns;
  const std::vector<bool> lasers_on = LasersOn(name);
  // Lines in the order of rows, each with all columns.
  band.counts.reserve(light.rows.size() * static_cast<std::size_t>(eye.columns));
  for (std::size_t i = 0; i < light.rows.size(); ++i) {
    readout_.Read(light.rows[i], light.patterns[i], band.first_column, exposure_s, key,
                  name.number(), lasers_on, band.counts);
  }
  return band;
}

// Reads the same light twice: with the lasers of one group, and without lasers for an exposure time
// that nearly repeats the first one.
messages::StripeExposure StripeImager::ReadPair(std::span<const Light> bands, double exposure_s,
                                                core::TrialKey key, StripeImageName name) const {
  messages::StripeExposure exposure{name.camera, name.group, {}, {}};
  name.lit = true;
  for (const Light& band : bands) exposure.lit.push_back(Read(band, exposure_s, key, name));
  name.lit = false;
  const double dark_s = readout_.RepeatedTime(exposure_s, key, name.number());
  for (const Light& band : bands) exposure.dark.push_back(Read(band, dark_s, key, name));
  return exposure;
}

// Returns which lasers are on: in a lit image those of its group.
std::vector<bool> StripeImager::LasersOn(const StripeImageName& name) const {
  std::vector<bool> on;
  for (const messages::StripeLaser& laser : calibration_.lasers) {
    on.push_back(name.lit && laser.group == name.group);
  }
  return on;
}

// A camera is read for a group only if it measures one of its stripes.
bool StripeImager::FindsStripe(int camera, int group) const {
  return std::any_of(calibration_.lasers.begin(), calibration_.lasers.end(),
                     [=](const messages::StripeLaser& laser) {
                       return laser.camera == camera && laser.group == group;
                     });
}

messages::StripeImages StripeImager::Expose(const terrain::Terrain& terrain,
                                            const math::Transform& X_WR, core::TrialKey key,
                                            std::int64_t scan_number) const {
  EXPECT(scan_number >= 0 && scan_number < StripeImageName::kScans);
  const rendering::ImageScene scene(terrain, X_WR, light_, sun_, body_, SightOf(params_));
  const LitStripes stripes = stripe_light_.Meet(scene);
  std::array<std::vector<Light>, 2> bands;
  std::vector<double> metered_e_s;
  for (int camera = 0; camera < 2; ++camera) {
    const auto c = static_cast<std::size_t>(camera);
    for (const View& view : views_[c]) {
      bands[c].push_back(Render(scene, stripes, camera, view, key));
      // The scanline itself is the middle line of its band.
      Meter(bands[c].back().rows[view.size() / 2], metered_e_s);
    }
  }
  messages::StripeImages images;
  images.number = scan_number;
  // One exposure time for all images of the scan, from both cameras' sunlight.
  images.exposure_s = rendering::ExposureTime(params_.imager, std::move(metered_e_s));
  images.electrons_per_count = readout_.electrons_per_count();
  for (int group = 0; group < LaserGroups(params_); ++group) {
    for (int camera = 0; camera < 2; ++camera) {
      if (!FindsStripe(camera, group)) continue;
      images.exposures.push_back(ReadPair(bands[static_cast<std::size_t>(camera)],
                                          images.exposure_s, key,
                                          {scan_number, camera, group, false}));
    }
  }
  return images;
}

messages::StripeExposure StripeImager::FullFrame(const terrain::Terrain& terrain,
                                                 const math::Transform& X_WR, core::TrialKey key,
                                                 std::int64_t scan_number, int camera,
                                                 int group) const {
  EXPECT(scan_number >= 0 && scan_number < StripeImageName::kScans);
  EXPECT(camera == 0 || camera == 1);
  const rendering::ImageScene scene(terrain, X_WR, light_, sun_, body_, SightOf(params_));
  const LitStripes stripes = stripe_light_.Meet(scene);
  std::vector<double> metered_e_s;
  for (int i = 0; i < 2; ++i) {
    for (const View& view : views_[static_cast<std::size_t>(i)]) {
      Meter(renderer_.Render(scene, stripes, EyeOf(i), view[view.size() / 2]), metered_e_s);
    }
  }
  // The exposure of the bands that Expose would read: the picture shows what the rover would see.
  const double exposure_s = rendering::ExposureTime(params_.imager, std::move(metered_e_s));
  const messages::Camera& eye = calibration_.cameras[static_cast<std::size_t>(camera)];
  const Light frame =
      Render(scene, stripes, camera, MakeView(camera, eye.first_row(), eye.last_row()), key);
  return ReadPair({&frame, 1}, exposure_s, key, {scan_number, camera, group, false});
}

}  // namespace rockyard::sensing

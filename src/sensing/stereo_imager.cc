#include "sensing/stereo_imager.h"

#include <cmath>
#include <limits>
#include <utility>

#include "core/check.h"
#include "rendering/picture/picture.h"
#include "rendering/picture/picture_renderer.h"
#include "sensing/rover_parts.h"
#include "vision/cameras/rig_drift.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;
using messages::LookDirection;
using vision::Image;

constexpr std::int64_t kMostLooks = std::int64_t{1} << 30;

}  // namespace

StereoImager::StereoImager(const StereoParams& params, const rendering::SunParams& sun,
                           const rendering::LookParams& look,
                           const rover::RoverGeometryParams& rover, core::TrialKey key)
    : sun_(sun),
      look_(look),
      camera_(params.images.camera),
      key_(key),
      body_(MakeRoverBody(rover)),
      ahead_(MakePair(params, LookDirection::kAhead, key)),
      behind_(MakePair(params, LookDirection::kBehind, key)) {}

StereoImager::Pair StereoImager::MakePair(const StereoParams& params, LookDirection direction,
                                          core::TrialKey key) const {
  const auto [left, right] = CalibratedCameras(params, direction);
  const int first = direction == LookDirection::kAhead ? 0 : 2;  // cameras of a rover count from 0
  const auto eye = [&](const vision::CameraModel& camera, int number) {
    rendering::PixelRays rays(camera);
    rendering::PictureReadout readout(camera_, rays, number, key);
    return Eye{std::move(rays), std::move(readout)};
  };
  core::RandomStream stream(key, core::Purpose::kRigDrift, static_cast<std::uint32_t>(first / 2));
  const vision::CameraModel true_right =
      vision::DriftedRight(left, right, vision::DrawRigDrift(params.images.drift, stream));
  return {true_right, {eye(left, first), eye(true_right, first + 1)}};
}

rendering::PictureScene StereoImager::SceneOf(const terrain::Terrain& terrain,
                                              const math::Transform& X_WR) const {
  return {terrain, sun_, look_, camera_.imager.filter_width_m, {&body_, X_WR}};
}

rendering::Picture StereoImager::Render(const rendering::PictureScene& scene, const Eye& eye,
                                        const math::Transform& X_WR,
                                        rendering::TerrainLook& look) const {
  rendering::Picture picture(eye.rays.columns(), eye.rays.rows());
  const rendering::PictureRenderer renderer(scene, look_, eye.rays, X_WR);
  renderer.RenderRows(0, picture.rows(), look, picture);
  return picture;
}

StereoImages StereoImager::Expose(const terrain::Terrain& terrain, const math::Transform& X_WR,
                                  std::int64_t look_number, LookDirection direction) const {
  EXPECT(look_number >= 0 && look_number < kMostLooks);
  const Pair& pair = PairOf(direction);
  const rendering::PictureScene scene = SceneOf(terrain, X_WR);
  rendering::TerrainLook look(terrain, sun_, look_, key_);
  StereoImages images;
  for (std::size_t i = 0; i < pair.eyes.size(); ++i) {
    const Eye& eye = pair.eyes[i];
    const Image<float> rates_e_s = eye.readout.Rates(Render(scene, eye, X_WR, look));
    if (i == 0) images.exposure_s = eye.readout.Exposure(rates_e_s);
    const auto number = static_cast<rendering::ImageNumber>(2 * look_number + static_cast<int>(i));
    const rendering::RawImage raw = eye.readout.Read(rates_e_s, images.exposure_s, number);
    (i == 0 ? images.left : images.right) =
        rendering::ToGray(raw.counts, static_cast<int>(camera_.imager.detector().adc_bits));
  }
  return images;
}

Image<float> StereoImager::TrueDisparities(const terrain::Terrain& terrain,
                                           const math::Transform& X_WR,
                                           LookDirection direction) const {
  const Pair& pair = PairOf(direction);
  const rendering::PictureScene scene = SceneOf(terrain, X_WR);
  rendering::TerrainLook look(terrain, sun_, look_, key_);
  const Eye& left = pair.eyes[0];
  const rendering::StereoTruth truth = rendering::SeenFromOtherEye(
      scene, Render(scene, left, X_WR, look), left.rays, X_WR, pair.true_right);
  Image<float> disparities(left.rays.columns(), left.rays.rows(),
                           std::numeric_limits<float>::quiet_NaN());
  for (int row = 0; row < disparities.height(); ++row) {
    for (int column = 0; column < disparities.width(); ++column) {
      if (truth.other.At(column, row) != rendering::OtherEye::kVisible) continue;
      disparities.At(column, row) = static_cast<float>(column - truth.other_column.At(column, row));
    }
  }
  return disparities;
}

}  // namespace rockyard::sensing

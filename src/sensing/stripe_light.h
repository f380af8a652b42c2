// The lasers of the light stripe sensor as lamps of a rendered image.
#pragma once

#include <utility>
#include <vector>

#include "messages/calibration.h"
#include "rendering/image_scene.h"
#include "rendering/row_renderer.h"
#include "sensing/beam_profile.h"
#include "sensing/laser_fan.h"
#include "sensing/light_stripe_params.h"

namespace rockyard::sensing {

// The stripes in one scene, integrated over each pixel in closed form. The light of a laser on a
// pixel on one surface, with the angles a, b of its edges out of the light plane, seen from the
// emitter, is
//   E = P / (F r^2) cos(i) (C(b) - C(a)) / (b - a),
// C the cumulative cross section of the beam; P / (F r^2) cos(i) (laser_fan.h) is the mean of the
// two edges. The pixels of a line share the edges, so that the sum over them loses no light.
//
// Deviation: a pixel is sampled along the middle of its line, so that a stripe which runs across
// the line is as wide as it is there (those of the default layout move by 0.1 to 0.2 columns from
// line to line).
class LitStripes final : public rendering::Lamps {
 public:
  // The fans must not outlive their scene, nor this the beam.
  LitStripes(const BeamCrossSection& beam, std::vector<LitFan> fans)
      : beam_(beam), fans_(std::move(fans)) {}

  void Add(const rendering::SurfacePoint& left, const rendering::SurfacePoint& right, int pixel,
           double gain, rendering::RenderedRow& row) const override;

 private:
  const BeamCrossSection& beam_;
  std::vector<LitFan> fans_;
};

// All lasers of the sensor.
class StripeLight {
 public:
  StripeLight(const LightStripeParams& params, const messages::StripeCalibration& calibration);

  // Finds what each laser may light in the scene. The stripes must outlive neither that nor this.
  LitStripes Meet(const rendering::ImageScene& scene) const;

 private:
  std::vector<LaserFan> fans_;
  BeamCrossSection beam_;
};

}  // namespace rockyard::sensing

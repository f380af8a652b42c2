// The cameras of the light stripe sensor: images with and without laser light of a true scene.
// Drives at the image fidelity look by it; captures of a scan show its whole images.
//
// Image formation, in the order in which a scan runs through it (equations beside the code):
//   radiometry     sun and sky in the passband, camera equation           radiometry.h
//   view           lens, the rover's own parts                    row_renderer.h, rover_body.h
//   scene          what a ray meets, shadows                              image_scene.h
//   light          sunlight on each pixel                                 row_renderer.h
//                  laser stripes on each pixel                            sensing/stripe_light.h
//   exposure       time from the bright pixels of the image without laser radiometry.h
//   readout        shot, read, dark and pattern noise, saturation, counts image_readout.h
// All but the lasers is common to all cameras (src/rendering).
//
// Matthies 1995, section 6: for each group of lasers an image with them on and one with all off,
// differenced on board. Table 3 gives imager, lens and lasers; what it leaves out is assumed, so
// that results from these images are sensitivities to those assumptions, not predictions.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "math/pose.h"
#include "messages/calibration.h"
#include "messages/stripe_images.h"
#include "rendering/image_readout.h"
#include "rendering/image_scene.h"
#include "rendering/rover_body.h"
#include "rendering/row_renderer.h"
#include "rendering/sun_params.h"
#include "rover/rover_geometry_params.h"
#include "sensing/light_stripe_params.h"
#include "sensing/stripe_light.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

// Names an image of a trial. Names must give different numbers, as images with the same number
// share their noise; records depend on the numbers. Each scan has 64 of them, so that 2^26 scans
// use up the 32 bits.
struct StripeImageName {
  static constexpr std::int64_t kScans = std::int64_t{1} << 26;  // that have names of their own

  std::int64_t scan = 0;
  int camera = 0;
  int group = 0;
  bool lit = false;

  rendering::ImageNumber number() const {
    constexpr std::int64_t kGroups = 16;
    return static_cast<rendering::ImageNumber>(((scan * 2 + camera) * kGroups + group) * 2 +
                                               (lit ? 1 : 0));
  }
};

// The sensor at the image fidelity.
class StripeImager {
 public:
  // Making one costs 6 ms and 1.3 MB for the default bands.
  StripeImager(const LightStripeParams& params, const rendering::SunParams& sun,
               const rover::RoverGeometryParams& rover);

  // Makes one scan with the rover at X_WR: for each group of lasers and each camera that measures a
  // stripe of that group, it returns the image lines around each scanline (imager.averaging_rows
  // and margin_rows), all columns. Lines beyond the image are left out; where fidelity is image,
  // BandsFitTheImage is required, and all are there. It is a pure function of its arguments. It
  // draws from (kImageNoise, kImageExposure, kImageSpeckle; scan number) and (kPixelPattern):
  // neighbouring scans share nothing but the pattern of the imagers. scan_number < 2^26. Cost: 3 to
  // 6 ms on a plane, mostly rays and noise; 95 ms on rough ground, where every ray marches.
  messages::StripeImages Expose(const terrain::Terrain& terrain, const math::Transform& X_WR,
                                core::TrialKey key, std::int64_t scan_number) const;

  // Returns the whole image of one camera with one group of lasers on, for pictures. The lines that
  // Expose also takes must be the same, bit for bit. Cost: 0.12 s.
  messages::StripeExposure FullFrame(const terrain::Terrain& terrain, const math::Transform& X_WR,
                                     core::TrialKey key, std::int64_t scan_number, int camera,
                                     int group) const;

  // Returns the geometry of the true sensor.
  const messages::StripeCalibration& calibration() const { return calibration_; }

 private:
  // A View holds the rays of consecutive image lines of one camera, a Light what falls on them.
  using View = std::vector<rendering::ViewRow>;
  struct Light {
    std::vector<rendering::RenderedRow> rows;
    std::vector<rendering::PixelPattern> patterns;
  };

  View MakeView(int camera, int first_row, int last_row) const;
  math::Vector3 EyeOf(int camera) const;
  Light Render(const rendering::ImageScene& scene, const LitStripes& stripes, int camera,
               const View& view, core::TrialKey key) const;
  messages::ImageBand Read(const Light& light, double exposure_s, core::TrialKey key,
                           const StripeImageName& name) const;
  messages::StripeExposure ReadPair(std::span<const Light> bands, double exposure_s,
                                    core::TrialKey key, StripeImageName name) const;
  bool FindsStripe(int camera, int group) const;
  std::vector<bool> LasersOn(const StripeImageName& name) const;

  LightStripeParams params_;
  rendering::SunParams sun_;
  rendering::SunLight light_;
  rendering::RoverBody body_;
  messages::StripeCalibration calibration_;
  StripeLight stripe_light_;
  rendering::RowRenderer renderer_;
  rendering::ImageReadout readout_;
  std::array<std::vector<View>, 2> views_;  // by camera; one for each scanline
};

}  // namespace rockyard::sensing

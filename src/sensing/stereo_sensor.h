// Range points from the stereo cameras at the rover's front and rear, without images: the sensor at
// the fidelities ideal and error_model. Drives see terrain by it, and studies of stereo measure it.
// Records depend on its draws and on the order of steps in Match.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/random.h"
#include "math/pose.h"
#include "messages/point_cloud.h"
#include "sensing/stereo_depth.h"
#include "sensing/stereo_params.h"
#include "sensing/stereo_view.h"
#include "sensing/sun_shade.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

// Turns the disparities of an image, px, into what matching makes of them: noise, rounding, wrong
// matches, the range of disparities searched, margins, dropouts. A pixel is 0 where there is no
// match. StereoGroundTruth counts by the same jumps, margins and shade.
class StereoMatcher {
 public:
  explicit StereoMatcher(const StereoParams& params);

  // `seen` holds the disparities of what both cameras see, `all` those of what the left camera
  // sees: jumps in depth are taken from `all`. `shaded` marks the pixels outside of the sun; it is
  // empty where shade does not matter. Draws by pixel from (key, kStereoDisparity, kStereoMismatch
  // and kStereoDropout, look).
  void Match(core::TrialKey key, std::uint32_t look, const DepthImage& all, DepthImage& seen,
             const PixelFlags& shaded = {}) const;

 private:
  class Draws;

  void MatchRow(const Draws& draws, int row, const DepthImage& all, DepthImage& seen,
                const PixelFlags& shaded) const;
  void AddNoise(const Draws& draws, int row, std::span<double> row_px) const;
  void Mismatch(const Draws& draws, int row, std::span<const double> all_px,
                std::span<double> row_px) const;
  void MismatchEdge(std::span<const double> row_px, std::size_t column, int jump,
                    double& pixel) const;
  void DropMargins(bool edge_row, std::span<double> row_px) const;
  void DropOut(const Draws& draws, int row, std::span<const double> all_px,
               std::span<const bool> shaded, std::span<double> row_px) const;

  StereoParams params_;
  float mismatch_quantile_;  // standard normal numbers below it are wrong matches
  // Numbers from mismatch_quantile_ up to this one, beside a jump, match the other surface.
  float edge_mismatch_quantile_;
  // So many of the least cells of PixelNoise drop out: [beside a jump][in shadow].
  std::array<std::array<std::uint32_t, 2>, 2> dropout_cells_;
};

// The sensor. It gives one point for each pixel of the left image for which all of the following
// hold:
//  - its ray meets a surface within max_range_m;
//  - the right camera sees that point too: it lies inside its image, with nothing in between;
//  - its measured disparity lies between min_ and max_disparity_px. The true disparity is d = f b /
//    Z (Goldberg 2002, section 2), with Z the depth along the optical axis. It is changed by N(0,
//    disparity_noise_px) and rounded to disparity_step_px. With mismatch_probability it is wrong
//    altogether; beside a jump in depth it is, with edge_mismatch_probability, that of the other
//    surface. The point is put on the same ray at the depth f b / d of the measured disparity d, so
//    that to first order sigma_Z = Z^2 sigma_d / (f b);
//  - it does not lie within margin_px of an image's edge;
//  - it did not drop out, with dropout_probability or edge_dropout_probability, in shadow with
//    shadow_dropout_probability on top.
// The ideal sensor stops after the first condition. With field_of_view stripe, points outside the
// window are dropped last.
//
// Limits: the rover's own body is not seen. By default errors are independent from pixel to pixel,
// while matching windows make those of neighbours alike (noise_window_px) and round off edges.
// Nothing depends on texture, and of light only dropouts in shadow. Surfaces beyond max_range_m
// give no point, but noise may put a point farther away.
//
// Cost: 0.2 to 0.3 ms a look of 128 x 128 in nominal and VL-2 terrain, 36 ms on rough ground.
class StereoSensor {
 public:
  explicit StereoSensor(const StereoParams& params);
  // Makes a sensor that knows of shade, which only shadow_dropout_probability asks for.
  StereoSensor(const StereoParams& params, const SunShade& shade);

  // Takes one look with the rover at X_WR. It is a pure function of its arguments. It draws by
  // pixel from (key, kStereoDisparity, kStereoMismatch and kStereoDropout, look number): at most
  // 2^32 looks.
  messages::PointCloud Look(const terrain::Terrain& terrain, const math::Transform& X_WR,
                            core::TrialKey key, std::int64_t look_number,
                            messages::LookDirection direction) const;

  // Returns the measurement alone: one over the depths of a look's pixels, 1/m, 0 where there is no
  // point. Look makes its points of it by PointsOf; on-board code does so with the depths of a
  // drive.
  DepthImage InverseDepths(const terrain::Terrain& terrain, const math::Transform& X_WR,
                           core::TrialKey key, std::int64_t look_number,
                           messages::LookDirection direction) const;

  const StereoView& view_R(messages::LookDirection direction) const {
    return direction == messages::LookDirection::kAhead ? ahead_R_ : behind_R_;
  }

 private:
  PixelFlags Shaded(const terrain::Terrain& terrain, const math::Transform& X_WR,
                    const StereoView& view_W, const DepthImage& seen) const;

  StereoParams params_;
  StereoMatcher matcher_;
  std::optional<SunShade> shade_;  // none where light does not matter
  StereoView ahead_R_;
  StereoView behind_R_;
};

}  // namespace rockyard::sensing
